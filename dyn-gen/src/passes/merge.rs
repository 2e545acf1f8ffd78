//! Merges linear forms: sums of nodes with constant weights are collected over the graph and formed anew with shared parts.

use super::linear::{Forms, ONE, Row, Term};
use super::rewrite::Images;
use super::share::{Algebra, shared};
use crate::graph::{Builder, Graph, Node, NodeId, Op};

/// A linear node with several users is written out in their sums if its own has at most this many terms; otherwise they share it.
const INLINED_TERMS: usize = 1;

/// Weights that cancel to this part of themselves leave nothing but rounding errors.
const NO_WEIGHT: f64 = 4.0 * f64::EPSILON;

/// Most rounds: each works on what the one before left.
const ROUNDS: usize = 3;

/// Rounds as long as they save operations:
/// c * x + c * y = c * (x + y), (c * x) * d = (c * d) * x, x + y formed once for all sums that contain it.
pub fn merge(graph: &Graph) -> Graph {
    let mut best = graph.clone();
    for _ in 0..ROUNDS {
        match merge_once(&best) {
            Some(merged) if merged.operation_count().total() < best.operation_count().total() => {
                best = merged
            }
            _ => break,
        }
    }
    best
}

fn merge_once(graph: &Graph) -> Option<Graph> {
    let live = graph.live();
    let linear = Linear::collect(graph, &live)?;
    let mut forms = Forms::new(linear.rows, graph.nodes.len() as Term + 1);
    forms.share_pairs();

    let mut sums = Sums { forms, partial: Vec::new() };
    let mut builder = Builder::with_sections_of(graph);
    let mut images = Images::new(graph);
    for (index, _) in live.iter().enumerate().filter(|(_, live)| **live) {
        builder.enter_section_index(graph.section_of[index]);
        let image = match graph.nodes[index] {
            node if is_linear(graph, node) => match linear.row_of[index] {
                Some(row) => sums.node(&mut builder, &images, row),
                None => continue,
            },
            node => {
                let node = images.node(graph, &mut builder, node);
                shared(&mut builder, node)
            }
        };
        images.set(index, image);
    }
    let outputs = images.outputs(graph);
    Some(builder.finish(graph, outputs))
}

/// Whether a node is a weighted sum of its operands with constant weights.
fn is_linear(graph: &Graph, node: Node) -> bool {
    let constant = |a: NodeId| matches!(graph.nodes[a.index()], Node::Constant(_));
    match node {
        Node::Unary(Op::Neg, _) | Node::Binary(Op::Add | Op::Sub, ..) => true,
        Node::Binary(Op::Mul, a, b) => constant(a) || constant(b),
        _ => false,
    }
}

/// The linear forms of a graph.
struct Linear {
    rows: Vec<Row>,
    /// For each node that something other than a sum reads, or that sums share, its row.
    row_of: Vec<Option<usize>>,
}

impl Linear {
    /// None if a weight is zero, as in a graph that is not simplified, or leaves the range of normal numbers.
    fn collect(graph: &Graph, live: &[bool]) -> Option<Linear> {
        let needed = read_as_value(graph, live);
        let uses = graph.use_counts();
        let mut linear = Linear { rows: Vec::new(), row_of: vec![None; graph.nodes.len()] };
        let mut sums: Vec<Row> = vec![Row::new(); graph.nodes.len()];
        for (index, node) in graph.nodes.iter().enumerate().filter(|(index, _)| live[*index]) {
            let itself = || vec![(index as Term + 1, 1.0)];
            if !is_linear(graph, *node) {
                sums[index] = match *node {
                    Node::Constant(value) => vec![(ONE, value)],
                    _ => itself(),
                };
                continue;
            }
            let row = match *node {
                Node::Unary(_, a) => scaled(&sums[a.index()], -1.0),
                Node::Binary(Op::Add, a, b) => combined(&sums[a.index()], &sums[b.index()], 1.0),
                Node::Binary(Op::Sub, a, b) => combined(&sums[a.index()], &sums[b.index()], -1.0),
                Node::Binary(_, a, b) => match (graph.nodes[a.index()], graph.nodes[b.index()]) {
                    (Node::Constant(weight), _) => scaled(&sums[b.index()], weight),
                    (_, Node::Constant(weight)) => scaled(&sums[a.index()], weight),
                    _ => itself(),
                },
                _ => itself(),
            };
            if !row.iter().all(|(_, weight)| weight.is_normal()) {
                return None;
            }
            let shared = uses[index] > 1 && row.len() > INLINED_TERMS;
            sums[index] = if shared { itself() } else { row.clone() };
            if shared || needed[index] {
                linear.row_of[index] = Some(linear.rows.len());
                linear.rows.push(row);
            }
        }
        Some(linear)
    }
}

/// For each node whether something other than a live linear node reads it.
fn read_as_value(graph: &Graph, live: &[bool]) -> Vec<bool> {
    let mut needed = vec![false; graph.nodes.len()];
    for (node, _) in graph.nodes.iter().zip(live).filter(|(node, live)| **live && !is_linear(graph, **node)) {
        graph.for_each_operand(*node, |operand| needed[operand.index()] = true);
    }
    for output in &graph.outputs {
        output.nodes.iter().for_each(|node| needed[node.index()] = true);
    }
    needed
}

fn scaled(row: &Row, weight: f64) -> Row {
    row.iter().map(|(term, own)| (*term, own * weight)).collect()
}

/// `a + sign * b`
fn combined(a: &Row, b: &Row, sign: f64) -> Row {
    let mut sum = Row::with_capacity(a.len() + b.len());
    let (mut i, mut j) = (0, 0);
    while i < a.len() || j < b.len() {
        let (from_a, from_b) = (a.get(i).copied(), b.get(j).map(|(term, weight)| (*term, sign * weight)));
        let next = match (from_a, from_b) {
            (Some(x), Some(y)) if x.0 == y.0 => {
                (i, j) = (i + 1, j + 1);
                let weight = x.1 + y.1;
                if weight.abs() <= NO_WEIGHT * x.1.abs() {
                    continue;
                }
                (x.0, weight)
            }
            (Some(x), Some(y)) if x.0 < y.0 => {
                i += 1;
                x
            }
            (Some(x), None) => {
                i += 1;
                x
            }
            (_, Some(y)) => {
                j += 1;
                y
            }
            (None, None) => break,
        };
        sum.push(next);
    }
    sum
}

/// Makes nodes of rows.
struct Sums {
    forms: Forms,
    /// Nodes of partial sums made so far, by row.
    partial: Vec<Option<NodeId>>,
}

impl Sums {
    fn node(&mut self, builder: &mut Builder, images: &Images, row: usize) -> NodeId {
        self.partial.resize(self.forms.rows.len(), None);
        // Partial sums only contain partial sums made before them.
        let mut needed = vec![row];
        let mut k = 0;
        while k < needed.len() {
            for (term, _) in &self.forms.rows[needed[k]] {
                if let Some(partial) = self.forms.partial(*term)
                    && self.partial[partial].is_none()
                    && !needed.contains(&partial)
                {
                    needed.push(partial);
                }
            }
            k += 1;
        }
        let mut partials = needed.split_off(1);
        partials.sort_unstable();
        for partial in partials {
            self.partial[partial] = Some(self.sum(builder, images, partial));
        }
        self.sum(builder, images, row)
    }

    fn sum(&self, builder: &mut Builder, images: &Images, row: usize) -> NodeId {
        let mut sum = builder.constant(0.0);
        for (term, weight) in &self.forms.rows[row] {
            let magnitude = builder.constant(weight.abs());
            let product = match self.forms.partial(*term) {
                _ if *term == ONE => magnitude,
                Some(partial) => {
                    let value = self.partial[partial].expect("partial sums are made before their users");
                    builder.mul(magnitude, value)
                }
                None => builder.mul(magnitude, images.of(NodeId(term - 1))),
            };
            sum = if *weight < 0.0 { builder.sub(sum, product) } else { builder.add(sum, product) };
        }
        sum
    }
}
