//! Long bodies: rustc 1.95 crashes on a function with some 3 000 `let`s when debug info is on.

use dyn_gen::graph::{Builder, Graph, NodeId, Op};

use crate::compiled::{assert_same_bits, interpret, run};
use crate::graphs::{graph, model, random, symbol};

/// `count` temporaries, each used twice, some much later.
fn long(count: usize) -> Graph {
    let inputs = vec![symbol("torque", &[], false)];
    let mut builder = Builder::new();
    let torque = builder.input(0, 0);
    let mut values: Vec<NodeId> = vec![torque];
    for step in 0..count {
        builder.enter_section(&format!("part {}", step / 130));
        let last = values[values.len() - 1];
        let earlier = values[values.len() / 3];
        let constant = builder.constant(1.0 + step as f64 / 1024.0);
        let product = builder.binary(Op::Mul, earlier, constant);
        values.push(builder.binary(Op::Sub, product, last));
    }
    let total = values[values.len() - 1];
    let early = values[17];
    let sum = builder.binary(Op::Add, total, early);
    graph("long", inputs, builder, vec![(symbol("totals", &[3], false), vec![total, early, sum])])
}

#[test]
fn a_body_of_five_thousand_statements_compiles_with_debug_info() {
    let graphs = [long(5000), random("random_long", 7, 6000)];
    let source = model(&graphs, &[]);
    assert!(source.matches(" let t").count() > 4000, "the test needs a long body");
    let cases = [vec![vec![vec![0.25]]], vec![vec![vec![0.5; 9], vec![-1.5]]]];
    let compiled = run(&source, &graphs, &cases, &["-C", "debuginfo=2", "-C", "opt-level=1"]);
    assert_same_bits(&graphs, &compiled, &interpret(&graphs, &cases));
}

#[test]
fn no_block_has_more_than_a_thousand_statements() {
    let source = model(&[long(5000)], &[]);
    // Between the lines that open and close a block, one statement starts with `let` or writes an output.
    let mut statements = 0;
    let mut blocks = 0;
    for line in source.lines() {
        if line.starts_with("    let (")
            || line.starts_with("    ) = {")
            || line == "    };"
            || line == "    {"
        {
            statements = 0;
            blocks += 1;
        }
        statements += usize::from(line.trim_start().starts_with("let t"));
        assert!(statements <= 1000);
    }
    assert!(blocks >= 5, "the body was not cut");
}
