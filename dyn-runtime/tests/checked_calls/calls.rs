//! One row per checked call.

use dyn_runtime::Input::{self, *};
use dyn_runtime::current::VoiceCoils;
use dyn_runtime::{Error, Hexapod, Limits};

use crate::arguments::{Arguments, flat};
use crate::mock::Mock;

/// One checked call: its name, what it depends on, and itself, giving its outputs flat and row-major in the
/// order of the model's function.
pub struct Call {
    pub name: &'static str,
    pub inputs: &'static [Input],
    pub run: fn(&Hexapod<Mock>, &Arguments) -> Result<Vec<f64>, Error>,
}

const POSES: &[Input] = &[BasePosition, BaseRotation, PlatformPosition, PlatformRotation];
const STATES: &[Input] =
    &[BasePosition, BaseRotation, BaseVelocity, PlatformPosition, PlatformRotation, PlatformVelocity];
const MOTIONS: &[Input] = &[
    BasePosition,
    BaseRotation,
    BaseVelocity,
    BaseAcceleration,
    PlatformPosition,
    PlatformRotation,
    PlatformVelocity,
    PlatformAcceleration,
];
const LOADED: &[Input] = &[
    BasePosition,
    BaseRotation,
    BaseVelocity,
    BaseAcceleration,
    PlatformPosition,
    PlatformRotation,
    PlatformVelocity,
    PlatformAcceleration,
    ActuatorForce,
    ExternalWrench,
];
/// Every input of any call.
pub const ALL: &[Input] = &[
    BasePosition,
    BaseRotation,
    BaseVelocity,
    BaseAcceleration,
    PlatformPosition,
    PlatformRotation,
    PlatformVelocity,
    PlatformAcceleration,
    ReferenceVelocity,
    ActuatorForce,
    ExternalWrench,
    ActuatorLength,
    ActuatorVelocity,
];
const PASSIVE: &[Input] = &[
    BasePosition,
    BaseRotation,
    BaseVelocity,
    BaseAcceleration,
    PlatformPosition,
    PlatformRotation,
    PlatformVelocity,
    PlatformAcceleration,
    ReferenceVelocity,
    ExternalWrench,
];
const INVERSE: &[Input] = &[
    BasePosition,
    BaseRotation,
    BaseVelocity,
    BaseAcceleration,
    PlatformPosition,
    PlatformRotation,
    PlatformVelocity,
    PlatformAcceleration,
    ExternalWrench,
];
const FORWARD: &[Input] = &[
    BasePosition,
    BaseRotation,
    BaseVelocity,
    BaseAcceleration,
    PlatformPosition,
    PlatformRotation,
    PlatformVelocity,
    ActuatorForce,
    ExternalWrench,
];

/// Calls whose outputs are those of one function of the model.
pub const CALLS: &[Call] = &[
    Call {
        name: "rod_alignment",
        inputs: POSES,
        run: |hexapod, a| Ok(flat(&[hexapod.rod_alignment(&a.base, &a.platform)?])),
    },
    Call {
        name: "leg_kinematics",
        inputs: MOTIONS,
        run: |hexapod, a| {
            let k = hexapod.leg_kinematics(&a.base, &a.platform, &a.platform_acceleration)?;
            let lengths = [k.actuator_length_m, k.actuator_velocity_m_s, k.actuator_acceleration_m_s2];
            let vectors = [
                k.rod_direction,
                k.hooke_joint_position_m,
                k.platform_joint_position_m,
                k.platform_joint_rate_rad_s,
            ];
            Ok([flat(&lengths), flat(vectors.as_flattened())].concat())
        },
    },
    Call {
        name: "body_kinematics",
        inputs: MOTIONS,
        run: |hexapod, a| {
            let k = hexapod.body_kinematics(&a.base, &a.platform, &a.platform_acceleration)?;
            let payload =
                [k.payload_com_position_m, k.payload_com_velocity_m_s, k.payload_com_acceleration_m_s2];
            let legs = [
                k.rod_angular_velocity_rad_s,
                k.rod_angular_acceleration_rad_s2,
                k.rod_com_position_m,
                k.rod_com_velocity_m_s,
                k.rod_com_acceleration_m_s2,
                k.mover_position_m,
                k.mover_velocity_m_s,
                k.mover_acceleration_m_s2,
            ];
            Ok([flat(&payload), flat(legs.as_flattened())].concat())
        },
    },
    Call {
        name: "partial_velocities",
        inputs: POSES,
        run: |hexapod, a| {
            let v = hexapod.partial_velocities(&a.base, &a.platform)?;
            let payload = [v.payload_partial_velocity, v.payload_partial_angular_velocity];
            let legs = [v.rod_partial_velocity, v.rod_partial_angular_velocity, v.mover_partial_velocity];
            Ok([flat(&payload), flat(legs.as_flattened())].concat())
        },
    },
    Call {
        name: "generalised_forces",
        inputs: LOADED,
        run: |hexapod, a| {
            let f = hexapod.generalised_forces(
                &a.base,
                &a.platform,
                &a.platform_acceleration,
                &a.actuator_force_n,
                &a.external_wrench,
            )?;
            let legs = [f.rod_active_force, f.rod_inertia_force, f.mover_active_force, f.mover_inertia_force];
            Ok([flat(&[f.payload_active_force, f.payload_inertia_force]), flat(legs.as_flattened())].concat())
        },
    },
    Call {
        name: "ups_body_kinematics",
        inputs: MOTIONS,
        run: |hexapod, a| {
            let k = hexapod.ups_body_kinematics(&a.base, &a.platform, &a.platform_acceleration)?;
            let payload =
                [k.payload_com_position_m, k.payload_com_velocity_m_s, k.payload_com_acceleration_m_s2];
            let legs = [
                k.leg_angular_velocity_rad_s,
                k.leg_angular_acceleration_rad_s2,
                k.lower_com_position_m,
                k.lower_com_velocity_m_s,
                k.lower_com_acceleration_m_s2,
                k.upper_com_position_m,
                k.upper_com_velocity_m_s,
                k.upper_com_acceleration_m_s2,
            ];
            Ok([flat(&payload), flat(legs.as_flattened())].concat())
        },
    },
    Call {
        name: "ups_partial_velocities",
        inputs: POSES,
        run: |hexapod, a| {
            let v = hexapod.ups_partial_velocities(&a.base, &a.platform)?;
            let payload = [v.payload_partial_velocity, v.payload_partial_angular_velocity];
            let legs = [v.lower_partial_velocity, v.upper_partial_velocity, v.leg_partial_angular_velocity];
            Ok([flat(&payload), flat(legs.as_flattened())].concat())
        },
    },
    Call {
        name: "ups_generalised_forces",
        inputs: LOADED,
        run: |hexapod, a| {
            let f = hexapod.ups_generalised_forces(
                &a.base,
                &a.platform,
                &a.platform_acceleration,
                &a.actuator_force_n,
                &a.external_wrench,
            )?;
            let legs =
                [f.lower_active_force, f.lower_inertia_force, f.upper_active_force, f.upper_inertia_force];
            Ok([flat(&[f.payload_active_force, f.payload_inertia_force]), flat(legs.as_flattened())].concat())
        },
    },
    Call {
        name: "jacobian_dp",
        inputs: POSES,
        run: |hexapod, a| Ok(flat(&[hexapod.jacobian_dp(&a.base, &a.platform)?])),
    },
    Call {
        name: "jacobian_db",
        inputs: POSES,
        run: |hexapod, a| Ok(flat(&[hexapod.jacobian_db(&a.base, &a.platform)?])),
    },
    Call {
        name: "mass_matrix_p",
        inputs: POSES,
        run: |hexapod, a| Ok(flat(&[hexapod.mass_matrix_p(&a.base, &a.platform)?])),
    },
    Call {
        name: "mass_matrix_b",
        inputs: POSES,
        run: |hexapod, a| Ok(flat(&[hexapod.mass_matrix_b(&a.base, &a.platform)?])),
    },
    Call {
        name: "coriolis_matrices",
        inputs: STATES,
        run: |hexapod, a| {
            let c = hexapod.coriolis_matrices(&a.base, &a.platform)?;
            Ok(flat(&[c.coriolis_matrix_p, c.coriolis_matrix_b]))
        },
    },
    Call {
        name: "stiffness_matrices",
        inputs: POSES,
        run: |hexapod, a| {
            let k = hexapod.stiffness_matrices(&a.base, &a.platform)?;
            Ok(flat(&[k.stiffness_matrix_p, k.stiffness_matrix_b]))
        },
    },
    Call {
        name: "matrices",
        inputs: STATES,
        run: |hexapod, a| {
            let m = hexapod.matrices(&a.base, &a.platform)?;
            Ok(flat(&[
                m.mass_matrix_p,
                m.coriolis_matrix_p,
                m.jacobian_dp,
                m.mass_matrix_b,
                m.coriolis_matrix_b,
                m.jacobian_db,
            ]))
        },
    },
    Call {
        name: "passive_forces",
        inputs: STATES,
        run: |hexapod, a| {
            let f = hexapod.passive_forces(&a.base, &a.platform)?;
            Ok(flat(&[f.gravity_force, f.spring_force, f.damping_force]))
        },
    },
    Call { name: "bias", inputs: STATES, run: |hexapod, a| Ok(flat(&[hexapod.bias(&a.base, &a.platform)?])) },
    Call {
        name: "equation_of_motion",
        inputs: STATES,
        run: |hexapod, a| {
            let e = hexapod.equation_of_motion(&a.base, &a.platform)?;
            let matrices = [
                e.mass_matrix_p,
                e.coriolis_matrix_p,
                e.stiffness_matrix_p,
                e.jacobian_dp,
                e.mass_matrix_b,
                e.coriolis_matrix_b,
                e.stiffness_matrix_b,
                e.jacobian_db,
            ];
            let forces = [e.gravity_force, e.spring_force, e.damping_force, e.bias];
            Ok([flat(&matrices), flat(&forces)].concat())
        },
    },
    Call {
        name: "inverse_dynamics",
        inputs: INVERSE,
        run: |hexapod, a| {
            Ok(flat(&[hexapod.inverse_dynamics(
                &a.base,
                &a.platform,
                &a.platform_acceleration,
                &a.external_wrench,
            )?]))
        },
    },
    Call {
        name: "control",
        inputs: INVERSE,
        run: |hexapod, a| {
            let c = hexapod.control(&a.base, &a.platform, &a.platform_acceleration, &a.external_wrench)?;
            let lengths = flat(&[c.actuator_length_m, c.actuator_velocity_m_s]);
            let matrices = flat(&[c.jacobian_dp, c.mass_matrix_p]);
            Ok([lengths, matrices, flat(&[c.total_bias, c.inverse_dynamics_n])].concat())
        },
    },
    Call {
        name: "passive_inverse_dynamics",
        inputs: PASSIVE,
        run: |hexapod, a| {
            let (velocity, acceleration) = (&a.reference_velocity, &a.platform_acceleration);
            Ok(flat(&[hexapod.passive_inverse_dynamics(
                &a.base,
                &a.platform,
                velocity,
                acceleration,
                &a.external_wrench,
            )?]))
        },
    },
    Call {
        name: "base_reaction",
        inputs: INVERSE,
        run: |hexapod, a| {
            let reaction =
                hexapod.base_reaction(&a.base, &a.platform, &a.platform_acceleration, &a.external_wrench)?;
            Ok(flat(&[reaction.force_n, reaction.moment_n_m]))
        },
    },
    Call {
        name: "forward_dynamics",
        inputs: FORWARD,
        run: |hexapod, a| {
            let acceleration =
                hexapod.forward_dynamics(&a.base, &a.platform, &a.actuator_force_n, &a.external_wrench)?;
            Ok(flat(&[acceleration.to_vector()]))
        },
    },
    Call {
        name: "energy",
        inputs: STATES,
        run: |hexapod, a| {
            let energy = hexapod.energy(&a.base, &a.platform)?;
            Ok(vec![energy.kinetic_j, energy.potential_j])
        },
    },
];

/// Calls that compute something themselves from what the model gives.
pub const COMPUTED: &[Call] = &[
    Call {
        name: "forward_kinematics",
        inputs: &[BasePosition, BaseRotation, PlatformPosition, PlatformRotation, ActuatorLength],
        run: |hexapod, a| {
            let found = hexapod.forward_kinematics(&a.base.pose, &a.actuator_length_m, &a.platform.pose)?;
            Ok(flat(&[found.pose.position_m]))
        },
    },
    Call {
        name: "platform_velocity",
        inputs: &[
            BasePosition,
            BaseRotation,
            BaseVelocity,
            PlatformPosition,
            PlatformRotation,
            ActuatorVelocity,
        ],
        run: |hexapod, a| {
            let velocity = hexapod.platform_velocity(&a.base, &a.platform.pose, &a.actuator_velocity_m_s)?;
            Ok(flat(&[velocity.to_vector()]))
        },
    },
    Call {
        name: "monitor",
        inputs: &[
            BasePosition,
            BaseRotation,
            BaseVelocity,
            PlatformPosition,
            PlatformRotation,
            PlatformVelocity,
            ActuatorForce,
        ],
        run: |hexapod, a| {
            let monitor = hexapod.monitor(&a.base, &a.platform, &a.actuator_force_n, &Limits::none())?;
            Ok(monitor.margins.map(|margin| margin.margin).to_vec())
        },
    },
    Call {
        name: "currents",
        inputs: &[ActuatorForce],
        run: |_, a| {
            let coils = VoiceCoils { force_constant_n_per_a: [20.0; 6], maximum_current_a: [2.0; 6] };
            Ok(flat(&[coils.currents(&a.actuator_force_n)?.current_a]))
        },
    },
];

/// Calls of both kinds.
pub fn all_calls() -> impl Iterator<Item = &'static Call> {
    CALLS.iter().chain(COMPUTED)
}

/// Calls of both kinds that depend on poses.
pub fn calls_at_poses() -> impl Iterator<Item = &'static Call> {
    all_calls().filter(|call| POSES.iter().all(|input| call.inputs.contains(input)))
}

/// A hexapod for this call: J_dp counts only where it is the result.
pub fn hexapod_for(call: &Call) -> Hexapod<Mock> {
    Hexapod::new(if call.name == "jacobian_dp" { Mock::counting() } else { Mock::regular() })
}
