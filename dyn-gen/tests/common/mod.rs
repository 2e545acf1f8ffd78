//! The committed graph file, the default platform and the test platforms, and their reach by formula.
#![allow(dead_code, reason = "each test binary uses its part")]

pub mod cli;
pub mod platforms;
pub mod random;
pub mod text;

use std::path::{Path, PathBuf};

use dyn_gen::graph::{Environment, Graph, Program};
use dyn_gen::passes::{Context, PASSES, Pass};
use dyn_gen::sample::{Kind, Pose};
use dyn_platform::{LegType, Platform};

/// The root of the workspace.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("the package lies in the workspace").to_owned()
}

pub fn program() -> Program {
    let text =
        std::fs::read_to_string(root().join("codegen/graphs/uhp.json")).expect("the graph file is committed");
    Program::from_json(&text).unwrap()
}

pub fn platform() -> Platform {
    Platform::from_file(root().join("platforms/uhp_2016.toml")).unwrap()
}

/// The default platform and all test platforms with its leg type.
pub fn platforms() -> Vec<Platform> {
    let folder = std::fs::read_dir(root().join("tests/platforms")).expect("the test platforms");
    let mut files: Vec<PathBuf> = folder.map(|entry| entry.unwrap().path()).collect();
    files.sort();
    let all = files.into_iter().map(|file| Platform::from_file(file).unwrap());
    let others: Vec<_> = all.filter(|other| other.leg_type == LegType::Uhp).collect();
    assert_eq!(others.len(), 8);
    std::iter::once(platform()).chain(others).collect()
}

/// All parameters of `platform` that `program` knows.
pub fn parameters(program: &Program, platform: &Platform) -> Environment {
    let value = |name: &str| platform.parameter(name).unwrap_or_else(|| panic!("the platform has `{name}`"));
    program.parameters().map(|symbol| (symbol.name.clone(), value(&symbol.name))).collect()
}

/// (u.a)^2 = 1 - n.n / s^2 of the worst leg, n the part of x = r + R p - b across the axis a.
pub fn alignment(parameters: &Environment, pose: &Pose) -> f64 {
    let vector =
        |name: &str, leg: usize| -> [f64; 3] { std::array::from_fn(|k| parameters[name][3 * leg + k]) };
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let leg_alignment = |leg| {
        let (a, b, p) =
            (vector("actuator_axis", leg), vector("base_point", leg), vector("platform_point", leg));
        let x: [f64; 3] = std::array::from_fn(|k| pose.position[k] + dot(pose.rotation[k], p) - b[k]);
        let n: [f64; 3] = std::array::from_fn(|k| x[k] - dot(a, x) * a[k]);
        1.0 - dot(n, n) / parameters["rod_length"][leg].powi(2)
    };
    (0..6).map(leg_alignment).fold(f64::INFINITY, f64::min)
}

/// Some states of every kind.
pub const STATES: [(Kind, usize); 4] =
    [(Kind::Home, 1), (Kind::Random, 16), (Kind::Large, 48), (Kind::NearEdge, 32)];

/// The pass of this name.
pub fn pass(name: &str) -> &'static Pass {
    PASSES.iter().find(|pass| pass.name == name).expect("a pass of the table")
}

/// The graph after one pass.
pub fn run(pass: &Pass, graph: &Graph, context: &Context) -> Graph {
    (pass.run)(graph, context, &mut Vec::new())
}
