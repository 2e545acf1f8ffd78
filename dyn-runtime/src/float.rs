//! The elementary functions that `core` lacks. Generated code calls [`sqrt`].
//!
//! A square root is correctly rounded everywhere, so the fastest one at hand is used. Trigonometric functions
//! differ by one unit in the last place between C libraries: they come from libm on every host, so that a
//! pose made from angles, or angles from a pose, have the same bits everywhere.

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

/// Angle of the point (x, y) in radians, `-pi` to `pi`; 0 for y = 0 and x = 0.
pub fn atan2(y: f64, x: f64) -> f64 {
    libm::atan2(y, x)
}
