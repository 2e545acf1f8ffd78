//! Passes against the interpreter on random graphs.

mod common;

use common::random::{self, Source, error_bounds};
use common::text::print;
use common::{pass, run};
use dyn_gen::graph::{Environment, Evaluator, Graph};
use dyn_gen::passes::{Context, Exactness, PASSES, run_passes};

/// Values of all outputs, signs of zeros removed; none if an intermediate value is not finite.
fn outputs(graph: &Graph, values: &[f64]) -> Option<Vec<u64>> {
    let finite =
        graph.nodes.iter().zip(graph.live()).zip(values).all(|((_, live), value)| !live || value.is_finite());
    let bits =
        graph.outputs.iter().flat_map(|output| &output.nodes).map(|id| (values[id.index()] + 0.0).to_bits());
    finite.then(|| bits.collect())
}

/// Evaluates a random graph with its parameters in place.
fn random_case(seed: u64) -> (Graph, Vec<Vec<f64>>, Environment) {
    let mut source = Source::new(seed);
    let size = 10 + source.below(80);
    let graph = random::graph(&mut source, size);
    let inputs =
        graph.inputs.iter().map(|_| (0..3).map(|_| source.number()).collect::<Vec<_>>()).collect::<Vec<_>>();
    let parameters = [("p".to_owned(), inputs[2].clone()), ("q".to_owned(), inputs[3].clone())];
    (graph, inputs, parameters.into())
}

/// The inputs a pass left, by name.
fn remaining<'a>(graph: &Graph, original: &Graph, inputs: &'a [Vec<f64>]) -> Vec<&'a [f64]> {
    let position = |name: &str| original.inputs.iter().position(|symbol| symbol.name == name).unwrap();
    graph.inputs.iter().map(|symbol| inputs[position(&symbol.name)].as_slice()).collect()
}

#[test]
fn exact_passes_keep_every_bit_of_random_graphs() {
    let mut compared = 0;
    for seed in 0..3000 {
        let (original, inputs, parameters) = random_case(seed);
        let context = Context { parameters, states: Vec::new(), ..Context::default() };
        let mut graph = original.clone();
        for pass in PASSES.iter().filter(|pass| pass.exactness == Exactness::Exact) {
            let after = run(pass, &graph, &context);
            let (mut evaluator, mut other) = (Evaluator::new(), Evaluator::new());
            let before = outputs(&graph, evaluator.run(&graph, &remaining(&graph, &original, &inputs)));
            if before.is_some() {
                let values = other.run(&after, &remaining(&after, &original, &inputs));
                assert_eq!(
                    before,
                    outputs(&after, values),
                    "{} changed random graph {seed}:\n{}",
                    pass.name,
                    print(&graph)
                );
                compared += 1;
            }
            graph = after;
        }
    }
    assert!(compared > 5000, "only {compared} comparisons");
}

#[test]
fn rounding_passes_stay_within_the_error_bounds_of_random_graphs() {
    let mut compared = 0;
    for seed in 0..3000 {
        let (original, inputs, parameters) = random_case(seed);
        let context = Context { parameters, states: Vec::new(), ..Context::default() };
        let mut graph = run(pass("simplify"), &run(pass("bake"), &original, &context), &context);
        for pass in PASSES.iter().filter(|pass| pass.exactness == Exactness::Rounding) {
            let after = run(pass, &graph, &context);
            let bounded = |graph: &Graph| {
                let mut evaluator = Evaluator::new();
                let values = evaluator.run(graph, &remaining(graph, &original, &inputs));
                let errors = error_bounds(graph, values);
                let nodes = graph.outputs.iter().flat_map(|output| &output.nodes);
                nodes.map(|id| (values[id.index()], errors[id.index()])).collect::<Vec<_>>()
            };
            for ((before, error), (after, other_error)) in bounded(&graph).into_iter().zip(bounded(&after)) {
                let tolerance = error + other_error;
                if tolerance.is_finite() && before.is_finite() && tolerance < 1e-6 * (1.0 + before.abs()) {
                    assert!(
                        (before - after).abs() <= tolerance,
                        "{}, seed {seed}: {before} != {after}",
                        pass.name
                    );
                    compared += 1;
                }
            }
            graph = after;
        }
    }
    assert!(compared > 10_000, "only {compared} comparisons");
}

#[test]
fn running_a_pass_twice_changes_nothing_more() {
    for seed in 0..500 {
        let (mut graph, _, parameters) = random_case(seed);
        let context = Context { parameters, states: Vec::new(), ..Context::default() };
        for pass in &PASSES {
            let once = run(pass, &graph, &context);
            let twice = run(pass, &once, &context);
            let counts = (once.operation_count(), twice.operation_count());
            assert_eq!(counts.0, counts.1, "{} on random graph {seed}", pass.name);
            graph = once;
        }
    }
}

#[test]
fn no_pass_adds_operations_but_expand_and_invert() {
    for seed in 0..500 {
        let (graph, _, parameters) = random_case(seed);
        for report in run_passes(&graph, &Context { parameters, states: Vec::new(), ..Context::default() }).1
        {
            let may_add = report.name == "expand" || report.name == "invert";
            assert!(
                may_add || report.after.total() <= report.before.total(),
                "{} on random graph {seed}",
                report.name
            );
        }
    }
}
