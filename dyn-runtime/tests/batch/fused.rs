//! A scalar with the rounding of lanes, and single states computed with it.

use std::ops::{Add, Div, Mul, Neg, Sub};

use dyn_runtime::float::Scalar;
use dyn_runtime::lanes::Number;

/// A single number whose multiply-adds are rounded once, whatever the test is compiled for.
#[derive(Clone, Copy)]
pub struct Fused<S>(pub S);

/// `std`'s fused multiply-add.
pub trait FusedMultiplyAdd: Number {
    fn fused(self, factor: Self, addend: Self) -> Self;
}

impl FusedMultiplyAdd for f64 {
    fn fused(self, factor: Self, addend: Self) -> Self {
        self.mul_add(factor, addend)
    }
}

impl FusedMultiplyAdd for f32 {
    fn fused(self, factor: Self, addend: Self) -> Self {
        self.mul_add(factor, addend)
    }
}

macro_rules! operators {
    ($($operator:ident $function:ident)*) => {$(
        impl<S: Number> $operator for Fused<S> {
            type Output = Self;
            fn $function(self, other: Self) -> Self {
                Self(self.0.$function(other.0))
            }
        }
    )*};
}
operators! { Add add Sub sub Mul mul Div div }

impl<S: Number> Neg for Fused<S> {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl<S: FusedMultiplyAdd> Scalar for Fused<S> {
    fn constant(value: f64) -> Self {
        Self(S::constant(value))
    }

    fn square_root(self) -> Self {
        Self(self.0.square_root())
    }

    fn multiply_add(self, factor: Self, addend: Self) -> Self {
        Self(self.0.fused(factor.0, addend.0))
    }

    fn solve_general<const N: usize>(matrix: &[[Self; N]; N], right_hand_side: &[Self; N]) -> [Self; N] {
        S::solve_general(&matrix.map(|row| row.map(|x| x.0)), &right_hand_side.map(|x| x.0)).map(Fused)
    }

    fn unless_wrong<const N: usize>(
        attempt: &[Self; N],
        residuals: &[Self; N],
        squares: &[Self; N],
        matrix: &[[Self; N]; N],
        right_hand_side: &[Self; N],
    ) -> [Self; N] {
        let [attempt, residuals, squares, right_hand_side] =
            [attempt, residuals, squares, right_hand_side].map(|numbers| numbers.map(|x| x.0));
        let matrix = matrix.map(|row| row.map(|x| x.0));
        S::unless_wrong(&attempt, &residuals, &squares, &matrix, &right_hand_side).map(Fused)
    }
}
