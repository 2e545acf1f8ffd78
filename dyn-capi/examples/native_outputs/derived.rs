//! Arguments that the test vectors do not give, made of those that they give.

use std::error::Error;
use std::mem::size_of;
use std::ptr::null_mut;

use dyn_capi as capi;
use dyn_capi::{Coils, Inputs, LegKinematics, Limits, Model, Real, Status};

use crate::{HEADER, structure};

/// What the calls of a control loop take besides, made of a test vector.
pub struct Derived {
    /// Moved a little.
    pub start: Inputs,
    /// At the state, m.
    pub lengths: [Real; 6],
    /// At the state, m/s.
    pub rates: [Real; 6],
    pub limits: Limits,
    pub coils: Coils,
    /// N.
    pub forces: [Real; 6],
    /// rad.
    pub angles: [Real; 3],
    /// Rates of angles or angular velocity, rad/s.
    pub speeds: [Real; 3],
    pub quaternion: [Real; 4],
}

impl Derived {
    pub fn of(model: *const Model, inputs: &Inputs) -> Result<Self, Box<dyn Error>> {
        let mut legs: LegKinematics =
            structure(&vec![0.0; size_of::<LegKinematics>() / size_of::<Real>() - HEADER])?;
        // SAFETY: all live.
        let status = unsafe { capi::dyn_leg_kinematics(model, inputs, &mut legs, null_mut()) };
        if status != Status::Ok {
            return Err(format!("a test vector is refused: {status:?}").into());
        }
        let mut start = *inputs;
        start.platform_position[0] += 2e-4;
        start.platform_position[2] -= 3e-4;
        let [vx, vy, vz, wx, wy, wz] = inputs.platform_velocity;
        let norm = (1.0 + wx * wx + wy * wy + wz * wz).sqrt();
        Ok(Self {
            start,
            lengths: legs.actuator_length,
            rates: legs.actuator_velocity,
            limits: Limits {
                struct_size: size_of::<Limits>(),
                minimum_length: legs.actuator_length.map(|length| length - 0.01),
                maximum_length: legs.actuator_length.map(|length| length + 0.02),
                maximum_velocity: [3.0; 6],
                maximum_force: [50.0; 6],
                maximum_hooke_joint_angle: [0.8; 6],
                maximum_platform_joint_angle: [1.2; 6],
                home_direction_in_base: [[0.1, -0.2, 0.9]; 6],
                home_direction_in_platform: legs.rod_direction,
                minimum_condition_bound: 1e-3,
            },
            coils: Coils {
                struct_size: size_of::<Coils>(),
                force_constant: [18.0, 19.0, 20.0, 21.0, 22.0, 23.0],
                maximum_current: [2.0; 6],
            },
            forces: inputs.actuator_force,
            angles: [wx, wy, wz],
            speeds: [vx, vy, vz],
            quaternion: [1.0 / norm, wx / norm, wy / norm, wz / norm],
        })
    }
}
