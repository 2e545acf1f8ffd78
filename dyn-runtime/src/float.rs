//! The elementary functions that `core` lacks. Generated code calls [`sqrt`].
//!
//! A square root is correctly rounded everywhere, so the fastest one at hand is used. Sines and cosines
//! differ by one unit in the last place between C libraries: they come from libm on every host, so that a
//! pose made from angles has the same bits everywhere.

/// Square root; NaN below zero.
#[cfg(feature = "std")]
#[inline(always)]
pub fn sqrt(x: f64) -> f64 {
    x.sqrt()
}

/// Square root; NaN below zero.
#[cfg(not(feature = "std"))]
#[inline(always)]
pub fn sqrt(x: f64) -> f64 {
    libm::sqrt(x)
}

/// Sine and cosine of an angle in radians, in this order.
pub fn sin_cos(angle: f64) -> (f64, f64) {
    libm::sincos(angle)
}
