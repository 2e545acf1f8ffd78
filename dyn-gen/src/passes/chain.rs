//! Begins sums of products with the term that is no product.

use super::rewrite::Images;
use crate::graph::{Builder, Graph, Node, NodeId, Op};

/// x + (a b + c d) as (x + a b) + c d, so that each product is taken up by a sum (`fuse`).
///
/// Of the products in a sum that nothing else reads one remains that no addition takes up: the first. With x in front of it
/// there is none. Where x is known so late that all of the sum would wait for it, the sum stays as it is.
pub fn chain(graph: &Graph) -> Graph {
    let mut builder = Builder::with_sections_of(graph);
    let mut images = Images::new(graph);
    let sums = Sums::of(graph);
    for (index, live) in graph.live().into_iter().enumerate() {
        if !live {
            continue;
        }
        builder.enter_section_index(graph.section_of[index]);
        let image = match sums.chained(&mut builder, &images, graph.nodes[index]) {
            Some(image) => image,
            None => {
                let node = images.node(graph, &mut builder, graph.nodes[index]);
                builder.insert(node)
            }
        };
        images.set(index, image);
    }
    let outputs = images.outputs(graph);
    builder.finish(graph, outputs)
}

/// How long the result of an operation takes, in additions.
fn latency(node: &Node) -> u32 {
    match node {
        Node::Unary(Op::Sqrt, _) => 5,
        Node::Binary(Op::Div, ..) => 4,
        Node::Unary(..) | Node::Binary(..) | Node::Ternary(..) => 1,
        _ => 0,
    }
}

struct Sums<'a> {
    graph: &'a Graph,
    uses: Vec<u32>,
    /// When each node is known, in additions one after the other.
    known_at: Vec<u32>,
    /// For each node whether it is a product or a sum, read once, in which a product is left that no sum takes up.
    has_free_product: Vec<bool>,
}

/// A term and whether it is subtracted.
#[derive(Clone, Copy)]
struct Term {
    id: NodeId,
    negative: bool,
}

impl Sums<'_> {
    fn of(graph: &Graph) -> Sums<'_> {
        let mut known_at: Vec<u32> = Vec::with_capacity(graph.nodes.len());
        for node in &graph.nodes {
            let mut last = 0;
            graph.for_each_operand(*node, |operand| last = last.max(known_at[operand.index()]));
            known_at.push(last + latency(node));
        }
        let mut sums = Sums {
            graph,
            uses: graph.use_counts(),
            known_at,
            has_free_product: Vec::with_capacity(graph.nodes.len()),
        };
        for (index, node) in graph.nodes.iter().enumerate() {
            let free = match *node {
                _ if sums.uses[index] != 1 => false,
                Node::Binary(Op::Mul, ..) => true,
                Node::Binary(Op::Add | Op::Sub, a, b) => match (sums.is_product(a), sums.is_product(b)) {
                    (true, _) => sums.has_free_product[b.index()],
                    (_, true) => sums.has_free_product[a.index()],
                    _ => sums.has_free_product[a.index()] || sums.has_free_product[b.index()],
                },
                _ => false,
            };
            sums.has_free_product.push(free);
        }
        sums
    }

    /// Whether it is a product that nothing else reads.
    fn is_product(&self, id: NodeId) -> bool {
        self.uses[id.index()] == 1 && matches!(self.graph.nodes[id.index()], Node::Binary(Op::Mul, ..))
    }

    /// The sum with one term in front of the other's first product, if that saves an operation.
    fn chained(&self, builder: &mut Builder, images: &Images, node: Node) -> Option<NodeId> {
        let (Node::Binary(Op::Add, a, b) | Node::Binary(Op::Sub, a, b)) = node else { return None };
        let terms = [
            Term { id: a, negative: false },
            Term { id: b, negative: matches!(node, Node::Binary(Op::Sub, ..)) },
        ];
        let late = 1 + self.known_at[a.index()].max(self.known_at[b.index()]);
        [(terms[0], terms[1]), (terms[1], terms[0])].into_iter().find_map(|(first, sum)| {
            let saves = !self.is_product(first.id)
                && !self.is_product(sum.id)
                && self.has_free_product[sum.id.index()];
            if !saves || self.known_with(first, sum) > late {
                return None;
            }
            self.put(builder, images, first, sum)
        })
    }

    /// The terms of a sum: the one in which there is a free product, and the other.
    fn split(&self, sum: Term) -> Option<(Term, Term)> {
        let (a, b, subtracted) = match self.graph.nodes[sum.id.index()] {
            Node::Binary(Op::Add, a, b) => (a, b, false),
            Node::Binary(Op::Sub, a, b) => (a, b, true),
            _ => return None,
        };
        let (a, b) = (Term { id: a, ..sum }, Term { id: b, negative: sum.negative != subtracted });
        // Of two products the one known first is begun with.
        let free = |term: Term| self.has_free_product[term.id.index()];
        let b_first = !free(a) || free(b) && self.known_at[b.id.index()] < self.known_at[a.id.index()];
        Some(if b_first { (b, a) } else { (a, b) })
    }

    /// When the sum is known with `first` in front.
    fn known_with(&self, first: Term, sum: Term) -> u32 {
        let operands_at = |id: NodeId| match self.is_product(id) {
            true => self.known_at[id.index()] - 1,
            false => self.known_at[id.index()],
        };
        1 + match self.split(sum) {
            Some((begin, other)) => self.known_with(first, begin).max(operands_at(other.id)),
            None => self.known_at[first.id.index()].max(operands_at(sum.id)),
        }
    }

    fn put(&self, builder: &mut Builder, images: &Images, first: Term, sum: Term) -> Option<NodeId> {
        let Some((begin, other)) = self.split(sum) else {
            let (x, product) = (images.of(first.id), images.of(sum.id));
            return match (first.negative, sum.negative) {
                (false, false) => Some(builder.binary(Op::Add, x, product)),
                (false, true) => Some(builder.binary(Op::Sub, x, product)),
                (true, false) => Some(builder.binary(Op::Sub, product, x)),
                (true, true) => None,
            };
        };
        let begun = self.put(builder, images, first, begin)?;
        let op = if other.negative { Op::Sub } else { Op::Add };
        Some(builder.binary(op, begun, images.of(other.id)))
    }
}
