//! The walk that most passes share.

use crate::graph::{Builder, Graph, Node, NodeId, Output, Solve};

/// Old node -> new node, as far as the walk has come.
pub struct Images(Vec<Option<NodeId>>);

impl Images {
    /// No node of `graph` has an image yet.
    pub fn new(graph: &Graph) -> Images {
        Images(vec![None; graph.nodes.len()])
    }

    /// The new node for an old one.
    pub fn of(&self, node: NodeId) -> NodeId {
        self.0[node.index()].expect("operands come before their users")
    }

    /// The new node for an old one, if it has one.
    pub fn get(&self, node: NodeId) -> Option<NodeId> {
        self.0[node.index()]
    }

    /// Sets the new node for the old node at `index`.
    pub fn set(&mut self, index: usize, image: NodeId) {
        self.0[index] = Some(image);
    }

    /// The node with the images of its operands, its solve made if it has one.
    pub fn node(&self, graph: &Graph, builder: &mut Builder, node: Node) -> Node {
        match node {
            Node::Unary(op, a) => Node::Unary(op, self.of(a)),
            Node::Binary(op, a, b) => Node::Binary(op, self.of(a), self.of(b)),
            Node::Ternary(op, a, b, c) => Node::Ternary(op, self.of(a), self.of(b), self.of(c)),
            Node::Lanes(lanes) => Node::Lanes(lanes.map(|lane| self.of(lane))),
            Node::Lane(a, lane) => Node::Lane(self.of(a), lane),
            Node::Solution { solve, element } => {
                let solve = builder.solve(self.solve(&graph.solves[solve as usize]));
                Node::Solution { solve, element }
            }
            leaf @ (Node::Constant(_) | Node::Input { .. }) => leaf,
        }
    }

    /// The solve with the images of its operands.
    pub fn solve(&self, solve: &Solve) -> Solve {
        Solve {
            name: solve.name.clone(),
            kind: solve.kind,
            matrix: solve.matrix.iter().map(|node| self.of(*node)).collect(),
            right_hand_side: solve.right_hand_side.iter().map(|node| self.of(*node)).collect(),
            attempt: solve.attempt.iter().map(|node| self.of(*node)).collect(),
        }
    }

    /// The outputs with the images of their nodes.
    pub fn outputs(&self, graph: &Graph) -> Vec<Output> {
        let image = |output: &Output| Output {
            symbol: output.symbol.clone(),
            nodes: output.nodes.iter().map(|node| self.of(*node)).collect(),
        };
        graph.outputs.iter().map(image).collect()
    }
}

/// Makes every live node of `graph` anew, in order: `construct` gets each node's old id and the
/// node with its operands already replaced by their images.
pub fn rewrite(graph: &Graph, mut construct: impl FnMut(&mut Builder, NodeId, Node) -> NodeId) -> Graph {
    let mut builder = Builder::with_sections_of(graph);
    let mut images = Images::new(graph);
    for (index, live) in graph.live().into_iter().enumerate() {
        if !live {
            continue;
        }
        builder.enter_section_index(graph.section_of[index]);
        let node = images.node(graph, &mut builder, graph.nodes[index]);
        images.set(index, construct(&mut builder, NodeId(index as u32), node));
    }
    let outputs = images.outputs(graph);
    builder.finish(graph, outputs)
}
