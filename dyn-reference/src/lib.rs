//! Hand-written numeric dynamics of six-legged parallel platforms on a moving base.
//!
//! This crate is the oracle against which generated code is compared. It is written by hand from the formulas
//! of "Dynamic Modeling and Simulation of a 6-UHP Parallel Platform under Base Excitation", ROBOT 38(6),
//! 2016, doi 10.13973/j.cnki.robot.2016.0687, whose equation numbers are cited as `(18)`. Where the print is
//! wrong, the function says so and implements the right formula.
//!
//! It works throughout in inertial coordinates O, keeps every part of a leg as a rigid body with an explicit angular
//! velocity and the inertia `J (1 - u u^T)`, and forms every matrix as the sum over bodies of its
//! definition. It knows no symbolic derivation, no generated code and no file format: parameters and states
//! are plain numbers.
//!
//! The numeric core uses fixed-size arrays and allocates nothing; only [`inputs`], [`outputs`] and [`mechanism`], which
//! carry values by name, allocate.
//!
//! | module | holds |
//! |-|-|
//! | [`parameters`], [`state`] | what goes in |
//! | [`legs`] | the leg types: closure, its rates, two bodies with their partial velocities, masses, forces |
//! | [`leg`] | what they have in common; `rod_alignment`, `leg_kinematics`, `jacobian_dp`, `jacobian_db` |
//! | [`bodies`] | `body_kinematics`: payload and legs' bodies |
//! | [`mod@partial_velocities`] | `partial_velocities` and their inertial time derivatives |
//! | [`mod@matrices`] | `mass_matrix_p`, `mass_matrix_b`, `coriolis_matrices`, `stiffness_matrices`, `matrices` |
//! | [`forces`] | `generalised_forces`, `passive_forces` |
//! | [`dynamics`] | `bias`, `equation_of_motion`, `inverse_dynamics`, `forward_dynamics` |
//! | [`control`] | `total_bias`, `passive_inverse_dynamics`, `base_wrench` |
//! | [`mod@energy`] | `energy` |
//! | [`inputs`], [`outputs`] | parameters, states and results by name, as flat row-major numbers |
//! | [`mechanism`] | parameters whose leg type is known at run time only |
//!
//! A leg that cannot be built (a rod that does not reach its platform joint) yields NaN (see [`leg::rod_alignment`]).

pub mod bodies;
pub mod control;
pub mod dynamics;
pub mod energy;
pub mod forces;
pub mod inputs;
pub mod leg;
pub mod legs;
pub mod matrices;
pub mod mechanism;
pub mod outputs;
pub mod parameters;
pub mod partial_velocities;
pub mod state;

pub use bodies::body_kinematics;
pub use control::{base_wrench, passive_inverse_dynamics, total_bias};
pub use dynamics::{bias, equation_of_motion, forward_dynamics, inverse_dynamics};
pub use energy::energy;
pub use forces::{generalised_forces, passive_forces};
pub use leg::{jacobian_db, jacobian_dp, leg_kinematics, rod_alignment};
pub use legs::{LegType, uhp, ups};
pub use matrices::{coriolis_matrices, mass_matrix_b, mass_matrix_p, matrices, stiffness_matrices};
pub use mechanism::Mechanism;
pub use parameters::{Parameters, Payload};
pub use partial_velocities::partial_velocities;
pub use state::{RigidBodyMotion, State};
