//! Experiments with a parallel platform on a moving base: excitation, simulation, spectra, virtual prototype,
//! comparison, report.
//!
//! ```
//! use dyn_sim::{compare, experiment, scenario::Scenario};
//!
//! # fn main() -> Result<(), dyn_sim::scenario::ScenarioError> {
//! let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenarios/published.toml");
//! let scenario = Scenario::from_file(path)?;
//! let result = experiment::run(&scenario, None, "example", &mut experiment::Silent);
//! // The largest error of any complex amplitude against the wanted motion, in percent.
//! assert!(compare::worst_percent(&result.outcome.amplitude_tables[0]) < 1e-5);
//! # Ok(())
//! # }
//! ```
//!
//! Everything is in SI units and in the axes of the inertial frame O unless it says otherwise. Angular velocity is never
//! a rate of Euler angles. Numbers in parentheses, as in (49), are equations of "Dynamic Modeling and Simulation of a
//! 6-UHP Parallel Platform under Base Excitation", ROBOT 38(6), 2016, doi 10.13973/j.cnki.robot.2016.0687.
//!
//! | module | holds |
//! |-|-|
//! | [`scenario`] | scenario files and measured motions, checked |
//! | [`excitation`], [`rotation`], [`measured`], [`motion`] | what a body does at any time |
//! | [`mechanism`] | the generated dynamics, baked or with parameters at run time |
//! | [`integrator`], [`adaptive`], [`simulate`] | from forces to motion |
//! | [`stop`], [`limits`] | what ends a motion, what it exceeds |
//! | [`prototype`] | the same by an independent multibody engine |
//! | [`spectrum`], [`compare`] | complex amplitudes, errors |
//! | [`experiment`], [`outcome`] | all of it in order, and what it leaves |
//! | [`sweep`] | many designs or starts at once |
//! | [`report`] | tables, curves and figures on disk |

pub mod adaptive;
pub mod compare;
pub mod excitation;
pub mod experiment;
pub mod integrator;
pub mod limits;
pub mod measured;
pub mod mechanism;
pub mod motion;
pub mod outcome;
pub mod prototype;
pub mod report;
pub mod rotation;
pub mod scenario;
pub mod simulate;
pub mod spectrum;
pub mod stop;
pub mod sweep;
