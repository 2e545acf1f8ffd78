//! Generated code beside the hand-written reference: what is measured, and how. `docs/benchmarks.md` tells how to
//! read the figures.
//!
//! | module | holds |
//! |-|-|
//! | [`states`] | the states that every implementation gets |
//! | [`output`] | results that differ in type, read alike |
//! | [`call`] | one call of one function by one implementation; the loops around it |
//! | [`cases`] | the table of functions and implementations |
//! | [`flat`] | the baked model without lanes |
//! | [`angles`] | rotations given by angles |
//! | [`peers`] | other people's code for the same functions |
//! | [`accuracy`] | rounding errors, against fifty digits |
//! | [`selection`] | the fastest of several ways to compile a peer |
//! | [`tail`] | times of single calls: median and 99th percentile |
//! | [`counts`] | instructions per call, by callgrind |
//! | [`budget`] | counts that may not grow |
//! | [`results`], [`ratios`] | criterion's results, and ratios from them |
//! | [`ratio_tables`], [`ratio_plot`] | those as tables and as a plot |
//! | [`bundle`] | everything that a controller asks of the model in a cycle |
//! | [`control_loop`], [`machine`], [`loop_plot`] | the same in a loop at 10 kHz: times, circumstances, plot |
//! | [`pass_variants`] | models made without some passes |
//! | [`table`] | text tables |
//!
//! `benches/dynamics.rs` measures times, `instruction_counts` counts, `ratios` sums up, `passes` tells what each pass is worth, `control_loop` runs a loop.

pub mod accuracy;
pub mod angles;
pub mod batch;
pub mod budget;
pub mod bundle;
pub mod call;
pub mod cases;
pub mod control_loop;
pub mod counts;
pub mod flat;
pub mod loop_plot;
pub mod machine;
pub mod output;
pub mod pass_variants;
pub mod peers;
pub mod ratio_plot;
pub mod ratio_tables;
pub mod ratios;
pub mod results;
pub mod selection;
pub mod states;
pub mod table;
pub mod tail;

/// The model that is measured with its numbers baked in.
pub mod model {
    include!(concat!(env!("OUT_DIR"), "/model.rs"));
}

/// The same with payload, gravity and stiffnesses given at run time.
pub mod payload {
    include!(concat!(env!("OUT_DIR"), "/payload.rs"));
}

/// Compiler, target, optimisation, target features and flags of this build.
pub const CODEGEN: &str = env!("DYN_BENCHES_CODEGEN");
