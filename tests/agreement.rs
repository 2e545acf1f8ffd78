//! Generated code against the hand-written reference: every output of every function, on the default platform and ten
//! others, at home, random, large and near-edge states; with parameters at run time and baked in.

use std::collections::BTreeSet;

use dyn_gen::Numbers;
use dyn_gen::deviation::Scale;
use dyn_gen::graph::{Environment, Graph, Rounding};
use dyn_gen::pack::unpack;
use dyn_gen::sample::Kind;
use dyn_platform::Platform;
use dyn_runtime::models::uhp_2016;
use dyn_runtime::triple::{Portable, in_registers};
use dyn_tests::comparison::Comparison;
use dyn_tests::compiled::{self, Model, array};
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
        let name = &platform.name;
        let model = compiled::at_run_time(&platform);
        add_model(&mut comparison, &*model, &platform, &format!("run time, {name}"));
        let model = compiled::prepared(&platform);
        add_model(&mut comparison, &*model, &platform, &format!("prepared, {name}"));
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
        let in_lanes = functions.iter().map(|f| f.in_lanes.as_ref().map(|packed| unpack(&packed.graph)));
        let in_lanes: Vec<Option<Graph>> = in_lanes.collect();
        for (kind, state) in platforms::states(&file, &platform, 5) {
            for (function, in_lanes) in functions.iter().zip(&in_lanes) {
                let compiled = model.call(&function.graph.name, &state);
                // A model takes registers of three numbers where the processor has them, and rounds once there.
                let (graph, rounding) = match in_lanes {
                    Some(graph) if in_registers() => (graph, Rounding::Fused),
                    _ => (&function.graph, AS_COMPILED),
                };
                for (output, interpreted) in graph.evaluate_with(rounding, &state).unwrap() {
                    let same =
                        compiled[&output].iter().zip(&interpreted).all(|(a, b)| a.to_bits() == b.to_bits());
                    assert!(same, "{name}, {kind:?}: {}, {output}", function.graph.name);
                }
            }
        }
    }
}

/// How single numbers round multiply-adds in this build.
const AS_COMPILED: Rounding = if cfg!(target_feature = "fma") { Rounding::Fused } else { Rounding::Separate };

/// What a processor without such registers computes: the function without lanes, and arrays as lanes.
#[test]
fn functions_without_registers_give_the_interpreter_s_bits() {
    let platform = platforms::platform("uhp_2016");
    let file = graph_file(platform.leg_type);
    let names = ["inverse_dynamics".to_owned()];
    let functions = dyn_gen::optimise(&file.program, &Numbers::baked(&platform), Some(&names)).unwrap();
    let packed = functions[0].in_lanes.as_ref().expect("inverse dynamics is generated in lanes");
    let in_arrays = unpack(&packed.graph);
    for (kind, state) in platforms::states(&file, &platform, 5) {
        macro_rules! bits {
            ($function:expr) => {{
                let mut forces = [f64::NAN; 6];
                $function(
                    &array(&state["base_position"]),
                    &array(&state["base_rotation"]),
                    &array(&state["base_velocity"]),
                    &array(&state["base_acceleration"]),
                    &array(&state["platform_position"]),
                    &array(&state["platform_rotation"]),
                    &array(&state["platform_velocity"]),
                    &array(&state["platform_acceleration"]),
                    &array(&state["external_wrench"]),
                    &mut forces,
                );
                forces.map(f64::to_bits).to_vec()
            }};
        }
        let interpreted = |graph: &Graph| -> Vec<u64> {
            let outputs = graph.evaluate_with(AS_COMPILED, &state).unwrap();
            outputs["inverse_dynamics"].iter().map(|x| x.to_bits()).collect()
        };
        let in_lanes = bits!(uhp_2016::inverse_dynamics_in_lanes::<Portable<f64>>);
        assert_eq!(in_lanes, interpreted(&in_arrays), "{kind:?}, in lanes");
        assert_eq!(bits!(uhp_2016::inverse_dynamics::<f64>), interpreted(&functions[0].graph), "{kind:?}");
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
