//! Generated code and hand-written reference against vectors that Pinocchio and MuJoCo agreed on (see
//! `tests/engines/README.md`): nothing of this workspace's mechanics is in them.

use std::collections::BTreeSet;

use dyn_gen::deviation::{Scale, relative_error, within};
use dyn_gen::graph::Environment;
use dyn_tests::comparison::Comparison;
use dyn_tests::compiled::{self, Model};
use dyn_tests::vectors::{self, Vectors};
use dyn_tests::{platforms, reference};

/// Outputs that need a definition beyond what an engine knows: the factorisation of the velocity terms, and a sum of outputs that
/// it has.
const OURS_ONLY: [&str; 4] =
    ["coriolis_matrix_p", "coriolis_matrix_b", "passive_inverse_dynamics", "total_bias"];

fn add_model(comparison: &mut Comparison, model: &dyn Model, vectors: &Vectors, label: &str) {
    for (number, (state, expected)) in vectors.cases.iter().enumerate() {
        for (function, output, values) in compiled::outputs(model, state) {
            if let Some(expected) = expected.get(&output) {
                let label = format!("{label}, case {number}: {function}");
                comparison.add(&label, &output, &values, expected, scale(vectors, &output));
            }
        }
    }
}

fn scale(vectors: &Vectors, output: &str) -> Scale {
    Scale::of(vectors.cases.iter().filter_map(|(_, expected)| expected.get(output)).map(Vec::as_slice))
}

fn all() -> Vec<Vectors> {
    vectors::files().iter().map(vectors::read).collect()
}

#[test]
fn model_with_run_time_parameters() {
    let mut comparison = Comparison::default();
    for vectors in all() {
        let name = &vectors.platform.name;
        let model = compiled::at_run_time(&vectors.platform);
        add_model(&mut comparison, &*model, &vectors, &format!("run time, {name}"));
        let model = compiled::prepared(&vectors.platform);
        add_model(&mut comparison, &*model, &vectors, &format!("prepared, {name}"));
    }
    comparison.finish();
}

/// Models of the other platforms are compared with parameters at run time only.
#[test]
fn baked_models() {
    let mut comparison = Comparison::default();
    let all = all();
    for (name, model) in compiled::BAKED {
        let vectors = all.iter().find(|vectors| vectors.platform.name == name);
        add_model(&mut comparison, model, vectors.expect("vectors of every platform"), name);
    }
    comparison.finish();
}

#[test]
fn hand_written_reference() {
    let mut comparison = Comparison::default();
    for vectors in all() {
        let parameters = reference::parameters(&vectors.platform);
        for (number, (state, expected)) in vectors.cases.iter().enumerate() {
            let state = reference::state(state);
            for (output, expected) in expected {
                let label = format!("{}, case {number}", vectors.platform.name);
                let values = reference::output(&parameters, &state, output);
                comparison.add(&label, output, &values, expected, scale(&vectors, output));
            }
        }
    }
    comparison.finish();
}

/// C_p v_p - C_b v_b is what the engines call velocity terms: bias without gravity, springs and dampers.
#[test]
fn coriolis_matrices_give_the_engines_velocity_terms() {
    for vectors in all() {
        let model = compiled::at_run_time(&vectors.platform);
        for (state, expected) in &vectors.cases {
            let matrices: Environment = model.call("coriolis_matrices", state);
            let product = |matrix: &str, velocity: &str| -> Vec<f64> {
                let row = |row: &[f64]| row.iter().zip(&state[velocity]).map(|(c, v)| c * v).sum();
                matrices[matrix].chunks(6).map(row).collect()
            };
            let platform = product("coriolis_matrix_p", "platform_velocity");
            let base = product("coriolis_matrix_b", "base_velocity");
            let passive = |k: usize| {
                ["gravity_force", "spring_force", "damping_force"]
                    .iter()
                    .map(|name| expected[*name][k])
                    .sum::<f64>()
            };
            let ours: Vec<f64> = (0..6).map(|k| platform[k] - base[k] + passive(k)).collect();
            let found = relative_error(&ours, &expected["bias"], Scale::own());
            assert!(within(found, "bias"), "{}: {found:.1e}", vectors.platform.name);
        }
    }
}

#[test]
fn vectors_cover_every_output_and_platform_with_twenty_states() {
    let all = all();
    let names: BTreeSet<&str> = all.iter().map(|vectors| vectors.platform.name.as_str()).collect();
    let expected: BTreeSet<&str> = platforms::TEST_PLATFORMS.into_iter().chain(["uhp_2016"]).collect();
    assert_eq!(names, expected);
    for vectors in &all {
        let generated: BTreeSet<String> = platforms::graph_file(vectors.platform.leg_type)
            .program
            .functions
            .iter()
            .flat_map(|function| function.outputs.clone())
            .filter(|output| !OURS_ONLY.contains(&output.as_str()))
            .collect();
        assert!(vectors.cases.len() >= 20, "{}: only {} states", vectors.platform.name, vectors.cases.len());
        let covered: BTreeSet<String> =
            vectors.cases.iter().flat_map(|(_, outputs)| outputs.keys().cloned()).collect();
        assert_eq!(covered, generated, "{}", vectors.platform.name);
    }
}

/// The vectors' platforms are today's platform files: after a change the vectors must be made again.
#[test]
fn vectors_belong_to_the_platform_files() {
    for vectors in all() {
        let name = &vectors.platform.name;
        assert_eq!(
            vectors.platform,
            platforms::platform(name),
            "tests/vectors/{name}.json was made for other numbers: run `cargo xtask vectors --write`"
        );
    }
}
