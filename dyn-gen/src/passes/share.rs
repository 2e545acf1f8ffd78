//! One node for values that differ only in sign: how passes that make many nodes make them.

use super::simplify::simplified;
use crate::graph::{Builder, Node, NodeId, Op};

/// [`simplified`], with differences in the order of their operands' ids, so that x - y and y - x are the same node; the sign
/// moves on to its users.
pub fn shared(builder: &mut Builder, node: Node) -> NodeId {
    let simplified = simplified(builder, node);
    match builder.node(simplified) {
        // y - x = -(x - y)
        Node::Binary(Op::Sub, y, x) if x < y => {
            let difference = builder.binary(Op::Sub, x, y);
            builder.unary(Op::Neg, difference)
        }
        _ => simplified,
    }
}

/// Shared nodes by operation, for passes that make many.
pub trait Algebra {
    /// `a + b`
    fn add(&mut self, a: NodeId, b: NodeId) -> NodeId;
    /// `a - b`
    fn sub(&mut self, a: NodeId, b: NodeId) -> NodeId;
    /// `a * b`
    fn mul(&mut self, a: NodeId, b: NodeId) -> NodeId;
    /// `1 / a`
    fn reciprocal(&mut self, a: NodeId) -> NodeId;
}

impl Algebra for Builder {
    fn add(&mut self, a: NodeId, b: NodeId) -> NodeId {
        shared(self, Node::Binary(Op::Add, a, b))
    }

    fn sub(&mut self, a: NodeId, b: NodeId) -> NodeId {
        shared(self, Node::Binary(Op::Sub, a, b))
    }

    fn mul(&mut self, a: NodeId, b: NodeId) -> NodeId {
        shared(self, Node::Binary(Op::Mul, a, b))
    }

    fn reciprocal(&mut self, a: NodeId) -> NodeId {
        let one = self.constant(1.0);
        shared(self, Node::Binary(Op::Div, one, a))
    }
}
