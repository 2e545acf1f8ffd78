//! Expression graphs: single assignment, operands before their users, equal nodes shared by [`Builder`].
//!
//! [`Program`] is what the graph file holds (small graphs and functions that call them over legs); [`Program::flatten`] makes
//! one [`Graph`] of a function, which the passes then work on. [`Evaluator`] gives any graph its meaning in numbers.

mod builder;
mod count;
mod flatten;
pub mod format;
mod hasher;
mod interpreter;
mod lanes;
mod ops;
mod program;
mod read_node;
mod validate;

pub use builder::Builder;
pub use count::OperationCount;
pub use flatten::Group;
pub use format::FormatError;
pub(crate) use hasher::NodeHash;
pub use interpreter::{
    Environment, EvaluationError, Evaluator, is_solved_by, solve_general, solve_symmetric,
};
pub use lanes::{Batch, LANES, LaneEvaluator, Number, Rates, Values};
pub use ops::{OPS, Op, OpInfo, Rounding};
pub use program::{Declaration, Function, Program, Provenance, Role, Step};

/// Index of a node in [`Graph::nodes`].
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct NodeId(pub u32);

impl NodeId {
    /// The index as Rust wants it.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// One value of a graph.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Node {
    /// A number.
    Constant(f64),
    /// Element `element` (flat, row-major) of the input [`Graph::inputs`]`[input]`.
    Input {
        /// Index into [`Graph::inputs`].
        input: u32,
        /// Flat row-major index.
        element: u32,
    },
    /// A unary operation.
    Unary(Op, NodeId),
    /// A binary operation.
    Binary(Op, NodeId, NodeId),
    /// A multiplication with an addition.
    Ternary(Op, NodeId, NodeId, NodeId),
    /// Three numbers side by side, each in a lane. An operation with a value in lanes among its operands works lane by lane;
    /// an operand without lanes is then the same in all of them.
    Lanes([NodeId; LANE_COUNT]),
    /// What a value in lanes has in this one.
    Lane(NodeId, u8),
    /// Element `element` of the solution of [`Graph::solves`]`[solve]`.
    Solution {
        /// Index into [`Graph::solves`].
        solve: u32,
        /// Row of the solution.
        element: u32,
    },
}

impl Node {
    /// Whether it has lanes, if `in_lanes` tells it of its operands.
    fn has_lanes(&self, in_lanes: &[bool]) -> bool {
        match *self {
            Node::Lanes(_) => true,
            Node::Unary(_, a) => in_lanes[a.index()],
            Node::Binary(_, a, b) => in_lanes[a.index()] || in_lanes[b.index()],
            Node::Ternary(_, a, b, c) => [a, b, c].iter().any(|id| in_lanes[id.index()]),
            Node::Constant(_) | Node::Input { .. } | Node::Lane(..) | Node::Solution { .. } => false,
        }
    }
}

/// Numbers side by side in [`Node::Lanes`]: the components of a vector, or three legs.
pub const LANE_COUNT: usize = 3;

/// How a linear system may be solved.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum SolveKind {
    /// General matrix: the order of the pivots matters.
    General,
    /// Symmetric positive definite matrix: stable in any order; only the lower triangle is read.
    SymmetricPositiveDefinite,
}

/// A linear system `matrix * solution = right_hand_side`, one named operation until a pass expands it.
#[derive(Clone, PartialEq, Debug)]
pub struct Solve {
    /// Name of the solution in the derivation.
    pub name: String,
    /// What is known of the matrix.
    pub kind: SolveKind,
    /// n x n, row-major.
    pub matrix: Vec<NodeId>,
    /// n.
    pub right_hand_side: Vec<NodeId>,
    /// The solution (n) as computed without choosing pivots; it counts where it satisfies the system ([`is_solved_by`]), and
    /// pivots are chosen only where it does not. Empty if there is none.
    pub attempt: Vec<NodeId>,
}

impl Solve {
    /// The nodes the solution depends on, to be replaced by others.
    pub fn operands_mut(&mut self) -> impl Iterator<Item = &mut NodeId> {
        self.matrix.iter_mut().chain(&mut self.right_hand_side).chain(&mut self.attempt)
    }

    /// The nodes the solution depends on.
    pub fn operands(&self) -> impl Iterator<Item = NodeId> + '_ {
        self.matrix.iter().chain(&self.right_hand_side).chain(&self.attempt).copied()
    }
}

/// A named array that enters or leaves a graph.
#[derive(Clone, PartialEq, Debug)]
pub struct Symbol {
    /// The noun it has in every stage.
    pub name: String,
    /// Row-major shape; empty for a scalar; a per-leg symbol has the leg as first dimension.
    pub shape: Vec<usize>,
    /// SI unit, e.g. `m/s`.
    pub unit: String,
    /// Frame the components are expressed in: `O`, `B`, `P`, `B -> O`, or `-`.
    pub frame: String,
    /// One line of physics.
    pub meaning: String,
    /// Equation number in the source, e.g. `(32)`, or empty.
    pub equation: String,
    /// Whether it is a physical parameter (may be baked), in contrast to a state.
    pub parameter: bool,
}

impl Symbol {
    /// Number of scalar elements.
    pub fn len(&self) -> usize {
        self.shape.iter().product()
    }

    /// Whether the symbol has no elements.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// An output array: one node per element.
#[derive(Clone, PartialEq, Debug)]
pub struct Output {
    /// Name, shape, unit, frame, meaning.
    pub symbol: Symbol,
    /// Row-major.
    pub nodes: Vec<NodeId>,
}

/// A function as an expression graph.
///
/// Invariants: operands of node `k` have ids below `k`; the operands of a solve have ids below its [`Node::Solution`] nodes;
/// inputs, elements and solves that nodes name exist; `section_of` has one entry per node.
#[derive(Clone, PartialEq, Debug)]
pub struct Graph {
    /// Name of the function.
    pub name: String,
    /// What it computes, one line.
    pub meaning: String,
    /// Equation number(s) in the source.
    pub equation: String,
    /// Arrays that may enter, states and parameters, in the order of the signature.
    pub inputs: Vec<Symbol>,
    /// Values in single assignment.
    pub nodes: Vec<Node>,
    /// Linear systems.
    pub solves: Vec<Solve>,
    /// Arrays that leave.
    pub outputs: Vec<Output>,
    /// Physical meaning of groups of nodes, e.g. `leg 3: rod direction`.
    pub sections: Vec<String>,
    /// For each node the index of its section (constants and inputs: 0, which is always the empty section).
    pub section_of: Vec<u32>,
}

impl Graph {
    /// Calls `visit` with each node that `node` reads, in order; for a solution these are all operands of its solve.
    pub fn for_each_operand(&self, node: Node, mut visit: impl FnMut(NodeId)) {
        match node {
            Node::Constant(_) | Node::Input { .. } => {}
            Node::Unary(_, a) | Node::Lane(a, _) => visit(a),
            Node::Lanes(lanes) => lanes.into_iter().for_each(visit),
            Node::Binary(_, a, b) => {
                visit(a);
                visit(b);
            }
            Node::Ternary(_, a, b, c) => {
                visit(a);
                visit(b);
                visit(c);
            }
            Node::Solution { solve, .. } => self.solves[solve as usize].operands().for_each(visit),
        }
    }

    /// For each node whether it has lanes.
    pub fn in_lanes(&self) -> Vec<bool> {
        let mut in_lanes = Vec::with_capacity(self.nodes.len());
        for node in &self.nodes {
            in_lanes.push(node.has_lanes(&in_lanes));
        }
        in_lanes
    }

    /// Whether any node has lanes.
    pub fn has_lanes(&self) -> bool {
        self.nodes.iter().any(|node| matches!(node, Node::Lanes(_)))
    }

    /// Marks every node that the nodes already marked need.
    pub fn mark_needed(&self, needed: &mut [bool]) {
        for k in (0..self.nodes.len()).rev() {
            if needed[k] {
                self.for_each_operand(self.nodes[k], |operand| needed[operand.index()] = true);
            }
        }
    }

    /// For each node whether an output needs it.
    pub fn live(&self) -> Vec<bool> {
        let mut live = vec![false; self.nodes.len()];
        for output in &self.outputs {
            output.nodes.iter().for_each(|node| live[node.index()] = true);
        }
        self.mark_needed(&mut live);
        live
    }

    /// How often each node is read by live nodes, solves and outputs (a solve reads its operands once).
    pub fn use_counts(&self) -> Vec<u32> {
        let mut counts = vec![0; self.nodes.len()];
        let mut solve_seen = vec![false; self.solves.len()];
        for (node, live) in self.nodes.iter().zip(self.live()) {
            let counted_before = match *node {
                Node::Solution { solve, .. } => std::mem::replace(&mut solve_seen[solve as usize], true),
                _ => false,
            };
            if live && !counted_before {
                self.for_each_operand(*node, |operand| counts[operand.index()] += 1);
            }
        }
        for output in &self.outputs {
            output.nodes.iter().for_each(|node| counts[node.index()] += 1);
        }
        counts
    }

    /// Makes every reader of `node` read `other`, which must come before it (mutation tests drop operands this way).
    pub fn replace_uses(&mut self, node: NodeId, other: NodeId) {
        assert!(other < node, "a node may only be replaced by an earlier one");
        let redirect = |operand: &mut NodeId| {
            if *operand == node {
                *operand = other;
            }
        };
        for reader in &mut self.nodes[node.index() + 1..] {
            match reader {
                Node::Unary(_, a) | Node::Lane(a, _) => redirect(a),
                Node::Lanes(lanes) => lanes.iter_mut().for_each(redirect),
                Node::Binary(_, a, b) => {
                    redirect(a);
                    redirect(b);
                }
                Node::Ternary(_, a, b, c) => {
                    redirect(a);
                    redirect(b);
                    redirect(c);
                }
                _ => {}
            }
        }
        for solve in &mut self.solves {
            solve.operands_mut().for_each(redirect);
        }
        for output in &mut self.outputs {
            output.nodes.iter_mut().for_each(redirect);
        }
    }
}
