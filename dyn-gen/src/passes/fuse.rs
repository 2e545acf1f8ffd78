//! Joins products with the sums that read them.

use super::rewrite::Images;
use crate::graph::{Builder, Graph, Node, NodeId, Op};

/// a * b + c, a * b - c and c - a * b as one operation each.
///
/// A product disappears when every reader is a sum that takes it up. Of two products in one sum, the one read less often
/// is taken up first. A product that has to stay for another reader is taken up all the same by the sums that have no better
/// use: they then need not wait for it, and without fused multiply-add it is still formed once, by the same two operands.
pub fn fuse(graph: &Graph) -> Graph {
    let choice = chosen_products(graph);
    let mut builder = Builder::with_sections_of(graph);
    let mut images = Images::new(graph);
    for (index, live) in graph.live().into_iter().enumerate() {
        if !live {
            continue;
        }
        builder.enter_section_index(graph.section_of[index]);
        let image = match (graph.nodes[index], choice[index]) {
            (Node::Binary(op, a, b), Some(product)) => {
                let other = if product == a { b } else { a };
                let operation = match (op, product == a) {
                    (Op::Add, _) => Op::MulAdd,
                    (_, true) => Op::MulSub,
                    (_, false) => Op::NegMulAdd,
                };
                let Node::Binary(_, x, y) = graph.nodes[product.index()] else {
                    unreachable!("only products are chosen")
                };
                builder.insert(Node::Ternary(operation, images.of(x), images.of(y), images.of(other)))
            }
            (node, _) => {
                let node = images.node(graph, &mut builder, node);
                builder.insert(node)
            }
        };
        images.set(index, image);
    }
    let outputs = images.outputs(graph);
    builder.finish(graph, outputs)
}

/// For each sum the product that it takes up.
fn chosen_products(graph: &Graph) -> Vec<Option<NodeId>> {
    let live = graph.live();
    let uses = graph.use_counts();
    let is_product = |id: NodeId| matches!(graph.nodes[id.index()], Node::Binary(Op::Mul, ..));
    let mut sums_of: Vec<Vec<usize>> = vec![Vec::new(); graph.nodes.len()];
    let mut products = Vec::new();
    for (index, node) in graph.nodes.iter().enumerate().filter(|(index, _)| live[*index]) {
        match *node {
            // Twice the same product is no sum of a product and something else.
            Node::Binary(Op::Add | Op::Sub, a, b) if a != b => {
                [a, b]
                    .into_iter()
                    .filter(|id| is_product(*id))
                    .for_each(|id| sums_of[id.index()].push(index));
            }
            Node::Binary(Op::Mul, ..) => products.push(NodeId(index as u32)),
            _ => {}
        }
    }
    products.sort_by_key(|id| uses[id.index()]);
    let mut choice: Vec<Option<NodeId>> = vec![None; graph.nodes.len()];
    let disappearing = products.iter().filter(|id| sums_of[id.index()].len() == uses[id.index()] as usize);
    for &product in disappearing {
        let sums = &sums_of[product.index()];
        if sums.iter().all(|sum| choice[*sum].is_none()) {
            sums.iter().for_each(|sum| choice[*sum] = Some(product));
        }
    }
    for &product in &products {
        for &sum in &sums_of[product.index()] {
            choice[sum].get_or_insert(product);
        }
    }
    choice
}
