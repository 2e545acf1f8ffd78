//! Removes operations with trivial operands and moves signs towards the outputs.

use super::fold::fold;
use super::rewrite::rewrite;
use crate::graph::{Builder, Graph, LANE_COUNT, Node, NodeId, Op};

/// Applies the identities of this file to every node.
pub fn simplify(graph: &Graph) -> Graph {
    rewrite(graph, |builder, _, node| simplified(builder, node))
}

/// The simplest node with the value of `node`, whose operands are simplified already.
///
/// One identity per comment. Negative constants count as negations: x * (-c) is -(x * c).
pub fn simplified(builder: &mut Builder, node: Node) -> NodeId {
    match node {
        Node::Unary(Op::Neg, a) => negated(builder, a),
        Node::Binary(Op::Add, a, b) => sum(builder, a, b),
        Node::Binary(Op::Sub, a, b) => {
            // x - y = x + (-y)
            let opposite = negated(builder, b);
            sum(builder, a, opposite)
        }
        Node::Binary(Op::Mul, a, b) => product(builder, a, b),
        Node::Binary(Op::Div, a, b) => quotient(builder, a, b),
        Node::Lanes(lanes) => side_by_side(builder, lanes),
        Node::Lane(a, lane) => in_lane(builder, a, lane),
        _ => fold(builder, node),
    }
}

fn side_by_side(builder: &mut Builder, lanes: [NodeId; LANE_COUNT]) -> NodeId {
    // The same in every lane: no lanes.
    if lanes.iter().all(|lane| *lane == lanes[0]) {
        return lanes[0];
    }
    let negations = lanes.map(|lane| match builder.node(lane) {
        Node::Unary(Op::Neg, x) => Some(x),
        _ => None,
    });
    match (lanes.map(|lane| builder.node(lane)), negations) {
        // Lanes 0 to 2 of x: x
        ([Node::Lane(x, 0), Node::Lane(y, 1), Node::Lane(z, 2)], _) if x == y && y == z => x,
        // [-x, -y, -z] = -[x, y, z]
        (_, [Some(x), Some(y), Some(z)]) => {
            let opposite = side_by_side(builder, [x, y, z]);
            negated(builder, opposite)
        }
        _ => builder.insert(Node::Lanes(lanes)),
    }
}

fn in_lane(builder: &mut Builder, a: NodeId, lane: u8) -> NodeId {
    match builder.node(a) {
        // Lane k of [x0, x1, x2]: xk
        Node::Lanes(lanes) => lanes[lane as usize],
        // Lane k of -x: -(lane k of x)
        Node::Unary(Op::Neg, x) => {
            let opposite = in_lane(builder, x, lane);
            negated(builder, opposite)
        }
        _ if builder.has_lanes(a) => builder.insert(Node::Lane(a, lane)),
        // What has no lanes is the same in all of them.
        _ => a,
    }
}

fn negated(builder: &mut Builder, a: NodeId) -> NodeId {
    match builder.node(a) {
        // -(-x) = x
        Node::Unary(Op::Neg, x) => x,
        _ => fold(builder, Node::Unary(Op::Neg, a)),
    }
}

/// `a` as a value without sign, and whether it is to be negated.
fn magnitude(builder: &mut Builder, a: NodeId) -> (NodeId, bool) {
    match builder.node(a) {
        Node::Unary(Op::Neg, x) => (x, true),
        Node::Constant(value) if value.is_sign_negative() => (builder.constant(-value), true),
        _ => (a, false),
    }
}

fn with_sign(builder: &mut Builder, negative: bool, a: NodeId) -> NodeId {
    if negative { negated(builder, a) } else { a }
}

fn sum(builder: &mut Builder, a: NodeId, b: NodeId) -> NodeId {
    let ((x, x_negative), (y, y_negative)) = (magnitude(builder, a), magnitude(builder, b));
    match (builder.constant_value(x), builder.constant_value(y)) {
        // constants
        (Some(_), Some(_)) => return fold(builder, Node::Binary(Op::Add, a, b)),
        // 0 + y = y
        (Some(0.0), _) => return b,
        // x + 0 = x
        (_, Some(0.0)) => return a,
        _ => {}
    }
    match (x_negative, y_negative) {
        // x + x = 2 * x
        (false, false) if x == y => {
            let two = builder.constant(2.0);
            product(builder, two, x)
        }
        (true, true) if x == y => {
            let two = builder.constant(-2.0);
            product(builder, two, x)
        }
        // x - x = 0
        _ if x == y => builder.constant(0.0),
        (false, false) => builder.binary(Op::Add, x, y),
        // x + (-y) = x - y
        (false, true) => builder.binary(Op::Sub, x, y),
        // (-x) + y = y - x
        (true, false) => builder.binary(Op::Sub, y, x),
        // (-x) + (-y) = -(x + y)
        (true, true) => {
            let sum = builder.binary(Op::Add, x, y);
            negated(builder, sum)
        }
    }
}

fn product(builder: &mut Builder, a: NodeId, b: NodeId) -> NodeId {
    let ((x, x_negative), (y, y_negative)) = (magnitude(builder, a), magnitude(builder, b));
    let product = match (builder.constant_value(x), builder.constant_value(y)) {
        // 0 * y = 0
        (Some(0.0), _) | (_, Some(0.0)) => return builder.constant(0.0),
        // 1 * y = y
        (Some(1.0), _) => y,
        // x * 1 = x
        (_, Some(1.0)) => x,
        _ => fold(builder, Node::Binary(Op::Mul, x, y)),
    };
    // (-x) * y = x * (-y) = -(x * y)
    with_sign(builder, x_negative != y_negative, product)
}

fn quotient(builder: &mut Builder, a: NodeId, b: NodeId) -> NodeId {
    let ((x, x_negative), (y, y_negative)) = (magnitude(builder, a), magnitude(builder, b));
    let quotient = match (builder.constant_value(x), builder.constant_value(y)) {
        // x / 0 is left to the machine
        (_, Some(0.0)) => return builder.binary(Op::Div, a, b),
        // 0 / y = 0
        (Some(0.0), _) => return builder.constant(0.0),
        // x / 1 = x
        (_, Some(1.0)) => x,
        // x / 2^k = x * 2^-k
        (None, Some(divisor)) if has_exact_reciprocal(divisor) => {
            let reciprocal = builder.constant(1.0 / divisor);
            builder.binary(Op::Mul, x, reciprocal)
        }
        _ => fold(builder, Node::Binary(Op::Div, x, y)),
    };
    // (-x) / y = x / (-y) = -(x / y)
    with_sign(builder, x_negative != y_negative, quotient)
}

/// Whether `value` is a power of two whose reciprocal is a normal number.
fn has_exact_reciprocal(value: f64) -> bool {
    const MANTISSA: u64 = (1 << 52) - 1;
    value.is_normal() && value.to_bits() & MANTISSA == 0 && (1.0 / value).is_normal()
}
