//! Kinematics of the thirteen moving bodies: payload (11)-(13), movers (24)-(26), rods (22), (27)-(29), in O
//! coordinates.

use core::array::from_fn;

use nalgebra::Vector3;

use crate::leg::{
    LegAcceleration, LegGeometry, LegVelocity, leg_geometries, leg_velocities, sliding_point_acceleration,
};
use crate::parameters::{Leg, Parameters};
use crate::state::{RigidBodyMotion, State};

/// The mover's centre of mass seen from the base's origin, m, in O (24).
pub(crate) fn mover_arm(leg: &Leg, geometry: &LegGeometry) -> Vector3<f64> {
    geometry.base_arm + (geometry.length - leg.mover_offset_m) * geometry.axis
}

/// Velocity of the mover's centre of mass, m/s, in O (25).
pub(crate) fn mover_velocity(
    leg: &Leg,
    geometry: &LegGeometry,
    velocity: &LegVelocity,
    base: &RigidBodyMotion,
) -> Vector3<f64> {
    base.point_velocity(&mover_arm(leg, geometry)) + velocity.length_rate * geometry.axis
}

/// Acceleration of the mover's centre of mass, m/s^2, in O (26), with the Coriolis term `2 d' w_b x a`.
pub(crate) fn mover_acceleration(
    leg: &Leg,
    geometry: &LegGeometry,
    velocity: &LegVelocity,
    acceleration: &LegAcceleration,
    base: &RigidBodyMotion,
) -> Vector3<f64> {
    let arm = mover_arm(leg, geometry);
    sliding_point_acceleration(base, &arm, velocity, acceleration.length, &geometry.axis)
}

/// The rod's centre of mass from the values of any one quantity (position, velocity, acceleration) at its two
/// ends: (27)-(29) for `k = 1/2`. The paper's (29) lacks the parentheses that put all of the sum under the
/// factor 1/2.
pub(crate) fn rod_com(leg: &Leg, hooke: &Vector3<f64>, platform_joint: &Vector3<f64>) -> Vector3<f64> {
    (1.0 - leg.rod_com_fraction) * hooke + leg.rod_com_fraction * platform_joint
}

/// What [`body_kinematics`] returns: positions in m, velocities in m/s and rad/s, accelerations in m/s^2 and
/// rad/s^2, all absolute and in O, of centres of mass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyKinematics {
    /// Payload (11).
    pub payload_com_position: Vector3<f64>,
    /// Payload (12).
    pub payload_com_velocity: Vector3<f64>,
    /// Payload (13).
    pub payload_com_acceleration: Vector3<f64>,
    /// Rods, `w_s` (22).
    pub rod_angular_velocity: [Vector3<f64>; 6],
    /// Rods, `w_s'`.
    pub rod_angular_acceleration: [Vector3<f64>; 6],
    /// Rods (27).
    pub rod_com_position: [Vector3<f64>; 6],
    /// Rods (28).
    pub rod_com_velocity: [Vector3<f64>; 6],
    /// Rods (29).
    pub rod_com_acceleration: [Vector3<f64>; 6],
    /// Movers (24).
    pub mover_position: [Vector3<f64>; 6],
    /// Movers (25).
    pub mover_velocity: [Vector3<f64>; 6],
    /// Movers (26).
    pub mover_acceleration: [Vector3<f64>; 6],
}

/// Positions, velocities and accelerations of all moving bodies, (11)-(13), (22), (24)-(29).
pub fn body_kinematics(parameters: &Parameters, state: &State) -> BodyKinematics {
    let State { base, platform, .. } = state;
    let legs = &parameters.legs;
    let geometries = leg_geometries(parameters, state);
    let velocities = leg_velocities(parameters, state, &geometries);
    let accelerations: [LegAcceleration; 6] =
        from_fn(|i| LegAcceleration::new(&legs[i], &geometries[i], &velocities[i], base, platform));
    let payload_arm = platform.rotation * parameters.payload.com_m;
    BodyKinematics {
        payload_com_position: platform.position_m + payload_arm,
        payload_com_velocity: platform.point_velocity(&payload_arm),
        payload_com_acceleration: platform.point_acceleration(&payload_arm),
        rod_angular_velocity: velocities.map(|leg| leg.rod_angular),
        rod_angular_acceleration: accelerations.map(|leg| leg.rod_angular),
        rod_com_position: from_fn(|i| {
            let hooke = base.position_m + geometries[i].hooke_arm;
            rod_com(&legs[i], &hooke, &(platform.position_m + geometries[i].platform_arm))
        }),
        rod_com_velocity: from_fn(|i| rod_com(&legs[i], &velocities[i].hooke, &velocities[i].platform_joint)),
        rod_com_acceleration: from_fn(|i| {
            rod_com(&legs[i], &accelerations[i].hooke, &accelerations[i].platform_joint)
        }),
        mover_position: from_fn(|i| base.position_m + mover_arm(&legs[i], &geometries[i])),
        mover_velocity: from_fn(|i| mover_velocity(&legs[i], &geometries[i], &velocities[i], base)),
        mover_acceleration: from_fn(|i| {
            mover_acceleration(&legs[i], &geometries[i], &velocities[i], &accelerations[i], base)
        }),
    }
}
