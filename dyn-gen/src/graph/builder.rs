//! Making graphs: equal nodes are created once.

use std::collections::HashMap;

use super::hasher::NodeHash;
use super::{Graph, LANE_COUNT, Node, NodeId, Op, Output, Solve, SolveKind};

/// What makes two nodes equal: constants by their bits, commutative operations in either order.
#[derive(PartialEq, Eq, Hash)]
enum Key {
    Constant(u64),
    Input(u32, u32),
    Unary(Op, NodeId),
    Binary(Op, NodeId, NodeId),
    Ternary(Op, NodeId, NodeId, NodeId),
    Lanes([NodeId; LANE_COUNT]),
    Lane(NodeId, u8),
    Solution(u32, u32),
}

/// Builds nodes in single assignment, each value once.
///
/// It does no algebra: what it returns evaluates to exactly the bits of what was asked for.
#[derive(Default)]
pub struct Builder {
    nodes: Vec<Node>,
    in_lanes: Vec<bool>,
    section_of: Vec<u32>,
    sections: Vec<String>,
    section: u32,
    solves: Vec<Solve>,
    known: HashMap<Key, NodeId, NodeHash>,
}

impl Builder {
    /// An empty builder, in the empty section.
    pub fn new() -> Builder {
        Builder { sections: vec![String::new()], ..Builder::default() }
    }

    /// An empty builder that knows the sections of `graph` by their indices.
    pub fn with_sections_of(graph: &Graph) -> Builder {
        let size = graph.nodes.len();
        Builder {
            nodes: Vec::with_capacity(size),
            section_of: Vec::with_capacity(size),
            sections: graph.sections.clone(),
            known: HashMap::with_capacity_and_hasher(size, NodeHash::default()),
            ..Builder::default()
        }
    }

    /// Nodes made from now on belong to the section called `name`.
    pub fn enter_section(&mut self, name: &str) {
        let known = self.sections.iter().position(|section| section == name);
        let index = known.unwrap_or_else(|| {
            self.sections.push(name.to_owned());
            self.sections.len() - 1
        });
        self.section = index as u32;
    }

    /// Nodes made from now on belong to the section with this index.
    pub fn enter_section_index(&mut self, section: u32) {
        self.section = section;
    }

    /// The node with this id.
    pub fn node(&self, id: NodeId) -> Node {
        self.nodes[id.index()]
    }

    /// The value of `id` if it is a constant.
    pub fn constant_value(&self, id: NodeId) -> Option<f64> {
        match self.node(id) {
            Node::Constant(value) => Some(value),
            _ => None,
        }
    }

    /// Whether `id` has lanes.
    pub fn has_lanes(&self, id: NodeId) -> bool {
        self.in_lanes[id.index()]
    }

    /// Number of nodes made so far.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Whether no node has been made.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// The node equal to `node`, made now if it is new.
    pub fn insert(&mut self, node: Node) -> NodeId {
        let (key, node) = match node {
            Node::Constant(value) => (Key::Constant(value.to_bits()), node),
            Node::Input { input, element } => (Key::Input(input, element), node),
            Node::Unary(op, a) => (Key::Unary(op, a), node),
            Node::Binary(op, a, b) if op.info().commutative && b < a => {
                (Key::Binary(op, b, a), Node::Binary(op, b, a))
            }
            Node::Binary(op, a, b) => (Key::Binary(op, a, b), node),
            Node::Ternary(op, a, b, c) => {
                let (a, b) = if op.info().commutative && b < a { (b, a) } else { (a, b) };
                (Key::Ternary(op, a, b, c), Node::Ternary(op, a, b, c))
            }
            Node::Lanes(lanes) => (Key::Lanes(lanes), node),
            Node::Lane(a, lane) => (Key::Lane(a, lane), node),
            Node::Solution { solve, element } => (Key::Solution(solve, element), node),
        };
        if let Some(known) = self.known.get(&key) {
            return *known;
        }
        let id = NodeId(self.nodes.len() as u32);
        let sectionless = matches!(node, Node::Constant(_) | Node::Input { .. });
        self.in_lanes.push(node.has_lanes(&self.in_lanes));
        self.nodes.push(node);
        self.section_of.push(if sectionless { 0 } else { self.section });
        self.known.insert(key, id);
        id
    }

    /// A number.
    pub fn constant(&mut self, value: f64) -> NodeId {
        self.insert(Node::Constant(value))
    }

    /// An element of an input.
    pub fn input(&mut self, input: u32, element: u32) -> NodeId {
        self.insert(Node::Input { input, element })
    }

    /// An operation on one operand.
    pub fn unary(&mut self, op: Op, a: NodeId) -> NodeId {
        self.insert(Node::Unary(op, a))
    }

    /// An operation on two operands.
    pub fn binary(&mut self, op: Op, a: NodeId, b: NodeId) -> NodeId {
        self.insert(Node::Binary(op, a, b))
    }

    /// A linear system, equal to one made before if its operands are the same; returns its index.
    pub fn solve(&mut self, solve: Solve) -> u32 {
        let same = |known: &Solve| {
            known.kind == solve.kind
                && known.right_hand_side == solve.right_hand_side
                && known.attempt == solve.attempt
                && match solve.kind {
                    SolveKind::General => known.matrix == solve.matrix,
                    SolveKind::SymmetricPositiveDefinite => lower(known).eq(lower(&solve)),
                }
        };
        let index = self.solves.iter().position(same).unwrap_or_else(|| {
            self.solves.push(solve);
            self.solves.len() - 1
        });
        index as u32
    }

    /// An element of the solution of a linear system.
    pub fn solution(&mut self, solve: u32, element: u32) -> NodeId {
        self.insert(Node::Solution { solve, element })
    }

    /// The graph made so far, with everything but nodes, solves and sections taken from `like`.
    pub fn finish(self, like: &Graph, outputs: Vec<Output>) -> Graph {
        Graph {
            name: like.name.clone(),
            meaning: like.meaning.clone(),
            equation: like.equation.clone(),
            inputs: like.inputs.clone(),
            outputs,
            ..self.into_graph()
        }
    }

    /// The nodes, solves and sections as a graph without name, inputs or outputs.
    pub fn into_graph(self) -> Graph {
        Graph {
            name: String::new(),
            meaning: String::new(),
            equation: String::new(),
            inputs: Vec::new(),
            nodes: self.nodes,
            solves: self.solves,
            outputs: Vec::new(),
            sections: self.sections,
            section_of: self.section_of,
        }
    }
}

/// The entries of a symmetric matrix that are read.
fn lower(solve: &Solve) -> impl Iterator<Item = NodeId> + '_ {
    let n = solve.right_hand_side.len();
    (0..n).flat_map(move |i| solve.matrix[i * n..=i * n + i].iter().copied())
}
