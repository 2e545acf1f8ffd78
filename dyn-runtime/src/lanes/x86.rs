//! Lanes of x86-64 processors: AVX2 with FMA, and AVX-512.

use core::arch::x86_64::*;
use core::ops::{Add, Div, Mul, Neg, Sub};

use super::{Kernel, Lanes, Number, filled, solve};
use crate::float::Scalar;
use crate::solve::MOST_RESIDUAL;
use crate::x86::operators;

/// Runs a kernel with lanes of AVX2 and FMA.
///
/// # Safety
/// [`has_avx2`](crate::x86::has_avx2).
#[target_feature(enable = "avx2,fma")]
pub(super) unsafe fn run_avx2<S: Number, T: Lanes<Number = S>, K: Kernel<S>>(kernel: K) -> K::Output {
    kernel.run::<T>()
}

/// Runs a kernel with lanes of AVX-512.
///
/// # Safety
/// [`has_avx512`](crate::x86::has_avx512).
#[target_feature(enable = "avx2,fma,avx512f,avx512vl,avx512dq")]
pub(super) unsafe fn run_avx512<S: Number, T: Lanes<Number = S>, K: Kernel<S>>(kernel: K) -> K::Output {
    kernel.run::<T>()
}

/// A type of lanes. All of its intrinsics belong to the instruction set by which its name is documented.
macro_rules! lanes {
    (
        $(#[$doc:meta])* $name:ident: $count:literal of $number:ident in $vector:ident, masks $mask:ty,
        $setr:ident($($lane:ident)*) $set1:ident $loadu:ident $storeu:ident $add:ident $sub:ident $mul:ident $div:ident $sqrt:ident $fmadd:ident $xor:ident,
        absolute |$absolute_of:ident| $absolute:expr,
        less_than |$less:ident, $greater:ident| $less_than:expr,
        select |$mask_value:ident, $chosen:ident, $other:ident| $select:expr,
        bits |$bits_of:ident| $bits:expr,
        integers $to_integers:ident $from_integers:ident $set1_integer:ident $add_integers:ident $and:ident $shift:ident, last $last:literal,
        odd |$odd_of:ident| $odd:expr
    ) => {
        $(#[$doc])*
        #[derive(Clone, Copy)]
        pub struct $name($vector);

        operators!($name: Add::add = $add, Sub::sub = $sub, Mul::mul = $mul, Div::div = $div);

        impl Neg for $name {
            type Output = Self;

            #[inline(always)]
            fn neg(self) -> Self {
                // SAFETY: a value of this type exists only where its instructions do.
                Self(unsafe { $xor(self.0, $set1(-0.0)) })
            }
        }

        impl Scalar for $name {
            #[inline(always)]
            fn constant(value: f64) -> Self {
                Self::splat(value as $number)
            }

            #[inline(always)]
            fn square_root(self) -> Self {
                // SAFETY: a value of this type exists only where its instructions do.
                Self(unsafe { $sqrt(self.0) })
            }

            #[inline(always)]
            fn multiply_add(self, factor: Self, addend: Self) -> Self {
                // SAFETY: a value of this type exists only where its instructions do.
                Self(unsafe { $fmadd(self.0, factor.0, addend.0) })
            }

            #[inline(always)]
            fn solve_general<const N: usize>(matrix: &[[Self; N]; N], right_hand_side: &[Self; N]) -> [Self; N] {
                solve::by_elimination(matrix, right_hand_side)
            }

            #[inline(always)]
            fn unless_wrong<const N: usize>(
                attempt: &[Self; N],
                residuals: &[Self; N],
                squares: &[Self; N],
                matrix: &[[Self; N]; N],
                right_hand_side: &[Self; N],
            ) -> [Self; N] {
                const MOST: $number = MOST_RESIDUAL as $number * $number::EPSILON;
                solve::unless_wrong(attempt, residuals, squares, Self::splat(MOST * MOST), matrix, right_hand_side)
            }
        }

        impl Lanes for $name {
            type Number = $number;
            type Mask = $mask;
            const COUNT: usize = $count;

            #[inline(always)]
            fn from_fn(number: impl FnMut(usize) -> $number) -> Self {
                let [$($lane),*]: [$number; $count] = core::array::from_fn(number);
                // SAFETY: only a kernel that runs where the instructions exist can name this type.
                Self(unsafe { $setr($($lane),*) })
            }

            #[inline(always)]
            fn splat(number: $number) -> Self {
                // SAFETY: only a kernel that runs where the instructions exist can name this type.
                Self(unsafe { $set1(number) })
            }

            #[inline(always)]
            fn load(numbers: &[$number]) -> Self {
                let lanes = match numbers.first_chunk::<$count>() {
                    Some(lanes) => lanes,
                    None => &filled(numbers),
                };
                // SAFETY: as many numbers as lanes are read, wherever they are; for the instructions see `splat`.
                Self(unsafe { $loadu(lanes.as_ptr()) })
            }

            #[inline(always)]
            fn store(self, numbers: &mut [$number]) {
                match numbers.first_chunk_mut::<$count>() {
                    // SAFETY: as many numbers as lanes are written; the value shows that the instructions exist.
                    Some(lanes) => unsafe { $storeu(lanes.as_mut_ptr(), self.0) },
                    None => {
                        for (number, lane) in numbers.iter_mut().zip(self.to_array()) {
                            *number = lane;
                        }
                    }
                }
            }

            #[inline(always)]
            fn for_each(self, mut use_number: impl FnMut(usize, $number)) {
                for (lane, number) in self.to_array().into_iter().enumerate() {
                    use_number(lane, number);
                }
            }

            #[inline(always)]
            fn absolute(self) -> Self {
                // SAFETY: a value of this type exists only where its instructions do.
                let $absolute_of = self.0;
                Self(unsafe { $absolute })
            }

            #[inline(always)]
            fn less_than(self, other: Self) -> $mask {
                // SAFETY: a value of this type exists only where its instructions do.
                let ($less, $greater) = (self.0, other.0);
                unsafe { $less_than }
            }

            #[inline(always)]
            fn select(mask: $mask, chosen: Self, other: Self) -> Self {
                // SAFETY: a value of this type exists only where its instructions do.
                let ($mask_value, $chosen, $other) = (mask, chosen.0, other.0);
                Self(unsafe { $select })
            }

            #[inline(always)]
            fn bits(mask: $mask) -> u32 {
                let $bits_of = mask;
                $bits
            }

            #[inline(always)]
            fn turned(sine: Self, cosine: Self, quarter_turns: Self, angle: Self) -> (Self, Self) {
                // SAFETY: a value of this type exists only where its instructions do.
                let (odd, sine_sign, cosine_sign) = unsafe {
                    let turns = $to_integers(quarter_turns.0);
                    let next = $add_integers(turns, $set1_integer(1));
                    let sign = |turns| $from_integers($shift::<{ $last - 1 }>(turns));
                    let minus = $set1(-0.0);
                    let $odd_of = $shift::<$last>(turns);
                    ($odd, $and($xor(sign(turns), angle.0), minus), $and(sign(next), minus))
                };
                let (new_sine, new_cosine) = (Self::select(odd, cosine, sine), Self::select(odd, sine, cosine));
                // SAFETY: the same.
                unsafe { (Self($xor(new_sine.0, sine_sign)), Self($xor(new_cosine.0, cosine_sign))) }
            }
        }

        impl $name {
            #[inline(always)]
            fn to_array(self) -> [$number; $count] {
                let mut lanes = [0.0; $count];
                // SAFETY: as many numbers as lanes are written; the value shows that the instructions exist.
                unsafe { $storeu(lanes.as_mut_ptr(), self.0) };
                lanes
            }
        }
    };
}

lanes! {
    /// Four lanes, AVX2 and FMA.
    F64x4: 4 of f64 in __m256d, masks __m256d,
    _mm256_setr_pd(a b c d) _mm256_set1_pd _mm256_loadu_pd _mm256_storeu_pd
    _mm256_add_pd _mm256_sub_pd _mm256_mul_pd _mm256_div_pd _mm256_sqrt_pd _mm256_fmadd_pd _mm256_xor_pd,
    absolute |a| _mm256_andnot_pd(_mm256_set1_pd(-0.0), a),
    less_than |a, b| _mm256_cmp_pd::<_CMP_LT_OQ>(a, b),
    select |mask, a, b| _mm256_blendv_pd(b, a, mask),
    // SAFETY: masks come from `less_than`.
    bits |mask| unsafe { _mm256_movemask_pd(mask) } as u32,
    integers _mm256_castpd_si256 _mm256_castsi256_pd _mm256_set1_epi64x _mm256_add_epi64 _mm256_and_pd _mm256_slli_epi64, last 63,
    // The mask of a selection is the sign bit.
    odd |last| _mm256_castsi256_pd(last)
}

lanes! {
    /// Eight lanes, AVX2 and FMA.
    F32x8: 8 of f32 in __m256, masks __m256,
    _mm256_setr_ps(a b c d e f g h) _mm256_set1_ps _mm256_loadu_ps _mm256_storeu_ps
    _mm256_add_ps _mm256_sub_ps _mm256_mul_ps _mm256_div_ps _mm256_sqrt_ps _mm256_fmadd_ps _mm256_xor_ps,
    absolute |a| _mm256_andnot_ps(_mm256_set1_ps(-0.0), a),
    less_than |a, b| _mm256_cmp_ps::<_CMP_LT_OQ>(a, b),
    select |mask, a, b| _mm256_blendv_ps(b, a, mask),
    // SAFETY: masks come from `less_than`.
    bits |mask| unsafe { _mm256_movemask_ps(mask) } as u32,
    integers _mm256_castps_si256 _mm256_castsi256_ps _mm256_set1_epi32 _mm256_add_epi32 _mm256_and_ps _mm256_slli_epi32, last 31,
    odd |last| _mm256_castsi256_ps(last)
}

lanes! {
    /// Eight lanes, AVX-512.
    F64x8: 8 of f64 in __m512d, masks __mmask8,
    _mm512_setr_pd(a b c d e f g h) _mm512_set1_pd _mm512_loadu_pd _mm512_storeu_pd
    _mm512_add_pd _mm512_sub_pd _mm512_mul_pd _mm512_div_pd _mm512_sqrt_pd _mm512_fmadd_pd _mm512_xor_pd,
    absolute |a| _mm512_abs_pd(a),
    less_than |a, b| _mm512_cmp_pd_mask::<_CMP_LT_OQ>(a, b),
    select |mask, a, b| _mm512_mask_blend_pd(mask, b, a),
    bits |mask| u32::from(mask),
    integers _mm512_castpd_si512 _mm512_castsi512_pd _mm512_set1_epi64 _mm512_add_epi64 _mm512_and_pd _mm512_slli_epi64, last 63,
    odd |last| _mm512_movepi64_mask(last)
}

lanes! {
    /// Sixteen lanes, AVX-512.
    F32x16: 16 of f32 in __m512, masks __mmask16,
    _mm512_setr_ps(a b c d e f g h i j k l m n o p) _mm512_set1_ps _mm512_loadu_ps _mm512_storeu_ps
    _mm512_add_ps _mm512_sub_ps _mm512_mul_ps _mm512_div_ps _mm512_sqrt_ps _mm512_fmadd_ps _mm512_xor_ps,
    absolute |a| _mm512_abs_ps(a),
    less_than |a, b| _mm512_cmp_ps_mask::<_CMP_LT_OQ>(a, b),
    select |mask, a, b| _mm512_mask_blend_ps(mask, b, a),
    bits |mask| u32::from(mask),
    integers _mm512_castps_si512 _mm512_castsi512_ps _mm512_set1_epi32 _mm512_add_epi32 _mm512_and_ps _mm512_slli_epi32, last 31,
    odd |last| _mm512_movepi32_mask(last)
}
