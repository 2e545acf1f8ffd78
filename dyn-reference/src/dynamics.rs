//! The equation of motion, its inverse and its forward solution.
//!
//! ```text
//! M_p v_p' + bias = J_dp^T F + W_ext + M_b v_b'
//! bias  = C_p v_p - C_b v_b - sum J_p^T m g + J_dp^T (k_e (d - d_0) + c_e d')
//! W_ext = [F_D; M_D + (R_p r_c) x F_D]
//! ```
//!
//! This is (49) without its linearisation of the springs. Inverse and forward dynamics do not form `C_p` and
//! `C_b`: they sum every body's active and inertia forces on its partial velocities, so that [`equation_of_motion`],
//! with its matrices, is another way to the same numbers.

use nalgebra::{Matrix6, Vector6};

use crate::forces::{PassiveForces, passive_forces_of, total_generalised_force};
use crate::leg::{jacobian_dp_of, leg_geometries, leg_velocities};
use crate::legs::LegType;
use crate::matrices::{Matrices, StiffnessMatrices, mass_matrix_p_of, matrices_of, stiffness_matrices_of};
use crate::parameters::Parameters;
use crate::state::State;

/// `C_p v_p - C_b v_b` and the passive forces: all of the left side but `M_p v_p'`, N and N m.
///
/// Computed as minus the total generalised force with `v_p'`, `v_b'`, `F` and the external wrench put to
/// zero.
pub fn bias<L: LegType>(parameters: &Parameters<L>, state: &State) -> Vector6<f64> {
    let mut unforced = *state;
    unforced.base.acceleration = Vector6::zeros();
    unforced.platform.acceleration = Vector6::zeros();
    unforced.actuator_force_n = Vector6::zeros();
    unforced.external_wrench = Vector6::zeros();
    let geometries = leg_geometries(parameters, &unforced);
    -total_generalised_force(parameters, &unforced, &geometries)
}

/// What [`equation_of_motion`] returns: matrices 6x6, forces one per platform speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EquationOfMotion {
    /// `M_p`.
    pub mass_matrix_p: Matrix6<f64>,
    /// `C_p`.
    pub coriolis_matrix_p: Matrix6<f64>,
    /// `K_p = J_dp^T k_e J_dp`.
    pub stiffness_matrix_p: Matrix6<f64>,
    /// `J_dp`.
    pub jacobian_dp: Matrix6<f64>,
    /// `M_b`.
    pub mass_matrix_b: Matrix6<f64>,
    /// `C_b`.
    pub coriolis_matrix_b: Matrix6<f64>,
    /// `K_b = J_dp^T k_e J_db`.
    pub stiffness_matrix_b: Matrix6<f64>,
    /// `J_db`.
    pub jacobian_db: Matrix6<f64>,
    /// `-sum J_p^T m g`, N and N m.
    pub gravity_force: Vector6<f64>,
    /// `J_dp^T k_e (d - d_0)`, N and N m.
    pub spring_force: Vector6<f64>,
    /// `J_dp^T c_e d'`, N and N m.
    pub damping_force: Vector6<f64>,
    /// `C_p v_p - C_b v_b` and the three passive forces, N and N m, formed with the matrices.
    pub bias: Vector6<f64>,
}

/// Every term of the equation of motion (49), with the legs computed once.
pub fn equation_of_motion<L: LegType>(parameters: &Parameters<L>, state: &State) -> EquationOfMotion {
    let State { base, platform, .. } = state;
    let geometries = leg_geometries(parameters, state);
    let velocities = leg_velocities(parameters, state, &geometries);
    let Matrices {
        mass_matrix_p,
        coriolis_matrix_p,
        jacobian_dp,
        mass_matrix_b,
        coriolis_matrix_b,
        jacobian_db,
    } = matrices_of(parameters, base, platform, &geometries, &velocities);
    let StiffnessMatrices { stiffness_matrix_p, stiffness_matrix_b } =
        stiffness_matrices_of(parameters, &jacobian_dp, &jacobian_db);
    let PassiveForces { gravity_force, spring_force, damping_force } =
        passive_forces_of(parameters, platform, &geometries, &velocities);
    EquationOfMotion {
        mass_matrix_p,
        coriolis_matrix_p,
        stiffness_matrix_p,
        jacobian_dp,
        mass_matrix_b,
        coriolis_matrix_b,
        stiffness_matrix_b,
        jacobian_db,
        gravity_force,
        spring_force,
        damping_force,
        bias: coriolis_matrix_p * platform.velocity - coriolis_matrix_b * base.velocity
            + gravity_force
            + spring_force
            + damping_force,
    }
}

/// Actuator forces `F`, N, that give the state's platform acceleration under its base motion and external
/// wrench; `state.actuator_force_n` is not read.
///
/// `None` where `J_dp` is singular or a leg is out of reach.
pub fn inverse_dynamics<L: LegType>(parameters: &Parameters<L>, state: &State) -> Option<Vector6<f64>> {
    let mut unactuated = *state;
    unactuated.actuator_force_n = Vector6::zeros();
    let geometries = leg_geometries(parameters, state);
    let missing = -total_generalised_force(parameters, &unactuated, &geometries);
    let force = jacobian_dp_of(&geometries).transpose().lu().solve(&missing)?;
    force.iter().all(|component| component.is_finite()).then_some(force)
}

/// Platform acceleration `v_p'`, m/s^2 and rad/s^2, in O, under the state's actuator forces, external wrench
/// and base motion; `state.platform.acceleration` is not read.
///
/// `None` where `M_p` is not positive definite, as with a leg out of reach.
pub fn forward_dynamics<L: LegType>(parameters: &Parameters<L>, state: &State) -> Option<Vector6<f64>> {
    let mut unaccelerated = *state;
    unaccelerated.platform.acceleration = Vector6::zeros();
    let geometries = leg_geometries(parameters, state);
    let force = total_generalised_force(parameters, &unaccelerated, &geometries);
    let mass = mass_matrix_p_of(parameters, &state.platform, &geometries);
    Some(mass.cholesky()?.solve(&force))
}
