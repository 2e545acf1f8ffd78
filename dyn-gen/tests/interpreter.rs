//! The interpreter on every operation and on linear systems, and what it says about wrong inputs.

mod common;

use common::text::{parse, print};
use dyn_gen::graph::{
    Environment, Evaluator, Node, NodeId, OPS, Op, Rounding, Solve, SolveKind, solve_general, solve_symmetric,
};

fn value(expression: &str, x: f64, y: f64) -> f64 {
    let graph = parse(&format!("r = {expression}\nx = x\ny = y"));
    let environment = Environment::from([("x".to_owned(), vec![x]), ("y".to_owned(), vec![y])]);
    graph.evaluate(&environment).unwrap()["r"][0]
}

#[test]
fn every_operation_gives_the_correctly_rounded_value() {
    let cases: [(Op, &str, f64); 6] = [
        (Op::Neg, "-x", -0.1),
        (Op::Sqrt, "sqrt(x)", 0.316_227_766_016_837_94),
        (Op::Add, "x + y", 0.1 + 0.7),
        (Op::Sub, "x - y", 0.1 - 0.7),
        (Op::Mul, "x * y", 0.1 * 0.7),
        (Op::Div, "x / y", 0.1 / 0.7),
    ];
    assert_eq!(cases.len() + 3, OPS.len(), "three more are multiplications with an addition");
    for ((op, expression, expected), info) in cases.into_iter().zip(&OPS) {
        assert_eq!(op, info.op, "the table is in the order of the enumeration");
        assert_eq!(op.info().name, info.name);
        assert_eq!(Op::from_name(info.name), Some(op));
        assert_eq!(value(expression, 0.1, 0.7).to_bits(), expected.to_bits(), "{expression}");
    }
    assert_eq!(Op::from_name("sin"), None);
}

#[test]
fn products_in_sums_are_rounded_as_told() {
    // x * x = 1 + 2^-29 + 2^-60, of which rounding loses the last part.
    let (x, one) = (1.0 + f64::EPSILON * f64::exp2(22.0), 1.0);
    let (tail, rounded) = (f64::exp2(-60.0), f64::exp2(-29.0));
    let cases = [(Op::MulAdd, -one, rounded), (Op::MulSub, one, rounded), (Op::NegMulAdd, one, -rounded)];
    for (op, addend, expected) in cases {
        assert_eq!(op.apply(Rounding::Separate, x, x, addend), expected, "{op:?}");
        assert_eq!(op.apply(Rounding::Fused, x, x, addend), expected + tail.copysign(expected), "{op:?}");
        assert_eq!(Op::from_name(op.info().name), Some(op));
        assert_eq!(op.info().op, op);
    }
}

#[test]
fn special_values_pass_through() {
    assert_eq!(value("x / y", 1.0, 0.0), f64::INFINITY);
    assert!(value("sqrt(x)", -1.0, 0.0).is_nan());
    assert_eq!(value("-x", 0.0, 0.0).to_bits(), (-0.0_f64).to_bits());
    assert_eq!(value("x * y", 5e-324, 0.5), 0.0);
}

/// A 4 x 4 system whose first two pivots in natural order are zero.
const MATRIX: [f64; 16] = [0., 2., 1., 4., 0., 0., 3., 1., 1., 5., -2., 0., 7., 1., 1., 1.];
const SOLUTION: [f64; 4] = [1.0, -2.0, 3.0, 0.5];

fn times(matrix: &[f64], x: &[f64]) -> Vec<f64> {
    matrix.chunks(x.len()).map(|row| row.iter().zip(x).map(|(a, x)| a * x).sum()).collect()
}

fn assert_close(x: &[f64], expected: &[f64]) {
    for (x, expected) in x.iter().zip(expected) {
        assert!((x - expected).abs() < 1e-14, "{x} instead of {expected}");
    }
}

#[test]
fn general_systems_are_pivoted_in_rows_and_columns() {
    let mut x = times(&MATRIX, &SOLUTION);
    solve_general(&mut MATRIX.to_vec(), &mut x, &mut Vec::new());
    assert_close(&x, &SOLUTION);
    // The large entry must come first, or 1 is lost beside 1e20.
    let mut x = vec![1.0, 2.0];
    solve_general(&mut [1e-20, 1.0, 1.0, 1.0], &mut x, &mut Vec::new());
    assert_close(&x, &[1.0, 1.0]);
}

#[test]
fn a_singular_system_gives_no_number_and_no_panic() {
    let mut x = vec![1.0, 2.0];
    solve_general(&mut [1.0, 2.0, 2.0, 4.0], &mut x, &mut Vec::new());
    assert!(x.iter().any(|x| !x.is_finite()));
    let mut x = vec![f64::NAN, 2.0];
    solve_general(&mut [f64::NAN, 2.0, 2.0, 4.0], &mut x, &mut Vec::new());
    assert!(x[0].is_nan());
}

#[test]
fn symmetric_systems_read_the_lower_triangle_only() {
    let matrix = [4., 1., 2., 0.5, 1., 5., 1., 1., 2., 1., 6., 2., 0.5, 1., 2., 7.];
    let mut x = times(&matrix, &SOLUTION);
    let mut lower = matrix;
    for (row, column) in [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)] {
        lower[4 * row + column] = f64::NAN;
    }
    solve_symmetric(&mut lower, &mut x);
    assert_close(&x, &SOLUTION);
}

#[test]
fn an_evaluator_may_be_used_again_for_another_graph() {
    let mut first = parse("a = x + y\nb = x * y");
    first.solves.push(Solve {
        name: "s".to_owned(),
        kind: SolveKind::General,
        matrix: vec![NodeId(2)],
        right_hand_side: vec![NodeId(3)],
        attempt: vec![],
    });
    first.nodes.push(Node::Solution { solve: 0, element: 0 });
    first.section_of.push(0);
    first.outputs[0].nodes[0] = NodeId(4);
    let second = parse("a = sqrt(x * x + 4)");
    let mut evaluator = Evaluator::new();
    for _ in 0..2 {
        assert_eq!(evaluator.run(&first, &[&[2.0], &[3.0]])[4], 6.0 / 5.0);
        let node = second.outputs[0].nodes[0];
        assert_eq!(evaluator.run(&second, &[&[0.0]])[node.index()], 2.0);
    }
}

#[test]
fn wrong_inputs_are_named() {
    let graph = parse("a = x + y");
    let environment = Environment::from([("x".to_owned(), vec![1.0, 2.0])]);
    let error = graph.evaluate(&environment).unwrap_err();
    assert_eq!(error.to_string(), "fixture: input `x` needs 1 numbers, got 2");
    let error = graph.evaluate(&Environment::from([("x".to_owned(), vec![1.0])])).unwrap_err();
    assert_eq!(error.to_string(), "fixture: input `y` needs 1 numbers, got 0");
}

#[test]
fn a_node_can_be_replaced_by_an_earlier_one() {
    let mut graph = parse("a = (x + y) * z\nb = x + y");
    let sum = graph.outputs[1].nodes[0];
    graph.replace_uses(sum, NodeId(0));
    assert_eq!(print(&graph), "a = x * z\nb = x\n");
}

#[test]
fn counts_are_of_live_operations() {
    let mut graph = parse("a = sqrt(x * x + 4) / y\nb = -(x * y) - x");
    assert_eq!(graph.operation_count().to_string(), "6 (2 add, 2 mul, 0 fma, 1 div, 1 sqrt; 1 neg, 0 solve)");
    graph.outputs.pop();
    assert_eq!(graph.operation_count().total(), 4);
}
