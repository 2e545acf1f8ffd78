//! Kinematics of the thirteen moving bodies: payload (11)-(13), and two of each leg, (22), (24)-(29), in O coordinates.

use core::array::from_fn;

use nalgebra::Vector3;

use crate::leg::{LegAcceleration, leg_geometries, leg_velocities};
use crate::legs::LegType;
use crate::parameters::Parameters;
use crate::state::State;

/// What [`body_kinematics`] returns: positions in m, velocities in m/s and rad/s, accelerations in m/s^2 and
/// rad/s^2, all absolute and in O, of centres of mass. Of each leg the two bodies in the order of its module.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyKinematics {
    /// Payload (11).
    pub payload_com_position: Vector3<f64>,
    /// Payload (12).
    pub payload_com_velocity: Vector3<f64>,
    /// Payload (13).
    pub payload_com_acceleration: Vector3<f64>,
    /// `w_s`, of what turns with the leg's direction (22).
    pub leg_angular_velocity: [Vector3<f64>; 6],
    /// `w_s'`.
    pub leg_angular_acceleration: [Vector3<f64>; 6],
    /// Both bodies of every leg, (24) and (27).
    pub com_position: [[Vector3<f64>; 2]; 6],
    /// Both bodies of every leg, (25) and (28).
    pub com_velocity: [[Vector3<f64>; 2]; 6],
    /// Both bodies of every leg, (26) and (29).
    pub com_acceleration: [[Vector3<f64>; 2]; 6],
}

/// Positions, velocities and accelerations of all moving bodies, (11)-(13), (22), (24)-(29).
pub fn body_kinematics<L: LegType>(parameters: &Parameters<L>, state: &State) -> BodyKinematics {
    let State { base, platform, .. } = state;
    let legs = &parameters.legs;
    let geometries = leg_geometries(parameters, state);
    let velocities = leg_velocities(parameters, state, &geometries);
    let accelerations: [LegAcceleration; 6] =
        from_fn(|i| legs[i].acceleration(&geometries[i], &velocities[i], base, platform));
    let payload_arm = platform.rotation * parameters.payload.com_m;
    BodyKinematics {
        payload_com_position: platform.position_m + payload_arm,
        payload_com_velocity: platform.point_velocity(&payload_arm),
        payload_com_acceleration: platform.point_acceleration(&payload_arm),
        leg_angular_velocity: velocities.map(|leg| leg.rod_angular),
        leg_angular_acceleration: accelerations.map(|leg| leg.rod_angular),
        com_position: from_fn(|i| legs[i].com_position(&geometries[i], base, platform)),
        com_velocity: from_fn(|i| legs[i].com_velocity(&geometries[i], &velocities[i], base)),
        com_acceleration: from_fn(|i| {
            legs[i].com_acceleration(&geometries[i], &velocities[i], &accelerations[i], base)
        }),
    }
}
