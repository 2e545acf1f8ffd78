//! Models with some numbers given at run time: what is compiled is the same model as the baked one.

use std::path::Path;

use dyn_gen::emit::{RuntimePath, Scalar};
use dyn_gen::evidence::{Sampling, cases};
use dyn_gen::graph::{Environment, Graph};
use dyn_gen::{GraphFile, Numbers, Options, generate, optimise};
use dyn_platform::Platform;

use crate::compiled::{assert_same_bits, interpret, run};

const FUNCTIONS: [&str; 3] = ["inverse_dynamics", "bias", "energy"];

/// One flat array per input of each graph and state.
fn inputs(graphs: &[Graph], states: &[Environment]) -> Vec<Vec<Vec<Vec<f64>>>> {
    let of = |graph: &Graph, state: &Environment| {
        graph.inputs.iter().map(|symbol| state[&symbol.name].clone()).collect::<Vec<_>>()
    };
    graphs.iter().map(|graph| states.iter().map(|state| of(graph, state)).collect()).collect()
}

#[test]
fn compiled_with_numbers_at_run_time_is_the_baked_model() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/platforms/everything.toml");
    let platform = Platform::from_file(path).unwrap();
    let file = GraphFile::of(platform.leg_type).unwrap();
    let functions = FUNCTIONS.map(str::to_owned).to_vec();
    let states: Vec<Environment> = cases(&file.program, &platform, Sampling { states: 4, seed: 8 })
        .unwrap()
        .into_iter()
        .map(|case| case.environment)
        .collect();
    let baked: Vec<Graph> = optimise(&file.program, &Numbers::baked(&platform), Some(&functions))
        .unwrap()
        .into_iter()
        .map(|function| function.graph)
        .collect();
    let expected = interpret(&baked, &inputs(&baked, &states));
    for names in [&["payload", "gravity", "legs.k_e"][..], &["rod_length", "b"], &["all"]] {
        let options = Options {
            model: "test_model".into(),
            runtime: RuntimePath::inside(),
            scalars: vec![Scalar::F64],
            functions: Some(functions.clone()),
            command: "cargo test".into(),
            evidence: None,
            without: Vec::new(),
        };
        let numbers = Numbers::with_run_time(&platform, names.iter().copied());
        let generated = generate(&file, &numbers, &options).unwrap();
        let graphs: Vec<Graph> = generated.functions.into_iter().map(|function| function.graph).collect();
        let inputs = inputs(&graphs, &states);
        let found = run(&generated.source, &graphs, &inputs, &[]);
        for (function, (found, expected)) in FUNCTIONS.iter().zip(found.iter().zip(&expected)) {
            for (found, expected) in found.iter().zip(expected) {
                let largest = expected.iter().fold(1e-3, |most: f64, x| most.max(x.abs()));
                for (x, y) in found.iter().zip(expected) {
                    assert!((x - y).abs() <= 1e-11 * largest, "{names:?}, {function}: {x} instead of {y}");
                }
            }
        }
        // Without a pivoted solve every operation is the interpreter's.
        if graphs.iter().all(|graph| graph.operation_count().solves == 0) {
            assert_same_bits(&graphs, &found, &interpret(&graphs, &inputs));
        }
    }
}
