//! Three numbers in an array.

use core::ops::{Add, Div, Mul, Neg, Sub};

use super::Triple;
use crate::float::Scalar;

/// Three numbers of any type; the compiler may put them into registers as it likes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Portable<T>([T; 3]);

macro_rules! lane_by_lane {
    ($($operator:ident::$function:ident),*) => {
        $(impl<T: Scalar> $operator for Portable<T> {
            type Output = Self;

            #[inline(always)]
            fn $function(self, other: Self) -> Self {
                let ([a, b, c], [x, y, z]) = (self.0, other.0);
                Portable([a.$function(x), b.$function(y), c.$function(z)])
            }
        })*
    };
}

lane_by_lane!(Add::add, Sub::sub, Mul::mul, Div::div);

impl<T: Scalar> Neg for Portable<T> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Portable(self.0.map(|x| -x))
    }
}

impl<T: Scalar> Scalar for Portable<T> {
    #[inline(always)]
    fn constant(value: f64) -> Self {
        Portable([T::constant(value); 3])
    }

    #[inline(always)]
    fn square_root(self) -> Self {
        Portable(self.0.map(T::square_root))
    }

    #[inline(always)]
    fn multiply_add(self, factor: Self, addend: Self) -> Self {
        let ([a, b, c], [x, y, z], [p, q, r]) = (self.0, factor.0, addend.0);
        Portable([a.multiply_add(x, p), b.multiply_add(y, q), c.multiply_add(z, r)])
    }

    fn solve_general<const N: usize>(matrix: &[[Self; N]; N], right_hand_side: &[Self; N]) -> [Self; N] {
        super::lane_after_lane(matrix, right_hand_side)
    }
}

impl<T: Scalar> Triple for Portable<T> {
    type Lane = T;

    #[inline(always)]
    fn triple(lanes: [T; 3]) -> Self {
        Portable(lanes)
    }

    #[inline(always)]
    fn splat(number: T) -> Self {
        Portable([number; 3])
    }

    #[inline(always)]
    fn lane(self, lane: usize) -> T {
        self.0[lane]
    }

    #[inline(always)]
    fn mul_add(a: T, b: T, c: T) -> T {
        a.multiply_add(b, c)
    }
}
