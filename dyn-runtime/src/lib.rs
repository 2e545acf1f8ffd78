//! Dynamics of a six-legged platform on a moving base, for control loops: `no_std`, no allocation, bounded
//! work, a typed answer to every bad situation.
//!
//! The mechanism is the 6-UHP platform of "Dynamic Modeling and Simulation of a 6-UHP Parallel Platform under
//! Base Excitation", ROBOT 38(6), 2016, doi 10.13973/j.cnki.robot.2016.0687; numbers in parentheses, as in
//! (49), are its equations. A leg, from the base up: an actuator fixed to the base, along a fixed axis `a`,
//! length `d`; a Hooke joint; a rod of fixed length along the unit vector `u`; a universal joint on the
//! platform. The base's motion is an input.
//!
//! # First call
//!
//! ```
//! use dyn_runtime::nalgebra::Vector3;
//! use dyn_runtime::{Acceleration, BaseMotion, Hexapod, PlatformState, Pose, Twist, Wrench, models::Uhp2016};
//!
//! let hexapod = Hexapod::new(Uhp2016);
//!
//! // The base is tilted by 0.1 rad about x and shakes upwards with 0.1 g.
//! let base = BaseMotion {
//!     pose: Pose::from_paper_angles(Vector3::zeros(), [0.1, 0.0, 0.0]),
//!     velocity: Twist::zero(),
//!     acceleration: Acceleration { linear_m_s2: Vector3::new(0.0, 0.0, 0.981), ..Acceleration::zero() },
//! };
//! // The platform is at home, 0.382 m above the base, and shall not feel it.
//! let home = Pose::from_paper_angles(Vector3::new(0.0, 0.0, 0.382), [0.0; 3]);
//! let platform = PlatformState::at_rest(base.pose.compose(&home));
//!
//! match hexapod.inverse_dynamics(&base, &platform, &Acceleration::zero(), &Wrench::zero()) {
//!     Ok(forces_n) => assert!(forces_n.amax() < 100.0),
//!     Err(reason) => panic!("stop the controller: {reason}"),
//! }
//! ```
//!
//! # Frames and units
//!
//! O is inertial, B fixed to the base, P fixed to the platform with its origin at the centre of the circle
//! of platform joints. Everything that enters or leaves is in SI units and in O's axes. A state's type says
//! which body it describes and a field's name its unit; names carry no frame because there is only this
//! one. What is measured in body axes is turned first: `pose.rotation * vector`. A [`Pose`] turns body
//! coordinates into O; make it from the paper's angles, a unit quaternion or a rotation matrix. Speeds are
//! `[r'; w]` with the angular velocity w, **never rates of Euler angles**; [`angles`] converts those.
//! Gravity is a parameter of the model.
//!
//! # Which call
//!
//! | wanted | call |
//! |-|-|
//! | forces for a wanted acceleration | [`Hexapod::inverse_dynamics`] |
//! | all that a controller needs, in one call | [`Hexapod::control`] |
//! | forces for passivity-based control | [`Hexapod::passive_inverse_dynamics`] |
//! | what the base feels | [`Hexapod::base_reaction`] |
//! | pose from actuator lengths, velocity from rates | [`Hexapod::forward_kinematics`], [`Hexapod::platform_velocity`] |
//! | margins of stroke, rate, force, joints, conditioning | [`Hexapod::monitor`] |
//! | acceleration under given forces | [`Hexapod::forward_dynamics`] |
//! | every term of the equation of motion (49) | [`Hexapod::equation_of_motion`] |
//! | M, C, J together, or singly | [`Hexapod::matrices`], [`Hexapod::mass_matrix_p`], [`Hexapod::jacobian_dp`], ... |
//! | velocity terms, gravity, springs, dampers | [`Hexapod::bias`], [`Hexapod::passive_forces`] |
//! | actuator lengths and rates, joints | [`Hexapod::leg_kinematics`] |
//! | every body by itself | [`Hexapod::body_kinematics`], [`Hexapod::partial_velocities`], [`Hexapod::generalised_forces`]; with legs `ups` [`Hexapod::ups_body_kinematics`] and so on |
//! | how far a pose is from a leg's limit | [`Hexapod::rod_alignment`] |
//! | energy | [`Hexapod::energy`] |
//! | many states, simulations or platforms at once | [`batch::Batch`] |
//!
//! # Models
//!
//! [`models::Uhp2016`] is the paper's platform with its numbers baked into the code; [`models::Uhp`] takes
//! all parameters at run time, and so does [`models::Ups`] for platforms with classical Gough-Stewart legs, whose
//! actuators lie along the legs. All implement the traits in [`kernels`], one trait per function, as does what
//! the generator writes for your platform; [`Hexapod`] works with any of them.
//!
//! For many calls with the same parameters, `Hexapod::new(Uhp { parameters }.prepared())`: a [`models::PreparedUhp`] has
//! computed what follows from its parameters alone, and its functions in lanes need not gather them. Its parameters cannot be
//! changed: other parameters make another one, so that nothing can be out of date.
//!
//! # What is checked, what is not
//!
//! Checked calls are the methods of [`Hexapod`], which lists what they refuse. The traits in [`kernels`] and
//! the free functions beside each model are the same computations on plain row-major arrays without any
//! check: a fixed amount of work (with geometry at run time there are two: a linear system is solved in blocks, and where
//! the solution does not satisfy it, by elimination as well) and no panic whatever comes in, but where a checked call refuses, numbers
//! without meaning come out, often finite ones: [`kernels`] says which.
//!
//! # Precision
//!
//! Everything is in `f64` unless said otherwise: a hexapod made by [`Hexapod::single_precision`] takes and
//! returns `f32`, refuses at the thresholds of `f32` (see [`Real`]), and knows its forces to about five
//! digits. Generated free functions take any [`float::Scalar`].
//!
//! # Features
//!
//! Off by default. `std`: square roots come from `std` instead of libm, results keep their bits; batches and single
//! calls ask the processor for its instructions, see [`triple`]. `rayon`: batches in several threads.

#![no_std]
// Lanes are made of intrinsics: two modules allow them and say why. Generated code forbids it.
#![deny(unsafe_code)]

#[cfg(feature = "std")]
extern crate std;

pub use nalgebra;

mod arrays;
mod base_reaction;
mod blocks;
mod check;
mod control;
mod energy;
mod equation_of_motion;
mod error;
mod evaluate;
mod forces;
mod forward_dynamics;
mod forward_kinematics;
#[rustfmt::skip]
mod generated;
mod hexapod;
mod inverse_dynamics;
mod kinematics;
mod matrices;
mod monitor;
mod newton;
mod real;
mod state;
mod trigonometry;
#[cfg(target_arch = "x86_64")]
mod x86;

pub mod angles;
pub mod batch;
pub mod current;
pub mod float;
pub mod lanes;
pub mod parameter;
pub mod rotation_vector;
pub mod solve;
pub mod triple;
pub mod ups;

pub use base_reaction::BaseReaction;
pub use check::{
    MAX_ROTATION_DEVIATION, MIN_RECIPROCAL_CONDITION, MIN_ROD_ALIGNMENT, jacobian_condition_bound,
    jacobian_reciprocal_condition,
};
pub use control::Control;
pub use energy::Energy;
pub use equation_of_motion::EquationOfMotion;
pub use error::{Error, GimbalLock, Input, NotARotation, NotAUnitQuaternion};
pub use forces::{GeneralisedForces, PassiveForces};
pub use forward_kinematics::ForwardKinematics;
pub use generated::kernels;
pub use hexapod::Hexapod;
pub use kinematics::{BodyKinematics, LegKinematics, PartialVelocities};
pub use matrices::{CoriolisMatrices, Matrices, StiffnessMatrices};
pub use monitor::{Limits, Margin, Monitor, Quantity};
pub use real::Real;
pub use state::{Acceleration, BaseMotion, PlatformState, Pose, Twist, Wrench};

/// The committed models, generated from `platforms/uhp_2016.toml`.
pub mod models {
    pub use crate::generated::uhp::{self, Parameters, PreparedUhp, Uhp};
    pub use crate::generated::uhp_2016::{self, Uhp2016};
    pub use crate::generated::ups::{self, PreparedUps, Ups};
}
