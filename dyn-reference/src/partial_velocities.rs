//! Partial velocities (33)-(38) of all moving bodies and their inertial time derivatives, in O coordinates.
//!
//! A body's velocity is `J_p v_p + J_b v_b`, its angular velocity `J_wp v_p + J_wb v_b`. Kane's equations for
//! the six platform speeds project on `J_p` and `J_wp`; `J_b` and `J_wb` carry the base's motion into them.
//! The payload does not depend on `v_b`. With the dot for the derivative seen from O, accelerations are `J_p
//! v_p' + J_b v_b' + J_p' v_p + J_b' v_b`.

use core::array::from_fn;

use nalgebra::{Matrix3, Matrix3x6, RowVector6, Vector3};

use crate::leg::{LegGeometry, LegVelocity, leg_geometries};
use crate::legs::LegType;
use crate::parameters::Parameters;
use crate::state::{RigidBodyMotion, State, stack};

/// Velocity of a body's point at `arm` from the body's origin, as a matrix on the body's `[r'; w]`: `[1,
/// -[arm]x]`.
pub(crate) fn point_partial(arm: &Vector3<f64>) -> Matrix3x6<f64> {
    blocks(&Matrix3::identity(), &-arm.cross_matrix())
}

/// Time derivative of [`point_partial`] for an arm that changes by `arm_rate`, 1/s.
pub(crate) fn point_partial_rate(arm_rate: &Vector3<f64>) -> Matrix3x6<f64> {
    blocks(&Matrix3::zeros(), &-arm_rate.cross_matrix())
}

fn blocks(left: &Matrix3<f64>, right: &Matrix3<f64>) -> Matrix3x6<f64> {
    let mut joined = Matrix3x6::zeros();
    joined.fixed_columns_mut::<3>(0).copy_from(left);
    joined.fixed_columns_mut::<3>(3).copy_from(right);
    joined
}

/// Partial velocities of the payload by `v_p`, or their time derivatives (1/s more).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PayloadPartials {
    /// Of the centre of mass.
    pub velocity: Matrix3x6<f64>,
    /// Of the angular velocity.
    pub angular_velocity: Matrix3x6<f64>,
}

impl PayloadPartials {
    /// `[1, -[R_p r_c]x]` and `[0, 1]` (33), (34).
    pub fn new<L: LegType>(parameters: &Parameters<L>, platform: &RigidBodyMotion) -> Self {
        Self {
            velocity: point_partial(&(platform.rotation * parameters.payload.com_m)),
            angular_velocity: blocks(&Matrix3::zeros(), &Matrix3::identity()),
        }
    }

    /// Time derivatives of [`PayloadPartials::new`].
    pub fn rates<L: LegType>(parameters: &Parameters<L>, platform: &RigidBodyMotion) -> Self {
        let arm = platform.rotation * parameters.payload.com_m;
        Self {
            velocity: point_partial_rate(&platform.angular_velocity().cross(&arm)),
            angular_velocity: Matrix3x6::zeros(),
        }
    }
}

/// Partial velocities of one leg's joints and bodies by `v_p` or by `v_b`, or their time derivatives (1/s more).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LegPartials {
    /// Of the actuator's velocity `d'`: a row of `J_dp`, or of `-J_db`.
    pub length: RowVector6<f64>,
    /// Of the Hooke joint.
    pub hooke: Matrix3x6<f64>,
    /// Of the platform joint; zero by `v_b`.
    pub platform_joint: Matrix3x6<f64>,
    /// Of the two bodies' centres of mass.
    pub com: [Matrix3x6<f64>; 2],
    /// Of the angular velocity `w_s`.
    pub angular: Matrix3x6<f64>,
}

/// Time derivative of `sign [u, arm x u]^T / (u . a)`, the rows (32) and (31), whose value is that of `partials`, by
/// the quotient rule.
pub(crate) fn length_partial_rate(
    partials: &LegPartials,
    geometry: &LegGeometry,
    velocity: &LegVelocity,
    arm: &Vector3<f64>,
    arm_rate: &Vector3<f64>,
    sign: f64,
) -> RowVector6<f64> {
    let (u, u_rate) = (&geometry.direction, &velocity.direction_rate);
    let cosine_rate = u_rate.dot(&geometry.axis) + u.dot(&velocity.axis_rate);
    let numerator_rate = stack(u_rate, &(arm_rate.cross(u) + arm.cross(u_rate))).transpose();
    (sign * numerator_rate - cosine_rate * partials.length) / geometry.cosine
}

/// What [`partial_velocities`] returns: 3x6 matrices on `v_p = [r_p'; w_p]`, in O.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PartialVelocities {
    /// Payload's centre of mass.
    pub payload_partial_velocity: Matrix3x6<f64>,
    /// Payload's angular velocity.
    pub payload_partial_angular_velocity: Matrix3x6<f64>,
    /// Centres of mass of both bodies of every leg.
    pub com_partial_velocity: [[Matrix3x6<f64>; 2]; 6],
    /// Legs' angular velocities `w_s`.
    pub leg_partial_angular_velocity: [Matrix3x6<f64>; 6],
}

/// Derivatives by `v_p` of the velocities of all moving bodies (33)-(38).
pub fn partial_velocities<L: LegType>(parameters: &Parameters<L>, state: &State) -> PartialVelocities {
    let geometries = leg_geometries(parameters, state);
    let payload = PayloadPartials::new(parameters, &state.platform);
    let legs: [LegPartials; 6] = from_fn(|i| parameters.legs[i].partials_by_platform(&geometries[i]));
    PartialVelocities {
        payload_partial_velocity: payload.velocity,
        payload_partial_angular_velocity: payload.angular_velocity,
        com_partial_velocity: legs.map(|leg| leg.com),
        leg_partial_angular_velocity: legs.map(|leg| leg.angular),
    }
}
