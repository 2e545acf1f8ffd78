//! The order in which a processor can begin operations.
//!
//! A call in lanes is short: most of its time a processor waits for results. Operations that long chains of others wait for
//! come first, as in a list scheduler, but within a window only: the farther an operation is moved forward, the longer its
//! result occupies a register.

use crate::graph::{Builder, Graph, Node, Op};
use crate::passes::Images;

/// How many operations ahead of the first one not yet placed may be placed.
const WINDOW: usize = 30;
/// Operations begun per cycle.
const PER_CYCLE: f64 = 2.0;

/// Cycles until the result can be used, on processors of today (Zen 4, Golden Cove), roughly.
fn latency(node: &Node) -> f64 {
    match node {
        Node::Constant(_) | Node::Input { .. } => 0.0,
        Node::Lane(_, 0) => 2.0,
        Node::Lane(..) => 4.0,
        Node::Lanes(_) => 1.0,
        Node::Unary(Op::Sqrt, _) => 21.0,
        Node::Unary(..) => 1.0,
        Node::Binary(Op::Div, ..) => 13.0,
        Node::Binary(..) => 3.0,
        Node::Ternary(..) => 4.0,
        // A pivoted solve.
        Node::Solution { .. } => 200.0,
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
    let mut waited_for = vec![0.0_f64; size];
    let mut users: Vec<Vec<usize>> = vec![Vec::new(); size];
    let mut missing = vec![0; size];
    for index in (0..size).rev() {
        waited_for[index] += latency(&graph.nodes[index]);
        let mut operands = Vec::new();
        graph.for_each_operand(graph.nodes[index], |operand| operands.push(operand.index()));
        operands.sort_unstable();
        operands.dedup();
        missing[index] = operands.len();
        for operand in operands {
            waited_for[operand] = waited_for[operand].max(waited_for[index]);
            users[operand].push(index);
        }
    }
    let mut known_at = vec![0.0_f64; size];
    let mut placed = vec![false; size];
    let (mut order, mut first, mut now) = (Vec::with_capacity(size), 0, 0.0);
    while order.len() < size {
        while placed[first] {
            first += 1;
        }
        let window = first..size.min(first + WINDOW);
        let ready = window.filter(|index| !placed[*index] && missing[*index] == 0);
        let (begun, waiting): (Vec<usize>, Vec<usize>) = ready.partition(|index| known_at[*index] <= now);
        let Some(&next) =
            begun.iter().max_by(|a, b| waited_for[**a].total_cmp(&waited_for[**b]).then(b.cmp(a)))
        else {
            now = waiting.iter().map(|index| known_at[*index]).fold(f64::INFINITY, f64::min);
            continue;
        };
        placed[next] = true;
        order.push(next);
        let cycles = latency(&graph.nodes[next]);
        for &user in &users[next] {
            known_at[user] = known_at[user].max(now + cycles);
            missing[user] -= 1;
        }
        if cycles > 0.0 {
            now += 1.0 / PER_CYCLE;
        }
    }
    order
}
