//! What `cargo regen` writes into `generated/`, and only that: edit the derivation or the platform file
//! instead.
#![forbid(unsafe_code)]
// Trait methods call free functions through `self::`, needed only where an output has the function's name.
#![allow(unused_qualifications)]

/// What every model can compute: one trait per function.
pub mod kernels;
/// The model with all parameters at run time.
pub mod uhp;
/// The paper's platform, every number baked in.
pub mod uhp_2016;
/// The model with legs of type `ups` and all parameters at run time.
pub mod ups;
