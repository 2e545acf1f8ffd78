//! Sums over legs, in the order that suits lanes.
//!
//! t1 + ... + t6 with a term per leg becomes (h1 + h2) + h3 with h1 = t1 + t4 and so on: the six terms and the first
//! addition stand in lanes, what is left is added across them.

use std::collections::{BTreeMap, HashMap};

use super::mapped;
use super::partition::Partition;
use crate::graph::{Builder, Graph, Group, Node, NodeId, Op, Symbol};
use crate::passes::{Context, Images, known_values};

/// The leg that a value belongs to.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Owner {
    /// No leg: constants, and what is common to all legs.
    Common,
    /// This one.
    Leg(usize),
    /// Several.
    Several,
}

impl Owner {
    /// Of a value computed from values of these two.
    fn and(self, other: Owner, sum: bool) -> Owner {
        match (self, other) {
            (Owner::Leg(a), Owner::Leg(b)) if a != b => Owner::Several,
            // Of a sum this is the next term of another leg.
            (Owner::Leg(_), Owner::Several) | (Owner::Several, Owner::Leg(_)) if sum => Owner::Several,
            (Owner::Leg(leg), _) | (_, Owner::Leg(leg)) => Owner::Leg(leg),
            (Owner::Several, _) | (_, Owner::Several) => Owner::Several,
            (Owner::Common, Owner::Common) => Owner::Common,
        }
    }
}

/// Inputs of generated functions that hold a number per leg.
const PER_LEG_INPUTS: [&str; 1] = ["actuator_force"];

/// The owner of each node: what a step gives for a leg is that leg's, and so are the numbers that a leg has.
fn owners(graph: &Graph, groups: &[Group], known: &[Option<f64>], legs: usize) -> Vec<Owner> {
    let mut given: Vec<Option<usize>> = vec![None; graph.nodes.len()];
    for group in groups {
        let Group::Legs(nodes) = group else { continue };
        // What is the same for two legs is no leg's own.
        if nodes.iter().enumerate().all(|(leg, id)| !nodes[..leg].contains(id)) {
            nodes.iter().enumerate().for_each(|(leg, id)| given[id.index()] = Some(leg));
        }
    }
    let per_leg = |symbol: &Symbol| {
        symbol.shape.first() == Some(&legs)
            && (symbol.parameter || PER_LEG_INPUTS.contains(&symbol.name.as_str()))
    };
    let mut owners: Vec<Owner> = Vec::with_capacity(graph.nodes.len());
    for (index, node) in graph.nodes.iter().enumerate() {
        let sum = matches!(node, Node::Binary(Op::Add | Op::Sub, ..));
        let mut owner = match *node {
            Node::Input { input, element } if per_leg(&graph.inputs[input as usize]) => {
                Owner::Leg(element as usize / (graph.inputs[input as usize].len() / legs))
            }
            _ => Owner::Common,
        };
        graph.for_each_operand(*node, |operand| owner = owner.and(owners[operand.index()], sum));
        if let Some(leg) = given[index] {
            owner = Owner::Leg(leg);
        }
        // A constant made of several legs' numbers is a constant like any other.
        if known[index].is_some() && owner == Owner::Several {
            owner = Owner::Common;
        }
        owners.push(owner);
    }
    owners
}

/// Reorders every sum that has as many terms of each leg as of any other.
pub fn regroup(
    graph: &Graph,
    groups: Vec<Group>,
    context: &Context,
    partition: &Partition,
) -> (Graph, Vec<Group>) {
    let legs = partition.legs.len();
    let owners = owners(graph, &groups, &known_values(graph, context), legs);
    let uses = graph.use_counts();
    let mut builder = Builder::with_sections_of(graph);
    let mut images = Images::new(graph);
    let mut added = Vec::new();
    let mut of_legs: HashMap<NodeId, NodeId> = HashMap::new();
    for (index, live) in graph.live().into_iter().enumerate() {
        if !live {
            continue;
        }
        builder.enter_section_index(graph.section_of[index]);
        let node = graph.nodes[index];
        let sum = matches!(node, Node::Binary(Op::Add | Op::Sub, ..)) && owners[index] == Owner::Several;
        let terms = if sum { Some(terms(graph, &uses, NodeId(index as u32))) } else { None };
        let image = match terms.and_then(|terms| by_leg(&terms, &owners, legs)) {
            Some(sum) => {
                let written = write(&mut builder, &images, &sum, partition);
                added.push(written.lanes);
                of_legs.insert(written.total, written.of_legs);
                written.total
            }
            None => {
                let node = images.node(graph, &mut builder, node);
                builder.insert(node)
            }
        };
        images.set(index, image);
    }
    let outputs = images.outputs(graph);
    let groups = mapped(groups, |node| images.get(node));
    let part = |id: NodeId| match builder.node(id) {
        // An element that is the sum with its sign changed.
        Node::Unary(Op::Neg, sum) => of_legs.get(&sum).copied(),
        _ => of_legs.get(&id).copied(),
    };
    let mut groups: Vec<Group> = groups.into_iter().flat_map(|group| with_parts(group, part)).collect();
    for lanes in added {
        let later = |group: &Group| group.nodes().iter().max() > lanes.iter().max();
        let place = groups.iter().position(later).unwrap_or(groups.len());
        groups.insert(place, Group::Array { shape: vec![3], nodes: lanes.to_vec() });
    }
    (builder.finish(graph, outputs), groups)
}

/// The group, behind what the legs alone contribute to its elements: elements may differ in what is added to that.
fn with_parts(group: Group, part: impl Fn(NodeId) -> Option<NodeId>) -> Vec<Group> {
    let Group::Array { shape, nodes } = &group else { return vec![group] };
    let parts: Option<Vec<NodeId>> = nodes.iter().map(|id| part(*id)).collect();
    match parts {
        Some(parts) => vec![Group::Array { shape: shape.clone(), nodes: parts }, group],
        None => vec![group],
    }
}

/// A term of a sum, and whether it is subtracted.
type Term = (NodeId, bool);

/// The terms of the sum that ends in `node`, through sums that nothing else reads.
fn terms(graph: &Graph, uses: &[u32], node: NodeId) -> Vec<Term> {
    let mut terms = Vec::new();
    let mut open = vec![(node, false)];
    while let Some((id, negative)) = open.pop() {
        let inside = id == node || uses[id.index()] == 1;
        match graph.nodes[id.index()] {
            Node::Binary(Op::Add, a, b) if inside => open.extend([(b, negative), (a, negative)]),
            Node::Binary(Op::Sub, a, b) if inside => open.extend([(b, !negative), (a, negative)]),
            Node::Unary(Op::Neg, a) if inside => open.push((a, !negative)),
            _ => terms.push((id, negative)),
        }
    }
    terms
}

/// A sum with the same number of terms for each leg.
struct SumOverLegs {
    common: Vec<Term>,
    /// For each leg its terms, in an order that is the same for all legs.
    of_leg: Vec<Vec<Term>>,
}

fn by_leg(terms: &[Term], owners: &[Owner], legs: usize) -> Option<SumOverLegs> {
    let mut of_leg: BTreeMap<usize, Vec<Term>> = BTreeMap::new();
    let mut common = Vec::new();
    for &(id, negative) in terms {
        match owners[id.index()] {
            Owner::Leg(leg) => of_leg.entry(leg).or_default().push((id, negative)),
            _ => common.push((id, negative)),
        }
    }
    let mut of_leg: Vec<Vec<Term>> = of_leg.into_values().collect();
    // Elements of an array are alike only if their terms have their signs in the same order.
    of_leg.iter_mut().for_each(|terms| terms.sort_by_key(|(_, negative)| *negative));
    let signs = |leg: &Vec<Term>| leg.iter().map(|(_, negative)| *negative).collect::<Vec<_>>();
    let alike = of_leg.len() == legs && of_leg.iter().all(|leg| signs(leg) == signs(&of_leg[0]));
    alike.then_some(SumOverLegs { common, of_leg })
}

/// A sum over legs in the order that suits lanes.
struct Written {
    total: NodeId,
    /// The total without the common terms.
    of_legs: NodeId,
    /// What the legs of each lane contribute.
    lanes: [NodeId; 3],
}

fn write(builder: &mut Builder, images: &Images, sum: &SumOverLegs, partition: &Partition) -> Written {
    let extended = |builder: &mut Builder, sum: Option<NodeId>, (id, negative): Term| {
        let term = images.of(id);
        match (sum, negative) {
            (None, false) => term,
            (None, true) => builder.unary(Op::Neg, term),
            (Some(sum), false) => builder.binary(Op::Add, sum, term),
            (Some(sum), true) => builder.binary(Op::Sub, sum, term),
        }
    };
    let lanes = [0, 1, 2].map(|lane| {
        let legs = partition.legs.iter().skip(lane).step_by(3);
        let terms = legs.flat_map(|leg| &sum.of_leg[*leg]);
        let total = terms.fold(None, |total, term| Some(extended(builder, total, *term)));
        total.expect("each leg has a term")
    });
    let first = builder.binary(Op::Add, lanes[0], lanes[1]);
    let of_legs = builder.binary(Op::Add, first, lanes[2]);
    let total = sum.common.iter().fold(of_legs, |total, term| extended(builder, Some(total), *term));
    Written { total, of_legs, lanes }
}
