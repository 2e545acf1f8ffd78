//! How well the six legs hold every wrench, over the workspace.

use dyn_platform::Platform;
use nalgebra::{Matrix3, Vector3};
use serde::Serialize;

use crate::error::GenerateError;
use crate::evidence::{Case, Sampling};
use crate::graph::{Environment, Program};
use crate::sample::Pose;
use crate::workspace::{jacobian_condition, parameters};

/// Condition number of J_dp (Frobenius norm; 6 is the least), moments over the radius of the platform joints.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Conditioning {
    /// At home.
    pub home: f64,
    /// Half of the sampled poses are better.
    pub median: f64,
    /// The worst sampled pose. Poses beyond 1000 are not sampled.
    pub worst: f64,
    /// Where that is.
    pub worst_pose: RelativePose,
    /// The poses.
    #[serde(flatten)]
    pub sampling: Sampling,
}

/// A pose of the platform relative to the base.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub struct RelativePose {
    /// m, B
    pub position: [f64; 3],
    /// Rotation vector from the home rotation, rad, B.
    pub rotation_from_home: [f64; 3],
}

pub(super) fn conditioning(
    program: &Program,
    platform: &Platform,
    cases: &[Case],
    sampling: Sampling,
) -> Result<Conditioning, GenerateError> {
    let condition = jacobian_condition(program, platform, &parameters(program, platform)?)?;
    let home = Pose { position: platform.home.position, rotation: platform.home.rotation };
    let poses = cases.iter().map(|case| relative(&case.environment));
    let mut sampled: Vec<(f64, Pose)> = poses.map(|pose| (condition(&pose), pose)).collect();
    if sampled.is_empty() {
        sampled.push((condition(&home), home));
    }
    sampled.sort_by(|(one, _), (other, _)| one.total_cmp(other));
    let (worst, pose) = sampled[sampled.len() - 1];
    let matrix = |rows: [[f64; 3]; 3]| Matrix3::from_fn(|i, j| rows[i][j]);
    let turn = matrix(pose.rotation) * matrix(home.rotation).transpose();
    let rotation = nalgebra::Rotation3::from_matrix_unchecked(turn).scaled_axis();
    Ok(Conditioning {
        home: condition(&home),
        median: sampled[sampled.len() / 2].0,
        worst,
        worst_pose: RelativePose { position: pose.position, rotation_from_home: rotation.into() },
        sampling,
    })
}

/// R_b^T (r_p - r_b) and R_b^T R_p.
fn relative(state: &Environment) -> Pose {
    let part = |name: &str| state.get(name).map_or(&[][..], Vec::as_slice);
    let matrix = |name: &str| Matrix3::from_row_slice(part(name));
    let vector = |name: &str| Vector3::from_row_slice(part(name));
    let base = matrix("base_rotation").transpose();
    let rotation = base * matrix("platform_rotation");
    Pose {
        position: (base * (vector("platform_position") - vector("base_position"))).into(),
        rotation: std::array::from_fn(|i| std::array::from_fn(|j| rotation[(i, j)])),
    }
}
