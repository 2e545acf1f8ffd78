//! Operations on constants.

use crate::graph::{Builder, Node, NodeId, Rounding};

/// `node`, or the constant it is if all its operands are.
///
/// The value is what the machine would compute at run time. One that is not finite is left to the machine.
pub fn fold(builder: &mut Builder, node: Node) -> NodeId {
    let value = match node {
        Node::Unary(op, a) => builder.constant_value(a).map(|a| op.apply(Rounding::Separate, a, 0.0, 0.0)),
        Node::Binary(op, a, b) => {
            let operands = builder.constant_value(a).zip(builder.constant_value(b));
            operands.map(|(a, b)| op.apply(Rounding::Separate, a, b, 0.0))
        }
        _ => None,
    };
    match value {
        Some(value) if value.is_finite() => builder.constant(value),
        _ => builder.insert(node),
    }
}
