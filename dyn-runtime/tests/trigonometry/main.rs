//! Sine and cosine against values to 32 digits (`exact.txt`, made by `exact.py`) and against the host's, their symmetry, and
//! that no build has bits of its own.

use dyn_runtime::Real;
use dyn_runtime::float::sin_cos;
use dyn_runtime::lanes::{self, Instructions, Kernel, Lanes, Number};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

/// Units in the last place that an `f64` may be wrong.
const F64_ERROR: f64 = 0.85;
/// The same of an `f32`.
const F32_ERROR: f64 = 0.85;

/// An angle, its sine and its cosine; each of these is a number and what it lacks.
struct Exact {
    angle: f64,
    sine: [f64; 2],
    cosine: [f64; 2],
}

fn exact() -> Vec<Exact> {
    let line = |line: &str| {
        let numbers: Vec<f64> = line.split(' ').map(|number| number.parse().expect("a number")).collect();
        let [angle, a, b, c, d] = numbers[..] else { panic!("five numbers: {line}") };
        Exact { angle, sine: [a, b], cosine: [c, d] }
    };
    include_str!("exact.txt").lines().map(line).collect()
}

/// Distance to the next larger magnitude among numbers with so many bits in the mantissa, the least of which has the exponent
/// `least`.
fn unit(x: f64, digits: i32, least: i32) -> f64 {
    let exponent = if x == 0.0 { least } else { x.abs().log2().floor() as i32 };
    2.0_f64.powi(exponent.max(least)) * 2.0_f64.powi(1 - digits)
}

/// Error in units in the last place of an `f64`.
fn f64_error(found: f64, [exact, rest]: [f64; 2]) -> f64 {
    ((found - exact) - rest).abs() / unit(exact, 53, -1022)
}

/// Error in units in the last place of an `f32`.
fn f32_error(found: f32, exact: f64) -> f64 {
    (f64::from(found) - exact).abs() / unit(exact, 24, -126)
}

#[test]
fn double_precision_against_many_digits() {
    let mut worst = 0.0_f64;
    let exact = exact();
    assert!(exact.len() > 700);
    for Exact { angle, sine, cosine } in exact {
        let (sin, cos) = sin_cos(angle);
        let error = f64_error(sin, sine).max(f64_error(cos, cosine));
        assert!(error < F64_ERROR, "{angle:e}: {error} units");
        worst = worst.max(error);
    }
    println!("largest error of f64: {worst:.3} units in the last place");
}

#[test]
fn single_precision_against_many_digits() {
    let mut worst = 0.0_f64;
    let mut count = 0;
    for Exact { angle, sine, cosine } in exact() {
        // Those angles that single precision can hold, and hence not those near multiples of pi/2 in double precision.
        if f64::from(angle as f32) != angle {
            continue;
        }
        let (sin, cos) = sin_cos(angle as f32);
        let error = f32_error(sin, sine[0]).max(f32_error(cos, cosine[0]));
        assert!(error < F32_ERROR, "{angle:e}: {error} units");
        worst = worst.max(error);
        count += 1;
    }
    assert!(count > 100, "{count}");
    println!("largest error of f32: {worst:.3} units in the last place");
}

/// The host's is wrong by little more than half a unit, ours by less than 0.85: they are neighbours at most.
#[test]
fn double_precision_beside_the_host() {
    let mut random = Pcg64::seed_from_u64(2);
    let mut differ = 0;
    const ANGLES: usize = 1_000_000;
    for k in 0..ANGLES {
        let size = if k.is_multiple_of(2) { 3.2 } else { 3300.0 };
        let angle: f64 = random.random_range(-size..size);
        let (found, host) = (sin_cos(angle), angle.sin_cos());
        for (found, host) in [(found.0, host.0), (found.1, host.1)] {
            let apart = found.to_bits().abs_diff(host.to_bits());
            assert!(apart <= 1, "{angle:e}: {found:e} {host:e}");
            differ += apart;
        }
    }
    println!("{differ} of {} differ from the host's by one unit", 2 * ANGLES);
}

/// Every `step`-th number in single precision up to 1000 rad, against the host's double precision.
fn single_precision_beside_the_host(step: usize) {
    let mut worst = (0.0_f64, 0.0_f32);
    for bits in (0..=1000.0_f32.to_bits()).step_by(step) {
        let angle = f32::from_bits(bits);
        let ((sin, cos), (exact_sin, exact_cos)) = (sin_cos(angle), f64::from(angle).sin_cos());
        let error = f32_error(sin, exact_sin).max(f32_error(cos, exact_cos));
        if error > worst.0 {
            worst = (error, angle);
        }
    }
    println!("largest error of f32: {:.3} units in the last place, at {:e} rad", worst.0, worst.1);
    assert!(worst.0 < F32_ERROR, "{worst:?}");
}

#[test]
fn some_single_precision_beside_the_host() {
    single_precision_beside_the_host(1009);
}

/// A minute in a release build.
#[test]
#[ignore = "long: all of single precision"]
fn all_single_precision_beside_the_host() {
    single_precision_beside_the_host(1);
}

#[test]
fn sine_is_odd_and_cosine_even() {
    let mut random = Pcg64::seed_from_u64(3);
    let any_bits = std::iter::repeat_with(|| f64::from_bits(random.random())).take(100_000);
    let edges = [0.0, f64::MIN_POSITIVE, 1.0, std::f64::consts::FRAC_PI_2, std::f64::consts::PI, 3200.0];
    for x in any_bits.filter(|x| x.is_finite()).chain(edges) {
        let ((sin, cos), (sin_of_negative, cos_of_negative)) = (sin_cos(x), sin_cos(-x));
        assert_eq!(sin_of_negative.to_bits(), (-sin).to_bits(), "{x:e}");
        assert_eq!(cos_of_negative.to_bits(), cos.to_bits(), "{x:e}");
        assert!(sin.abs() <= 1.0 && cos.abs() <= 1.0, "{x:e}");
    }
    let any_bits = std::iter::repeat_with(|| f32::from_bits(random.random())).take(100_000);
    for x in any_bits.filter(|x| x.is_finite()) {
        let (sin, cos) = sin_cos(x);
        assert_eq!(sin_cos(-x), (-sin, cos), "{x:e}");
    }
    assert_eq!(sin_cos(0.0_f64).0.to_bits(), 0.0_f64.to_bits());
    assert_eq!(sin_cos(-0.0_f64).0.to_bits(), (-0.0_f64).to_bits());
    assert_eq!(sin_cos(-0.0_f32).0.to_bits(), (-0.0_f32).to_bits());
}

#[test]
fn what_is_not_finite_has_none() {
    for x in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let (sin, cos) = sin_cos(x);
        assert!(sin.is_nan() && cos.is_nan());
        let (sin, cos) = sin_cos(x as f32);
        assert!(sin.is_nan() && cos.is_nan());
    }
}

/// All lanes of all instructions of this processor, and three angles at once.
#[test]
fn lanes_have_the_bits_of_single_numbers() {
    let mut random = Pcg64::seed_from_u64(5);
    let mut angles = vec![0.0, -0.0, f64::NAN, f64::INFINITY, 3200.0, -3200.1, 1e300, 5e-324, 0.785, 0.786];
    angles.extend((0..5_000).map(|k| random.random_range(-1.0..1.0) * [0.8, 4.0, 3300.0][k % 3]));
    let single: Vec<_> = angles.iter().map(|angle| *angle as f32).collect();
    for instructions in Instructions::available() {
        compare(&angles, &instructions.run(SinesAndCosines(&angles)), f64::to_bits);
        compare(&single, &instructions.run(SinesAndCosines(&single)), |x| f32::to_bits(x).into());
    }
    let three = |angles: &[f64]| -> Vec<_> {
        angles.windows(3).map(|angles| f64::sine_cosines([angles[0], angles[1], angles[2]])[1]).collect()
    };
    compare(&angles[1..angles.len() - 1], &three(&angles), f64::to_bits);
    let three: Vec<_> =
        single.windows(3).map(|angles| f32::sine_cosines([angles[0], angles[1], angles[2]])[1]).collect();
    compare(&single[1..single.len() - 1], &three, |x| f32::to_bits(x).into());
}

struct SinesAndCosines<'a, S>(&'a [S]);

impl<S: Number> Kernel<S> for SinesAndCosines<'_, S> {
    type Output = Vec<(S, S)>;

    #[inline(always)]
    fn run<T: Lanes<Number = S>>(self) -> Self::Output {
        let mut found = vec![(S::zero(), S::zero()); self.0.len().next_multiple_of(T::COUNT)];
        for first in (0..self.0.len()).step_by(T::COUNT) {
            let (sine, cosine) = lanes::sin_cos(T::load(&self.0[first..]));
            sine.for_each(|lane, sine| found[first + lane].0 = sine);
            cosine.for_each(|lane, cosine| found[first + lane].1 = cosine);
        }
        found.truncate(self.0.len());
        found
    }
}

fn compare<S: Number>(angles: &[S], found: &[(S, S)], bits: impl Fn(S) -> u64) {
    assert_eq!(angles.len(), found.len());
    for (angle, (sine, cosine)) in angles.iter().zip(found) {
        let (sin, cos) = sin_cos(*angle);
        assert!(
            bits(sin) == bits(*sine) && bits(cos) == bits(*cosine)
                || sin.to_f64().is_nan() && sine.to_f64().is_nan(),
            "{angle}"
        );
    }
}

/// With and without `std`, in debug and release, whatever processor it is compiled for: a change of these sums is a change
/// of every pose made from angles.
#[test]
fn every_build_has_the_same_bits() {
    let mut random = Pcg64::seed_from_u64(4);
    let mut sums = [0_u64; 2];
    for _ in 0..100_000 {
        let angle: f64 = random.random_range(-4000.0..4000.0);
        let ((sin, cos), (sin_32, cos_32)) = (sin_cos(angle), sin_cos(angle as f32));
        for bits in [sin.to_bits(), cos.to_bits()] {
            sums[0] = sums[0].rotate_left(5).wrapping_add(bits);
        }
        for bits in [sin_32.to_bits(), cos_32.to_bits()] {
            sums[1] = sums[1].rotate_left(5).wrapping_add(bits.into());
        }
    }
    assert_eq!(sums, [1455156821110457795, 3393841525959211433]);
}
