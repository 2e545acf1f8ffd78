//! One node of a graph file, checked.

use serde_json::Number;

use super::format::FileNode;
use super::{Node, NodeId, OPS, Op, OpInfo, Symbol};

/// A node of a graph with these inputs, at this index.
pub(super) fn read_node(file: FileNode, index: usize, inputs: &[Symbol]) -> Result<Node, String> {
    let FileNode { operation, operands } = file;
    let arity = |expected: usize| match operands.len() {
        got if got == expected => Ok(()),
        got => Err(format!(
            "`{operation}` takes {expected} operand{}, got {got}",
            if expected == 1 { "" } else { "s" }
        )),
    };
    let whole = |number: &Number| {
        let value = number.as_u64().and_then(|value| u32::try_from(value).ok());
        value.ok_or_else(|| format!("`{operation}` takes whole numbers as operands, got {number}"))
    };
    let operand = |number: &Number| {
        let node = whole(number)?;
        if (node as usize) < index {
            Ok(NodeId(node))
        } else {
            Err(format!("reads node {node}, which is not before it"))
        }
    };
    match operation.as_str() {
        "const" => {
            arity(1)?;
            let value = operands[0].as_f64().filter(|value| value.is_finite());
            value
                .map(Node::Constant)
                .ok_or_else(|| format!("constant {} is not a finite number", operands[0]))
        }
        "input" => {
            arity(2)?;
            let (input, element) = (whole(&operands[0])?, whole(&operands[1])?);
            let Some(symbol) = inputs.get(input as usize) else {
                return Err(format!("input {input} does not exist ({} inputs)", inputs.len()));
            };
            if element as usize >= symbol.len() {
                let Symbol { name, shape, .. } = symbol;
                return Err(format!("element {element} is outside `{name}` of shape {shape:?}"));
            }
            Ok(Node::Input { input, element })
        }
        name => {
            // Fusing is a pass: a derivation does not know it.
            let derived = |info: &OpInfo| info.arity < 3;
            let Some(op) = Op::from_name(name).filter(|op| derived(op.info())) else {
                let known: Vec<_> = OPS.iter().filter(|info| derived(info)).map(|info| info.name).collect();
                let known = known.join(", ");
                return Err(format!("unknown operation `{name}`; known: input, const, {known}"));
            };
            arity(op.info().arity)?;
            let a = operand(&operands[0])?;
            if op.info().arity == 1 {
                return Ok(Node::Unary(op, a));
            }
            Ok(Node::Binary(op, a, operand(&operands[1])?))
        }
    }
}
