//! Turns divisions by the same node into multiplications by its reciprocal.

use super::rewrite::rewrite;
use super::share::{Algebra, shared};
use crate::graph::{Graph, Node, Op};

/// a / y, b / y -> r = 1 / y, a * r, b * r; and x / c -> x * (1 / c) for a constant c.
///
/// A division takes longer than several multiplications, and CasADi itself turns x * (1 / y) into x / y.
pub fn invert(graph: &Graph) -> Graph {
    let mut quotients = vec![0; graph.nodes.len()];
    for (node, live) in graph.nodes.iter().zip(graph.live()) {
        if let (Node::Binary(Op::Div, _, divisor), true) = (node, live) {
            quotients[divisor.index()] += 1;
        }
    }
    rewrite(graph, |builder, old, node| {
        let (Node::Binary(Op::Div, a, b), Node::Binary(_, _, divisor)) = (node, graph.nodes[old.index()])
        else {
            return shared(builder, node);
        };
        let constant = builder.constant_value(b).is_some_and(|value| (1.0 / value).is_normal());
        if quotients[divisor.index()] < 2 && !constant {
            return shared(builder, node);
        }
        let reciprocal = builder.reciprocal(b);
        builder.mul(a, reciprocal)
    })
}
