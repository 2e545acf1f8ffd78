//! What several tests need.

#![allow(dead_code, reason = "each test uses its part")]

use std::path::{Path, PathBuf};

use dyn_runtime::{BaseMotion, PlatformState};
use dyn_sim::motion::{BodyMotion, Motion};
use dyn_sim::outcome::Series;
use dyn_sim::scenario::{Scenario, Steering};
use dyn_sim::simulate::Grid;

/// Folder of the committed scenarios.
pub fn scenarios() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenarios")
}

/// A committed scenario.
pub fn scenario(name: &str) -> Scenario {
    Scenario::from_file(scenarios().join(format!("{name}.toml"))).expect("a committed scenario is valid")
}

/// Its target.
pub fn target(scenario: &Scenario) -> &Motion {
    match &scenario.steering {
        Steering::Target(motion) => motion,
        Steering::Free(..) => panic!("{} has no target", scenario.name),
    }
}

/// Motion at whole steps.
pub fn series(grid: Grid, motion: &Motion) -> Series {
    let mut series = Series::empty("target");
    for k in 0..=grid.steps {
        series.push(grid.time(k), &motion.at(grid.time(k)));
    }
    series
}

/// Distance of two states: the largest of position (m), rotation (rad) and velocity (m/s, rad/s).
pub fn distance(one: &PlatformState, other: &PlatformState) -> f64 {
    let position = (one.pose.position_m - other.pose.position_m).amax();
    let rotation = (one.pose.rotation.matrix() - other.pose.rotation.matrix()).amax();
    position.max(rotation).max((one.velocity.to_vector() - other.velocity.to_vector()).amax())
}

/// The base's motion of samples.
pub fn bases(samples: &[BodyMotion]) -> Vec<BaseMotion> {
    samples.iter().map(BodyMotion::as_base).collect()
}
