//! From a graph file and a platform's numbers to flat Rust.
//!
//! [`generate`] is the pipeline; the modules are its stages:
//!
//! | module | does |
//! |-|-|
//! | [`graph`] | reads the graph file, composes one expression graph per function, gives graphs their meaning in numbers |
//! | [`passes`] | bakes numbers in and makes graphs smaller |
//! | [`sample`] | states of the mechanism, by which pivot orders are chosen and results compared |
//! | [`emit`] | prints graphs as Rust |
//! | [`evidence`] | compares what will be printed with the graph as derived and with hand-written dynamics, and asks laws of mechanics of it |
//! | [`mod@explain`] | a platform in figures |
//! | [`mod@vectors`] | inputs and outputs for whoever ports the equations |
//! | [`deviation`] | how far arrays of numbers are apart |
//!
//! Only [`Build`], for build scripts, and [`output`] touch files; the command line tool `dyn-gen` does the rest.

mod build_script;
pub mod deviation;
pub mod emit;
mod error;
pub mod evidence;
pub mod explain;
mod generate;
pub mod graph;
mod graph_file;
mod limits;
mod numbers;
pub mod output;
pub mod pack;
mod parallel;
pub mod passes;
pub mod sample;
mod text;
pub mod vectors;
mod workspace;

pub use build_script::{Build, BuildError};
pub use error::GenerateError;
pub use generate::{
    Generated, GeneratedFunction, IN_LANES, MOST_GROWTH, Options, generate, kernels, optimise,
    optimise_without,
};
pub use graph_file::{GraphFile, sha256};
pub use numbers::Numbers;
pub use workspace::{sampled_states, state_at};
