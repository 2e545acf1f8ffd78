//! Generated code against the hand-written reference: every output of every function, on the default platform and ten
//! others, at home, random, large and near-edge states; with parameters at run time and baked in.

use std::collections::BTreeSet;

use dyn_gen::Numbers;
use dyn_gen::deviation::Scale;
use dyn_gen::graph::Environment;
use dyn_gen::sample::Kind;
use dyn_platform::Platform;
use dyn_tests::comparison::Comparison;
use dyn_tests::compiled::{self, Model};
use dyn_tests::platforms::{self, graph_file};
use dyn_tests::reference;

const STATES_OF_EACH_KIND: usize = 50;

fn add_model(comparison: &mut Comparison, model: &dyn Model, platform: &Platform, label: &str) {
    let states = platforms::states(&graph_file(platform.leg_type), platform, STATES_OF_EACH_KIND);
    let expected = expected(platform, &states);
    for ((kind, state), outputs) in states.iter().zip(&expected) {
        for (function, output, values) in compiled::outputs(model, state) {
            let label = format!("{label}, {kind:?}: {function}");
            comparison.add(&label, &output, &values, &outputs[&output], scale(&expected, &output));
        }
    }
}

/// The reference's outputs at every state.
fn expected(platform: &Platform, states: &[(Kind, Environment)]) -> Vec<Environment> {
    let parameters = reference::parameters(platform);
    states.iter().map(|(_, state)| reference::outputs(&parameters, &reference::state(state))).collect()
}

fn scale(expected: &[Environment], output: &str) -> Scale {
    Scale::of(expected.iter().map(|outputs| outputs[output].as_slice()))
}

#[test]
fn model_with_run_time_parameters_on_every_platform() {
    let mut comparison = Comparison::default();
    for platform in platforms::all() {
        add_model(
            &mut comparison,
            &*compiled::at_run_time(&platform),
            &platform,
            &format!("run time, {}", platform.name),
        );
    }
    comparison.finish();
}

#[test]
fn baked_models() {
    let mut comparison = Comparison::default();
    for (name, model) in compiled::BAKED {
        add_model(&mut comparison, model, &platforms::platform(name), name);
    }
    comparison.finish();
}

/// Interpreted final graphs of all platforms that are not compiled.
#[test]
fn baked_graphs_of_the_other_platforms() {
    let mut comparison = Comparison::default();
    let is_baked = |platform: &Platform| compiled::BAKED.iter().any(|(name, _)| *name == platform.name);
    for platform in platforms::all().into_iter().filter(|platform| !is_baked(platform)) {
        let (name, file) = (&platform.name, graph_file(platform.leg_type));
        let functions = dyn_gen::optimise(&file.program, &Numbers::baked(&platform), None).unwrap();
        let states = platforms::states(&file, &platform, 10);
        let expected = expected(&platform, &states);
        for ((kind, state), outputs) in states.iter().zip(&expected) {
            for function in &functions {
                let label = format!("{name}, {kind:?}: {}", function.graph.name);
                for (output, values) in function.graph.evaluate(state).unwrap() {
                    comparison.add(&label, &output, &values, &outputs[&output], scale(&expected, &output));
                }
            }
        }
    }
    comparison.finish();
}

/// What is printed and compiled computes the interpreter's bits. (The model with parameters at run time solves with
/// pivots in the runtime crate, the interpreter in its own way: they agree to rounding only.)
#[test]
fn compiled_baked_models_give_the_interpreter_s_bits() {
    for (name, model) in compiled::BAKED {
        let platform = platforms::platform(name);
        let file = graph_file(platform.leg_type);
        let functions = dyn_gen::optimise(&file.program, &Numbers::baked(&platform), None).unwrap();
        for (kind, state) in platforms::states(&file, &platform, 5) {
            for function in &functions {
                let compiled = model.call(&function.graph.name, &state);
                for (output, interpreted) in function.graph.evaluate(&state).unwrap() {
                    let same =
                        compiled[&output].iter().zip(&interpreted).all(|(a, b)| a.to_bits() == b.to_bits());
                    assert!(same, "{name}, {kind:?}: {}, {output}", function.graph.name);
                }
            }
        }
    }
}

#[test]
fn the_reference_has_every_generated_output_and_no_other() {
    for platform in platforms::all() {
        let file = graph_file(platform.leg_type);
        let functions = file.program.functions.iter();
        let generated: BTreeSet<&str> =
            functions.flat_map(|function| function.outputs.iter().map(String::as_str)).collect();
        let reference: BTreeSet<&str> = reference::parameters(&platform).output_names().into_iter().collect();
        assert_eq!(generated, reference, "{}", platform.name);
    }
}
