//! The number type of the library.

use dyn_runtime::Hexapod;

/// A physical number: double precision, or with DYN_F32 defined single precision, as the library was built.
/// Define DYN_F32 for the program if and only if the library has the feature f32; calls on bare arrays with info NULL cannot notice.
#[cfg(not(feature = "f32"))]
pub type Real = f64;

/// A physical number: double precision, or with DYN_F32 defined single precision, as the library was built.
/// Define DYN_F32 for the program if and only if the library has the feature f32; calls on bare arrays with info NULL cannot notice.
#[cfg(feature = "f32")]
pub type Real = f32;

/// A hexapod in the library's precision.
#[cfg(not(feature = "f32"))]
pub(crate) fn hexapod<M>(model: M) -> Hexapod<M, Real> {
    Hexapod::new(model)
}

/// A hexapod in the library's precision.
#[cfg(feature = "f32")]
pub(crate) fn hexapod<M>(model: M) -> Hexapod<M, Real> {
    Hexapod::single_precision(model)
}
