//! Sine and cosine for the angle front doors, of single numbers and in lanes: additions and multiplications only, so that
//! every build on every host has the same bits.
//!
//! An angle `|x|` is n quarter turns and a rest r, at most an eighth of a turn (Cody and Waite: pi/2 in parts so short that
//! products of n and all but the last are exact; what r loses stands in a second number). Polynomials give sine and cosine
//! of r, n says which is which and their signs, and the sign of x is put back at the end: sine is exactly odd, cosine
//! exactly even.
//!
//! | | `f64` | `f32` |
//! |-|-|-|
//! | reduced so, rad | up to 3200 | up to 800 |
//! | beyond | libm, which reduces any angle exactly | the same |
//! | error, units in the last place | below 0.85 | below 0.85 |
//!
//! `tests/trigonometry` compares with values to 32 digits, and has the script that made these and the numbers here.

use crate::float::Scalar;
use crate::lanes::{Instructions, Kernel, Lanes, Number};

/// What a type of number needs.
#[derive(Debug)]
pub struct Constants {
    /// Larger angles are left to libm.
    largest: f64,
    /// The sum with so large a number is a whole one, which then stands in its last bits.
    round: f64,
    /// Parts of pi/2: the first, from whose subtraction no error comes; those between; the last.
    parts: (f64, &'static [f64], f64),
    /// `(sin r/r - 1)/r^2` by powers of `r^2`.
    sine: &'static [f64],
    /// `(cos r - 1 + r^2/2)/r^4` by powers of `r^2`.
    cosine: &'static [f64],
}

pub(crate) const OF_F64: Constants = Constants {
    largest: 3200.0,
    // 1.5 x 2^52
    round: 6_755_399_441_055_744.0,
    // 42 bits, 42 bits, the rest.
    parts: (1.570_796_326_794_607, &[2.896_073_971_621_817_5e-13], 1.644_625_693_632_425_8e-26),
    sine: &[
        -0.166_666_666_666_666_3,
        0.008_333_333_333_322_108,
        -0.000_198_412_698_295_801_66,
        2.755_731_361_801_742_4e-6,
        -2.505_074_721_820_226_7e-8,
        1.589_619_763_583_410_4e-10,
    ],
    cosine: &[
        0.041_666_666_666_666_595,
        -0.001_388_888_888_887_304,
        2.480_158_728_884_137_7e-5,
        -2.755_731_417_623_35e-7,
        2.087_570_041_524_503e-9,
        -1.135_851_391_011_358_7e-11,
    ],
};

pub(crate) const OF_F32: Constants = Constants {
    largest: 800.0,
    // 1.5 x 2^23
    round: 12_582_912.0,
    // Three times 15 bits, the rest.
    parts: (
        1.570_739_746_093_75,
        &[5.657_970_905_303_955e-5, 9.920_881_893_776_823e-10],
        5.390_302_858_158_119e-15,
    ),
    sine: &[
        -0.166_666_666_407_761_9,
        0.008_333_329_302_413_307,
        -0.000_198_393_114_844_403_65,
        2.718_114_110_273_205e-6,
    ],
    cosine: &[0.041_666_645_670_155_2, -0.001_388_731_561_651_562_5, 2.443_308_269_072_604e-5],
};

/// Sine and cosine of angles in radians, in this order; NaN where they are not finite.
#[inline(always)]
pub(crate) fn sine_cosine<T: Lanes>(x: T) -> (T, T) {
    let near = x.absolute().less_than(T::constant(T::Number::SINE_COSINE.largest));
    if T::bits(near) == u32::MAX >> (32 - T::COUNT) { of_near(x) } else { with_libm(x) }
}

/// [`sine_cosine`] where all angles are below the largest one.
#[inline(always)]
pub(crate) fn of_near<T: Lanes>(x: T) -> (T, T) {
    let Constants { round, parts: (first, between, last), .. } = T::Number::SINE_COSINE;
    let size = x.absolute();
    let sum = size * T::constant(core::f64::consts::FRAC_2_PI) + T::constant(*round);
    let quarter_turns = sum - T::constant(*round);
    let mut rest = size - quarter_turns * T::constant(*first);
    let mut lost = T::constant(0.0);
    for part in *between {
        let part = quarter_turns * T::constant(*part);
        let difference = rest - part;
        let taken = rest - difference;
        lost = lost + ((rest - (difference + taken)) + (taken - part));
        rest = difference;
    }
    lost = lost - quarter_turns * T::constant(*last);
    let (sine, cosine) = of_rest(rest, lost);
    T::turned(sine, cosine, sum, x)
}

/// [`sine_cosine`] of a single number. Below an eighth of a turn, where platforms stay, that is nothing but the polynomials.
#[inline]
pub(crate) fn of_one<S: Lanes<Number = S>>(x: S) -> (S, S) {
    let size = x.absolute();
    if S::bits(size.less_than(S::constant(core::f64::consts::FRAC_PI_4))) == 1 {
        let (sine, cosine) = of_rest(size, S::constant(0.0));
        return S::turned(sine, cosine, S::constant(0.0), x);
    }
    sine_cosine(x)
}

/// Those of three numbers, in lanes if they are not too many.
#[inline]
pub(crate) fn of_three<S: Number + Lanes<Number = S>>(x: &[S; 3]) -> [(S, S); 3] {
    Instructions::of_single_states().run(OfThree(x))
}

struct OfThree<'a, S>(&'a [S; 3]);

impl<S: Number + Lanes<Number = S>> Kernel<S> for OfThree<'_, S> {
    type Output = [(S, S); 3];

    #[inline(always)]
    fn run<T: Lanes<Number = S>>(self) -> Self::Output {
        let [a, b, c] = self.0;
        if T::COUNT < 3 {
            return [of_one(*a), of_one(*b), of_one(*c)];
        }
        let (sine, cosine) = sine_cosine(T::load(self.0));
        let (mut sines, mut cosines) = ([S::constant(0.0); 3], [S::constant(0.0); 3]);
        sine.store(&mut sines);
        cosine.store(&mut cosines);
        let ([a, b, c], [d, e, f]) = (sines, cosines);
        [(a, d), (b, e), (c, f)]
    }
}

/// Angles of hundreds of turns, or none.
#[inline(always)]
fn with_libm<T: Lanes>(x: T) -> (T, T) {
    let mut angles = [T::Number::constant(0.0); MOST_LANES];
    x.for_each(|lane, angle| angles[lane] = angle);
    let (sines, cosines) = each_with_libm(&angles);
    (T::from_fn(|lane| sines[lane]), T::from_fn(|lane| cosines[lane]))
}

/// The largest [`Lanes::COUNT`].
const MOST_LANES: usize = 16;

#[cold]
#[inline(never)]
fn each_with_libm<S: Number>(angles: &[S; MOST_LANES]) -> ([S; MOST_LANES], [S; MOST_LANES]) {
    let mut found = (*angles, *angles);
    for ((sine, cosine), angle) in found.0.iter_mut().zip(&mut found.1).zip(angles) {
        // What is near keeps its bits beside what is far.
        let near = angle.abs() < S::constant(S::SINE_COSINE.largest);
        (*sine, *cosine) = if near { angle.sine_cosine_of_near() } else { angle.sine_cosine_of_libm() };
    }
    found
}

/// Sine and cosine of `rest + lost`, at most an eighth of a turn, `lost` tiny:
/// `sin(r + l) = r + r^3 p(r^2) + l cos r` and `cos(r + l) = 1 - r^2/2 + r^4 q(r^2) - l sin r`.
#[inline(always)]
fn of_rest<T: Lanes>(rest: T, lost: T) -> (T, T) {
    let Constants { sine, cosine, .. } = T::Number::SINE_COSINE;
    let (one, square) = (T::constant(1.0), rest * rest);
    let half = T::constant(0.5) * square;
    let most = one - half;
    let rounding = (one - most) - half;
    (
        rest + (square * rest * polynomial(sine, square) + lost * most),
        most + (rounding + (square * square * polynomial(cosine, square) - lost * rest)),
    )
}

/// Two terms at a time: half the chain of operations that wait for each other.
#[inline(always)]
fn polynomial<T: Scalar>(coefficients: &[f64], x: T) -> T {
    let square = x * x;
    let mut value = T::constant(0.0);
    for (k, pair) in coefficients.chunks(2).rev().enumerate() {
        let term = match *pair {
            [even, odd] => T::constant(even) + T::constant(odd) * x,
            [even, ..] => T::constant(even),
            [] => T::constant(0.0),
        };
        value = if k == 0 { term } else { value * square + term };
    }
    value
}
