//! Values of a graph as text.

use std::fmt::Write;

use super::EmitError;
use super::names::{
    CONSTANT, CONSTANT_IN_LANES, LANE, LOAD, PARAMETERS, SCALARS_IN_LANES, SOLVE_AFTER_ATTEMPT,
    SOLVE_AFTER_ATTEMPT_IN_LANES, SOLVE_GENERAL, SPLAT, SQRT, TRIPLE, identifier,
};
use super::placement::Place;
use super::schedule::{Statement, Step, Value};
use super::signature::Signature;
use crate::graph::{Graph, Node, NodeId, Op, SolveKind, Symbol};
use crate::pack::{PREPARED, row};

/// Writes the values of one graph.
pub struct Expressions<'a> {
    graph: &'a Graph,
    places: &'a [Place],
    inputs: Vec<String>,
    outputs: Vec<String>,
    /// For each node the number of its temporary, if it is one.
    temporaries: Vec<u32>,
    solutions: Vec<String>,
    in_lanes: Vec<bool>,
    graph_has_lanes: bool,
}

/// How tightly an expression is held together; whatever is looser than its place needs parentheses.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Binding {
    Sum,
    Product,
    Negative,
    Whole,
}

impl<'a> Expressions<'a> {
    /// Names everything: temporaries are numbered in the order of the source.
    pub fn new(
        graph: &'a Graph,
        places: &'a [Place],
        statements: &[Statement],
    ) -> Result<Expressions<'a>, EmitError> {
        let signature = Signature::of(graph);
        let arguments: Vec<String> = signature.argument_names()?.iter().map(ToString::to_string).collect();
        let outputs = arguments[signature.inputs.len()..].to_vec();
        let input = |symbol: &Symbol| {
            let name = identifier(&graph.name, &symbol.name)?;
            Ok(if symbol.parameter { format!("{PARAMETERS}.{name}") } else { name.to_string() })
        };
        let inputs = graph.inputs.iter().map(input).collect::<Result<_, EmitError>>()?;
        let mut solutions: Vec<String> = Vec::with_capacity(graph.solves.len());
        for solve in &graph.solves {
            // The derivation's name, unless an argument or another solution has it already.
            let mut name = identifier(&graph.name, &solve.name)?.to_string();
            while arguments.iter().chain(&solutions).any(|taken| *taken == name) {
                name.push_str("_solution");
            }
            solutions.push(name);
        }
        let mut temporaries = vec![0; graph.nodes.len()];
        let mut last = 0;
        for statement in statements {
            if let Step::Define(Value::Temporary(id)) = statement.step {
                last += 1;
                temporaries[id.index()] = last;
            }
        }
        let in_lanes = graph.in_lanes();
        let graph_has_lanes = graph.has_lanes();
        Ok(Expressions { graph, places, inputs, outputs, temporaries, solutions, in_lanes, graph_has_lanes })
    }

    /// The name of a value that has one.
    pub fn name(&self, value: Value) -> String {
        match value {
            Value::Temporary(id) => format!("t{}", self.temporaries[id.index()]),
            Value::Solution(solve) => self.solutions[solve].clone(),
        }
    }

    /// An element of an output, to be written.
    pub fn target(&self, output: usize, element: usize) -> String {
        let (name, shape) = (&self.outputs[output], &self.graph.outputs[output].symbol.shape);
        let mut text = if shape.is_empty() { format!("*{name}") } else { name.clone() };
        write_indices(&mut text, shape, element);
        text
    }

    /// The expression of a value that has a name, as it stands behind the name.
    pub fn definition(&self, value: Value) -> Result<String, EmitError> {
        let mut text = String::with_capacity(80);
        match value {
            Value::Temporary(id) => self.write_definition(&mut text, id, Binding::Sum)?,
            Value::Solution(solve) => self.write_solution(&mut text, solve)?,
        }
        Ok(text)
    }

    /// `id` where it is used: its name, or its expression where it has none.
    pub fn value(&self, id: NodeId) -> Result<String, EmitError> {
        let mut text = String::with_capacity(80);
        self.write_value(&mut text, id, Binding::Sum)?;
        Ok(text)
    }

    fn write_value(&self, text: &mut String, id: NodeId, place: Binding) -> Result<(), EmitError> {
        match self.places[id.index()] {
            Place::Temporary => {
                put(text, format_args!("t{}", self.temporaries[id.index()]));
                Ok(())
            }
            _ => self.write_definition(text, id, place),
        }
    }

    /// `operand` where `user` reads it: in lanes if `user` is.
    fn write_operand(
        &self,
        text: &mut String,
        user: NodeId,
        operand: NodeId,
        place: Binding,
    ) -> Result<(), EmitError> {
        if !self.in_lanes[user.index()] || self.in_lanes[operand.index()] {
            return self.write_value(text, operand, place);
        }
        match self.graph.nodes[operand.index()] {
            Node::Constant(value) if value.is_finite() => {
                put(text, format_args!("{CONSTANT_IN_LANES}({value:?})"))
            }
            _ => {
                put(text, format_args!("{SCALARS_IN_LANES}::{SPLAT}("));
                self.write_value(text, operand, Binding::Sum)?;
                text.push(')');
            }
        }
        Ok(())
    }

    /// The expression that computes `id`: the tree of the graph, with the parentheses that keep it, as in
    /// `a - (b - c)` and `a + (b + c)`.
    fn write_definition(&self, text: &mut String, id: NodeId, place: Binding) -> Result<(), EmitError> {
        match self.graph.nodes[id.index()] {
            Node::Constant(value) if !value.is_finite() => {
                let function = self.graph.name.clone();
                return Err(EmitError::NonFiniteConstant { function, node: id.0, value });
            }
            // The fewest digits that read back as the same number.
            Node::Constant(value) => put(text, format_args!("{CONSTANT}({value:?})")),
            Node::Input { input, element } => {
                text.push_str(&self.inputs[input as usize]);
                write_indices(text, &self.graph.inputs[input as usize].shape, element as usize);
            }
            Node::Solution { solve, element } => {
                put(text, format_args!("{}[{element}]", self.solutions[solve as usize]));
            }
            Node::Unary(Op::Sqrt, a) => {
                put(text, format_args!("{SQRT}("));
                self.write_operand(text, id, a, Binding::Sum)?;
                text.push(')');
            }
            Node::Unary(_, a) => self.in_parentheses(text, Binding::Negative < place, |text| {
                text.push('-');
                // `-(-x)`: `--` looks like an operator of other languages and rustc warns of it.
                self.write_operand(text, id, a, Binding::Whole)
            })?,
            Node::Binary(op, a, b) => {
                let (operator, own, right) = match op {
                    Op::Mul => (" * ", Binding::Product, Binding::Negative),
                    Op::Div => (" / ", Binding::Product, Binding::Negative),
                    Op::Sub => (" - ", Binding::Sum, Binding::Product),
                    _ => (" + ", Binding::Sum, Binding::Product),
                };
                self.in_parentheses(text, own < place, |text| {
                    self.write_operand(text, id, a, own)?;
                    text.push_str(operator);
                    self.write_operand(text, id, b, right)
                })?;
            }
            Node::Lanes(lanes) if row(self.graph, lanes).is_some() => {
                let row = row(self.graph, lanes).unwrap_or_default();
                put(text, format_args!("{SCALARS_IN_LANES}::{LOAD}(&{PREPARED}[{row}])"));
            }
            Node::Lanes(lanes) => {
                put(text, format_args!("{SCALARS_IN_LANES}::{TRIPLE}(["));
                self.write_list(text, &lanes, |text, lane| self.write_value(text, lane, Binding::Sum))?;
                text.push_str("])");
            }
            Node::Lane(a, lane) => {
                put(text, format_args!("{SCALARS_IN_LANES}::{LANE}("));
                self.write_value(text, a, Binding::Sum)?;
                put(text, format_args!(", {lane})"));
            }
            Node::Ternary(op, a, b, c) => {
                // Of single numbers in a function in lanes it is the lanes' type that knows how to.
                if self.graph_has_lanes && !self.in_lanes[id.index()] {
                    put(text, format_args!("{SCALARS_IN_LANES}::"));
                }
                put(text, format_args!("{}(", op.info().name));
                let operand =
                    |text: &mut String, operand| self.write_operand(text, id, operand, Binding::Sum);
                self.write_list(text, &[a, b, c], operand)?;
                text.push(')');
            }
        }
        Ok(())
    }

    /// `solve_general(&[[...], ...], &[...])`, a row of the matrix on a line, after the attempt if there is one.
    fn write_solution(&self, text: &mut String, solve: usize) -> Result<(), EmitError> {
        let system = &self.graph.solves[solve];
        if system.kind == SolveKind::SymmetricPositiveDefinite {
            let (function, solve) = (self.graph.name.clone(), system.name.clone());
            return Err(EmitError::SymmetricSolve { function, solve });
        }
        let n = system.right_hand_side.len();
        let value = |text: &mut String, id| self.write_value(text, id, Binding::Sum);
        let order = self.places_in_lanes(&system.attempt);
        let row = |text: &mut String, nodes: &[NodeId]| match &order {
            Some(order) => self.write_triples(text, nodes, order),
            None => self.write_list(text, nodes, value),
        };
        match (system.attempt.is_empty(), &order) {
            (true, _) => put(text, format_args!("{SOLVE_GENERAL}(\n")),
            (false, None) => put(text, format_args!("{SOLVE_AFTER_ATTEMPT}(\n    &[")),
            (false, Some(_)) => {
                put(text, format_args!("{SOLVE_AFTER_ATTEMPT_IN_LANES}::<{SCALARS_IN_LANES}>(\n    &["));
            }
        }
        if !system.attempt.is_empty() {
            row(text, &system.attempt)?;
            text.push_str("],\n");
        }
        text.push_str("    &[\n");
        for nodes in system.matrix.chunks(n) {
            text.push_str("        [");
            row(text, nodes)?;
            text.push_str("],\n");
        }
        text.push_str("    ],\n    &[");
        self.write_list(text, &system.right_hand_side, value)?;
        text.push_str("],\n");
        if let Some(order) = order {
            put(text, format_args!("    &{order:?},\n"));
        }
        text.push(')');
        Ok(())
    }

    /// Which of six values stand in the lanes of two others: those of the first, in order, and those of the second.
    fn places_in_lanes(&self, values: &[NodeId]) -> Option<[usize; 6]> {
        let lanes = values.iter().map(|id| match self.graph.nodes[id.index()] {
            Node::Lane(of, lane) => Some((of, lane)),
            _ => None,
        });
        let lanes: [(NodeId, u8); 6] = lanes.collect::<Option<Vec<_>>>()?.try_into().ok()?;
        let mut order = [0, 1, 2, 3, 4, 5];
        order.sort_by_key(|place| lanes[*place]);
        let in_order =
            (0..6).map(|k| lanes[order[k]]).zip([0, 1, 2, 0, 1, 2]).all(|((_, lane), k)| lane == k);
        (in_order && lanes[order[0]].0 == lanes[order[2]].0 && lanes[order[3]].0 == lanes[order[5]].0)
            .then_some(order)
    }

    /// Six values as two in lanes.
    fn write_triples(
        &self,
        text: &mut String,
        values: &[NodeId],
        order: &[usize; 6],
    ) -> Result<(), EmitError> {
        for (side, places) in order.chunks(3).enumerate() {
            if side > 0 {
                text.push_str(", ");
            }
            let three = [0, 1, 2].map(|k: usize| values[places[k]]);
            match three.map(|id| self.graph.nodes[id.index()]) {
                [Node::Lane(a, 0), Node::Lane(b, 1), Node::Lane(c, 2)] if a == b && b == c => {
                    self.write_value(text, a, Binding::Sum)?;
                }
                _ => {
                    put(text, format_args!("{SCALARS_IN_LANES}::{TRIPLE}(["));
                    self.write_list(text, &three, |text, id| self.write_value(text, id, Binding::Sum))?;
                    text.push_str("])");
                }
            }
        }
        Ok(())
    }

    fn write_list(
        &self,
        text: &mut String,
        ids: &[NodeId],
        write: impl Fn(&mut String, NodeId) -> Result<(), EmitError>,
    ) -> Result<(), EmitError> {
        for (place, id) in ids.iter().enumerate() {
            if place > 0 {
                text.push_str(", ");
            }
            write(text, *id)?;
        }
        Ok(())
    }

    fn in_parentheses(
        &self,
        text: &mut String,
        parentheses: bool,
        write: impl FnOnce(&mut String) -> Result<(), EmitError>,
    ) -> Result<(), EmitError> {
        if parentheses {
            text.push('(');
        }
        write(text)?;
        if parentheses {
            text.push(')');
        }
        Ok(())
    }
}

/// Writes to a string, which cannot fail.
fn put(text: &mut String, arguments: std::fmt::Arguments) {
    let _ = text.write_fmt(arguments);
}

/// `[0][2]` for the flat row-major `element` of an array with this shape; nothing for a scalar.
fn write_indices(text: &mut String, shape: &[usize], element: usize) {
    let mut stride: usize = shape.iter().product();
    let mut rest = element;
    for length in shape {
        stride /= length;
        put(text, format_args!("[{}]", rest / stride));
        rest %= stride;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn elements_are_row_major() {
        let text = |shape: &[usize], element| {
            let mut text = String::from("a");
            write_indices(&mut text, shape, element);
            text
        };
        assert_eq!(text(&[2, 3, 4], 23), "a[1][2][3]");
        assert_eq!(text(&[3, 3], 5), "a[1][2]");
        assert_eq!(text(&[], 0), "a");
    }
}
