//! Lanes for any processor: an array, lane by lane.

use core::array;
use core::ops::{Add, Div, Mul, Neg, Sub};

use super::{Lanes, Number, solve};
use crate::float::Scalar;

/// N numbers.
#[derive(Clone, Copy)]
pub struct Array<S, const N: usize>([S; N]);

macro_rules! lane_by_lane {
    ($($operator:ident $function:ident)*) => {$(
        impl<S: Number, const N: usize> $operator for Array<S, N> {
            type Output = Self;

            #[inline(always)]
            fn $function(self, other: Self) -> Self {
                Self(array::from_fn(|lane| self.0[lane].$function(other.0[lane])))
            }
        }
    )*};
}
lane_by_lane! { Add add Sub sub Mul mul Div div }

impl<S: Number, const N: usize> Neg for Array<S, N> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self(self.0.map(|number| -number))
    }
}

impl<S: Number, const N: usize> Scalar for Array<S, N> {
    #[inline(always)]
    fn constant(value: f64) -> Self {
        Self([S::constant(value); N])
    }

    #[inline(always)]
    fn square_root(self) -> Self {
        Self(self.0.map(S::square_root))
    }

    #[inline(always)]
    fn multiply_add(self, factor: Self, addend: Self) -> Self {
        Self(array::from_fn(|lane| self.0[lane].multiply_add(factor.0[lane], addend.0[lane])))
    }

    #[inline(always)]
    fn solve_general<const M: usize>(matrix: &[[Self; M]; M], right_hand_side: &[Self; M]) -> [Self; M] {
        solve::by_elimination(matrix, right_hand_side)
    }
}

impl<S: Number, const N: usize> Lanes for Array<S, N> {
    type Number = S;
    type Mask = [bool; N];
    const COUNT: usize = N;

    #[inline(always)]
    fn from_fn(number: impl FnMut(usize) -> S) -> Self {
        Self(array::from_fn(number))
    }

    #[inline(always)]
    fn splat(number: S) -> Self {
        Self([number; N])
    }

    #[inline(always)]
    fn load(numbers: &[S]) -> Self {
        match numbers.first_chunk() {
            Some(lanes) => Self(*lanes),
            None => Self(super::filled(numbers)),
        }
    }

    #[inline(always)]
    fn store(self, numbers: &mut [S]) {
        for (number, lane) in numbers.iter_mut().zip(self.0) {
            *number = lane;
        }
    }

    #[inline(always)]
    fn for_each(self, mut use_number: impl FnMut(usize, S)) {
        for (lane, number) in self.0.into_iter().enumerate() {
            use_number(lane, number);
        }
    }

    #[inline(always)]
    fn absolute(self) -> Self {
        Self(self.0.map(|number| number.abs()))
    }

    #[inline(always)]
    fn less_than(self, other: Self) -> [bool; N] {
        array::from_fn(|lane| self.0[lane] < other.0[lane])
    }

    #[inline(always)]
    fn select(mask: [bool; N], chosen: Self, other: Self) -> Self {
        Self(array::from_fn(|lane| if mask[lane] { chosen.0[lane] } else { other.0[lane] }))
    }

    #[inline(always)]
    fn bits(mask: [bool; N]) -> u32 {
        mask.iter().enumerate().fold(0, |bits, (lane, truth)| bits | u32::from(*truth) << lane)
    }
}
