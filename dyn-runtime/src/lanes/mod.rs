//! Several numbers side by side, computed with at once (SIMD lanes), and the choice of the processor's widest ones
//! when the program runs.
//!
//! A generated function takes any [`Scalar`]; here are scalars of four, eight or sixteen numbers. Code for them is
//! written once, as a [`Kernel`] that is generic in the lanes, and [`run`] calls it with the widest lanes that the
//! processor has:
//!
//! | instructions | `f64` | `f32` | multiply-add |
//! |-|-|-|-|
//! | AVX-512 (F, VL, DQ) | 8 | 16 | rounded once |
//! | AVX2 and FMA | 4 | 8 | rounded once |
//! | portable | 1 | 1 | as compiled, see [`Scalar::multiply_add`] |
//!
//! With the feature `std` a program built for plain x86-64 asks the processor; without it, the instructions for which
//! the program is compiled are taken. A lane computes what a single number does, bit for bit, with multiply-adds
//! rounded as the table says: results of one instruction set do not depend on which lane a state is in.
//!
//! ```
//! use dyn_runtime::lanes::{self, Kernel, Lanes};
//!
//! /// The lengths of many vectors, x, y and z each in a slice of their own.
//! struct Lengths<'a>([&'a [f64]; 3]);
//!
//! impl Kernel<f64> for Lengths<'_> {
//!     type Output = Vec<f64>;
//!
//!     // Inlined, or the code is not compiled for the processor's lanes.
//!     #[inline(always)]
//!     fn run<T: Lanes<Number = f64>>(self) -> Vec<f64> {
//!         let mut lengths = vec![0.0; self.0[0].len()];
//!         for first in (0..lengths.len()).step_by(T::COUNT) {
//!             let [x, y, z] = self.0.map(|numbers| T::load(&numbers[first..]));
//!             (x * x + y * y + z * z).square_root().store(&mut lengths[first..]);
//!         }
//!         lengths
//!     }
//! }
//!
//! let lengths = lanes::run(Lengths([&[3.0, 1.0], &[4.0, 2.0], &[0.0, 2.0]]));
//! assert_eq!(lengths, [5.0, 3.0]);
//! ```
//!
//! # Why this module may use `unsafe`
//!
//! Intrinsics of `core::arch` are unsafe because a processor may lack them. The types made of them are private to
//! this module: nobody can name or make one, except a kernel that [`Instructions::run`] calls with it, and an
//! [`Instructions`] is only made for a processor that has them. Besides, lanes are loaded from several slices of a
//! length that was checked once.

// The only unsafe code of this crate, see above.
#![allow(unsafe_code)]

mod components;
mod model;
mod single;
#[cfg(target_arch = "x86_64")]
mod solve;
#[cfg(target_arch = "x86_64")]
mod x86;

pub(crate) use components::{Components, ComponentsMut};
pub use model::{Generic, InLanes};

use crate::float::Scalar;
use crate::real::Real;
use crate::trigonometry;
#[cfg(target_arch = "x86_64")]
use crate::x86::{has_avx2, has_avx512};

/// Several numbers side by side.
///
/// Comparisons give a mask, a truth value per lane.
pub trait Lanes: Scalar + 'static {
    /// What each lane holds.
    type Number: Number;
    /// A truth value per lane.
    type Mask: Copy;
    /// How many lanes there are.
    const COUNT: usize;

    /// `number(lane)` in each lane.
    fn from_fn(number: impl FnMut(usize) -> Self::Number) -> Self;

    /// The same number in every lane.
    fn splat(number: Self::Number) -> Self;

    /// The first numbers of a slice. Where it is shorter, its last number fills the other lanes, zero if it is empty.
    fn load(numbers: &[Self::Number]) -> Self;

    /// Writes the lanes to the beginning of a slice; lanes for which it is too short are left out.
    fn store(self, numbers: &mut [Self::Number]);

    /// Passes the number of each lane on, in order.
    fn for_each(self, use_number: impl FnMut(usize, Self::Number));

    /// Magnitude.
    fn absolute(self) -> Self;

    /// Where `self < other`; nowhere in lanes with a NaN.
    fn less_than(self, other: Self) -> Self::Mask;

    /// `chosen` where the mask is true, else `other`.
    fn select(mask: Self::Mask, chosen: Self, other: Self) -> Self;

    /// Bit k is lane k.
    fn bits(mask: Self::Mask) -> u32;

    /// Sine and cosine of `angle`, from those of a rest and a number whose last bits say by how many quarter turns the
    /// magnitude of the angle is larger.
    #[doc(hidden)]
    fn turned(sine: Self, cosine: Self, quarter_turns: Self, angle: Self) -> (Self, Self);
}

/// Sine and cosine of angles in radians, in this order; in every lane the bits of [`float::sin_cos`](crate::float::sin_cos).
#[inline(always)]
pub fn sin_cos<T: Lanes>(angle: T) -> (T, T) {
    trigonometry::sine_cosine(angle)
}

/// A computation that is generic in the lanes.
pub trait Kernel<S: Number> {
    /// What it gives.
    type Output;

    /// The computation. To be marked `#[inline(always)]`, and all that it calls with lanes as well: what is inlined is
    /// compiled for the processor's instructions, what is not is slow. Closures, and hence `array::map`, are not always
    /// inlined: loops are safer.
    fn run<T: Lanes<Number = S>>(self) -> Self::Output;
}

/// A number that lanes can hold: `f64` or `f32`.
pub trait Number: Real {
    /// [`Instructions::run`].
    #[doc(hidden)]
    fn run_with<K: Kernel<Self>>(instructions: Instructions, kernel: K) -> K::Output;

    #[doc(hidden)]
    const SINE_COSINE: &'static trigonometry::Constants;

    #[doc(hidden)]
    fn sine_cosine_of_libm(self) -> (Self, Self);

    /// The same of an angle that is known to be near.
    #[doc(hidden)]
    fn sine_cosine_of_near(self) -> (Self, Self);
}

/// Instructions that this processor has.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Instructions(Set);

/// In the order of preference.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Set {
    #[cfg(target_arch = "x86_64")]
    Avx512,
    #[cfg(target_arch = "x86_64")]
    Avx2,
    Portable,
}

impl Set {
    const ALL: &[Set] = &[
        #[cfg(target_arch = "x86_64")]
        Set::Avx512,
        #[cfg(target_arch = "x86_64")]
        Set::Avx2,
        Set::Portable,
    ];

    /// Whether this processor has them.
    fn available(self) -> bool {
        match self {
            #[cfg(target_arch = "x86_64")]
            Set::Avx512 => has_avx512(),
            #[cfg(target_arch = "x86_64")]
            Set::Avx2 => has_avx2(),
            Set::Portable => true,
        }
    }
}

impl Instructions {
    /// The widest that this processor has.
    pub fn widest() -> Self {
        Self::available().next().unwrap_or(Self(Set::Portable))
    }

    /// For a few numbers of one state: the widest registers would slow down all that follows.
    #[inline]
    pub(crate) fn of_single_states() -> Self {
        #[cfg(target_arch = "x86_64")]
        if has_avx2() {
            return Self(Set::Avx2);
        }
        Self(Set::Portable)
    }

    /// All that this processor has, the widest first.
    pub fn available() -> impl Iterator<Item = Self> {
        Set::ALL.iter().copied().filter(|set| set.available()).map(Self)
    }

    /// `"AVX-512"`, `"AVX2"` or `"portable"`.
    pub fn name(self) -> &'static str {
        match self.0 {
            #[cfg(target_arch = "x86_64")]
            Set::Avx512 => "AVX-512",
            #[cfg(target_arch = "x86_64")]
            Set::Avx2 => "AVX2",
            Set::Portable => "portable",
        }
    }

    /// Whether multiply-adds in lanes are rounded once.
    pub fn fused(self) -> bool {
        match self.0 {
            #[cfg(target_arch = "x86_64")]
            Set::Avx512 | Set::Avx2 => true,
            Set::Portable => cfg!(all(feature = "std", target_feature = "fma")),
        }
    }

    /// Runs a kernel with lanes of these instructions.
    #[inline]
    pub fn run<S: Number, K: Kernel<S>>(self, kernel: K) -> K::Output {
        S::run_with(self, kernel)
    }
}

/// Runs a kernel with the widest lanes of this processor.
#[inline]
pub fn run<S: Number, K: Kernel<S>>(kernel: K) -> K::Output {
    Instructions::widest().run(kernel)
}

macro_rules! number {
    ($number:ident, $avx2:ident, $avx512:ident, $constants:ident, $libm:ident) => {
        impl Number for $number {
            const SINE_COSINE: &'static trigonometry::Constants = &trigonometry::$constants;

            fn sine_cosine_of_libm(self) -> (Self, Self) {
                libm::$libm(self)
            }

            #[inline]
            fn sine_cosine_of_near(self) -> (Self, Self) {
                crate::trigonometry::of_near(self)
            }

            #[inline]
            fn run_with<K: Kernel<Self>>(instructions: Instructions, kernel: K) -> K::Output {
                match instructions.0 {
                    // SAFETY: an `Instructions` of them exists only where the processor has them.
                    #[cfg(target_arch = "x86_64")]
                    Set::Avx512 => unsafe { x86::run_avx512::<_, x86::$avx512, K>(kernel) },
                    // SAFETY: the same.
                    #[cfg(target_arch = "x86_64")]
                    Set::Avx2 => unsafe { x86::run_avx2::<_, x86::$avx2, K>(kernel) },
                    Set::Portable => kernel.run::<$number>(),
                }
            }
        }
    };
}
number!(f64, F64x4, F64x8, OF_F64, sincos);
number!(f32, F32x8, F32x16, OF_F32, sincosf);

/// The first numbers of a slice that is shorter than there are lanes.
#[cfg(target_arch = "x86_64")]
fn filled<S: Number, const N: usize>(numbers: &[S]) -> [S; N] {
    let mut lanes = [numbers.last().copied().unwrap_or(S::zero()); N];
    for (lane, number) in lanes.iter_mut().zip(numbers) {
        *lane = *number;
    }
    lanes
}
