//! What controllers need besides the equation of motion: forces at reference speeds, the bias on an accelerating
//! base, the wrench of the base.

use nalgebra::{Matrix3, Vector3, Vector6};

use crate::bodies::body_kinematics;
use crate::dynamics::bias;
use crate::leg::{jacobian_dp, leg_geometries};
use crate::legs::LegType;
use crate::matrices::{coriolis_matrices, mass_matrix_b, mass_matrix_p, payload_inertia};
use crate::parameters::Parameters;
use crate::state::{State, angular, linear, stack};

/// `bias - M_b v_b'`, N and N m: all of (49) but `M_p v_p'`, `J_dp^T F` and `W_ext`.
pub fn total_bias<L: LegType>(parameters: &Parameters<L>, state: &State) -> Vector6<f64> {
    bias(parameters, state) - mass_matrix_b(parameters, state) * state.base.acceleration
}

/// Actuator forces `F`, N, at the reference velocity `v_r` and, as the platform's acceleration, `a_r`:
/// `J_dp^T F = M_p a_r + C_p v_r - C_b v_b - M_b v_b' + passive forces - W_ext`, formed with the matrices.
///
/// `None` where `J_dp` is singular or a leg is out of reach.
pub fn passive_inverse_dynamics<L: LegType>(
    parameters: &Parameters<L>,
    state: &State,
) -> Option<Vector6<f64>> {
    let arm = state.platform.rotation * parameters.payload.com_m;
    let force = linear(&state.external_wrench);
    let external = stack(&force, &(angular(&state.external_wrench) + arm.cross(&force)));
    let error = state.reference_velocity - state.platform.velocity;
    let right = mass_matrix_p(parameters, state) * state.platform.acceleration
        + total_bias(parameters, state)
        + coriolis_matrices(parameters, state).coriolis_matrix_p * error
        - external;
    let force = jacobian_dp(parameters, state).transpose().lu().solve(&right)?;
    force.iter().all(|component| component.is_finite()).then_some(force)
}

/// Wrench of the base on payload and both bodies of every leg, N and N m, in O, moments about `r_b`: the rate of
/// momentum of every body less its weight, less the external wrench.
pub fn base_wrench<L: LegType>(parameters: &Parameters<L>, state: &State) -> Vector6<f64> {
    let bodies = body_kinematics(parameters, state);
    let geometries = leg_geometries(parameters, state);
    let State { base, platform, .. } = state;
    let mut total = Vector6::zeros();
    let mut add = |force: Vector3<f64>, position: Vector3<f64>, moment: Vector3<f64>| {
        total += stack(&force, &((position - base.position_m).cross(&force) + moment));
    };
    let inertia = payload_inertia(parameters, platform);
    let w = platform.angular_velocity();
    let weightless = |mass: f64, acceleration: Vector3<f64>| mass * (acceleration - parameters.gravity_m_s2);
    add(
        weightless(parameters.payload.mass_kg, bodies.payload_com_acceleration)
            - linear(&state.external_wrench),
        bodies.payload_com_position,
        inertia * platform.angular_acceleration() + w.cross(&(inertia * w)) - angular(&state.external_wrench),
    );
    for (i, leg) in parameters.legs.iter().enumerate() {
        let (masses, inertias) = (leg.masses(), leg.inertias());
        let u = geometries[i].direction;
        let w = bodies.leg_angular_velocity[i];
        for body in 0..2 {
            let inertia = inertias[body] * (Matrix3::identity() - u * u.transpose());
            add(
                weightless(masses[body], bodies.com_acceleration[i][body]),
                bodies.com_position[i][body],
                inertia * bodies.leg_angular_acceleration[i] + w.cross(&(inertia * w)),
            );
        }
    }
    total
}
