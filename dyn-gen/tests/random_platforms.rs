//! Random platforms through the whole chain: what would be printed agrees with the graph as derived and with the hand-written
//! dynamics, whatever the numbers are and whichever of them are given at run time.
//!
//! The long run: `DYN_GEN_PLATFORMS=2000 cargo test --release -p dyn-gen --test random_platforms -- --nocapture`.

mod common;

use common::platforms::{Draw, random};
use dyn_gen::evidence::{Sampling, gather};
use dyn_gen::{GenerateError, GraphFile, Numbers, optimise};
use dyn_platform::LegType;

/// Platforms looked at unless `DYN_GEN_PLATFORMS` says otherwise.
const PLATFORMS: usize = 60;
/// States of each unless `DYN_GEN_STATES` says otherwise.
const STATES: usize = 5;

fn count(variable: &str, otherwise: usize) -> usize {
    std::env::var(variable).map_or(otherwise, |count| count.parse().expect("a number"))
}

#[test]
fn whatever_the_numbers_the_printed_functions_are_right() {
    let (platforms, states) = (count("DYN_GEN_PLATFORMS", PLATFORMS), count("DYN_GEN_STATES", STATES));
    for leg_type in LegType::ALL {
        let file = GraphFile::of(leg_type).unwrap();
        let mut worst_law = (0.0, "");
        let (mut examined, mut singular, mut worst) = (0, 0, (0.0, String::new()));
        for seed in 0..platforms as u64 {
            let platform = random(leg_type, seed);
            let mut draw = Draw::new(seed + 1_000_000);
            // Every other platform keeps some of its numbers for run time.
            let at_run_time = if seed % 2 == 0 { Vec::new() } else { draw.some(platform.parameter_names()) };
            let numbers = Numbers::with_run_time(&platform, at_run_time.clone());
            let evidence = optimise(&file.program, &numbers, None)
                .and_then(|functions| gather(&file.program, &numbers, &functions, Sampling { states, seed }));
            match evidence {
                Ok(evidence) => {
                    let context = format!("{} {seed}, at run time {at_run_time:?}", leg_type.name());
                    assert!(evidence.holds(), "{context}:\n{}", evidence.failures().join("\n"));
                    examined += 1;
                    for row in &evidence.laws {
                        let share = row.worst.map_or(0.0, |worst| worst.share());
                        if share > worst_law.0 {
                            worst_law = (share, row.law);
                        }
                    }
                    for row in &evidence.outputs {
                        let share = row.reference.share().max(row.unoptimised.share());
                        if share > worst.0 {
                            worst = (share, format!("{} of {context}", row.output));
                        }
                    }
                }
                // A random layout may be one that no legs can hold; that is said, not generated.
                Err(GenerateError::NoPose { .. } | GenerateError::Growth { .. }) => singular += 1,
                Err(error) => panic!("{} {seed}: {error}", leg_type.name()),
            }
        }
        println!(
            "{}: {examined} platforms x {states} states, {singular} refused as singular; at worst {:.2} of a tolerance ({}), \
             {:.2} of a law's ({})",
            leg_type.name(),
            worst.0,
            worst.1,
            worst_law.0,
            worst_law.1
        );
        assert!(singular * 20 <= examined, "{singular} of {examined} random platforms are singular");
    }
}
