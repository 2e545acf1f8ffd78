//! Three alike in lanes: from the results of the function's steps back to their operands.

use std::collections::HashMap;

use super::partition::Partition;
use crate::graph::{Builder, Graph, Group, LANE_COUNT, Node, NodeId, Op, Output};
use crate::passes::{Context, known_values, simplified};

/// Nodes of the graph without lanes that stand side by side.
type Three = [NodeId; LANE_COUNT];

/// `graph` with three numbers in each operation wherever the groups, and what leads to them, allow.
pub fn superword(graph: &Graph, groups: &[Group], context: &Context, partition: &Partition) -> Graph {
    let mut words = Words::new(graph, context);
    let live = graph.live();
    for alternatives in groups.iter().flat_map(|group| arrangements(group, partition)) {
        let alike = |three: &Three| three.iter().all(|id| live[id.index()]) && words.alike(*three);
        if let Some(threes) = alternatives.into_iter().find(|threes| threes.iter().all(alike)) {
            for three in threes {
                words.wide(three);
            }
        }
    }
    let outputs = graph.outputs.iter().map(|output| Output {
        symbol: output.symbol.clone(),
        nodes: output.nodes.iter().map(|id| words.scalar(*id)).collect(),
    });
    let outputs = outputs.collect();
    words.builder.finish(graph, outputs)
}

/// Ways to put something into lanes, the best first: the first one whose threes are all alike is taken.
type Alternatives = Vec<Vec<Three>>;

/// What a group has to put into lanes.
fn arrangements(group: &Group, partition: &Partition) -> Vec<Alternatives> {
    let three = |nodes: &[NodeId], at: [usize; LANE_COUNT]| at.map(|k| nodes[k]);
    match group {
        Group::Legs(nodes) => {
            let legs = partition.legs.chunks_exact(LANE_COUNT);
            legs.map(|legs| vec![vec![three(nodes, [legs[0], legs[1], legs[2]])]]).collect()
        }
        Group::Array { shape, nodes } if shape[..] == [3, 3] => {
            let columns = (0..3).map(|column| three(nodes, [column, 3 + column, 6 + column]));
            // Entries of skew matrices are alike along these.
            let diagonals = (0..3).map(|k| three(nodes, [k, 3 + (1 + k) % 3, 6 + (2 + k) % 3]));
            vec![vec![columns.collect(), diagonals.collect()]]
        }
        Group::Array { nodes, .. } if nodes.len() % LANE_COUNT == 0 => {
            nodes.chunks_exact(LANE_COUNT).map(|row| vec![vec![three(row, [0, 1, 2])]]).collect()
        }
        Group::Array { .. } => Vec::new(),
    }
}

/// The graph in lanes so far, and where the nodes of the one without are in it.
struct Words<'a> {
    graph: &'a Graph,
    builder: Builder,
    /// Values of the nodes that depend on baked parameters only.
    constant: Vec<Option<f64>>,
    scalars: Vec<Option<NodeId>>,
    wides: HashMap<Three, NodeId>,
    /// For each node a value in lanes that holds it, and in which lane.
    lane_of: Vec<Option<(NodeId, u8)>>,
    solves: Vec<Option<u32>>,
}

impl<'a> Words<'a> {
    fn new(graph: &'a Graph, context: &Context) -> Words<'a> {
        Words {
            graph,
            builder: Builder::with_sections_of(graph),
            constant: known_values(graph, context),
            scalars: vec![None; graph.nodes.len()],
            wides: HashMap::new(),
            lane_of: vec![None; graph.nodes.len()],
            solves: vec![None; graph.solves.len()],
        }
    }

    fn node(&self, id: NodeId) -> Node {
        match self.constant[id.index()] {
            Some(value) => Node::Constant(value),
            None => self.graph.nodes[id.index()],
        }
    }

    /// Whether the three are computed by the same operation, or are no operations at all.
    fn alike(&self, three: Three) -> bool {
        let kind = |id: NodeId| match self.node(id) {
            Node::Unary(op, _) | Node::Binary(op, ..) | Node::Ternary(op, ..) => Some(op),
            _ => None,
        };
        let leaf = |id: &NodeId| matches!(self.node(*id), Node::Constant(_) | Node::Input { .. });
        match kind(three[0]) {
            Some(op) => three.iter().all(|id| kind(*id) == Some(op)),
            None => three.iter().all(leaf),
        }
    }

    /// The value without lanes.
    fn scalar(&mut self, id: NodeId) -> NodeId {
        if let Some(known) = self.scalars[id.index()] {
            return known;
        }
        self.builder.enter_section_index(self.graph.section_of[id.index()]);
        let image = match self.lane_of[id.index()] {
            Some((wide, lane)) if self.constant[id.index()].is_none() => {
                simplified(&mut self.builder, Node::Lane(wide, lane))
            }
            _ => {
                let node = match self.node(id) {
                    Node::Unary(op, a) => Node::Unary(op, self.scalar(a)),
                    Node::Binary(op, a, b) => Node::Binary(op, self.scalar(a), self.scalar(b)),
                    Node::Ternary(op, a, b, c) => {
                        Node::Ternary(op, self.scalar(a), self.scalar(b), self.scalar(c))
                    }
                    Node::Solution { solve, element } => {
                        Node::Solution { solve: self.solve(solve as usize), element }
                    }
                    leaf => leaf,
                };
                self.builder.enter_section_index(self.graph.section_of[id.index()]);
                simplified(&mut self.builder, node)
            }
        };
        self.scalars[id.index()] = Some(image);
        image
    }

    fn solve(&mut self, index: usize) -> u32 {
        if let Some(known) = self.solves[index] {
            return known;
        }
        let mut solve = self.graph.solves[index].clone();
        solve.operands_mut().for_each(|id| *id = self.scalar(*id));
        let solve = self.builder.solve(solve);
        self.solves[index] = Some(solve);
        solve
    }

    /// The three side by side; the same value three times stays one without lanes.
    fn wide(&mut self, three: Three) -> NodeId {
        if three.iter().all(|id| *id == three[0]) {
            return self.scalar(three[0]);
        }
        if let Some(known) = self.wides.get(&three) {
            return *known;
        }
        let known =
            three.iter().all(|id| self.lane_of[id.index()].is_some() || self.scalars[id.index()].is_some());
        let leaf = |id: &NodeId| matches!(self.node(*id), Node::Constant(_) | Node::Input { .. });
        let gather = known || three.iter().any(leaf) || !self.alike(three);
        let node = if let Some((known, added)) = self.unevenly_added(three) {
            let zero = self.builder.constant(0.0);
            let added = added.map(|id| id.map_or(zero, |id| self.scalar(id)));
            let (known, added) = (self.wide(known), simplified(&mut self.builder, Node::Lanes(added)));
            Node::Binary(Op::Add, known, added)
        } else if gather {
            Node::Lanes(three.map(|id| self.scalar(id)))
        } else {
            match three.map(|id| self.node(id)) {
                [Node::Unary(op, x), Node::Unary(_, y), Node::Unary(_, z)] => {
                    Node::Unary(op, self.wide([x, y, z]))
                }
                [Node::Binary(op, x0, y0), Node::Binary(_, x1, y1), Node::Binary(_, x2, y2)] => {
                    let mut pairs = [(x0, y0), (x1, y1), (x2, y2)];
                    if op.info().commutative {
                        self.align(&mut pairs);
                    }
                    let a = self.wide(pairs.map(|(a, _)| a));
                    let b = self.wide(pairs.map(|(_, b)| b));
                    Node::Binary(op, a, b)
                }
                _ => Node::Lanes(three.map(|id| self.scalar(id))),
            }
        };
        self.enter_section(three);
        let image = simplified(&mut self.builder, node);
        self.wides.insert(three, image);
        for (lane, id) in three.into_iter().enumerate() {
            if self.constant[id.index()].is_none() {
                self.lane_of[id.index()].get_or_insert((image, lane as u8));
            }
        }
        image
    }

    /// Enters the section of the three: `legs 1, 3, 5: ...` if they are the same of three legs, else that of the first.
    fn enter_section(&mut self, three: Three) {
        let sections = three.map(|id| self.graph.section_of[id.index()]);
        let of_leg = sections.map(|section| {
            let name = self.graph.sections[section as usize].strip_prefix("leg ")?;
            name.split_once(": ")
        });
        match of_leg {
            [Some((x, what)), Some((y, same)), Some((z, also))]
                if what == same && same == also && x != y && y != z =>
            {
                self.builder.enter_section(&format!("legs {x}, {y}, {z}: {what}"));
            }
            _ => self.builder.enter_section_index(sections[0]),
        }
    }

    /// Values that are in lanes already, with something added to one or two of them.
    fn unevenly_added(&self, three: Three) -> Option<(Three, [Option<NodeId>; LANE_COUNT])> {
        let in_lanes = |id: NodeId| self.lane_of[id.index()].is_some();
        let parts = three.map(|id| match self.node(id) {
            _ if in_lanes(id) => Some((id, None)),
            Node::Binary(Op::Add, a, b) if in_lanes(a) => Some((a, Some(b))),
            Node::Binary(Op::Add, a, b) if in_lanes(b) => Some((b, Some(a))),
            _ => None,
        });
        let [Some(x), Some(y), Some(z)] = parts else { return None };
        let added = [x.1, y.1, z.1];
        let uneven = added.iter().any(Option::is_some) && added.iter().any(Option::is_none);
        uneven.then_some(([x.0, y.0, z.0], added))
    }

    /// Exchanges operands so that those on one side are as alike as possible.
    fn align(&self, pairs: &mut [(NodeId, NodeId); LANE_COUNT]) {
        let (a, b) = pairs[0];
        for pair in &mut pairs[1..] {
            let straight = self.likeness(a, pair.0) + self.likeness(b, pair.1);
            let crossed = self.likeness(a, pair.1) + self.likeness(b, pair.0);
            if crossed > straight {
                *pair = (pair.1, pair.0);
            }
        }
    }

    /// How well two nodes go side by side.
    fn likeness(&self, a: NodeId, b: NodeId) -> u32 {
        if a == b {
            return 8;
        }
        let together = match (self.lane_of[a.index()], self.lane_of[b.index()]) {
            (Some((x, _)), Some((y, _))) if x == y => 4,
            _ => 0,
        };
        let alike = match (self.node(a), self.node(b)) {
            (Node::Constant(_), Node::Constant(_)) => 3,
            (Node::Input { input: x, .. }, Node::Input { input: y, .. }) if x == y => 3,
            (Node::Unary(x, _), Node::Unary(y, _)) if x == y => 2,
            (Node::Binary(x, ..), Node::Binary(y, ..)) if x == y => 2,
            _ => 0,
        };
        together + alike
    }
}
