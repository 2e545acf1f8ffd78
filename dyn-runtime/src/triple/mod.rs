//! Three numbers side by side in one state: the components of a vector, or the same number of three legs.
//!
//! Generated functions called `..._in_lanes` compute a single state with three numbers in most operations. They are generic
//! in a [`Triple`], of which there are two: an array, for any processor and any type of number, and a register of four
//! double-precision numbers for x86-64 with AVX2 and FMA, whose fourth lane is idle.
//!
//! [`run`] takes the register where the processor has it and the function without lanes where it has not. Where a program is
//! compiled for such a processor (`-C target-cpu=native`), nothing is asked at run time; with the feature `std` a program
//! compiled for plain x86-64 asks once and remembers. Multiply-adds are rounded once in registers, and elsewhere as
//! [`Scalar::multiply_add`] does.
//!
//! # Why this module may use `unsafe`
//!
//! Intrinsics of `core::arch` are unsafe because a processor may lack them. The type made of them is private: nobody can name
//! or make one, except a call that [`run`] gives it to, and `run` does so only on a processor that has them.

mod portable;
#[cfg(all(
    target_arch = "x86_64",
    any(feature = "std", all(target_feature = "avx2", target_feature = "fma"))
))]
mod x86;
#[cfg(not(all(
    target_arch = "x86_64",
    any(feature = "std", all(target_feature = "avx2", target_feature = "fma"))
)))]
mod x86 {
    /// Without `std` a processor cannot be asked, and code in registers is not made.
    pub(super) fn available() -> bool {
        false
    }

    pub(super) fn run<C: super::Call<f64>>(call: C) {
        call.flat();
    }
}

pub use portable::Portable;

use crate::float::Scalar;

/// Three numbers side by side; operations work on each of them.
pub trait Triple: Scalar {
    /// What each lane holds.
    type Lane: Scalar;

    /// The three numbers.
    fn triple(lanes: [Self::Lane; 3]) -> Self;

    /// The first three of these numbers, the fourth of which is the third again.
    #[inline(always)]
    fn load([x, y, z, _]: &[Self::Lane; 4]) -> Self {
        Self::triple([*x, *y, *z])
    }

    /// The same number three times.
    fn splat(number: Self::Lane) -> Self;

    /// The number in lane 0, 1 or 2.
    ///
    /// # Panics
    /// For any other lane; generated code has none.
    fn lane(self, lane: usize) -> Self::Lane;

    /// `a * b + c` of single numbers, rounded as in lanes.
    fn mul_add(a: Self::Lane, b: Self::Lane, c: Self::Lane) -> Self::Lane;

    /// `a * b - c` of single numbers, rounded as in lanes.
    #[inline(always)]
    fn mul_sub(a: Self::Lane, b: Self::Lane, c: Self::Lane) -> Self::Lane {
        Self::mul_add(a, b, -c)
    }

    /// `c - a * b` of single numbers, rounded as in lanes.
    #[inline(always)]
    fn neg_mul_add(a: Self::Lane, b: Self::Lane, c: Self::Lane) -> Self::Lane {
        Self::mul_add(-a, b, c)
    }
}

/// A call of a function that exists with and without lanes.
pub trait Call<T> {
    /// The call in lanes. To be marked `#[inline(always)]`, like the function it calls: what is inlined is compiled for the
    /// processor's registers, what is not is slow.
    fn in_lanes<P: Triple<Lane = T>>(self);

    /// The call without lanes.
    fn flat(self);
}

/// Makes the call in the registers that suit three numbers, if the processor has such.
#[inline(always)]
pub fn run<C: Call<f64>>(call: C) {
    if x86::available() { x86::run(call) } else { call.flat() }
}

/// Whether [`run`] uses registers, whose multiply-adds are rounded once.
pub fn in_registers() -> bool {
    x86::available()
}

/// The body of a model's method: a call of the function named first in lanes, or of the second one without.
#[doc(hidden)]
#[macro_export]
macro_rules! single_state {
    ($in_lanes:ident, $flat:ident; $($input:ident: $input_type:ty),*; $($output:ident: $output_type:ty),*) => {
        $crate::single_state!($in_lanes, $flat; $($input: $input_type),*; only in lanes; $($output: $output_type),*)
    };
    (
        $in_lanes:ident, $flat:ident; $($input:ident: $input_type:ty),*;
        only in lanes $($extra:ident: $extra_type:ty),*; $($output:ident: $output_type:ty),*
    ) => {{
        struct Arguments<'a> {
            $($input: &'a $input_type,)*
            $($extra: &'a $extra_type,)*
            $($output: &'a mut $output_type,)*
        }
        impl $crate::triple::Call<f64> for Arguments<'_> {
            #[inline(always)]
            fn in_lanes<P: $crate::triple::Triple<Lane = f64>>(self) {
                self::$in_lanes::<P>($(self.$input,)* $(self.$extra,)* $(self.$output),*);
            }
            // Where it is called, like the method: a library that nobody calls it in need not compile it.
            #[inline]
            fn flat(self) {
                self::$flat($(self.$input,)* $(self.$output),*);
            }
        }
        $crate::triple::run(Arguments { $($input,)* $($extra,)* $($output),* });
    }};
}

/// Solves a system for each lane by itself.
fn lane_after_lane<P: Triple, const N: usize>(matrix: &[[P; N]; N], right_hand_side: &[P; N]) -> [P; N] {
    let solutions = [0, 1, 2].map(|lane| {
        let matrix = matrix.map(|row| row.map(|entry| entry.lane(lane)));
        P::Lane::solve_general(&matrix, &right_hand_side.map(|entry| entry.lane(lane)))
    });
    core::array::from_fn(|row| P::triple(solutions.map(|solution| solution[row])))
}
