//! The graph file: what is refused and in which words, and that flattening keeps the meaning of the committed one.

mod common;

use dyn_gen::graph::{Environment, FormatError, Program};
use proptest::prelude::*;

const SMALL: &str = include_str!("common/small.json");

fn error(text: &str) -> FormatError {
    Program::from_json(text).expect_err("a file to be refused")
}

/// The error after one change of [`SMALL`].
fn refused(from: &str, to: &str) -> String {
    assert_eq!(SMALL.matches(from).count(), 1, "{from} occurs once");
    error(&SMALL.replace(from, to)).to_string()
}

#[test]
fn a_small_file_is_read_and_evaluated() {
    let program = Program::from_json(SMALL).unwrap();
    let function = program.function("solved").unwrap();
    // [3 2.5; 4 2.5] y = [1; 2]
    let values = program.evaluate(function, &program.sample).unwrap();
    assert_eq!(values["a"], [3.0, 2.5, 4.0, 2.5]);
    assert!((values["y"][0] - 1.0).abs() < 1e-15 && (values["y"][1] + 0.8).abs() < 1e-15, "{values:?}");
    assert_eq!(program.parameters_of(function).map(|symbol| symbol.name.as_str()).collect::<Vec<_>>(), ["k"]);
    let graph = program.flatten(function);
    assert_eq!(graph.sections, ["", "leg 1: matrix", "leg 2: matrix", "result"]);
    // The sample in the file is wrong on purpose.
    let (deviation, place) = program.check_samples().unwrap();
    assert!(deviation > 0.5 && place == "solved, y");
}

#[test]
fn format_and_version_are_checked_first() {
    let other_format = refused("dyn-gen graph", "svg");
    assert_eq!(other_format, "graph file: format is `svg`, expected `dyn-gen graph`");
    let newer = error(r#"{"format": "dyn-gen graph", "version": 2, "new": []}"#);
    assert_eq!(newer.to_string(), "graph file: version 2 of the format, but this dyn-gen reads version 1");
    assert_eq!(
        newer.remedy,
        "derive the graph again with the codegen folder of this release: `cargo regen --derive`"
    );
}

#[test]
fn syntax_errors_have_line_and_column() {
    assert_eq!(refused("[\"const\", 0.5]", "[\"const\", ]"), "line 10, column 75: expected value");
    assert_eq!(refused("[\"const\", 0.5]", "[\"const\", NaN]"), "line 10, column 75: expected value");
    assert_eq!(refused("[\"const\", 0.5]", "[\"const\", 1e999]"), "line 10, column 79: number out of range");
    assert_eq!(
        refused("\"leg_count\": 2", "\"legs\": 2"),
        "line 1, column 65: unknown field `legs`, expected one of `format`, `version`, `name`, `leg_count`, `provenance`, \
         `symbols`, `graphs`, `functions`, `sample`"
    );
    assert_eq!(error("").to_string(), "line 1, column 0: EOF while parsing a value");
}

#[test]
fn nodes_are_checked_one_by_one() {
    let node = |text: &str| refused("[\"mul\", 2, 0]", text);
    assert_eq!(
        node("[\"sin\", 2]"),
        "graph `leg`, node 4: unknown operation `sin`; known: input, const, neg, sqrt, add, sub, mul, div"
    );
    assert_eq!(node("[\"mul\", 2]"), "graph `leg`, node 4: `mul` takes 2 operands, got 1");
    assert_eq!(node("[\"sqrt\", 2, 3]"), "graph `leg`, node 4: `sqrt` takes 1 operand, got 2");
    assert_eq!(node("[\"mul\", 2, 4]"), "graph `leg`, node 4: reads node 4, which is not before it");
    assert_eq!(
        node("[\"mul\", 2, -1]"),
        "graph `leg`, node 4: `mul` takes whole numbers as operands, got -1"
    );
    assert_eq!(
        node("[\"mul\", 2, 0.5]"),
        "graph `leg`, node 4: `mul` takes whole numbers as operands, got 0.5"
    );
    assert_eq!(
        node("[\"mul\", 2, 4294967296]"),
        "graph `leg`, node 4: `mul` takes whole numbers as operands, got 4294967296"
    );
    assert_eq!(node("[\"input\", 2, 0]"), "graph `leg`, node 4: input 2 does not exist (2 inputs)");
    assert_eq!(node("[\"input\", 0, 2]"), "graph `leg`, node 4: element 2 is outside `x` of shape [2]");
    // Called over legs, the graph sees one leg's stiffness.
    assert_eq!(node("[\"input\", 1, 1]"), "graph `leg`, node 4: element 1 is outside `k` of shape []");
    assert_eq!(
        node("[]"),
        "line 10, column 82: invalid length 0, expected a node, [\"operation\", operands...]"
    );
}

#[test]
fn graphs_are_checked() {
    assert_eq!(
        refused("\"nodes\": [4, 5]", "\"nodes\": [4]"),
        "graph `leg`, output `a`: 1 nodes for shape [2]"
    );
    assert_eq!(
        refused("\"nodes\": [4, 5]", "\"nodes\": [4, 6]"),
        "graph `leg`, output `a`: node 6 does not exist (6 nodes)"
    );
    assert_eq!(refused("[\"x\", \"k\"]", "[\"x\", \"q\"]"), "graph `leg`: unknown symbol `q`");
    assert_eq!(refused("[\"x\", \"k\"]", "[\"x\", \"x\"]"), "graph `leg`: input `x` listed twice");
    assert_eq!(
        refused("\"symbol\": \"a\"", "\"symbol\": \"x\""),
        "graph `leg`, output `x`: an input or parameter cannot be computed"
    );
    assert_eq!(
        refused("\"symbol\": \"a\"", "\"symbol\": \"y\""),
        "graph `leg`, output `y`: computed over legs but not declared per leg"
    );
    assert_eq!(
        refused("\"name\": \"leg\"", "\"name\": \"Leg\""),
        "function `solved`: calls unknown graph `leg`"
    );
    let unused = r#""graphs": [{"name": "idle", "meaning": "", "inputs": [], "outputs": [], "nodes": []},"#;
    assert_eq!(refused("\"graphs\": [", unused), "graph `idle`: no function calls it");
    let twice = r#""graphs": [{"name": "leg", "meaning": "", "inputs": [], "outputs": [], "nodes": []},"#;
    assert_eq!(refused("\"graphs\": [", twice), "graph `leg`: defined twice");
}

#[test]
fn symbols_are_checked() {
    assert_eq!(refused("{\"name\": \"k\"", "{\"name\": \"x\""), "symbol `x`: declared twice");
    assert_eq!(
        refused("{\"name\": \"k\"", "{\"name\": \"k-1\""),
        "symbol `k-1`: symbol name \"k-1\" is not of the form lower_case_1"
    );
    let shape = |shape: &str| {
        refused("\"per_leg\": true, \"shape\": []", &format!("\"per_leg\": true, \"shape\": {shape}"))
    };
    assert_eq!(shape("[0]"), "symbol `k`: shape [2, 0] does not have 1 to 65536 elements");
    assert_eq!(
        shape("[4294967296, 4294967296]"),
        "symbol `k`: shape [2, 4294967296, 4294967296] does not have 1 to 65536 elements"
    );
    assert_eq!(
        refused("\"leg_count\": 2", "\"leg_count\": 0"),
        "graph file: leg_count is 0, expected 1 to 64"
    );
}

#[test]
fn functions_are_checked() {
    assert_eq!(
        refused("\"over\": \"legs\"}", "\"over\": \"legs\"}, {\"call\": \"leg\"}"),
        "function `solved`: calls graph `leg` both once and over legs"
    );
    assert_eq!(
        refused("\"over\": \"legs\"}", "\"over\": \"legs\"}, {\"call\": \"leg\", \"over\": \"legs\"}"),
        "function `solved`, step 1: `a` gets a second value"
    );
    assert_eq!(refused("{\"call\": \"leg\", \"over\": \"legs\"}, ", ""), "graph `leg`: no function calls it");
    assert_eq!(
        refused("\"inputs\": [\"x\"]", "\"inputs\": []"),
        "function `solved`, step 0: `x` has no value yet"
    );
    assert_eq!(
        refused("\"inputs\": [\"x\"]", "\"inputs\": [\"k\"]"),
        "function `solved`: `k` is listed as Input, but declared Parameter"
    );
    assert_eq!(
        refused("\"outputs\": [\"y\"]", "\"outputs\": [\"y\", \"y\"]"),
        "function `solved`: `y` listed twice"
    );
    assert_eq!(
        refused("\"solve\": \"y\"", "\"solve\": \"z\""),
        "function `solved`, step 1: unknown symbol `z`"
    );
    assert_eq!(
        refused("\"right_hand_side\": \"x\"", "\"right_hand_side\": \"a\""),
        "function `solved`, step 1: solve needs shapes [n, n], [n] and [n]: matrix `a` has [2, 2], right-hand side `a` [2, 2], \
         solution `y` [2]"
    );
    assert!(refused("\"over\": \"legs\"", "\"over\": \"feet\"").ends_with("a step is {\"call\": graph} with optional \"over\": \"legs\", or {\"solve\": symbol, \"matrix\": symbol, \"right_hand_side\": symbol, \"symmetric_positive_definite\": bool}"));
}

#[test]
fn samples_are_checked() {
    assert_eq!(refused("[0.5, 0.25]", "[0.5]"), "function `solved`, sample: 1 numbers for `y` of shape [2]");
    assert_eq!(refused("\"k\": [3.0, 4.0]", "\"k\": [3.0]"), "sample: 1 numbers for `k` of shape [2]");
    assert_eq!(refused(", \"k\": [3.0, 4.0]", ""), "sample: no value for `k`");
    assert_eq!(refused("\"k\": [3.0, 4.0]", "\"q\": [3.0, 4.0]"), "sample: unknown symbol `q`");
    assert_eq!(
        refused("{\"y\": [0.5, 0.25]}", "{\"x\": [0.5, 0.25]}"),
        "function `solved`: sample of `x`, which is not an output"
    );
}

#[test]
fn large_systems_are_refused() {
    let wide = |n: usize| {
        let nodes = (0..n).map(|k| k.to_string()).collect::<Vec<_>>().join(", ");
        let inputs = (0..n).map(|k| format!("[\"input\", 0, {k}]")).collect::<Vec<_>>().join(", ");
        let numbers = vec!["1.0"; n].join(", ");
        let symbol = |name: &str, role: &str, per_leg: bool| {
            format!(
                r#"{{"name": "{name}", "role": "{role}", "per_leg": {per_leg}, "shape": [{n}], "unit": "", "frame": "", "meaning": "", "equation": ""}}"#
            )
        };
        let symbols =
            [symbol("x", "input", false), symbol("a", "intermediate", true), symbol("y", "output", false)];
        format!(
            r#"{{"format": "dyn-gen graph", "version": 1, "name": "wide", "leg_count": {n},
            "provenance": {{"casadi": "", "derivation_sha256": ""}}, "symbols": [{symbols}],
            "graphs": [{{"name": "row", "meaning": "", "inputs": ["x"], "outputs": [{{"symbol": "a", "nodes": [{nodes}]}}], "nodes": [{inputs}]}}],
            "functions": [{{"name": "f", "meaning": "", "equation": "", "inputs": ["x"], "outputs": ["y"],
              "steps": [{{"call": "row", "over": "legs"}}, {{"solve": "y", "matrix": "a", "right_hand_side": "x", "symmetric_positive_definite": true}}],
              "sample_outputs": {{}}}}],
            "sample": {{"x": [{numbers}]}}}}"#,
            symbols = symbols.join(", ")
        )
    };
    Program::from_json(&wide(12)).unwrap();
    assert_eq!(
        error(&wide(13)).to_string(),
        "function `f`, step 1: `y` has 13 unknowns; at most 12 can be written out"
    );
}

#[test]
fn texts_that_would_leave_their_comment_are_refused() {
    assert_eq!(
        refused("\"casadi\": \"3.8.2\"", "\"casadi\": \"3.8.2\\nfn injected() {}\""),
        "provenance: the text \"3.8.2\\nfn injected() {}\" has a character that cannot be printed"
    );
    for (from, to, place) in [
        ("\"position\"", "\"a\\rb\"", "symbol `x`"),
        ("\"N/m\"", "\"N\\u2028\"", "symbol `k`"),
        ("\"one row\"", "\"one\\u0000row\"", "graph `leg`"),
        ("\"solution\"", "\"\\u202e\"", "function `solved`"),
    ] {
        let error = refused(from, to);
        assert!(error.starts_with(&format!("{place}: the text")), "{error}");
    }
}

proptest! {
    #[test]
    fn damaged_files_never_panic(cuts in prop::collection::vec((0..SMALL.len(), 0..12_usize, "[\\[\\]{}\",:0-9a-z.e-]{0,6}"), 1..4)) {
        let mut text = SMALL.to_owned();
        for (at, length, insertion) in cuts {
            let at = at.min(text.len());
            text.replace_range(at..(at + length).min(text.len()), &insertion);
        }
        if let Ok(program) = Program::from_json(&text) {
            for function in &program.functions {
                program.flatten(function).evaluate(&program.sample).unwrap();
            }
        }
    }
}

#[test]
fn flattened_functions_equal_their_steps_bit_for_bit() {
    let program = common::program();
    let platform = common::platform();
    let parameters = common::parameters(&program, &platform);
    let mut states = dyn_gen::sampled_states(&program, &platform, &common::STATES, 3).unwrap();
    states.truncate(24);
    for function in &program.functions {
        let graph = program.flatten(function);
        for state in states.iter().chain([&program.sample]) {
            let mut environment: Environment = program.sample.clone();
            environment.extend(parameters.clone());
            environment.extend(state.clone());
            let steps = program.evaluate(function, &environment).unwrap();
            for (name, values) in graph.evaluate(&environment).unwrap() {
                let bits = |values: &[f64]| values.iter().map(|value| value.to_bits()).collect::<Vec<_>>();
                assert_eq!(bits(&values), bits(&steps[&name]), "{name} of {}", function.name);
            }
        }
    }
}

#[test]
fn the_committed_file_agrees_with_the_derivation_at_its_sample() {
    let (deviation, place) = common::program().check_samples().unwrap();
    assert!(deviation < 1e-13, "{deviation:e} in {place}");
}
