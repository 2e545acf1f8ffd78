//! The inside of a function: statements in order, in blocks, under section comments.

use quote::format_ident;
use syn::{Expr, Stmt};

use super::EmitError;
use super::blocks::blocks;
use super::expression::Expressions;
use super::names::SOLVE_GENERAL;
use super::placement::place;
use super::print::comment_marker;
use super::schedule::{Statement, Step, Value, schedule};
use super::tree;
use crate::graph::{Graph, NodeId, SolveKind};
use crate::text::one_line;

/// Comment above output elements that are constants or copies of inputs.
const COPIED: &str = "constant and copied elements";

/// The inside of a function, before layout.
pub struct Body {
    /// Comments are markers.
    pub statements: Vec<Stmt>,
    /// Text of the comments the markers stand for.
    pub comments: Vec<String>,
}

/// The statements that evaluate `graph` and write its outputs, with the arguments named by its
/// [`Signature`](super::Signature).
pub fn body(graph: &Graph) -> Result<Body, EmitError> {
    let places = place(graph);
    let order = schedule(graph, &places);
    let expressions = Expressions::new(graph, &places, &order)?;
    let blocks = blocks(&order);
    let mut statements = Vec::new();
    for block in &blocks {
        let mut lines = Vec::with_capacity(block.statements.len());
        let mut section = None;
        for statement in &order[block.statements.clone()] {
            // A body without any section needs no comment at all.
            if section.replace(statement.section) != Some(statement.section) && graph.sections.len() > 1 {
                lines.push(comment_marker(statement.section as usize));
            }
            lines.push(print(graph, &expressions, statement)?);
        }
        if blocks.len() == 1 {
            statements = lines;
        } else {
            let live: Vec<_> = block.live.iter().map(|value| expressions.name(value)).collect();
            statements.push(tree::block(lines, &live));
        }
    }
    let mut comments: Vec<String> = graph.sections.iter().map(|section| one_line(section)).collect();
    if let Some(unnamed) = comments.first_mut() {
        *unnamed = COPIED.into();
    }
    Ok(Body { statements, comments })
}

fn print(graph: &Graph, expressions: &Expressions, statement: &Statement) -> Result<Stmt, EmitError> {
    Ok(match statement.step {
        Step::Define(value @ Value::Temporary(id)) => {
            tree::define(expressions.name(&value), expressions.definition(id)?)
        }
        Step::Define(value @ Value::Solution(solve)) => {
            tree::define(expressions.name(&value), solution(graph, expressions, solve)?)
        }
        Step::Store { output, element } => {
            let id = graph.outputs[output].nodes[element];
            tree::assign(expressions.target(output, element), expressions.value(id)?)
        }
    })
}

/// `solve_general(&[[...], ...], &[...])`
fn solution(graph: &Graph, expressions: &Expressions, solve: usize) -> Result<Expr, EmitError> {
    let system = &graph.solves[solve];
    if system.kind == SolveKind::SymmetricPositiveDefinite {
        return Err(EmitError::SymmetricSolve { function: graph.name.clone(), solve: system.name.clone() });
    }
    let vector = |ids: &[NodeId]| -> Result<Expr, EmitError> {
        Ok(tree::array(ids.iter().map(|&id| expressions.value(id)).collect::<Result<Vec<_>, _>>()?))
    };
    let rows =
        system.matrix.chunks(system.right_hand_side.len()).map(vector).collect::<Result<Vec<_>, _>>()?;
    let right_hand_side = vector(&system.right_hand_side)?;
    let arguments = [tree::borrowed(tree::array(rows)), tree::borrowed(right_hand_side)];
    Ok(tree::call(&format_ident!("{SOLVE_GENERAL}"), arguments))
}
