//! The inside of a function: statements in order, in blocks, under section comments.
//!
//! Bodies are written as text. As syntax trees, tens of thousands of expressions that are built, laid out and dropped again,
//! they took a third of the generator's time.

use super::EmitError;
use super::blocks::blocks;
use super::expression::Expressions;
use super::placement::place;
use super::schedule::{Statement, Step, schedule};
use crate::graph::Graph;
use crate::text::one_line;

/// Comment above output elements that are constants or copies of inputs.
const COPIED: &str = "constant and copied elements";
/// Statements that would be longer continue on a second line.
const WIDTH: usize = 100;
const INDENT: &str = "    ";

/// The statements that evaluate `graph` and write its outputs, with the arguments named by its
/// [`Signature`](super::Signature).
pub fn body(graph: &Graph) -> Result<String, EmitError> {
    let places = place(graph);
    let order = schedule(graph, &places);
    let expressions = Expressions::new(graph, &places, &order)?;
    let blocks = blocks(&order);
    let mut text = String::with_capacity(50 * order.len());
    for block in &blocks {
        let live: Vec<String> = block.live.iter().map(|value| expressions.name(*value)).collect();
        let nested = blocks.len() > 1;
        let indent = if nested { [INDENT, INDENT].concat() } else { INDENT.into() };
        if nested {
            text.push_str(INDENT);
            if !live.is_empty() {
                text.push_str("let ");
                push_tuple(&mut text, &live, INDENT);
                text.push_str(" = ");
            }
            text.push_str("{\n");
        }
        let mut section = None;
        for statement in &order[block.statements.clone()] {
            // A body without any section needs no comment at all.
            if section.replace(statement.section) != Some(statement.section) && graph.sections.len() > 1 {
                let comment = match statement.section {
                    0 => COPIED.into(),
                    section => one_line(&graph.sections[section as usize]),
                };
                text.extend([&indent, "// ", &comment, "\n"]);
            }
            push_statement(&mut text, graph, &expressions, statement, &indent)?;
        }
        if nested {
            if !live.is_empty() {
                text.push_str(&indent);
                push_tuple(&mut text, &live, &indent);
                text.push('\n');
            }
            text.extend([INDENT, if live.is_empty() { "}\n" } else { "};\n" }]);
        }
    }
    Ok(text)
}

fn push_statement(
    text: &mut String,
    graph: &Graph,
    expressions: &Expressions,
    statement: &Statement,
    indent: &str,
) -> Result<(), EmitError> {
    let (target, value) = match statement.step {
        Step::Define(value) => (format!("let {}", expressions.name(value)), expressions.definition(value)?),
        Step::Store { output, element } => {
            let id = graph.outputs[output].nodes[element];
            (expressions.target(output, element), expressions.value(id)?)
        }
    };
    text.extend([indent, &target, " ="]);
    let length = indent.len() + target.len() + " = ;".len() + value.len();
    let mut lines = value.lines();
    match lines.next() {
        Some(only) if value.len() == only.len() && length > WIDTH => {
            text.extend(["\n", indent, INDENT, only]);
        }
        first => text.extend([" ", first.unwrap_or_default()]),
    }
    lines.for_each(|line| text.extend(["\n", indent, line]));
    text.push_str(";\n");
    Ok(())
}

/// `(a, b, c)`, or `a` alone; many names on as many lines as they need.
fn push_tuple(text: &mut String, names: &[String], indent: &str) {
    if let [name] = names {
        return text.push_str(name);
    }
    let line: usize = names.iter().map(|name| name.len() + ", ".len()).sum();
    if line + indent.len() + "let () = {".len() <= WIDTH {
        return text.extend(["(", &names.join(", "), ")"]);
    }
    text.push('(');
    let mut column = WIDTH;
    for name in names {
        if column + name.len() + ", ".len() > WIDTH {
            text.extend(["\n", indent, INDENT]);
            column = indent.len() + INDENT.len();
        } else {
            text.push(' ');
        }
        text.extend([name, ","]);
        column += name.len() + ", ".len();
    }
    text.extend(["\n", indent, ")"]);
}
