//! The default platform and the test platforms, and states of them.

use std::path::{Path, PathBuf};

use dyn_gen::graph::Environment;
use dyn_gen::sample::Kind;
use dyn_gen::{GraphFile, sampled_states};
use dyn_platform::{LegType, Platform};

/// Seed of all sampled states.
pub const SEED: u64 = 2016;

/// Every kind of state.
pub const KINDS: [Kind; 4] = [Kind::Home, Kind::Random, Kind::Large, Kind::NearEdge];

/// Names of the test platforms, files in `tests/platforms`.
pub const TEST_PLATFORMS: [&str; 10] = [
    "tilted_axes",
    "unequal_legs",
    "full_inertia",
    "no_gravity",
    "no_springs",
    "tilted_gravity_damped",
    "long_thin",
    "everything",
    "ups_regular",
    "ups_everything",
];

/// The workspace's root folder.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// A test platform by name, or the default one, `uhp_2016`.
pub fn platform(name: &str) -> Platform {
    let folder = if name == "uhp_2016" { root().join("platforms") } else { root().join("tests/platforms") };
    Platform::from_file(folder.join(format!("{name}.toml"))).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// The default platform and all test platforms.
pub fn all() -> Vec<Platform> {
    std::iter::once("uhp_2016").chain(TEST_PLATFORMS).map(platform).collect()
}

/// The graph file of a leg type, as it is committed.
pub fn graph_file(leg_type: LegType) -> GraphFile {
    GraphFile::of(leg_type).expect("committed graph files are checked by their own tests")
}

/// `count` states of each kind, seeded.
pub fn states(file: &GraphFile, platform: &Platform, count: usize) -> Vec<(Kind, Environment)> {
    KINDS
        .iter()
        .flat_map(|&kind| {
            let states = sampled_states(&file.program, platform, &[(kind, count)], SEED);
            states.expect("the graph knows the platform").into_iter().map(move |state| (kind, state))
        })
        .collect()
}

/// Flat arrays of a platform's parameters by name.
pub fn parameters(platform: &Platform) -> Environment {
    platform
        .parameter_names()
        .map(|name| (name.to_owned(), platform.parameter(name).expect("a name from the list")))
        .collect()
}
