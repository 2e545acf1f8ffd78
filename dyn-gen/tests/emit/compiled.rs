//! Emitted files compiled by rustc and run.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

use dyn_gen::graph::{Evaluator, Graph, Symbol};
use serde_json::Value;

/// The runtime crate as generated code sees it from inside, but for the kernel traits, which a test makes for itself.
const RUNTIME: &str =
    "pub use dyn_runtime::{Limits, Real, current, float, lanes, parameter, single_state, solve, triple};";

/// The compiled runtime crate.
fn runtime() -> &'static Path {
    static LIBRARY: OnceLock<PathBuf> = OnceLock::new();
    LIBRARY.get_or_init(|| {
        let built = Command::new(env!("CARGO"))
            .args(["build", "--quiet", "--package", "dyn-runtime", "--message-format", "json"])
            .current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
            .output()
            .expect("cargo runs");
        assert!(built.status.success(), "{}", String::from_utf8_lossy(&built.stderr));
        let messages = String::from_utf8(built.stdout).expect("JSON");
        let mut files = messages.lines().filter_map(|line| {
            let message: Value = serde_json::from_str(line).ok()?;
            let is_runtime = message["target"]["name"] == "dyn_runtime";
            is_runtime.then(|| message["filenames"][0].as_str().map(PathBuf::from))?
        });
        files.next().expect("a library")
    })
}

/// Runs every function of `file` through its kernel trait on every case and returns the outputs' elements in order.
/// `cases[k]` holds one flat array per input of `graphs[k]`, parameters included.
pub fn run(
    file: &str,
    graphs: &[Graph],
    cases: &[Vec<Vec<Vec<f64>>>],
    options: &[&str],
) -> Vec<Vec<Vec<f64>>> {
    let signatures: Vec<_> = graphs.iter().map(dyn_gen::emit::Signature::of).collect();
    let header = dyn_gen::emit::Header {
        title: "Traits made for a test.".into(),
        command: "cargo test".into(),
        graphs: vec![dyn_gen::emit::Source { name: "test.json".into(), sha256: "00".into() }],
        platform: None,
        casadi: "0.0.0".into(),
        operations: Vec::new(),
        eliminations: Vec::new(),
        evidence: Vec::new(),
    };
    let kernels = dyn_gen::emit::kernels_file(&header, &signatures).expect("printable traits");
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = |name: &str| folder.path().join(name);
    std::fs::write(path("kernels.rs"), kernels).unwrap();
    std::fs::write(path("model.rs"), file).unwrap();
    let mut main = format!(
        "#![deny(warnings, missing_docs, unused_qualifications)]\n#![allow(dead_code)]\n//! Test.\n\
         /// Traits.\n pub mod kernels;\n/// Model.\npub mod model;\n{RUNTIME}\nfn main() {{\n"
    );
    for (graph, cases) in graphs.iter().zip(cases) {
        for case in cases {
            main.push_str(&call(graph, case));
        }
    }
    main.push_str("}\n");
    std::fs::write(path("main.rs"), main).unwrap();
    let library = runtime();
    let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let compiled = Command::new(rustc)
        .args(["--edition=2024", "main.rs", "-o", "program", "--extern"])
        .arg(format!("dyn_runtime={}", library.display()))
        .arg(format!("-Ldependency={}", library.with_file_name("deps").display()))
        .args(options)
        .current_dir(folder.path())
        .output()
        .expect("rustc runs");
    assert!(
        compiled.status.success(),
        "rustc: {}\n{}",
        compiled.status,
        String::from_utf8_lossy(&compiled.stderr)
    );
    let output = Command::new(path("program")).output().expect("the program runs");
    assert!(output.status.success());
    let text = String::from_utf8(output.stdout).unwrap();
    let mut lines = text.lines().map(|line| {
        line.split_whitespace().map(|bits| f64::from_bits(u64::from_str_radix(bits, 16).unwrap())).collect()
    });
    cases.iter().map(|cases| lines.by_ref().take(cases.len()).collect()).collect()
}

/// The same by the interpreter.
pub fn interpret(graphs: &[Graph], cases: &[Vec<Vec<Vec<f64>>>]) -> Vec<Vec<Vec<f64>>> {
    let evaluate = |graph: &Graph, case: &Vec<Vec<f64>>| {
        let mut evaluator = Evaluator::new();
        let inputs: Vec<&[f64]> = case.iter().map(Vec::as_slice).collect();
        let values = evaluator.run(graph, &inputs);
        graph.outputs.iter().flat_map(|output| &output.nodes).map(|id| values[id.index()]).collect()
    };
    graphs
        .iter()
        .zip(cases)
        .map(|(graph, cases)| cases.iter().map(|case| evaluate(graph, case)).collect())
        .collect()
}

/// Fails unless all numbers agree bit for bit; any NaN equals any other.
pub fn assert_same_bits(graphs: &[Graph], compiled: &[Vec<Vec<f64>>], interpreted: &[Vec<Vec<f64>>]) {
    for ((graph, compiled), interpreted) in graphs.iter().zip(compiled).zip(interpreted) {
        assert_eq!(compiled.len(), interpreted.len(), "{}", graph.name);
        for (compiled, interpreted) in compiled.iter().zip(interpreted) {
            assert_eq!(compiled.len(), interpreted.len(), "{}", graph.name);
            for (element, (&a, &b)) in compiled.iter().zip(interpreted).enumerate() {
                let same = a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan());
                assert!(same, "{}, element {element}: compiled {a:e}, interpreted {b:e}", graph.name);
            }
        }
    }
}

/// Source that calls one function through its trait and prints the bits of its outputs.
fn call(graph: &Graph, case: &[Vec<f64>]) -> String {
    let mut text = String::from("    {\n");
    let mut arguments = Vec::new();
    let mut parameters = String::new();
    for (symbol, values) in graph.inputs.iter().zip(case) {
        if symbol.parameter {
            let _ = write!(parameters, "{:?} => &{},", symbol.name, flat(values));
            continue;
        }
        let borrow = if symbol.shape.is_empty() { "" } else { "&" };
        let mut elements = values.iter();
        arguments.push(format!("{borrow}std::hint::black_box({})", nested(&symbol.shape, &mut elements)));
    }
    let mut prints = String::new();
    for (index, output) in graph.outputs.iter().enumerate() {
        let zeros = vec![0.0; output.symbol.len()];
        let _ =
            writeln!(text, "        let mut o{index} = {};", nested(&output.symbol.shape, &mut zeros.iter()));
        arguments.push(format!("&mut o{index}"));
        for indices in indices(&output.symbol) {
            let _ = writeln!(prints, "        print!(\"{{:x}} \", o{index}{indices}.to_bits());");
        }
    }
    let model = if parameters.is_empty() {
        "model::TestModel".to_string()
    } else {
        let fill = format!(
            "|name, slots| {{ let values: &[f64] = match name {{ {parameters} _ => return }}; slots.copy_from_slice(values) }}"
        );
        format!("model::TestModel {{ parameters: model::Parameters::from_fn({fill}) }}")
    };
    let kernel = dyn_gen::emit::type_name(&graph.name);
    let _ = writeln!(
        text,
        "        kernels::{kernel}::{}(&{model}, {});\n{prints}        println!();\n    }}",
        graph.name,
        arguments.join(", ")
    );
    text
}

fn number(value: f64) -> String {
    format!("f64::from_bits({:#x})", value.to_bits())
}

fn flat(values: &[f64]) -> String {
    format!("[{}]", values.iter().map(|&value| number(value)).collect::<Vec<_>>().join(", "))
}

fn nested(shape: &[usize], values: &mut std::slice::Iter<f64>) -> String {
    match shape {
        [] => number(*values.next().unwrap()),
        [length, inner @ ..] => {
            format!("[{}]", (0..*length).map(|_| nested(inner, values)).collect::<Vec<_>>().join(", "))
        }
    }
}

fn indices(symbol: &Symbol) -> Vec<String> {
    symbol.shape.iter().fold(vec![String::new()], |prefixes, &length| {
        prefixes
            .iter()
            .flat_map(|prefix| (0..length).map(move |index| format!("{prefix}[{index}]")))
            .collect()
    })
}
