//! Random graphs and a bound for their rounding errors.

use dyn_gen::graph::{Builder, Graph, Node, NodeId, OPS, Op, Output, Solve, SolveKind, Symbol};
use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::{Rng, SeedableRng};

use super::text::scalar;

pub struct Source(Pcg64Mcg);

impl Source {
    pub fn new(seed: u64) -> Source {
        Source(Pcg64Mcg::seed_from_u64(seed))
    }

    pub fn below(&mut self, n: usize) -> usize {
        (self.0.next_u64() % n as u64) as usize
    }

    /// Uniform in (-2, 2).
    pub fn number(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 / (1_u64 << 51) as f64 - 2.0
    }
}

/// A graph of about `size` nodes over two states and two parameters of three elements each. Operands are mostly recent nodes and
/// constants are few and often trivial, so that every identity finds its occasion.
pub fn graph(source: &mut Source, size: usize) -> Graph {
    const CONSTANTS: [f64; 12] = [0.0, -0.0, 1.0, -1.0, 2.0, -2.0, 0.5, 0.3, -0.3, 1.7, 4.0, 3.0];
    let array = |name: &str, parameter| Symbol { shape: vec![3], ..scalar(name, parameter) };
    let inputs = vec![array("x", false), array("y", false), array("p", true), array("q", true)];
    let mut builder = Builder::new();
    let mut nodes: Vec<NodeId> = (0..12).map(|k| builder.input(k / 3, k % 3)).collect();
    nodes.extend(CONSTANTS.map(|value| builder.constant(value)));
    let mut solves = 0;
    for step in 0..size {
        builder.enter_section(&format!("section {}", step / 8));
        let pick = |source: &mut Source| {
            let recent = nodes.len().min(16);
            let from = if source.below(2) == 0 { nodes.len() - recent } else { 0 };
            nodes[from + source.below(nodes.len() - from)]
        };
        let (a, b) = (pick(source), pick(source));
        let made = match source.below(40) {
            0 if solves < 2 => {
                solves += 1;
                system(source, &mut builder, &nodes)
            }
            // Roots of sums of squares, so that they are real.
            1..=3 => {
                let (aa, bb) = (builder.binary(Op::Mul, a, a), builder.binary(Op::Mul, b, b));
                let sum = builder.binary(Op::Add, aa, bb);
                vec![builder.unary(Op::Sqrt, sum)]
            }
            4..=7 => vec![builder.unary(Op::Neg, a)],
            8 => vec![builder.binary(Op::Div, a, b)],
            _ => vec![builder.binary([Op::Add, Op::Sub, Op::Mul][source.below(3)], a, b)],
        };
        nodes.extend(made);
    }
    let pick = |source: &mut Source| nodes[24 + source.below(nodes.len() - 24)];
    let outputs = (0..2)
        .map(|k| Output {
            symbol: array(&format!("output_{k}"), false),
            nodes: (0..3).map(|_| pick(source)).collect(),
        })
        .collect();
    Graph { name: "random".to_owned(), inputs, outputs, ..builder.into_graph() }
}

/// A 3 x 3 linear system; a symmetric one is made definite by a large diagonal.
fn system(source: &mut Source, builder: &mut Builder, nodes: &[NodeId]) -> Vec<NodeId> {
    let pick = |source: &mut Source| nodes[source.below(nodes.len())];
    let mut matrix = (0..9).map(|_| pick(source)).collect::<Vec<_>>();
    let right_hand_side = (0..3).map(|_| pick(source)).collect::<Vec<_>>();
    let kind = match source.below(2) {
        0 => SolveKind::General,
        _ => SolveKind::SymmetricPositiveDefinite,
    };
    if kind == SolveKind::SymmetricPositiveDefinite {
        let mut sum = builder.constant(10.0);
        for entry in matrix.clone() {
            let square = builder.binary(Op::Mul, entry, entry);
            sum = builder.binary(Op::Add, sum, square);
        }
        (0..3).for_each(|k| matrix[4 * k] = sum);
        (matrix[1], matrix[2], matrix[5]) = (matrix[3], matrix[6], matrix[7]);
    }
    let solve =
        builder.solve(Solve { name: "solution".to_owned(), kind, matrix, right_hand_side, attempt: vec![] });
    (0..3).map(|element| builder.solution(solve, element)).collect()
}

/// For each node a first-order bound of the rounding error in its value; infinite after a solve (the test `expand` is about
/// those). Passes that round may combine
/// constants, so these count as rounded too.
pub fn error_bounds(graph: &Graph, values: &[f64]) -> Vec<f64> {
    const UNIT: f64 = f64::EPSILON;
    let mut errors: Vec<f64> = Vec::new();
    for (node, value) in graph.nodes.iter().zip(values) {
        let own = UNIT * value.abs();
        let error = match *node {
            Node::Constant(value) => 8.0 * UNIT * value.abs(),
            Node::Input { .. } => 0.0,
            Node::Unary(Op::Neg, a) => errors[a.index()],
            Node::Unary(_, a) => errors[a.index()] / value + own,
            Node::Binary(op, a, b) => {
                let ((a, b), (x, y)) =
                    ((values[a.index()], values[b.index()]), (errors[a.index()], errors[b.index()]));
                own + match op {
                    Op::Mul => x * b.abs() + y * a.abs(),
                    Op::Div => (x + y * value.abs()) / b.abs(),
                    _ => x + y,
                }
            }
            Node::Ternary(_, a, b, c) => {
                let [(a, x), (b, y), (c, z)] = [a, b, c].map(|id| (values[id.index()], errors[id.index()]));
                own + UNIT * (a * b).abs().max(c.abs()) + x * b.abs() + y * a.abs() + z
            }
            Node::Lanes(_) | Node::Lane(..) => unreachable!("these graphs have no lanes"),
            Node::Solution { .. } => f64::INFINITY,
        };
        errors.push(error);
    }
    assert_eq!(OPS.len(), 9, "a new operation needs its error bound here");
    errors
}
