//! Operation counts: the figure by which passes are judged.

use std::fmt;

use super::{Graph, Node, Op};

/// Live operations of a graph by kind.
#[derive(Clone, Copy, PartialEq, Eq, Default, Debug)]
pub struct OperationCount {
    /// Additions and subtractions.
    pub additions: usize,
    /// Multiplications.
    pub multiplications: usize,
    /// Multiplications with an addition in one.
    pub multiply_additions: usize,
    /// Divisions.
    pub divisions: usize,
    /// Square roots.
    pub square_roots: usize,
    /// Sign changes; not part of [`total`](Self::total).
    pub negations: usize,
    /// Linear systems still to be solved as one operation; not part of [`total`](Self::total).
    pub solves: usize,
}

impl OperationCount {
    /// Additions, multiplications, both in one, divisions and square roots; sign changes ride along with additions and are not counted.
    pub fn total(&self) -> usize {
        self.additions + self.multiplications + self.multiply_additions + self.divisions + self.square_roots
    }
}

impl fmt::Display for OperationCount {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{} ({} add, {} mul, {} fma, {} div, {} sqrt; {} neg, {} solve)",
            self.total(),
            self.additions,
            self.multiplications,
            self.multiply_additions,
            self.divisions,
            self.square_roots,
            self.negations,
            self.solves
        )
    }
}

impl Graph {
    /// Counts the operations that the outputs need.
    pub fn operation_count(&self) -> OperationCount {
        let mut count = OperationCount::default();
        let mut solve_needed = vec![false; self.solves.len()];
        for (node, live) in self.nodes.iter().zip(self.live()) {
            if !live {
                continue;
            }
            match *node {
                Node::Constant(_) | Node::Input { .. } | Node::Lanes(_) | Node::Lane(..) => {}
                Node::Unary(op, _) | Node::Binary(op, _, _) | Node::Ternary(op, ..) => match op {
                    Op::Add | Op::Sub => count.additions += 1,
                    Op::Mul => count.multiplications += 1,
                    Op::MulAdd | Op::MulSub | Op::NegMulAdd => count.multiply_additions += 1,
                    Op::Div => count.divisions += 1,
                    Op::Sqrt => count.square_roots += 1,
                    Op::Neg => count.negations += 1,
                },
                Node::Solution { solve, .. } => solve_needed[solve as usize] = true,
            }
        }
        count.solves = solve_needed.iter().filter(|needed| **needed).count();
        count
    }
}
