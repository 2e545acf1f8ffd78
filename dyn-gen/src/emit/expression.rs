//! Values of a graph as expressions.

use std::collections::HashMap;

use proc_macro2::Ident;
use quote::format_ident;
use syn::{BinOp, Expr};

use super::EmitError;
use super::names::{
    CONSTANT, CONSTANT_IN_LANES, LANE, PARAMETERS, SCALARS_IN_LANES, SPLAT, SQRT, TRIPLE, identifier,
    temporary,
};
use super::placement::Place;
use super::schedule::{Statement, Step, Value};
use super::signature::Signature;
use super::tree;
use crate::graph::{Graph, Node, NodeId, Op, Symbol};

/// Writes the values of one graph.
pub struct Expressions<'a> {
    graph: &'a Graph,
    places: &'a [Place],
    inputs: Vec<Ident>,
    parameters: Ident,
    outputs: Vec<Ident>,
    names: HashMap<Value, Ident>,
    constant: Ident,
    sqrt: Ident,
    in_lanes: Vec<bool>,
    graph_has_lanes: bool,
}

impl<'a> Expressions<'a> {
    /// Names everything: temporaries are numbered in the order of the source.
    pub fn new(
        graph: &'a Graph,
        places: &'a [Place],
        statements: &[Statement],
    ) -> Result<Expressions<'a>, EmitError> {
        let signature = Signature::of(graph);
        let mut arguments = signature.argument_names()?;
        let outputs = arguments.split_off(signature.inputs.len());
        let name = |symbol: &Symbol| identifier(&graph.name, &symbol.name);
        let inputs = graph.inputs.iter().map(name).collect::<Result<_, _>>()?;
        let mut names: HashMap<Value, Ident> = HashMap::new();
        let mut temporaries = 0;
        for statement in statements {
            let Step::Define(value) = statement.step else { continue };
            let name = match value {
                Value::Temporary(_) => {
                    temporaries += 1;
                    temporary(temporaries)
                }
                Value::Solution(solve) => {
                    // The derivation's name, unless an argument or another solution has it already.
                    let mut name = identifier(&graph.name, &graph.solves[solve].name)?;
                    while arguments.iter().chain(&outputs).chain(names.values()).any(|taken| *taken == name) {
                        name = format_ident!("{name}_solution");
                    }
                    name
                }
            };
            names.insert(value, name);
        }
        let [parameters, constant, sqrt] = [PARAMETERS, CONSTANT, SQRT].map(|name| format_ident!("{name}"));
        let in_lanes = graph.in_lanes();
        let graph_has_lanes = graph.has_lanes();
        Ok(Expressions {
            in_lanes,
            graph_has_lanes,
            graph,
            places,
            inputs,
            parameters,
            outputs,
            names,
            constant,
            sqrt,
        })
    }

    /// The name of a value that has one.
    pub fn name(&self, value: &Value) -> &Ident {
        &self.names[value]
    }

    /// An element of an output, to be written.
    pub fn target(&self, output: usize, element: usize) -> Expr {
        let array = tree::path(&self.outputs[output]);
        let shape = &self.graph.outputs[output].symbol.shape;
        if shape.is_empty() { tree::dereferenced(array) } else { element_of(array, shape, element) }
    }

    /// `id` where it is used: its name, or its expression where it has none.
    pub fn value(&self, id: NodeId) -> Result<Expr, EmitError> {
        match self.places[id.index()] {
            Place::Temporary => Ok(tree::path(self.name(&Value::Temporary(id)))),
            _ => self.definition(id),
        }
    }

    /// A function of the type in lanes.
    fn of_lanes(&self, function: &str) -> Expr {
        tree::associated(&format_ident!("{SCALARS_IN_LANES}"), &format_ident!("{function}"))
    }

    /// `operand` where `user` reads it: in lanes if `user` is.
    fn operand(&self, user: NodeId, operand: NodeId) -> Result<Expr, EmitError> {
        if !self.in_lanes[user.index()] || self.in_lanes[operand.index()] {
            return self.value(operand);
        }
        match self.graph.nodes[operand.index()] {
            Node::Constant(value) if value.is_finite() => {
                Ok(tree::call(&format_ident!("{CONSTANT_IN_LANES}"), [tree::number(value)]))
            }
            _ => Ok(tree::call_value(self.of_lanes(SPLAT), [self.value(operand)?])),
        }
    }

    /// The expression that computes `id`. It is the tree of the graph; the layout adds the parentheses that keep it, as in
    /// `a - (b - c)` and `a + (b + c)`.
    pub fn definition(&self, id: NodeId) -> Result<Expr, EmitError> {
        Ok(match self.graph.nodes[id.index()] {
            Node::Constant(value) if !value.is_finite() => {
                let function = self.graph.name.clone();
                return Err(EmitError::NonFiniteConstant { function, node: id.0, value });
            }
            Node::Constant(value) => tree::call(&self.constant, [tree::number(value)]),
            Node::Input { input, element } => {
                let name = &self.inputs[input as usize];
                let symbol = &self.graph.inputs[input as usize];
                let array = match symbol.parameter {
                    true => tree::field(tree::path(&self.parameters), name),
                    false => tree::path(name),
                };
                element_of(array, &symbol.shape, element as usize)
            }
            Node::Solution { solve, element } => {
                tree::index(tree::path(self.name(&Value::Solution(solve as usize))), element as usize)
            }
            Node::Unary(Op::Sqrt, a) => tree::call(&self.sqrt, [self.operand(id, a)?]),
            Node::Unary(_, a) => tree::negative(self.operand(id, a)?),
            Node::Binary(op, a, b) => {
                let operator = match op {
                    Op::Mul => BinOp::Mul(Default::default()),
                    Op::Div => BinOp::Div(Default::default()),
                    Op::Sub => BinOp::Sub(Default::default()),
                    _ => BinOp::Add(Default::default()),
                };
                tree::binary(operator, self.operand(id, a)?, self.operand(id, b)?)
            }
            Node::Lanes(lanes) => {
                let lanes = lanes.iter().map(|lane| self.value(*lane)).collect::<Result<Vec<_>, _>>()?;
                tree::call_value(self.of_lanes(TRIPLE), [tree::array(lanes)])
            }
            Node::Lane(a, lane) => {
                tree::call_value(self.of_lanes(LANE), [self.value(a)?, tree::integer(lane.into())])
            }
            Node::Ternary(op, a, b, c) => {
                // Of single numbers in a function in lanes it is the lanes' type that knows how to.
                let function = match self.graph_has_lanes && !self.in_lanes[id.index()] {
                    true => self.of_lanes(op.info().name),
                    false => tree::path(&format_ident!("{}", op.info().name)),
                };
                tree::call_value(function, [self.operand(id, a)?, self.operand(id, b)?, self.operand(id, c)?])
            }
        })
    }
}

/// `array[0][2]` for the flat row-major `element` of an array with this shape; the array itself if it is a scalar.
fn element_of(array: Expr, shape: &[usize], element: usize) -> Expr {
    let mut stride: usize = shape.iter().product();
    let mut rest = element;
    shape.iter().fold(array, |array, &length| {
        stride /= length;
        let index = rest / stride;
        rest %= stride;
        tree::index(array, index)
    })
}

#[cfg(test)]
mod tests {
    use quote::{ToTokens, format_ident, quote};

    use super::*;

    #[test]
    fn elements_are_row_major() {
        let text = |shape: &[usize], element| {
            element_of(tree::path(&format_ident!("a")), shape, element).into_token_stream().to_string()
        };
        assert_eq!(text(&[2, 3, 4], 23), quote!(a[1][2][3]).to_string());
        assert_eq!(text(&[3, 3], 5), quote!(a[1][2]).to_string());
        assert_eq!(text(&[], 0), "a");
    }
}
