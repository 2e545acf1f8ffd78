//! Generated code beside the hand-written reference: what is measured, and how. `docs/benchmarks.md` tells how to
//! read the figures.
//!
//! | module | holds |
//! |-|-|
//! | [`states`] | the states that every implementation gets |
//! | [`output`] | results that differ in type, read alike |
//! | [`call`] | one call of one function by one implementation; the loops around it |
//! | [`cases`] | the table of functions and implementations |
//! | [`counts`] | instructions per call, by callgrind |
//! | [`budget`] | counts that may not grow |
//! | [`ratios`] | ratios from criterion's results |
//! | [`bundle`] | everything that a controller asks of the model in a cycle |
//! | [`control_loop`], [`machine`], [`loop_plot`] | the same in a loop at 10 kHz: times, circumstances, plot |
//! | [`table`] | text tables |
//!
//! `benches/dynamics.rs` measures times, `instruction_counts` counts, `ratios` sums up, `control_loop` runs a loop.

pub mod budget;
pub mod bundle;
pub mod call;
pub mod cases;
pub mod control_loop;
pub mod counts;
pub mod loop_plot;
pub mod machine;
pub mod output;
pub mod ratios;
pub mod states;
pub mod table;

/// Compiler, target, optimisation, target features and flags of this build.
pub const CODEGEN: &str = env!("DYN_BENCHES_CODEGEN");
