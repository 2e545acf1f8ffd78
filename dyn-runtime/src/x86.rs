//! What all types of registers of x86-64 have in common: the question whether the processor has the instructions, and arithmetic.

/// Whether features were compiled for, or (with `std`) this processor has them.
macro_rules! has {
    ($($feature:tt),+) => {{
        #[cfg(feature = "std")]
        let has = $(std::is_x86_feature_detected!($feature))&&+;
        #[cfg(not(feature = "std"))]
        let has = cfg!(all($(target_feature = $feature),+));
        has
    }};
}

/// Whether this processor has AVX2 and FMA, as far as this build can know.
#[inline(always)]
pub(crate) fn has_avx2() -> bool {
    has!("avx2", "fma")
}

/// Whether it has all that lanes of AVX-512 need.
pub(crate) fn has_avx512() -> bool {
    has!("avx2", "fma", "avx512f", "avx512vl", "avx512dq")
}

/// The operators of a type that holds a register and exists only where its instructions do.
macro_rules! operators {
    ($name:ident: $($operator:ident::$function:ident = $intrinsic:ident),*) => {$(
        impl $operator for $name {
            type Output = Self;

            #[inline(always)]
            fn $function(self, other: Self) -> Self {
                // SAFETY: a value of this type exists only where its instructions do.
                Self(unsafe { $intrinsic(self.0, other.0) })
            }
        }
    )*};
}

pub(crate) use operators;
