//! The generated hexapod dynamics for C: checked calls on plain structs and arrays.
//!
//! The header is `dyn-capi/include/dyn_capi.h`; `docs/control-loop.md` shows how the calls belong together, in C and in
//! Rust. Every call takes a [`Model`], [`Inputs`], a place for its output and, if wanted, a place for [`Info`], and
//! returns a [`Status`]. It allocates nothing, keeps nothing, and writes its output only with `DYN_STATUS_OK`.
//!
//! No call panics, whatever comes in: `cargo xtask bare` shows it for the compiled library. So nothing can unwind into C.
//!
//! # What a caller must keep
//!
//! Pointers are null or point to what their type says. A struct need only be as large as its first member, `struct_size`,
//! while that member is not the struct's size in this library: then the rest is neither read nor written, and the
//! call refuses. During a call no other thread writes what the call reads, or uses what it writes. Outputs may lie
//! anywhere, over inputs as well: they are written when everything is computed.
//!
//! # Inside
//!
//! | module | holds |
//! |-|-|
//! | `real` | the number type |
//! | `status` | status, details, both in words |
//! | `model`, `parameters`, `inputs`, `outputs` | structs, and what the runtime makes of them |
//! | `pointers` | the border: the only module that follows pointers |
//! | `control` | the calls that a control loop is made of |
//! | `limits` | the calls about what actuators and joints may do |
//! | `dynamics` | the other calls about a model, one row each |
//! | `rotations` | the calls about rotations and angles |
//! | `panic` | the handler of libraries without `std` |
//!
//! A call more is a row in `dynamics`, its result (if it has several parts) a struct in `outputs`; then
//! `cargo run -p dyn-capi --example write_header`.

#![no_std]
// Unmangled names and pointers of callers are what a C interface is made of; only `pointers` follows them.
#![allow(unsafe_code)]
// One contract for all calls; it stands above.
#![allow(clippy::missing_safety_doc)]

#[cfg(feature = "hosted")]
extern crate std;

mod control;
mod dynamics;
mod inputs;
mod limits;
mod model;
mod outputs;
#[cfg(all(feature = "panic-handler", not(feature = "hosted")))]
mod panic;
mod parameters;
mod pointers;
mod real;
mod rotations;
mod status;

pub use control::*;
pub use dynamics::*;
pub use inputs::Inputs;
pub use limits::*;
pub use model::{Model, ModelKind, dyn_baked_platform_name, dyn_check_model};
pub use outputs::{
    CoriolisMatrices, Energy, EquationOfMotion, LegKinematics, Matrices, PassiveForces, StiffnessMatrices,
};
pub use parameters::{UhpParameters, UpsParameters};
pub use real::Real;
pub use rotations::*;
pub use status::{Info, InputName, Status, dyn_input_text, dyn_status_text};
