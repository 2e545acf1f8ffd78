//! The committed graph file with the default platform, and states of it.
#![allow(dead_code, reason = "each test binary uses its part")]

pub mod random;
pub mod text;

use std::path::{Path, PathBuf};

use dyn_gen::graph::{Environment, Program};
use dyn_gen::sample::{Kind, Pose, Workspace, states};
use dyn_platform::Platform;

fn root() -> PathBuf {
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

/// States of every kind.
pub fn sampled_states(platform: &Platform, parameters: &Environment, seed: u64) -> Vec<Environment> {
    let alignment = |pose: &Pose| alignment(parameters, pose);
    let home = Pose { position: platform.home.position, rotation: platform.home.rotation };
    let workspace = Workspace { home, alignment: &alignment };
    [(Kind::Home, 1), (Kind::Random, 16), (Kind::Large, 48), (Kind::NearEdge, 32)]
        .into_iter()
        .flat_map(|(kind, count)| states(&workspace, kind, count, seed))
        .collect()
}
