//! The notation table says what the graph file says, and the README's example compiles (see the crate's documentation).

use dyn_gen::graph::Role;
use dyn_platform::LegType;
use dyn_tests::platforms::{graph_file, root};

#[test]
fn notation_has_every_symbol_with_shape_unit_and_frame() {
    let table = std::fs::read_to_string(root().join("docs/notation.md")).expect("docs/notation.md");
    let mut missing = Vec::new();
    for program in LegType::ALL.map(|leg_type| graph_file(leg_type).program) {
        for declaration in &program.symbols {
            let symbol = &declaration.symbol;
            if declaration.role == Role::Intermediate {
                continue;
            }
            let shape = match symbol.shape.as_slice() {
                [] => "scalar".to_owned(),
                shape => shape.iter().map(usize::to_string).collect::<Vec<_>>().join("x"),
            };
            let facts = format!(
                "| {shape} | {} | {} | {} | {}",
                symbol.unit, symbol.frame, symbol.meaning, symbol.equation
            );
            let mut rows = table.lines().filter(|line| line.starts_with(&format!("| `{}` |", symbol.name)));
            if !rows.any(|row| row.contains(facts.trim_end())) {
                missing.push(format!("`{}` should read {facts}", symbol.name));
            }
        }
        for function in &program.functions {
            let start = format!("| `{}` | {} |", function.name, function.meaning);
            if !table.lines().any(|line| line.starts_with(&start)) {
                missing.push(format!("function {start}"));
            }
        }
    }
    assert!(missing.is_empty(), "docs/notation.md:\n{}", missing.join("\n"));
}
