//! The calls that a control loop is made of: pose from lengths, everything for a cycle, what the base feels.

use core::mem::size_of;

use dyn_runtime::nalgebra::Vector6;

use crate::inputs::Inputs;
use crate::model::{Model, with_hexapod};
use crate::outputs::rows;
use crate::pointers::{answer, array, convert, structure};
use crate::real::Real;
use crate::status::{Info, Status};

/// What a controller needs in every cycle, from one shared evaluation.
#[repr(C)]
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Control {
    /// Set to sizeof(dyn_control_result) before the call.
    pub struct_size: usize,
    /// d, m.
    pub actuator_length: [Real; 6],
    /// d', m/s.
    pub actuator_velocity: [Real; 6],
    /// J_dp.
    pub jacobian_dp: [[Real; 6]; 6],
    /// M_p.
    pub mass_matrix_p: [[Real; 6]; 6],
    /// dyn_bias less M_b v_b', N and N m, O: M_p v_p' + total_bias = J_dp^T F + W_ext.
    pub total_bias: [Real; 6],
    /// Forces as dyn_inverse_dynamics gives them, N.
    pub actuator_force: [Real; 6],
}

/// A pose with given actuator lengths.
#[repr(C)]
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct ForwardKinematics {
    /// Set to sizeof(dyn_forward_kinematics_result) before the call.
    pub struct_size: usize,
    /// Origin of P, m, O.
    pub platform_position: [Real; 3],
    /// P coordinates to O coordinates.
    pub platform_rotation: [[Real; 3]; 3],
    /// Largest difference between a length given and one at this pose, m, by the pose relative to the base: far from O the
    /// rounding of positions in O adds to it.
    pub residual: Real,
    /// Newton steps that led there.
    pub iterations: u32,
}

/// Lengths, rates, J_dp, M_p, total_bias and the forces for `platform_acceleration`, in one call that costs less than twice
/// dyn_inverse_dynamics. Depends on poses, velocities and accelerations of both bodies and on the external wrench.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dyn_control(
    model: *const Model,
    inputs: *const Inputs,
    result: *mut Control,
    info: *mut Info,
) -> Status {
    // SAFETY: the caller keeps what the crate says.
    unsafe {
        answer(model, inputs, result, info, |platform, s| {
            with_hexapod!(platform, |hexapod| {
                hexapod
                    .control(&s.base, &s.platform, &s.platform_acceleration, &s.external_wrench)
                    .map(Into::into)
            })
        })
    }
}

/// Forces, N, at `reference_velocity` and, as reference acceleration, `platform_acceleration`, for passivity-based control
/// (Slotine and Li): J_dp^T F = M_p a_r + C_p v_r - C_b v_b - M_b v_b' + gravity, springs, dampers - W_ext.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dyn_passive_inverse_dynamics(
    model: *const Model,
    inputs: *const Inputs,
    force: *mut [Real; 6],
    info: *mut Info,
) -> Status {
    // SAFETY: the caller keeps what the crate says.
    unsafe {
        answer(model, inputs, force, info, |platform, s| {
            with_hexapod!(platform, |hexapod| {
                let (velocity, acceleration) = (&s.reference_velocity, &s.platform_acceleration);
                hexapod
                    .passive_inverse_dynamics(
                        &s.base,
                        &s.platform,
                        velocity,
                        acceleration,
                        &s.external_wrench,
                    )
                    .map(Into::into)
            })
        })
    }
}

/// Wrench of the base on the mechanism [force; moment about the base's origin], N, N m, O; the base feels the opposite.
/// Depends on poses, velocities and accelerations of both bodies and on the external wrench.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dyn_base_reaction(
    model: *const Model,
    inputs: *const Inputs,
    wrench: *mut [Real; 6],
    info: *mut Info,
) -> Status {
    // SAFETY: the caller keeps what the crate says.
    unsafe {
        answer(model, inputs, wrench, info, |platform, s| {
            with_hexapod!(platform, |hexapod| {
                hexapod.base_reaction(&s.base, &s.platform, &s.platform_acceleration, &s.external_wrench).map(
                    |reaction| {
                        let (force, moment) = (reaction.force_n, reaction.moment_n_m);
                        [force.x, force.y, force.z, moment.x, moment.y, moment.z]
                    },
                )
            })
        })
    }
}

/// The platform's pose from six actuator lengths, m: Newton's method from the platform's pose in `inputs`, the last one in a
/// loop, home at first. Depends on the base's pose.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dyn_forward_kinematics(
    model: *const Model,
    inputs: *const Inputs,
    actuator_length: *const Real,
    result: *mut ForwardKinematics,
    info: *mut Info,
) -> Status {
    // SAFETY: the caller keeps what the crate says.
    unsafe {
        convert(result, info, || {
            let platform = structure(model)?.platform()?;
            let s = structure(inputs)?.into();
            let lengths = Vector6::from(array::<6>(actuator_length)?);
            Ok(forward_kinematics(&platform, &s, &lengths)?)
        })
    }
}

fn forward_kinematics(
    platform: &crate::model::Platform<'_>,
    s: &crate::inputs::States,
    lengths: &Vector6<Real>,
) -> Result<ForwardKinematics, dyn_runtime::Error> {
    with_hexapod!(platform, |hexapod| {
        hexapod.forward_kinematics(&s.base.pose, lengths, &s.platform.pose).map(Into::into)
    })
}

/// The platform's velocity [r_p'; w_p], m/s, rad/s, O, from six actuator rates, m/s. Depends on both poses and the base's
/// velocity.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dyn_platform_velocity(
    model: *const Model,
    inputs: *const Inputs,
    actuator_velocity: *const Real,
    velocity: *mut [Real; 6],
    info: *mut Info,
) -> Status {
    // SAFETY: the caller keeps what the crate says.
    unsafe {
        convert(velocity, info, || {
            let platform = structure(model)?.platform()?;
            let s: crate::inputs::States = structure(inputs)?.into();
            let rates = Vector6::from(array::<6>(actuator_velocity)?);
            with_hexapod!(&platform, |hexapod| {
                let velocity = hexapod.platform_velocity(&s.base, &s.platform.pose, &rates)?;
                Ok(velocity.to_vector().into())
            })
        })
    }
}

impl From<dyn_runtime::Control<Real>> for Control {
    fn from(result: dyn_runtime::Control<Real>) -> Self {
        Self {
            struct_size: size_of::<Self>(),
            actuator_length: result.actuator_length_m.into(),
            actuator_velocity: result.actuator_velocity_m_s.into(),
            jacobian_dp: rows(result.jacobian_dp),
            mass_matrix_p: rows(result.mass_matrix_p),
            total_bias: result.total_bias.into(),
            actuator_force: result.inverse_dynamics_n.into(),
        }
    }
}

impl From<dyn_runtime::ForwardKinematics<Real>> for ForwardKinematics {
    fn from(result: dyn_runtime::ForwardKinematics<Real>) -> Self {
        Self {
            struct_size: size_of::<Self>(),
            platform_position: result.pose.position_m.into(),
            platform_rotation: result.pose.rotation.matrix().transpose().into(),
            residual: result.residual_m,
            iterations: result.iterations,
        }
    }
}
