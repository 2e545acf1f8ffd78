//! Reads test vectors: a resolved platform, states and outputs by name (format: `tests/engines/README.md`).

use std::path::PathBuf;

use dyn_gen::graph::Environment;
use dyn_platform::Platform;
use serde_json::Value;

use crate::platforms::root;

/// A file of vectors.
#[derive(Debug)]
pub struct Vectors {
    /// The platform they are for.
    pub platform: Platform,
    /// State and expected outputs, flat and row-major.
    pub cases: Vec<(Environment, Environment)>,
}

/// The committed files.
pub fn files() -> Vec<PathBuf> {
    let folder = root().join("tests/vectors");
    let entries = std::fs::read_dir(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let mut files: Vec<PathBuf> = entries
        .map(|entry| entry.expect("a readable folder").path())
        .filter(|path| path.extension().is_some_and(|e| e == "json"))
        .collect();
    files.sort();
    files
}

/// Reads a file.
pub fn read(path: &PathBuf) -> Vectors {
    let text = std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let file: Value =
        serde_json::from_str(&text).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    assert_eq!(file["version"], 1, "{}: version", path.display());
    let cases = file["cases"].as_array().expect("cases").iter().map(case).collect();
    Vectors {
        platform: serde_json::from_value(file["platform"].clone()).expect("a resolved platform"),
        cases,
    }
}

fn case(case: &Value) -> (Environment, Environment) {
    let mut state = Environment::new();
    for body in ["base", "platform"] {
        for part in ["position", "rotation", "velocity", "acceleration"] {
            state.insert(format!("{body}_{part}"), flat(&case[body][part]));
        }
    }
    // The engines know no reference; at the platform's own velocity it makes no difference.
    state.insert("reference_velocity".into(), state["platform_velocity"].clone());
    for load in ["actuator_force", "external_wrench"] {
        state.insert(load.into(), flat(&case[load]));
    }
    let outputs = case["outputs"].as_object().expect("outputs");
    (state, outputs.iter().map(|(name, values)| (name.clone(), flat(values))).collect())
}

fn flat(value: &Value) -> Vec<f64> {
    match value {
        Value::Array(elements) => elements.iter().flat_map(flat).collect(),
        number => vec![number.as_f64().expect("a number")],
    }
}
