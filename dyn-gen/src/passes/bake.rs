//! Replaces parameters by their values.

use super::Context;
use super::rewrite::rewrite;
use crate::graph::{Graph, Node, NodeId, Op, Rounding};

/// Of a sum of numbers this part of the larger one is rounding error: each of them may come from a sum over legs.
const CANCELLED: f64 = 16.0 * f64::EPSILON;

/// Replaces every parameter that `context` gives a value of the right size, and what follows from such parameters alone.
pub fn bake(graph: &Graph, context: &Context) -> Graph {
    let known = known_values(graph, context);
    rewrite(graph, |builder, id, node| match known[id.index()] {
        Some(value) => builder.constant(value),
        None => builder.insert(node),
    })
}

/// For each node its value, if it depends on nothing but numbers and the parameters in `context`, and is finite. It is what
/// the machine would compute at run time, with one exception.
///
/// Numbers that cancel up to rounding errors cancel altogether: moments of symmetric platforms would otherwise be 1e-18, and
/// every product with them an operation.
pub(crate) fn known_values(graph: &Graph, context: &Context) -> Vec<Option<f64>> {
    let given = graph.inputs.iter().map(|symbol| {
        let values = context.parameters.get(&symbol.name).filter(|_| symbol.parameter);
        values.filter(|values| values.len() == symbol.len())
    });
    let given: Vec<Option<&Vec<f64>>> = given.collect();
    let mut known: Vec<Option<f64>> = Vec::with_capacity(graph.nodes.len());
    for node in &graph.nodes {
        let apply = |op: Op, a: f64, b: f64, c: f64| op.apply(Rounding::Separate, a, b, c);
        let of = |id: NodeId| known[id.index()];
        let value = match *node {
            Node::Constant(value) => Some(value),
            Node::Input { input, element } => given[input as usize].map(|values| values[element as usize]),
            Node::Unary(op, a) => of(a).map(|a| apply(op, a, 0.0, 0.0)),
            Node::Binary(op, a, b) => of(a).zip(of(b)).map(|(a, b)| match apply(op, a, b, 0.0) {
                sum if matches!(op, Op::Add | Op::Sub) && sum.abs() <= CANCELLED * a.abs().max(b.abs()) => {
                    0.0
                }
                value => value,
            }),
            Node::Ternary(op, a, b, c) => of(a).zip(of(b)).zip(of(c)).map(|((a, b), c)| apply(op, a, b, c)),
            Node::Lanes(_) | Node::Lane(..) | Node::Solution { .. } => None,
        };
        known.push(value.filter(|value| value.is_finite()));
    }
    known
}
