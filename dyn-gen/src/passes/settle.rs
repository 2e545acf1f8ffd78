//! Lets differences and constants take up negations.

use super::rewrite::Images;
use crate::graph::{Builder, Graph, Node, NodeId, Op};

/// How deep a negation may move into an expression.
const DEPTH: usize = 16;

/// Replaces -x by an expression of the same cost as x where x has no other use.
pub fn settle(graph: &Graph) -> Graph {
    let mut builder = Builder::with_sections_of(graph);
    let mut images = Images::new(graph);
    let uses = graph.use_counts();
    for (index, live) in graph.live().into_iter().enumerate() {
        if !live {
            continue;
        }
        builder.enter_section_index(graph.section_of[index]);
        let image = match graph.nodes[index] {
            Node::Unary(Op::Neg, x) => {
                let absorbed = Negation { graph, uses: &uses, images: &images }.of(&mut builder, x, DEPTH);
                absorbed.unwrap_or_else(|| builder.unary(Op::Neg, images.of(x)))
            }
            node => {
                let node = images.node(graph, &mut builder, node);
                builder.insert(node)
            }
        };
        images.set(index, image);
    }
    let outputs = images.outputs(graph);
    builder.finish(graph, outputs)
}

struct Negation<'a> {
    graph: &'a Graph,
    uses: &'a [u32],
    images: &'a Images,
}

impl Negation<'_> {
    /// -x at no more cost than x, if that is possible.
    fn of(&self, builder: &mut Builder, x: NodeId, depth: usize) -> Option<NodeId> {
        let node = self.graph.nodes[x.index()];
        if let Node::Constant(value) = node {
            return Some(builder.constant(-value));
        }
        if self.uses[x.index()] != 1 || depth == 0 {
            return None;
        }
        let depth = depth - 1;
        match node {
            // -(-a) = a
            Node::Unary(Op::Neg, a) => Some(self.images.of(a)),
            // -(a - b) = b - a
            Node::Binary(Op::Sub, a, b) => {
                Some(builder.binary(Op::Sub, self.images.of(b), self.images.of(a)))
            }
            // -(a + b) = (-a) - b = (-b) - a
            Node::Binary(Op::Add, a, b) => {
                let (opposite, other) = self.either(builder, a, b, depth)?;
                Some(builder.binary(Op::Sub, opposite, other))
            }
            // -(a * b) = (-a) * b = a * (-b)
            Node::Binary(Op::Mul, a, b) => {
                let (opposite, other) = self.either(builder, a, b, depth)?;
                Some(builder.binary(Op::Mul, opposite, other))
            }
            // -(a / b) = (-a) / b = a / (-b)
            Node::Binary(Op::Div, a, b) => match self.of(builder, a, depth) {
                Some(opposite) => Some(builder.binary(Op::Div, opposite, self.images.of(b))),
                None => {
                    let opposite = self.of(builder, b, depth)?;
                    Some(builder.binary(Op::Div, self.images.of(a), opposite))
                }
            },
            _ => None,
        }
    }

    /// The opposite of one of two operands, and the other.
    fn either(&self, builder: &mut Builder, a: NodeId, b: NodeId, depth: usize) -> Option<(NodeId, NodeId)> {
        if let Some(opposite) = self.of(builder, a, depth) {
            return Some((opposite, self.images.of(b)));
        }
        Some((self.of(builder, b, depth)?, self.images.of(a)))
    }
}
