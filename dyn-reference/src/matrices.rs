//! Matrices of the equation of motion (49): sums over payload and legs' bodies, in O coordinates.
//!
//! ```text
//! M_p =  sum (J_p^T m J_p  + J_wp^T I J_wp)
//! M_b = -sum (J_p^T m J_b  + J_wp^T I J_wb)
//! C_p =  sum (J_p^T m J_p' + J_wp^T (I J_wp' + [w]x I J_wp))
//! C_b = -sum (J_p^T m J_b' + J_wp^T (I J_wb' + [w]x I J_wb))
//! ```
//!
//! The dot is the derivative seen from O, every body counts at its own centre of mass, `M_p' - 2 C_p` is
//! skew. The payload does not depend on `v_b` and is absent from `M_b` and `C_b`. What turns in a leg turns with one
//! `w_s`, so that the moments of inertia of its bodies add up.

use nalgebra::{Matrix3, Matrix6, Vector3};

use crate::leg::{LegGeometry, LegVelocity, jacobian_db_of, jacobian_dp_of, leg_geometries, leg_velocities};
use crate::legs::{LegType, transverse_inertia};
use crate::parameters::Parameters;
use crate::partial_velocities::{LegPartials, PayloadPartials};
use crate::state::{RigidBodyMotion, State};

/// `R_p I_c R_p^T`: the payload's inertia about its centre of mass, kg m^2, in O.
pub(crate) fn payload_inertia<L: LegType>(
    parameters: &Parameters<L>,
    platform: &RigidBodyMotion,
) -> Matrix3<f64> {
    platform.rotation * parameters.payload.inertia_kg_m2 * platform.rotation.transpose()
}

/// `J^T m K + J_w^T I K_w` over one leg's bodies.
fn leg_mass<L: LegType>(leg: &L, geometry: &LegGeometry, j: &LegPartials, k: &LegPartials) -> Matrix6<f64> {
    let [first, second] = leg.masses();
    let inertia = transverse_inertia(leg.turning_inertia(), geometry);
    first * j.com[0].tr_mul(&k.com[0])
        + j.angular.tr_mul(&(inertia * k.angular))
        + second * j.com[1].tr_mul(&k.com[1])
}

/// `J^T m K' + J_w^T (I K_w' + [w]x I K_w)` over one leg's bodies.
fn leg_coriolis<L: LegType>(
    leg: &L,
    geometry: &LegGeometry,
    w_s: &Vector3<f64>,
    j: &LegPartials,
    k: &LegPartials,
    k_rate: &LegPartials,
) -> Matrix6<f64> {
    let inertia = transverse_inertia(leg.turning_inertia(), geometry);
    let gyroscopic = w_s.cross_matrix() * inertia * k.angular;
    leg_mass(leg, geometry, j, k_rate) + j.angular.tr_mul(&gyroscopic)
}

fn payload_mass<L: LegType>(
    parameters: &Parameters<L>,
    platform: &RigidBodyMotion,
    j: &PayloadPartials,
) -> Matrix6<f64> {
    let inertia = payload_inertia(parameters, platform);
    parameters.payload.mass_kg * j.velocity.tr_mul(&j.velocity)
        + j.angular_velocity.tr_mul(&(inertia * j.angular_velocity))
}

fn payload_coriolis<L: LegType>(
    parameters: &Parameters<L>,
    platform: &RigidBodyMotion,
    j: &PayloadPartials,
) -> Matrix6<f64> {
    let inertia = payload_inertia(parameters, platform);
    let rate = PayloadPartials::rates(parameters, platform);
    let angular = inertia * rate.angular_velocity
        + platform.angular_velocity().cross_matrix() * inertia * j.angular_velocity;
    parameters.payload.mass_kg * j.velocity.tr_mul(&rate.velocity) + j.angular_velocity.tr_mul(&angular)
}

/// `M_p`, 6x6, symmetric positive definite; blocks in kg, kg m, kg m^2 (49).
pub fn mass_matrix_p<L: LegType>(parameters: &Parameters<L>, state: &State) -> Matrix6<f64> {
    mass_matrix_p_of(parameters, &state.platform, &leg_geometries(parameters, state))
}

pub(crate) fn mass_matrix_p_of<L: LegType>(
    parameters: &Parameters<L>,
    platform: &RigidBodyMotion,
    geometries: &[LegGeometry; 6],
) -> Matrix6<f64> {
    let mut mass = payload_mass(parameters, platform, &PayloadPartials::new(parameters, platform));
    for (leg, geometry) in parameters.legs.iter().zip(geometries) {
        let j = leg.partials_by_platform(geometry);
        mass += leg_mass(leg, geometry, &j, &j);
    }
    mass
}

/// `M_b`, 6x6: `M_b v_b'` stands on the right side of the equation of motion (49).
pub fn mass_matrix_b<L: LegType>(parameters: &Parameters<L>, state: &State) -> Matrix6<f64> {
    let mut mass = Matrix6::zeros();
    for (leg, geometry) in parameters.legs.iter().zip(&leg_geometries(parameters, state)) {
        let by_platform = leg.partials_by_platform(geometry);
        mass -= leg_mass(leg, geometry, &by_platform, &leg.partials_by_base(geometry));
    }
    mass
}

/// What [`coriolis_matrices`] returns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoriolisMatrices {
    /// `C_p`: `C_p v_p` stands on the left side (49).
    pub coriolis_matrix_p: Matrix6<f64>,
    /// `C_b`: `C_b v_b` stands on the right side (49).
    pub coriolis_matrix_b: Matrix6<f64>,
}

/// `C_p` and `C_b`, 6x6, in the natural factorisation given at the head of this module.
pub fn coriolis_matrices<L: LegType>(parameters: &Parameters<L>, state: &State) -> CoriolisMatrices {
    let State { base, platform, .. } = state;
    let payload = PayloadPartials::new(parameters, platform);
    let mut coriolis_matrix_p = payload_coriolis(parameters, platform, &payload);
    let mut coriolis_matrix_b = Matrix6::zeros();
    for leg in &parameters.legs {
        let geometry = leg.geometry(base, platform);
        let velocity = leg.velocity(&geometry, base, platform);
        let j = leg.partials_by_platform(&geometry);
        let k = leg.partials_by_base(&geometry);
        let j_rate = leg.partial_rates_by_platform(&j, &geometry, &velocity, platform);
        let k_rate = leg.partial_rates_by_base(&k, &geometry, &velocity, base);
        coriolis_matrix_p += leg_coriolis(leg, &geometry, &velocity.rod_angular, &j, &j, &j_rate);
        coriolis_matrix_b -= leg_coriolis(leg, &geometry, &velocity.rod_angular, &j, &k, &k_rate);
    }
    CoriolisMatrices { coriolis_matrix_p, coriolis_matrix_b }
}

/// What [`stiffness_matrices`] returns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StiffnessMatrices {
    /// `K_p = J_dp^T k_e J_dp`.
    pub stiffness_matrix_p: Matrix6<f64>,
    /// `K_b = J_dp^T k_e J_db`.
    pub stiffness_matrix_b: Matrix6<f64>,
}

/// The springs' linearised stiffness for small twists of platform and base, 6x6. The paper writes one `K` for
/// both (49). The preload's share `(dJ_dp^T/dq) k_e (d - d_0)` is not in it.
pub fn stiffness_matrices<L: LegType>(parameters: &Parameters<L>, state: &State) -> StiffnessMatrices {
    let geometries = leg_geometries(parameters, state);
    stiffness_matrices_of(parameters, &jacobian_dp_of(&geometries), &jacobian_db_of(&geometries))
}

pub(crate) fn stiffness_matrices_of<L: LegType>(
    parameters: &Parameters<L>,
    jacobian_dp: &Matrix6<f64>,
    jacobian_db: &Matrix6<f64>,
) -> StiffnessMatrices {
    let mut transposed = jacobian_dp.transpose();
    for i in 0..6 {
        transposed.column_mut(i).scale_mut(parameters.legs[i].axial_element().stiffness_n_m);
    }
    StiffnessMatrices {
        stiffness_matrix_p: transposed * jacobian_dp,
        stiffness_matrix_b: transposed * jacobian_db,
    }
}

/// What [`matrices`] returns, each 6x6.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Matrices {
    /// `M_p` (49).
    pub mass_matrix_p: Matrix6<f64>,
    /// `C_p` (49).
    pub coriolis_matrix_p: Matrix6<f64>,
    /// `J_dp` (32).
    pub jacobian_dp: Matrix6<f64>,
    /// `M_b` (49).
    pub mass_matrix_b: Matrix6<f64>,
    /// `C_b` (49).
    pub coriolis_matrix_b: Matrix6<f64>,
    /// `J_db` (31).
    pub jacobian_db: Matrix6<f64>,
}

/// Mass, Coriolis and Jacobian matrices at once, with the legs computed once.
pub fn matrices<L: LegType>(parameters: &Parameters<L>, state: &State) -> Matrices {
    let State { base, platform, .. } = state;
    let geometries = leg_geometries(parameters, state);
    let velocities = leg_velocities(parameters, state, &geometries);
    matrices_of(parameters, base, platform, &geometries, &velocities)
}

pub(crate) fn matrices_of<L: LegType>(
    parameters: &Parameters<L>,
    base: &RigidBodyMotion,
    platform: &RigidBodyMotion,
    geometries: &[LegGeometry; 6],
    velocities: &[LegVelocity; 6],
) -> Matrices {
    let payload = PayloadPartials::new(parameters, platform);
    let mut sums = Matrices {
        mass_matrix_p: payload_mass(parameters, platform, &payload),
        coriolis_matrix_p: payload_coriolis(parameters, platform, &payload),
        jacobian_dp: jacobian_dp_of(geometries),
        mass_matrix_b: Matrix6::zeros(),
        coriolis_matrix_b: Matrix6::zeros(),
        jacobian_db: jacobian_db_of(geometries),
    };
    for i in 0..6 {
        let (leg, geometry, velocity) = (&parameters.legs[i], &geometries[i], &velocities[i]);
        let j = leg.partials_by_platform(geometry);
        let k = leg.partials_by_base(geometry);
        let j_rate = leg.partial_rates_by_platform(&j, geometry, velocity, platform);
        let k_rate = leg.partial_rates_by_base(&k, geometry, velocity, base);
        sums.mass_matrix_p += leg_mass(leg, geometry, &j, &j);
        sums.mass_matrix_b -= leg_mass(leg, geometry, &j, &k);
        sums.coriolis_matrix_p += leg_coriolis(leg, geometry, &velocity.rod_angular, &j, &j, &j_rate);
        sums.coriolis_matrix_b -= leg_coriolis(leg, geometry, &velocity.rod_angular, &j, &k, &k_rate);
    }
    sums
}
