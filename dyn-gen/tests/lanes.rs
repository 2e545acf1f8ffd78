//! Evaluation at several states at a time against evaluation at one, and exact rates against differences.

mod common;

use common::random;
use dyn_gen::graph::{Builder, Environment, Evaluator, Graph, LANES, LaneEvaluator, Rates, Values};

/// Random inputs of a graph, lane by lane.
fn inputs(graph: &Graph, source: &mut random::Source) -> Vec<Vec<Values>> {
    let lanes = |length: usize, source: &mut random::Source| {
        (0..length).map(|_| std::array::from_fn(|_| source.number())).collect()
    };
    graph.inputs.iter().map(|symbol| lanes(symbol.len(), source)).collect()
}

/// One lane by the interpreter.
fn interpreted(graph: &Graph, inputs: &[Vec<Values>], lane: usize) -> Vec<f64> {
    let inputs: Vec<Vec<f64>> =
        inputs.iter().map(|array| array.iter().map(|value| value[lane]).collect()).collect();
    let mut evaluator = Evaluator::new();
    let values = evaluator.run(graph, &inputs.iter().map(Vec::as_slice).collect::<Vec<_>>());
    graph.outputs.iter().flat_map(|output| &output.nodes).map(|id| values[id.index()]).collect()
}

#[test]
fn every_lane_has_the_interpreter_s_bits() {
    for seed in 0..40 {
        let mut source = random::Source::new(seed);
        let graph = random::graph(&mut source, 300);
        let inputs = inputs(&graph, &mut source);
        let borrowed: Vec<&[Values]> = inputs.iter().map(Vec::as_slice).collect();
        let found = LaneEvaluator::default().run(&graph, &borrowed).concat();
        for lane in 0..LANES {
            let expected = interpreted(&graph, &inputs, lane);
            for (found, expected) in found.iter().zip(&expected) {
                let same = found[lane].to_bits() == expected.to_bits()
                    || (found[lane].is_nan() && expected.is_nan());
                assert!(same, "seed {seed}, lane {lane}: {} instead of {expected}", found[lane]);
            }
        }
    }
}

#[test]
fn rates_are_those_of_the_solution_of_both_kinds() {
    use dyn_gen::graph::{Output, Solve, SolveKind};
    // A x = b with A = [[4 + a, c], [c, 3]] and b = [1, a]: symmetric, so both kinds apply.
    for kind in [SolveKind::General, SolveKind::SymmetricPositiveDefinite] {
        let mut builder = Builder::new();
        let (a, c) = (builder.input(0, 0), builder.input(1, 0));
        let (four, three, one) = (builder.constant(4.0), builder.constant(3.0), builder.constant(1.0));
        let first = builder.binary(dyn_gen::graph::Op::Add, four, a);
        let solve = builder.solve(Solve {
            name: "x".into(),
            kind,
            matrix: vec![first, c, c, three],
            right_hand_side: vec![one, a],
            attempt: vec![],
        });
        let nodes = (0..2).map(|element| builder.solution(solve, element)).collect();
        let symbol = |name: &str| common::text::scalar(name, false);
        let shell = Graph { inputs: vec![symbol("a"), symbol("c")], ..Builder::new().into_graph() };
        let graph = builder.finish(&shell, vec![Output { symbol: symbol("x"), nodes }]);
        let at = |t: f64| {
            let environment: Environment =
                [("a".to_owned(), vec![0.3 + 2.0 * t]), ("c".to_owned(), vec![-0.7 + 0.5 * t])].into();
            let inputs: Vec<Vec<Values>> = graph
                .inputs
                .iter()
                .map(|symbol| environment[&symbol.name].iter().map(|value| [*value; LANES]).collect())
                .collect();
            interpreted(&graph, &inputs, 0)
        };
        let moving = [
            vec![Rates { value: [0.3; LANES], rate: [2.0; LANES] }],
            vec![Rates { value: [-0.7; LANES], rate: [0.5; LANES] }],
        ];
        let borrowed: Vec<&[Rates]> = moving.iter().map(Vec::as_slice).collect();
        let found = LaneEvaluator::default().run(&graph, &borrowed).concat();
        let (before, after, step) = (at(-1e-5), at(1e-5), 2e-5);
        for (k, found) in found.iter().enumerate() {
            assert_eq!(found.value[3], at(0.0)[k]);
            let difference = (after[k] - before[k]) / step;
            assert!(
                (found.rate[3] - difference).abs() < 1e-9,
                "{kind:?}: {} and {difference}",
                found.rate[3]
            );
        }
    }
}
