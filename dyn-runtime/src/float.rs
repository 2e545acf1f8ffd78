//! The numbers that generated functions compute with, and the elementary functions that `core` lacks.
//!
//! A square root is correctly rounded everywhere, so the fastest one at hand is used. Trigonometric functions
//! differ by one unit in the last place between C libraries: sine and cosine are this crate's own, the arc tangent comes
//! from libm on every host, so that a pose made from angles, or angles from a pose, have the same bits everywhere.

use core::ops::{Add, Div, Mul, Neg, Sub};

use crate::real::Real;
use crate::solve;

/// A number, or several side by side (SIMD lanes): all that a generated function needs.
///
/// No comparison and no branch: what a function does never depends on its numbers, so every lane does the
/// same. The one exception, a linear system whose pivots are chosen by size, is a single operation here, and
/// lanes solve it each for itself.
pub trait Scalar:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self>
{
    /// The number nearest to `value`, in every lane.
    fn constant(value: f64) -> Self;

    /// Square root, correctly rounded; NaN below zero.
    fn square_root(self) -> Self;

    /// `self * factor + addend`: rounded once where the code is compiled for a processor with fused multiply-add, else the
    /// product is rounded first.
    fn multiply_add(self, factor: Self, addend: Self) -> Self;

    /// Solves `matrix * x = right_hand_side` with pivoting; `matrix` is row-major. See
    /// [`solve::solve_general`].
    fn solve_general<const N: usize>(matrix: &[[Self; N]; N], right_hand_side: &[Self; N]) -> [Self; N];

    /// `attempt` if the residual of each row is small beside the root of the sum of its terms' squares, else
    /// [`solve_general`](Self::solve_general); in lanes each for itself. See [`solve::solve_after_attempt`]. Unless a type of
    /// number says otherwise, no attempt is good enough: that is right too, and slower.
    fn unless_wrong<const N: usize>(
        _attempt: &[Self; N],
        _residuals: &[Self; N],
        _squares: &[Self; N],
        matrix: &[[Self; N]; N],
        right_hand_side: &[Self; N],
    ) -> [Self; N] {
        Self::solve_general(matrix, right_hand_side)
    }
}

/// [`Scalar::unless_wrong`] of single numbers.
macro_rules! unless_wrong {
    ($number:ident) => {
        #[inline(always)]
        fn unless_wrong<const N: usize>(
            attempt: &[Self; N],
            residuals: &[Self; N],
            squares: &[Self; N],
            matrix: &[[Self; N]; N],
            right_hand_side: &[Self; N],
        ) -> [Self; N] {
            const MOST: $number = solve::MOST_RESIDUAL as $number * $number::EPSILON;
            let mut right = true;
            for row in 0..N {
                // Squares that overflow make no number here, and nothing is less than that.
                let overflow = squares[row] * 0.0;
                right &= residuals[row] * residuals[row] < MOST * MOST * squares[row] + overflow;
            }
            if right {
                *attempt
            } else {
                seldom();
                // Copies: what elimination reads lies in memory, what was examined may stay in registers.
                let (matrix, right_hand_side) = (*matrix, *right_hand_side);
                Self::solve_general(&matrix, &right_hand_side)
            }
        }
    };
}

/// What leads here is seldom taken.
#[cold]
fn seldom() {}

/// A fused multiply-add is one instruction or a slow call of a library: it is used only where it is an instruction.
macro_rules! multiply_add_as_compiled {
    ($number:ident, $a:expr, $b:expr, $c:expr) => {{
        #[cfg(all(feature = "std", target_feature = "fma"))]
        return $number::mul_add($a, $b, $c);
        #[cfg(not(all(feature = "std", target_feature = "fma")))]
        return $a * $b + $c;
    }};
}

impl Scalar for f64 {
    #[inline(always)]
    fn constant(value: f64) -> Self {
        value
    }

    #[inline(always)]
    fn square_root(self) -> Self {
        #[cfg(feature = "std")]
        return self.sqrt();
        #[cfg(not(feature = "std"))]
        return libm::sqrt(self);
    }

    #[inline(always)]
    fn multiply_add(self, factor: Self, addend: Self) -> Self {
        multiply_add_as_compiled!(f64, self, factor, addend)
    }

    fn solve_general<const N: usize>(matrix: &[[Self; N]; N], right_hand_side: &[Self; N]) -> [Self; N] {
        solve::by_elimination(matrix, right_hand_side)
    }

    unless_wrong!(f64);
}

impl Scalar for f32 {
    #[inline(always)]
    fn constant(value: f64) -> Self {
        value as f32
    }

    #[inline(always)]
    fn square_root(self) -> Self {
        #[cfg(feature = "std")]
        return self.sqrt();
        #[cfg(not(feature = "std"))]
        return libm::sqrtf(self);
    }

    #[inline(always)]
    fn multiply_add(self, factor: Self, addend: Self) -> Self {
        multiply_add_as_compiled!(f32, self, factor, addend)
    }

    fn solve_general<const N: usize>(matrix: &[[Self; N]; N], right_hand_side: &[Self; N]) -> [Self; N] {
        solve::by_elimination(matrix, right_hand_side)
    }

    unless_wrong!(f32);
}

/// Square root; NaN below zero.
#[inline(always)]
pub fn sqrt<T: Scalar>(x: T) -> T {
    x.square_root()
}

/// `a * b + c`, see [`Scalar::multiply_add`].
#[inline(always)]
pub fn mul_add<T: Scalar>(a: T, b: T, c: T) -> T {
    a.multiply_add(b, c)
}

/// `a * b - c`, see [`Scalar::multiply_add`].
#[inline(always)]
pub fn mul_sub<T: Scalar>(a: T, b: T, c: T) -> T {
    a.multiply_add(b, -c)
}

/// `c - a * b`, see [`Scalar::multiply_add`].
#[inline(always)]
pub fn neg_mul_add<T: Scalar>(a: T, b: T, c: T) -> T {
    (-a).multiply_add(b, c)
}

/// Sine and cosine of an angle in radians, in this order, see [`Real::sine_cosine`].
#[inline]
pub fn sin_cos<T: Real>(angle: T) -> (T, T) {
    angle.sine_cosine()
}

/// Angle of the point (x, y) in radians, `-pi` to `pi`; 0 for y = 0 and x = 0.
pub fn atan2<T: Real>(y: T, x: T) -> T {
    y.arc_tangent(x)
}
