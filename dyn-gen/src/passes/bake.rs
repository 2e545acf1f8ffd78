//! Replaces parameters by their values.

use super::Context;
use super::fold::fold;
use super::rewrite::rewrite;
use crate::graph::{Graph, Node};

/// Replaces every parameter that `context` gives a value of the right size, and folds operations on constants.
pub fn bake(graph: &Graph, context: &Context) -> Graph {
    let values = graph.inputs.iter().map(|symbol| {
        let values = context.parameters.get(&symbol.name).filter(|_| symbol.parameter);
        values.filter(|values| values.len() == symbol.len() && values.iter().all(|value| value.is_finite()))
    });
    let values = values.collect::<Vec<_>>();
    rewrite(graph, |builder, _, node| match node {
        Node::Input { input, element } => match values[input as usize] {
            Some(values) => builder.constant(values[element as usize]),
            None => builder.insert(node),
        },
        _ => fold(builder, node),
    })
}
