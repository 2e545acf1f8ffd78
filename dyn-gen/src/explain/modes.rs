//! Natural frequencies at home: small motions under constant actuator forces, springs with their preload included.

use nalgebra::{Matrix3, Matrix6, Vector3};
use serde::Serialize;

use super::Home;
use crate::error::GenerateError;
use crate::evidence::moving;
use crate::graph::{Batch, Environment, LaneEvaluator};

/// A small motion about home that keeps its shape.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Mode {
    /// Of its square: negative where the motion grows instead of swinging, rad^2/s^2.
    pub angular_frequency_squared: f64,
    /// 0 where the platform does not swing but drift or fall, Hz.
    pub frequency_hz: f64,
    /// [displacement; rotation] of the platform, m and rad, largest component 1.
    pub shape: [f64; 6],
}

/// Eigenvalues of M_p^-1 K, slowest first, with K the tangent stiffness: how the forces that the actuators and springs and
/// gravity leave over change with the pose, the actuators holding the forces that balance home.
pub(super) fn modes(home: &Home, holding_force: &[f64]) -> Result<Vec<Mode>, GenerateError> {
    let stiffness = tangent_stiffness(home, holding_force)?;
    let mass = Matrix6::from_row_slice(&home.output("mass_matrix_p", None)?);
    // With M_p = L L^T: L^-1 K L^-T has the same eigenvalues and is symmetric.
    let Some(factor) = mass.cholesky().map(|factor| factor.l()) else { return Ok(Vec::new()) };
    let Some(inverse) = factor.try_inverse() else { return Ok(Vec::new()) };
    let symmetric = inverse * stiffness * inverse.transpose();
    let eigen = (0.5 * (symmetric + symmetric.transpose())).symmetric_eigen();
    let mut modes: Vec<Mode> = (0..6)
        .map(|k| {
            let squared = eigen.eigenvalues[k];
            let shape = inverse.transpose() * eigen.eigenvectors.column(k);
            let largest = shape[shape.iamax()];
            Mode {
                angular_frequency_squared: squared,
                frequency_hz: squared.max(0.0).sqrt() / (2.0 * std::f64::consts::PI),
                shape: std::array::from_fn(|i| shape[i] / largest),
            }
        })
        .collect();
    modes.sort_by(|one, other| one.angular_frequency_squared.total_cmp(&other.angular_frequency_squared));
    Ok(modes)
}

/// d/dx (G + J_dp^T (k_e (d - d0) - F)) with F constant, x = [displacement; rotation vector] in O. Exact: the graphs are
/// differentiated.
fn tangent_stiffness(home: &Home, holding_force: &[f64]) -> Result<Matrix6<f64>, GenerateError> {
    // One direction per lane.
    let state = Batch::new(&[&home.environment]);
    let directions: Vec<Environment> = (0..6).map(|k| direction(home, k)).collect();
    let rates = Batch::new(&directions.iter().collect::<Vec<_>>());
    let mut evaluator = LaneEvaluator::default();
    let mut rate = |name: &str| {
        let graph = home.graph(name)?;
        let outputs = moving(&graph, &state, &rates, &mut evaluator)?;
        let position = graph.outputs.iter().position(|output| output.symbol.name == name).unwrap_or(0);
        Ok::<_, GenerateError>(outputs[position].clone())
    };
    let (gravity, spring, jacobian) = (rate("gravity_force")?, rate("spring_force")?, rate("jacobian_dp")?);
    Ok(Matrix6::from_fn(|row, column| {
        let driven: f64 = (0..6).map(|leg| jacobian[6 * leg + row].rate[column] * holding_force[leg]).sum();
        gravity[row].rate[column] + spring[row].rate[column] - driven
    }))
}

/// The platform's pose moving by the unit vector `k` of [displacement; rotation].
fn direction(home: &Home, k: usize) -> Environment {
    let unit: Vec<f64> = (0..6).map(|i| f64::from(u8::from(i == k))).collect();
    let rotation = home.environment.get("platform_rotation").map_or(&[][..], Vec::as_slice);
    let turned = Vector3::new(unit[3], unit[4], unit[5]).cross_matrix() * Matrix3::from_row_slice(rotation);
    [
        ("platform_position".to_owned(), unit[..3].to_vec()),
        ("platform_rotation".to_owned(), turned.transpose().as_slice().to_vec()),
    ]
    .into()
}
