//! Operations on constants.

use crate::graph::{Builder, LANE_COUNT, Node, NodeId, Rounding};

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
        _ => in_lanes(builder, node).unwrap_or_else(|| builder.insert(node)),
    }
}

/// The operation lane by lane, if all its operands are constants in lanes.
fn in_lanes(builder: &mut Builder, node: Node) -> Option<NodeId> {
    let lanes = |builder: &Builder, id: NodeId| -> Option<[f64; LANE_COUNT]> {
        match builder.node(id) {
            Node::Constant(value) => Some([value; LANE_COUNT]),
            Node::Lanes([x, y, z]) => {
                Some([builder.constant_value(x)?, builder.constant_value(y)?, builder.constant_value(z)?])
            }
            _ => None,
        }
    };
    let values: [f64; LANE_COUNT] = match node {
        Node::Unary(op, a) => {
            let a = lanes(builder, a)?;
            std::array::from_fn(|lane| op.apply(Rounding::Separate, a[lane], 0.0, 0.0))
        }
        Node::Binary(op, a, b) => {
            let (a, b) = (lanes(builder, a)?, lanes(builder, b)?);
            std::array::from_fn(|lane| op.apply(Rounding::Separate, a[lane], b[lane], 0.0))
        }
        _ => return None,
    };
    if !values.iter().all(|value| value.is_finite()) {
        return None;
    }
    let constants = values.map(|value| builder.constant(value));
    Some(if constants.iter().all(|id| *id == constants[0]) {
        constants[0]
    } else {
        builder.insert(Node::Lanes(constants))
    })
}
