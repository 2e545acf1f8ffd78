//! Compiling C against the library that this test was built with, and test vectors as C reads them.

use std::ffi::OsStr;
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use dyn_platform::Platform;
use serde_json::Value;

/// Strict C99; a warning is an error.
const STRICT: [&str; 5] = ["-std=c99", "-Wall", "-Wextra", "-Werror", "-pedantic"];

/// How a program gets the library.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Link {
    /// `libdyn_capi.a`.
    Static,
    /// `libdyn_capi.so`.
    Dynamic,
}

/// The crate's folder.
pub fn folder() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Where cargo put the libraries: beside this test.
fn libraries() -> PathBuf {
    let test = std::env::current_exe().expect("a test knows where it is");
    test.parent().expect("a file lies in a folder").to_owned()
}

/// The C compiler with strict flags; `CC` chooses it.
pub fn compiler() -> Command {
    let mut command = Command::new(std::env::var_os("CC").unwrap_or_else(|| "cc".into()));
    command.args(STRICT).arg("-I").arg(folder().join("include"));
    // As the library was built.
    if cfg!(feature = "f32") {
        command.arg("-DDYN_F32");
    }
    command
}

/// Compiles a program and links it.
///
/// # Panics
/// With the compiler's messages.
pub fn compile(source: &Path, link: Link, scratch: &Path) -> PathBuf {
    compile_with(&[], source, link, scratch)
}

/// The same with more arguments for the compiler.
///
/// # Panics
/// With the compiler's messages.
pub fn compile_with(arguments: &[&OsStr], source: &Path, link: Link, scratch: &Path) -> PathBuf {
    let libraries = libraries();
    let name = source.file_stem().expect("a source has a name").to_string_lossy();
    let program = scratch.join(format!("{name}_{link:?}"));
    let mut command = compiler();
    command.args(arguments).arg(source).arg("-o").arg(&program);
    match link {
        Link::Static => {
            command.arg(libraries.join("libdyn_capi.a")).args(["-lpthread", "-ldl"]);
        }
        Link::Dynamic => {
            command.arg("-L").arg(&libraries).arg("-ldyn_capi");
            command.arg(format!("-Wl,-rpath,{}", libraries.display()));
        }
    }
    succeed(command.arg("-lm"));
    program
}

/// A compiled program that finds the library of this test first, whatever else cargo has put on the search path.
pub fn program(path: &Path) -> Command {
    let mut command = Command::new(path);
    command.env("LD_LIBRARY_PATH", libraries());
    command
}

/// Runs a program; its output goes to the test's.
///
/// # Panics
/// If it does not end with success.
pub fn succeed(command: &mut Command) -> Output {
    let output = command.output().unwrap_or_else(|error| panic!("{command:?}: {error}"));
    let text = String::from_utf8_lossy(&output.stdout);
    let errors = String::from_utf8_lossy(&output.stderr);
    println!("{text}{errors}");
    assert!(output.status.success(), "{command:?}: {}\n{text}{errors}", output.status);
    output
}

/// The committed vectors, as records for `tests/c/vectors.c`.
pub fn records() -> String {
    let vectors = folder().join("../tests/vectors");
    let entries = fs::read_dir(&vectors).unwrap_or_else(|error| panic!("{}: {error}", vectors.display()));
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.expect("a readable folder").path()).collect();
    files.sort();
    let mut records = String::new();
    for file in files {
        let text = fs::read_to_string(&file).unwrap_or_else(|error| panic!("{}: {error}", file.display()));
        let vectors: Value = serde_json::from_str(&text).expect("vectors are JSON");
        add(&mut records, &vectors);
    }
    records
}

fn add(records: &mut String, vectors: &Value) {
    let platform: Platform =
        serde_json::from_value(vectors["platform"].clone()).expect("a resolved platform");
    record(records, "platform", &platform.name, &[]);
    record(records, "leg_type", vectors["platform"]["leg_type"].as_str().expect("a leg type"), &[]);
    for name in platform.parameter_names() {
        record(records, "parameter", name, &platform.parameter(name).expect("a name from the list"));
    }
    let cases = vectors["cases"].as_array().expect("cases");
    for case in cases {
        for body in ["base", "platform"] {
            for part in ["position", "rotation", "velocity", "acceleration"] {
                record(records, "input", &format!("{body}_{part}"), &flat(&case[body][part]));
            }
        }
        for load in ["actuator_force", "external_wrench"] {
            record(records, "input", load, &flat(&case[load]));
        }
        record(records, "case", "-", &[]);
        for (name, expected) in case["outputs"].as_object().expect("outputs") {
            let expected = flat(expected);
            // A single energy may be zero by the choice of its datum: it is measured by the largest of all cases.
            let scale = if expected.len() == 1 { largest(cases, name) } else { 0.0 };
            if expected.len() <= 36 {
                record(records, "output", name, &[&[scale], expected.as_slice()].concat());
            }
        }
    }
}

fn largest(cases: &[Value], name: &str) -> f64 {
    cases.iter().flat_map(|case| flat(&case["outputs"][name])).fold(0.0, |most, x| x.abs().max(most))
}

fn record(records: &mut String, kind: &str, name: &str, numbers: &[f64]) {
    write!(records, "{kind} {name} {}", numbers.len()).expect("a string takes any text");
    for number in numbers {
        // Enough digits to come back as the same number.
        write!(records, " {number:e}").expect("a string takes any text");
    }
    records.push('\n');
}

fn flat(value: &Value) -> Vec<f64> {
    match value {
        Value::Array(elements) => elements.iter().flat_map(flat).collect(),
        number => vec![number.as_f64().expect("a number")],
    }
}
