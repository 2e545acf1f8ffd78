//! The order in which a processor can begin operations.
//!
//! A call in lanes is short: most of its time a processor waits for results. Operations that long chains of others wait for
//! come first, as in a list scheduler.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use crate::graph::{Builder, Graph, Node, Op};
use crate::passes::Images;

/// Half cycles, in each of which an operation is begun.
type Time = u32;

/// Time until the result can be used, on processors of today (Zen 4, Golden Cove), roughly.
fn latency(node: &Node) -> Time {
    match node {
        Node::Constant(_) | Node::Input { .. } => 0,
        Node::Lane(_, 0) => 4,
        Node::Lane(..) => 8,
        Node::Lanes(_) => 2,
        Node::Unary(Op::Sqrt, _) => 42,
        Node::Unary(..) => 2,
        Node::Binary(Op::Div, ..) => 26,
        Node::Binary(..) => 6,
        Node::Ternary(..) => 8,
        // A pivoted solve.
        Node::Solution { .. } => 400,
    }
}

/// The same graph, its nodes in the order in which they are best begun.
pub fn order(graph: &Graph) -> Graph {
    let mut builder = Builder::with_sections_of(graph);
    let mut images = Images::new(graph);
    for index in begun(graph) {
        builder.enter_section_index(graph.section_of[index]);
        let node = images.node(graph, &mut builder, graph.nodes[index]);
        let image = builder.insert(node);
        images.set(index, image);
    }
    let outputs = images.outputs(graph);
    builder.finish(graph, outputs)
}

/// Indices of the nodes in the order in which they are begun.
fn begun(graph: &Graph) -> Vec<usize> {
    let size = graph.nodes.len();
    // How long the results that follow from a node take, itself included.
    let mut waited_for: Vec<Time> = vec![0; size];
    let mut users: Vec<Vec<usize>> = vec![Vec::new(); size];
    let mut missing = vec![0; size];
    let mut operands = Vec::new();
    for index in (0..size).rev() {
        waited_for[index] += latency(&graph.nodes[index]);
        operands.clear();
        graph.for_each_operand(graph.nodes[index], |operand| operands.push(operand.index()));
        operands.sort_unstable();
        operands.dedup();
        missing[index] = operands.len();
        for &operand in &operands {
            waited_for[operand] = waited_for[operand].max(waited_for[index]);
            users[operand].push(index);
        }
    }
    let mut known_at: Vec<Time> = vec![0; size];
    let leaves = (0..size).filter(|index| missing[*index] == 0);
    let mut ready: BinaryHeap<(Time, Reverse<usize>)> =
        leaves.map(|index| (waited_for[index], Reverse(index))).collect();
    let mut waiting: BinaryHeap<Reverse<(Time, usize)>> = BinaryHeap::new();
    let (mut order, mut now) = (Vec::with_capacity(size), 0);
    while order.len() < size {
        while let Some(&Reverse((time, index))) = waiting.peek()
            && (time <= now || ready.is_empty())
        {
            now = now.max(time);
            waiting.pop();
            ready.push((waited_for[index], Reverse(index)));
        }
        let Some((_, Reverse(next))) = ready.pop() else { unreachable!("operands come before their users") };
        order.push(next);
        let duration = latency(&graph.nodes[next]);
        for &user in &users[next] {
            known_at[user] = known_at[user].max(now + duration);
            missing[user] -= 1;
            if missing[user] == 0 {
                waiting.push(Reverse((known_at[user], user)));
            }
        }
        now += Time::from(duration > 0);
    }
    order
}
