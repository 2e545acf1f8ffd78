//! Generated code against the hand-written reference: every output of every function, on the default platform and eight
//! others, at home, random, large and near-edge states; with parameters at run time and baked in.

use std::collections::BTreeMap;

use dyn_gen::graph::Environment;
use dyn_tests::compare::{Scale, deviation, within};
use dyn_tests::compiled::{self, Model, baked};
use dyn_tests::platforms::{self, SEED, graph_file};
use dyn_tests::reference;
use dyn_tests::tolerance::tolerance;

const STATES_OF_EACH_KIND: usize = 50;

/// Largest deviation per output, and failures in words.
#[derive(Default)]
struct Comparison {
    worst: BTreeMap<String, f64>,
    failures: Vec<String>,
}

impl Comparison {
    fn add<M: Model>(&mut self, model: &M, platform: &dyn_platform::Platform, label: &str) {
        let parameters = reference::parameters(platform);
        let states = platforms::states(&graph_file(), platform, STATES_OF_EACH_KIND);
        let expected: Vec<Environment> = states
            .iter()
            .map(|(_, state)| reference::outputs(&parameters, &reference::state(state)))
            .collect();
        for ((kind, state), outputs) in states.iter().zip(&expected) {
            for (function, output, values) in compiled::outputs(model, state) {
                let scale = Scale::of(expected.iter().map(|outputs| outputs[&output].as_slice()));
                let found = deviation(&values, &outputs[&output], scale);
                if !within(found, tolerance(&output)) {
                    self.failures
                        .push(format!("{label}, {kind:?}: {function}, {output} deviates by {found:.1e}"));
                }
                let worst = self.worst.entry(output).or_default();
                *worst = worst.max(found);
            }
        }
    }

    fn finish(self) {
        for (output, worst) in &self.worst {
            println!("{output:36} {worst:8.1e}  (tolerance {:.0e})", tolerance(output));
        }
        let failures = self.failures;
        assert!(
            failures.is_empty(),
            "{} failures with seed {SEED}:\n{}",
            failures.len(),
            failures[..failures.len().min(20)].join("\n")
        );
    }
}

#[test]
fn model_with_run_time_parameters_on_every_platform() {
    let mut comparison = Comparison::default();
    for platform in platforms::all() {
        comparison.add(&compiled::at_run_time(&platform), &platform, &format!("run time, {}", platform.name));
    }
    comparison.finish();
}

#[test]
fn baked_models() {
    let mut comparison = Comparison::default();
    comparison.add(&dyn_runtime::models::Uhp2016, &platforms::platform("uhp_2016"), "uhp_2016");
    comparison.add(&baked::tilted_axes::TiltedAxes, &platforms::platform("tilted_axes"), "tilted_axes");
    comparison.add(&baked::unequal_legs::UnequalLegs, &platforms::platform("unequal_legs"), "unequal_legs");
    comparison.add(&baked::long_thin::LongThin, &platforms::platform("long_thin"), "long_thin");
    comparison.add(&baked::everything::Everything, &platforms::platform("everything"), "everything");
    comparison.finish();
}

/// Interpreted final graphs of all platforms that are not compiled.
#[test]
fn baked_graphs_of_the_other_platforms() {
    let file = graph_file();
    let mut failures = Vec::new();
    for name in ["full_inertia", "no_gravity", "no_springs", "tilted_gravity_damped"] {
        let platform = platforms::platform(name);
        let parameters = reference::parameters(&platform);
        let functions = dyn_gen::optimise(&file.program, dyn_gen::Numbers::Baked(&platform), None).unwrap();
        let states = platforms::states(&file, &platform, 10);
        let expected: Vec<Environment> = states
            .iter()
            .map(|(_, state)| reference::outputs(&parameters, &reference::state(state)))
            .collect();
        for ((kind, state), outputs) in states.iter().zip(&expected) {
            for function in &functions {
                for (output, values) in function.graph.evaluate(state).unwrap() {
                    let scale = Scale::of(expected.iter().map(|outputs| outputs[&output].as_slice()));
                    let found = deviation(&values, &outputs[&output], scale);
                    if !within(found, tolerance(&output)) {
                        failures.push(format!(
                            "{name}, {kind:?}: {}, {output}: {found:.1e}",
                            function.graph.name
                        ));
                    }
                }
            }
        }
    }
    assert!(failures.is_empty(), "{} failures with seed {SEED}:\n{}", failures.len(), failures.join("\n"));
}

#[test]
fn the_reference_has_every_generated_output_and_no_other() {
    let file = graph_file();
    let generated: std::collections::BTreeSet<&str> = file
        .program
        .functions
        .iter()
        .flat_map(|function| function.outputs.iter().map(String::as_str))
        .collect();
    let reference: std::collections::BTreeSet<&str> =
        dyn_reference::outputs::OUTPUTS.iter().map(|output| output.name).collect();
    assert_eq!(generated, reference);
}
