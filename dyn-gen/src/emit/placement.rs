//! Which values get a name and which are written where they are used.

use crate::graph::{Graph, Node, NodeId, Op};

/// Where a value of the graph appears in the source.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Place {
    /// No output needs it.
    Unused,
    /// A literal, an element of an argument or of a solution, a lane: written wherever it is used.
    Leaf,
    /// Used once, and short enough to stand in the expression that uses it.
    Inline,
    /// `let t12 = ...;`
    Temporary,
}

/// Expressions are inlined up to this many characters, so that a statement stays on one line.
const WIDTH: u32 = 76;
/// Characters of a temporary such as `t1234`.
const TEMPORARY: u32 = 5;
/// Characters of `P::splat()` around a number that stands in all lanes.
const SPLAT: u32 = 10;

/// The place of every node. Inlining never crosses a section, so section comments stay true, and never changes the
/// tree of an expression, so results stay bit-identical.
pub fn place(graph: &Graph) -> Vec<Place> {
    let uses = uses(graph);
    let mut width = vec![0; graph.nodes.len()];
    let mut places = vec![Place::Unused; graph.nodes.len()];
    let mut narrowest_first = Vec::with_capacity(3);
    let in_lanes = graph.in_lanes();
    for (index, node) in graph.nodes.iter().enumerate() {
        if uses[index].count == 0 {
            continue;
        }
        let section = graph.section_of[index];
        let mut total = own_width(graph, node);
        places[index] = match node {
            Node::Constant(_) | Node::Input { .. } | Node::Solution { .. } | Node::Lane(..) => Place::Leaf,
            Node::Unary(..) | Node::Binary(..) | Node::Ternary(..) | Node::Lanes(_) => Place::Temporary,
        };
        narrowest_first.clear();
        narrowest_first.extend(operands(node));
        narrowest_first.sort_by_key(|operand| width[operand.index()]);
        // Until it is inlined, an operand counts as the temporary it otherwise is.
        let is_leaf = |operand: &NodeId| places[operand.0 as usize] == Place::Leaf;
        let as_leaf = |operand: &NodeId| if is_leaf(operand) { width[operand.0 as usize] } else { TEMPORARY };
        if in_lanes[index] && !matches!(node, Node::Lanes(_)) {
            total +=
                SPLAT * narrowest_first.iter().filter(|operand| !in_lanes[operand.index()]).count() as u32;
        }
        total += narrowest_first.iter().map(as_leaf).sum::<u32>();
        for operand in narrowest_first.iter().map(|operand| operand.index()) {
            if places[operand] == Place::Leaf {
                continue;
            }
            let wider = total - TEMPORARY + width[operand] + 2;
            if uses[operand].inlinable && graph.section_of[operand] == section && wider <= WIDTH {
                places[operand] = Place::Inline;
                total = wider;
            }
        }
        width[index] = total;
    }
    for NodeId(index) in graph.outputs.iter().flat_map(|output| &output.nodes) {
        let index = *index as usize;
        if places[index] == Place::Temporary && uses[index].inlinable {
            places[index] = Place::Inline;
        }
    }
    places
}

/// Operands of a node, in order; a square appears twice.
pub fn operands(node: &Node) -> impl Iterator<Item = NodeId> + use<> {
    let three = match *node {
        Node::Constant(_) | Node::Input { .. } | Node::Solution { .. } => [None; 3],
        Node::Unary(_, a) | Node::Lane(a, _) => [Some(a), None, None],
        Node::Lanes(lanes) => lanes.map(Some),
        Node::Binary(_, a, b) => [Some(a), Some(b), None],
        Node::Ternary(_, a, b, c) => [Some(a), Some(b), Some(c)],
    };
    three.into_iter().flatten()
}

#[derive(Clone, Copy, Default)]
struct Uses {
    count: u32,
    inlinable: bool,
}

/// How often the outputs need each node. A value is inlinable when exactly one operation or output uses it.
fn uses(graph: &Graph) -> Vec<Uses> {
    let mut uses = vec![Uses::default(); graph.nodes.len()];
    let mut solved = vec![false; graph.solves.len()];
    let add = |uses: &mut Vec<Uses>, id: NodeId, inlinable: bool| {
        let entry = &mut uses[id.0 as usize];
        entry.count += 1;
        entry.inlinable = inlinable && entry.count == 1;
    };
    for node in graph.outputs.iter().flat_map(|output| &output.nodes) {
        add(&mut uses, *node, true);
    }
    for (index, node) in graph.nodes.iter().enumerate().rev() {
        if uses[index].count == 0 {
            continue;
        }
        for operand in operands(node) {
            add(&mut uses, operand, true);
        }
        if let Node::Solution { solve, .. } = *node {
            let solve = solve as usize;
            if !std::mem::replace(&mut solved[solve], true) {
                let solve = &graph.solves[solve];
                for operand in solve.operands() {
                    add(&mut uses, operand, false);
                }
            }
        }
    }
    uses
}

/// Characters a node adds to its operands'.
fn own_width(graph: &Graph, node: &Node) -> u32 {
    let characters = match *node {
        Node::Constant(value) => format!("c({value:?})").len(),
        Node::Input { input, .. } => {
            let symbol = &graph.inputs[input as usize];
            symbol.name.len()
                + 3 * symbol.shape.len()
                + if symbol.parameter { "parameters.".len() } else { 0 }
        }
        Node::Solution { solve, .. } => graph.solves[solve as usize].name.len() + 3,
        Node::Lanes(_) => "P::triple([, , ])".len(),
        Node::Lane(..) => "P::lane(, 0)".len(),
        Node::Unary(Op::Sqrt, _) => "sqrt()".len(),
        Node::Unary(..) => "-".len(),
        Node::Binary(..) => " + ".len(),
        Node::Ternary(op, ..) => op.info().name.len() + "(, , )".len(),
    };
    characters as u32
}
