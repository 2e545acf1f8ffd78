//! Three numbers in a register of x86-64 with AVX2 and FMA.
//!
//! A wrapper of an intrinsic is always inlined: into [`in_register`], which is compiled for AVX2 and FMA, where the intrinsic
//! becomes one instruction.

// Intrinsics, see the reasons in the module's documentation.
#![allow(unsafe_code)]

use core::arch::x86_64::{
    __m256d, _mm_cvtsd_f64, _mm_fmadd_sd, _mm_set_sd, _mm256_add_pd, _mm256_div_pd, _mm256_fmadd_pd,
    _mm256_loadu_pd, _mm256_mul_pd, _mm256_set_pd, _mm256_set1_pd, _mm256_sqrt_pd, _mm256_sub_pd,
};
use core::ops::{Add, Div, Mul, Neg, Sub};

use super::{Call, Triple};
use crate::float::Scalar;
use crate::x86::operators;

pub(super) use crate::x86::has_avx2 as available;

/// Makes the call in registers.
///
/// # Panics
/// Never: [`available`] is asked before.
#[inline(always)]
pub(super) fn run<C: Call<f64>>(call: C) {
    // SAFETY: `super::run` calls this only where `available` has found AVX2 and FMA.
    unsafe { in_register(call) }
}

#[target_feature(enable = "avx2,fma")]
fn in_register<C: Call<f64>>(call: C) {
    call.in_lanes::<Register>();
}

/// Three double-precision numbers; the fourth lane repeats the third.
#[derive(Clone, Copy)]
struct Register(__m256d);

operators!(Register:
    Add::add = _mm256_add_pd,
    Sub::sub = _mm256_sub_pd,
    Mul::mul = _mm256_mul_pd,
    Div::div = _mm256_div_pd
);

impl Neg for Register {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        // -0 - x is -x for every x, zeros included.
        Self::constant(-0.0) - self
    }
}

impl Scalar for Register {
    #[inline(always)]
    fn constant(value: f64) -> Self {
        Self::splat(value)
    }

    #[inline(always)]
    fn square_root(self) -> Self {
        // SAFETY: a register exists only within `in_register`.
        Register(unsafe { _mm256_sqrt_pd(self.0) })
    }

    #[inline(always)]
    fn multiply_add(self, factor: Self, addend: Self) -> Self {
        // SAFETY: a register exists only within `in_register`.
        Register(unsafe { _mm256_fmadd_pd(self.0, factor.0, addend.0) })
    }

    fn solve_general<const N: usize>(matrix: &[[Self; N]; N], right_hand_side: &[Self; N]) -> [Self; N] {
        super::lane_after_lane(matrix, right_hand_side)
    }
}

impl Triple for Register {
    type Lane = f64;

    #[inline(always)]
    fn triple([x, y, z]: [f64; 3]) -> Self {
        // SAFETY: triples are made within `in_register` only.
        Register(unsafe { _mm256_set_pd(z, z, y, x) })
    }

    #[inline(always)]
    fn load(lanes: &[f64; 4]) -> Self {
        // SAFETY: four numbers are read, wherever they are; triples are made within `in_register` only.
        Register(unsafe { _mm256_loadu_pd(lanes.as_ptr()) })
    }

    #[inline(always)]
    fn splat(number: f64) -> Self {
        // SAFETY: triples are made within `in_register` only.
        Register(unsafe { _mm256_set1_pd(number) })
    }

    #[inline(always)]
    fn lane(self, lane: usize) -> f64 {
        // SAFETY: both types are four doubles.
        let lanes: [f64; 4] = unsafe { core::mem::transmute(self.0) };
        lanes[lane]
    }

    #[inline(always)]
    fn mul_add(a: f64, b: f64, c: f64) -> f64 {
        // SAFETY: numbers are computed with within `in_register` only.
        unsafe { _mm_cvtsd_f64(_mm_fmadd_sd(_mm_set_sd(a), _mm_set_sd(b), _mm_set_sd(c))) }
    }
}
