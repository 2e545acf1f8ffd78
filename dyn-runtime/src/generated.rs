//! What `cargo regen` writes into `generated/`, and only that: edit the derivation or the platform file
//! instead.
#![forbid(unsafe_code)]
// Trait methods call free functions through `self::`, needed only where an output has the function's name.
#![allow(unused_qualifications)]

/// What every model can compute: one trait per function, on plain row-major arrays, without any check.
///
/// Where a checked call of [`Hexapod`](crate::Hexapod) refuses, these give NaN or infinities for inputs that are not finite and out of
/// a leg's reach, but **finite numbers without meaning** for a matrix that is no rotation, for a rod nearly perpendicular to its
/// actuator (below [`Real::MIN_ROD_ALIGNMENT`](crate::Real::MIN_ROD_ALIGNMENT)) and near a singular J_dp. So a look at the result
/// is no replacement for the checks.
pub mod kernels;
/// The model with all parameters at run time.
pub mod uhp;
/// The paper's platform, every number baked in.
pub mod uhp_2016;
/// The model with legs of type `ups` and all parameters at run time.
pub mod ups;
