//! The order of statements: operands first, sections together, values used soon after they are made.

use super::placement::{Place, operands};
use crate::graph::{Graph, Node, NodeId};

/// A value with a name in the source.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Value {
    /// `let t12 = ...;`
    Temporary(NodeId),
    /// `let actuator_reaction = solve_general(...);`
    Solution(usize),
}

/// What a statement does.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Step {
    /// Names a value.
    Define(Value),
    /// Writes element `element` of output `output`.
    Store {
        /// Index into [`Graph::outputs`].
        output: usize,
        /// Flat row-major index.
        element: usize,
    },
}

/// One statement of the body.
#[derive(Clone, PartialEq, Debug)]
pub struct Statement {
    /// What it does.
    pub step: Step,
    /// Index into [`Graph::sections`].
    pub section: u32,
    /// Named values it reads.
    pub reads: Vec<Value>,
}

/// Every statement of the body, in order.
///
/// Sections come in the order of their first node. Within a section the order is depth-first from the values that leave
/// it, so that a value stands close to its use; an output is written as soon as it is known. Graphs in lanes are in a good
/// order already.
pub fn schedule(graph: &Graph, places: &[Place]) -> Vec<Statement> {
    let units = Units::of(graph, places);
    let mut order = Order { units: &units, done: vec![false; units.statements.len()], list: Vec::new() };
    if graph.has_lanes() {
        (0..units.statements.len()).for_each(|unit| order.visit(unit));
    }
    for section in units.sections() {
        // What the section needs from others comes first, so that the section itself is not interrupted.
        for &unit in &section {
            for &read in &units.reads[unit] {
                if units.statements[read].section != units.statements[unit].section {
                    order.visit(read);
                }
            }
        }
        for &unit in section.iter().filter(|&&unit| units.leaves_section[unit]) {
            order.visit(unit);
        }
    }
    let order = order.list;
    let mut statements: Vec<Option<Statement>> = units.statements.into_iter().map(Some).collect();
    order.iter().filter_map(|&unit| statements[unit].take()).collect()
}

/// Statements in the order of their nodes, with the dependencies between them.
struct Units {
    statements: Vec<Statement>,
    /// For each statement the statements it reads from.
    reads: Vec<Vec<usize>>,
    /// For each statement the outputs that are just its value.
    stores: Vec<Vec<usize>>,
    /// Whether another section, or an output, needs the statement.
    leaves_section: Vec<bool>,
}

impl Units {
    fn of(graph: &Graph, places: &[Place]) -> Units {
        let mut statements = Vec::new();
        let mut unit_of_node = vec![usize::MAX; graph.nodes.len()];
        let mut unit_of_solve = vec![usize::MAX; graph.solves.len()];
        for (index, node) in graph.nodes.iter().enumerate() {
            let id = NodeId(index as u32);
            let section = graph.section_of[index];
            if places[index] == Place::Temporary {
                let mut reads = Vec::new();
                operands(node).for_each(|operand| values_of(graph, places, operand, &mut reads));
                unit_of_node[index] = statements.len();
                statements.push(Statement { step: Step::Define(Value::Temporary(id)), section, reads });
            }
            if let Node::Solution { solve, .. } = *node {
                let solve = solve as usize;
                if places[index] != Place::Unused && unit_of_solve[solve] == usize::MAX {
                    let mut reads = Vec::new();
                    let system = &graph.solves[solve];
                    for operand in system.operands() {
                        values_of(graph, places, operand, &mut reads);
                    }
                    unit_of_solve[solve] = statements.len();
                    statements.push(Statement { step: Step::Define(Value::Solution(solve)), section, reads });
                }
            }
        }
        let definitions = statements.len();
        let mut stores = vec![Vec::new(); definitions];
        for (output, array) in graph.outputs.iter().enumerate() {
            for (element, &id) in array.nodes.iter().enumerate() {
                let mut reads = Vec::new();
                values_of(graph, places, id, &mut reads);
                // An element that is a bare constant or input belongs to no section.
                let section = match places[id.0 as usize] {
                    Place::Leaf if reads.is_empty() => 0,
                    _ => graph.section_of[id.0 as usize],
                };
                if places[id.0 as usize] == Place::Temporary {
                    stores[unit_of_node[id.0 as usize]].push(statements.len());
                }
                statements.push(Statement { step: Step::Store { output, element }, section, reads });
            }
        }
        stores.resize(statements.len(), Vec::new());
        let unit_of = |value: &Value| match *value {
            Value::Temporary(id) => unit_of_node[id.0 as usize],
            Value::Solution(solve) => unit_of_solve[solve],
        };
        let reads: Vec<Vec<usize>> =
            statements.iter().map(|statement| statement.reads.iter().map(unit_of).collect()).collect();
        let mut leaves_section = vec![false; statements.len()];
        for (unit, statement) in statements.iter().enumerate() {
            leaves_section[unit] |= unit >= definitions;
            for &read in &reads[unit] {
                leaves_section[read] |= statements[read].section != statement.section;
            }
        }
        Units { statements, reads, stores, leaves_section }
    }

    /// The statements of each section, sections in the order of their first node; those without a section last.
    fn sections(&self) -> Vec<Vec<usize>> {
        let mut sections: Vec<Vec<usize>> = Vec::new();
        let mut without = Vec::new();
        let mut position = std::collections::HashMap::new();
        for (unit, statement) in self.statements.iter().enumerate() {
            if statement.section == 0 {
                without.push(unit);
                continue;
            }
            let place = *position.entry(statement.section).or_insert(sections.len());
            if place == sections.len() {
                sections.push(Vec::new());
            }
            sections[place].push(unit);
        }
        sections.push(without);
        sections
    }
}

struct Order<'a> {
    units: &'a Units,
    done: Vec<bool>,
    list: Vec<usize>,
}

impl Order<'_> {
    /// Puts `unit` after everything it needs. Iterative: a chain of sums may be thousands long.
    fn visit(&mut self, unit: usize) {
        let mut stack = vec![(unit, 0)];
        while let Some((unit, next)) = stack.pop() {
            if self.done[unit] {
                continue;
            }
            match self.units.reads[unit].get(next) {
                Some(&read) => stack.extend([(unit, next + 1), (read, 0)]),
                None => {
                    self.done[unit] = true;
                    self.list.push(unit);
                    for &store in &self.units.stores[unit] {
                        self.done[store] = true;
                        self.list.push(store);
                    }
                }
            }
        }
    }
}

/// The named values in the expression of `id`, through everything inlined in it.
fn values_of(graph: &Graph, places: &[Place], id: NodeId, values: &mut Vec<Value>) {
    let node = &graph.nodes[id.0 as usize];
    let value = match (places[id.0 as usize], node) {
        (Place::Temporary, _) => Value::Temporary(id),
        (_, Node::Solution { solve, .. }) => Value::Solution(*solve as usize),
        _ => {
            return operands(node).for_each(|operand| values_of(graph, places, operand, values));
        }
    };
    if !values.contains(&value) {
        values.push(value);
    }
}
