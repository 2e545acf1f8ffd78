//! One leg: closure, rates and accelerations, (14)-(22) and (30)-(32), in O coordinates.
//!
//! Three structs build on one another, so that a caller computes only as far as it needs: [`LegGeometry`]
//! (positions), [`LegVelocity`] (first derivatives), [`LegAcceleration`] (second derivatives). The symbols
//! are the paper's: `a` actuator axis, `d` actuator length, `u` rod direction, `w_s` rod angular velocity.

use core::array::from_fn;

use nalgebra::{Matrix6, RowVector6, Vector3, Vector6};

use crate::parameters::{Leg, Parameters};
use crate::state::{RigidBodyMotion, State, stack};

/// A leg's configuration. "Arm" is a vector from the body's origin to one of its points, in O.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LegGeometry {
    /// `a = R_b a_i`, unit vector, in O.
    pub axis: Vector3<f64>,
    /// `R_b b_i`, m, in O.
    pub base_arm: Vector3<f64>,
    /// `R_p p_i`, m, in O.
    pub platform_arm: Vector3<f64>,
    /// `R_b b_i + d a`: the Hooke joint seen from the base's origin, m, in O.
    pub hooke_arm: Vector3<f64>,
    /// `d`, m (18).
    pub length: f64,
    /// `u`, from the Hooke joint to the platform joint, unit vector, in O (17).
    pub direction: Vector3<f64>,
    /// `u . a`, positive on the assembly branch of (18).
    pub cosine: f64,
}

impl LegGeometry {
    /// Solves the closure `l = d a + s u`. Out of reach, `length` and all that follows are NaN.
    pub fn new(leg: &Leg, base: &RigidBodyMotion, platform: &RigidBodyMotion) -> Self {
        let axis = base.rotation * leg.actuator_axis;
        let base_arm = base.rotation * leg.base_point_m;
        let platform_arm = platform.rotation * leg.platform_point_m;
        let l = platform.position_m + platform_arm - base.position_m - base_arm; // (14)
        let along = axis.dot(&l);
        let length = along - axial_reach_squared(leg, &axis, &l).sqrt(); // (18)
        let direction = (l - length * axis) / leg.rod_length_m; // (17)
        Self {
            axis,
            base_arm,
            platform_arm,
            hooke_arm: base_arm + length * axis,
            length,
            direction,
            cosine: direction.dot(&axis),
        }
    }

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
    /// `a' = w_b x a`, 1/s, in O.
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

impl LegVelocity {
    /// Differentiates the closure once; uses the velocities of base and platform.
    pub fn new(
        leg: &Leg,
        geometry: &LegGeometry,
        base: &RigidBodyMotion,
        platform: &RigidBodyMotion,
    ) -> Self {
        let LegGeometry { axis, direction, .. } = geometry;
        let platform_joint = platform.point_velocity(&geometry.platform_arm);
        let hooke_locked = base.point_velocity(&geometry.hooke_arm);
        // The rod keeps its length: u . (r_pi' - hooke') = 0 with hooke' = hooke_locked + d' a. This is (30).
        let length_rate = direction.dot(&(platform_joint - hooke_locked)) / geometry.cosine;
        let hooke = hooke_locked + length_rate * axis;
        let rod_angular = direction.cross(&(platform_joint - hooke)) / leg.rod_length_m; // (22)
        Self {
            axis_rate: base.angular_velocity().cross(axis),
            length_rate,
            hooke,
            platform_joint,
            rod_angular,
            direction_rate: rod_angular.cross(direction),
        }
    }
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

impl LegAcceleration {
    /// Differentiates the closure twice; uses the velocities and accelerations of base and platform.
    pub fn new(
        leg: &Leg,
        geometry: &LegGeometry,
        velocity: &LegVelocity,
        base: &RigidBodyMotion,
        platform: &RigidBodyMotion,
    ) -> Self {
        let LegGeometry { axis, direction, .. } = geometry;
        let platform_joint = platform.point_acceleration(&geometry.platform_arm);
        let hooke_unextended = sliding_point_acceleration(base, &geometry.hooke_arm, velocity, 0.0, axis);
        // (s u)'' . u = -s |w_s|^2, and (s u)'' = platform_joint - hooke_unextended - d'' a.
        let centripetal = leg.rod_length_m * velocity.rod_angular.norm_squared();
        let length = (direction.dot(&(platform_joint - hooke_unextended)) + centripetal) / geometry.cosine;
        let hooke = hooke_unextended + length * axis;
        // The derivative of (22) also holds u' x (s u'), which is zero.
        let rod_angular = direction.cross(&(platform_joint - hooke)) / leg.rod_length_m;
        Self { length, hooke, platform_joint, rod_angular }
    }
}

/// Acceleration of a point that slides along the actuator's axis with `d'` and `d''`, now at `arm` from the
/// base's origin, m/s^2, in O. Holds for the mover (26) and the Hooke joint.
///
/// The Coriolis term is `2 d' w_b x a`; the paper prints it without `w_b x`.
pub(crate) fn sliding_point_acceleration(
    base: &RigidBodyMotion,
    arm: &Vector3<f64>,
    velocity: &LegVelocity,
    length_acceleration: f64,
    axis: &Vector3<f64>,
) -> Vector3<f64> {
    base.point_acceleration(arm)
        + 2.0 * velocity.length_rate * velocity.axis_rate
        + length_acceleration * axis
}

/// The radicand of (18), m^2: square of the rod's component along the actuator.
fn axial_reach_squared(leg: &Leg, axis: &Vector3<f64>, l: &Vector3<f64>) -> f64 {
    let along = axis.dot(l);
    along * along - l.norm_squared() + leg.rod_length_m * leg.rod_length_m
}

/// The six legs' configurations.
pub fn leg_geometries(parameters: &Parameters, state: &State) -> [LegGeometry; 6] {
    from_fn(|i| LegGeometry::new(&parameters.legs[i], &state.base, &state.platform))
}

/// The six legs' first derivatives.
pub fn leg_velocities(
    parameters: &Parameters,
    state: &State,
    geometries: &[LegGeometry; 6],
) -> [LegVelocity; 6] {
    from_fn(|i| LegVelocity::new(&parameters.legs[i], &geometries[i], &state.base, &state.platform))
}

/// Per leg `(u . a)^2`, from the radicand of (18): 1 for a rod along its actuator, near 0 for a rod
/// perpendicular to it, where (31) and (32) are singular, negative for a platform joint out of the rod's
/// reach.
pub fn rod_alignment(parameters: &Parameters, state: &State) -> Vector6<f64> {
    let State { base, platform, .. } = state;
    Vector6::from_fn(|i, _| {
        let leg = &parameters.legs[i];
        let base_point = base.position_m + base.rotation * leg.base_point_m;
        let platform_point = platform.position_m + platform.rotation * leg.platform_point_m;
        let reach =
            axial_reach_squared(leg, &(base.rotation * leg.actuator_axis), &(platform_point - base_point));
        reach / (leg.rod_length_m * leg.rod_length_m)
    })
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
    /// `w_p - w_s`, rates of the universal joints, rad/s, in O (23).
    pub universal_joint_rate: [Vector3<f64>; 6],
}

/// Lengths, rates and joints of the six legs, (17), (18), (23), (30).
pub fn leg_kinematics(parameters: &Parameters, state: &State) -> LegKinematics {
    let State { base, platform, .. } = state;
    let geometries = leg_geometries(parameters, state);
    let velocities = leg_velocities(parameters, state, &geometries);
    let accelerations: [LegAcceleration; 6] = from_fn(|i| {
        LegAcceleration::new(&parameters.legs[i], &geometries[i], &velocities[i], base, platform)
    });
    LegKinematics {
        actuator_length: Vector6::from_fn(|i, _| geometries[i].length),
        actuator_velocity: Vector6::from_fn(|i, _| velocities[i].length_rate),
        actuator_acceleration: Vector6::from_fn(|i, _| accelerations[i].length),
        rod_direction: geometries.map(|leg| leg.direction),
        hooke_joint_position: geometries.map(|leg| base.position_m + leg.hooke_arm),
        platform_joint_position: geometries.map(|leg| platform.position_m + leg.platform_arm),
        universal_joint_rate: velocities.map(|leg| platform.angular_velocity() - leg.rod_angular),
    }
}

/// `J_dp`, 6x6, columns as `v_p`: `d' = J_dp v_p - J_db v_b` (32).
pub fn jacobian_dp(parameters: &Parameters, state: &State) -> Matrix6<f64> {
    jacobian_dp_of(&leg_geometries(parameters, state))
}

/// `J_db`, 6x6, columns as `v_b`: `d' = J_dp v_p - J_db v_b` (31).
pub fn jacobian_db(parameters: &Parameters, state: &State) -> Matrix6<f64> {
    jacobian_db_of(&leg_geometries(parameters, state))
}

pub(crate) fn jacobian_dp_of(geometries: &[LegGeometry; 6]) -> Matrix6<f64> {
    Matrix6::from_rows(&geometries.map(|leg| leg.jacobian_dp()))
}

pub(crate) fn jacobian_db_of(geometries: &[LegGeometry; 6]) -> Matrix6<f64> {
    Matrix6::from_rows(&geometries.map(|leg| leg.jacobian_db()))
}
