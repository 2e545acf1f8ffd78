//! Kinematics of the legs, (14)-(22) and (30)-(32), in O coordinates: what [`crate::legs`] compute, and results that all
//! leg types have.
//!
//! Three structs build on one another, so that a caller computes only as far as it needs: [`LegGeometry`]
//! (positions), [`LegVelocity`] (first derivatives), [`LegAcceleration`] (second derivatives). The symbols
//! are the paper's: `a` actuator axis, `d` actuator length, `u` rod direction, `w_s` rod angular velocity.

use core::array::from_fn;

use nalgebra::{Matrix6, RowVector6, Vector3, Vector6};

use crate::legs::LegType;
use crate::parameters::Parameters;
use crate::state::{State, stack};

/// A leg's configuration. "Arm" is a vector from the body's origin to one of its points, in O.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LegGeometry {
    /// `a`, the actuator's line of force, unit vector, in O.
    pub axis: Vector3<f64>,
    /// `R_b b_i`, m, in O.
    pub base_arm: Vector3<f64>,
    /// `R_p p_i`, m, in O.
    pub platform_arm: Vector3<f64>,
    /// The Hooke joint seen from the base's origin, m, in O.
    pub hooke_arm: Vector3<f64>,
    /// `d`, m (18).
    pub length: f64,
    /// `u`, from the Hooke joint to the platform joint, unit vector, in O (17).
    pub direction: Vector3<f64>,
    /// `u . a`, positive on the assembly branch of (18).
    pub cosine: f64,
}

impl LegGeometry {
    /// Row of `J_dp`: derivative of the actuator's velocity by `v_p` (32).
    pub fn jacobian_dp(&self) -> RowVector6<f64> {
        let u = &self.direction;
        stack(u, &self.platform_arm.cross(u)).transpose() / self.cosine
    }

    /// Row of `J_db`: minus the derivative of the actuator's velocity by `v_b` (31).
    pub fn jacobian_db(&self) -> RowVector6<f64> {
        let u = &self.direction;
        stack(u, &self.hooke_arm.cross(u)).transpose() / self.cosine
    }
}

/// First derivatives of a leg's configuration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LegVelocity {
    /// `a'`, 1/s, in O.
    pub axis_rate: Vector3<f64>,
    /// `d'`, m/s (30).
    pub length_rate: f64,
    /// Velocity of the Hooke joint, m/s, in O.
    pub hooke: Vector3<f64>,
    /// Velocity of the platform joint, m/s, in O.
    pub platform_joint: Vector3<f64>,
    /// `w_s`, rad/s, in O, without spin: `w_s . u = 0` (22).
    pub rod_angular: Vector3<f64>,
    /// `u' = w_s x u`, 1/s, in O.
    pub direction_rate: Vector3<f64>,
}

/// Second derivatives of a leg's configuration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LegAcceleration {
    /// `d''`, m/s^2.
    pub length: f64,
    /// Acceleration of the Hooke joint, m/s^2, in O.
    pub hooke: Vector3<f64>,
    /// Acceleration of the platform joint, m/s^2, in O.
    pub platform_joint: Vector3<f64>,
    /// `w_s'`, rad/s^2, in O.
    pub rod_angular: Vector3<f64>,
}

/// The six legs' configurations.
pub fn leg_geometries<L: LegType>(parameters: &Parameters<L>, state: &State) -> [LegGeometry; 6] {
    from_fn(|i| parameters.legs[i].geometry(&state.base, &state.platform))
}

/// The six legs' first derivatives.
pub fn leg_velocities<L: LegType>(
    parameters: &Parameters<L>,
    state: &State,
    geometries: &[LegGeometry; 6],
) -> [LegVelocity; 6] {
    from_fn(|i| parameters.legs[i].velocity(&geometries[i], &state.base, &state.platform))
}

/// Per leg `(u . a)^2`. Of the paper's legs, from the radicand of (18): 1 for a rod along its actuator, near 0 for a rod
/// perpendicular to it, where (31) and (32) are singular, negative for a platform joint out of the rod's
/// reach. Of a leg that is its own actuator, 1, and NaN where it has no length.
pub fn rod_alignment<L: LegType>(parameters: &Parameters<L>, state: &State) -> Vector6<f64> {
    Vector6::from_fn(|i, _| parameters.legs[i].alignment(&state.base, &state.platform))
}

/// What [`leg_kinematics`] returns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LegKinematics {
    /// `d`, m (18).
    pub actuator_length: Vector6<f64>,
    /// `d'`, m/s (30).
    pub actuator_velocity: Vector6<f64>,
    /// `d''`, m/s^2.
    pub actuator_acceleration: Vector6<f64>,
    /// `u`, unit vectors, in O (17).
    pub rod_direction: [Vector3<f64>; 6],
    /// Hooke joints, m, in O, from O's origin.
    pub hooke_joint_position: [Vector3<f64>; 6],
    /// Platform joints, m, in O, from O's origin.
    pub platform_joint_position: [Vector3<f64>; 6],
    /// `w_p - w_s`, rates of the platform joints, rad/s, in O (23).
    pub platform_joint_rate: [Vector3<f64>; 6],
}

/// Lengths, rates and joints of the six legs, (17), (18), (23), (30).
pub fn leg_kinematics<L: LegType>(parameters: &Parameters<L>, state: &State) -> LegKinematics {
    let State { base, platform, .. } = state;
    let geometries = leg_geometries(parameters, state);
    let velocities = leg_velocities(parameters, state, &geometries);
    let accelerations: [LegAcceleration; 6] =
        from_fn(|i| parameters.legs[i].acceleration(&geometries[i], &velocities[i], base, platform));
    LegKinematics {
        actuator_length: Vector6::from_fn(|i, _| geometries[i].length),
        actuator_velocity: Vector6::from_fn(|i, _| velocities[i].length_rate),
        actuator_acceleration: Vector6::from_fn(|i, _| accelerations[i].length),
        rod_direction: geometries.map(|leg| leg.direction),
        hooke_joint_position: geometries.map(|leg| base.position_m + leg.hooke_arm),
        platform_joint_position: geometries.map(|leg| platform.position_m + leg.platform_arm),
        platform_joint_rate: velocities.map(|leg| platform.angular_velocity() - leg.rod_angular),
    }
}

/// `J_dp`, 6x6, columns as `v_p`: `d' = J_dp v_p - J_db v_b` (32).
pub fn jacobian_dp<L: LegType>(parameters: &Parameters<L>, state: &State) -> Matrix6<f64> {
    jacobian_dp_of(&leg_geometries(parameters, state))
}

/// `J_db`, 6x6, columns as `v_b`: `d' = J_dp v_p - J_db v_b` (31).
pub fn jacobian_db<L: LegType>(parameters: &Parameters<L>, state: &State) -> Matrix6<f64> {
    jacobian_db_of(&leg_geometries(parameters, state))
}

pub(crate) fn jacobian_dp_of(geometries: &[LegGeometry; 6]) -> Matrix6<f64> {
    Matrix6::from_rows(&geometries.map(|leg| leg.jacobian_dp()))
}

pub(crate) fn jacobian_db_of(geometries: &[LegGeometry; 6]) -> Matrix6<f64> {
    Matrix6::from_rows(&geometries.map(|leg| leg.jacobian_db()))
}
