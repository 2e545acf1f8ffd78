//! The calls about what actuators and joints may do: limits and coils of the platform file, margins, currents.

use core::ffi::{CStr, c_char};
use core::mem::size_of;

use dyn_runtime::current::{Currents, VoiceCoils};
use dyn_runtime::nalgebra::Vector6;
use dyn_runtime::{Margin, Monitor};

use crate::inputs::Inputs;
use crate::model::{Model, with_hexapod};
use crate::pointers::{array, convert, explain, structure};
use crate::real::Real;
use crate::status::{Info, Refusal, Status, text};

/// What actuators and joints may do. INFINITY is no limit (for minima -INFINITY).
#[repr(C)]
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Limits {
    /// Set to sizeof(dyn_limits).
    pub struct_size: usize,
    /// Shortest d, m.
    pub minimum_length: [Real; 6],
    /// Longest d, m.
    pub maximum_length: [Real; 6],
    /// Highest |d'|, m/s.
    pub maximum_velocity: [Real; 6],
    /// Largest |F|, N.
    pub maximum_force: [Real; 6],
    /// Largest angle between a rod and its direction at home, both in axes of B, rad.
    pub maximum_hooke_joint_angle: [Real; 6],
    /// Largest angle between a rod and its direction at home, both in axes of P, rad.
    pub maximum_platform_joint_angle: [Real; 6],
    /// Direction of each rod at home, B, length 1. Counts where an angle at the Hooke joint is limited.
    pub home_direction_in_base: [[Real; 3]; 6],
    /// Direction of each rod at home, P, length 1. Counts where an angle at the platform joint is limited.
    pub home_direction_in_platform: [[Real; 3]; 6],
    /// Least lower bound of the reciprocal condition number of J_dp, without unit; -INFINITY is no limit. The bound is
    /// several times smaller than the number itself: look at the margin of DYN_QUANTITY_CONDITIONING at home first.
    pub minimum_condition_bound: Real,
}

/// Quantities with a limit: indices of `margin` and `leg` in dyn_monitor_result.
#[repr(i32)]
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Quantity {
    /// d, m.
    ActuatorLength = 0,
    /// d', m/s.
    ActuatorVelocity = 1,
    /// F, N.
    ActuatorForce = 2,
    /// Angle at the Hooke joint, rad.
    HookeJointAngle = 3,
    /// Angle at the platform joint, rad.
    PlatformJointAngle = 4,
    /// Conditioning of J_dp.
    Conditioning = 5,
}

/// The least margin of every quantity.
#[repr(C)]
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Margins {
    /// Set to sizeof(dyn_monitor_result) before the call.
    pub struct_size: usize,
    /// Distance to the limit in the quantity's unit, by DYN_QUANTITY_...; negative beyond it, INFINITY without limit.
    pub margin: [Real; 6],
    /// The leg that is nearest to its limit, 0 to 5, by DYN_QUANTITY_...; -1 for conditioning.
    pub leg: [i32; 6],
}

/// The voice coils of the six actuators.
#[repr(C)]
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Coils {
    /// Set to sizeof(dyn_voice_coils).
    pub struct_size: usize,
    /// Force per current, N/A; not 0.
    pub force_constant: [Real; 6],
    /// Largest current either way, A; INFINITY is no limit.
    pub maximum_current: [Real; 6],
}

/// Currents for wanted forces.
#[repr(C)]
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct CurrentsResult {
    /// Set to sizeof(dyn_currents_result) before the call.
    pub struct_size: usize,
    /// Current of each coil, A, never beyond its limit.
    pub current: [Real; 6],
    /// The forces that they make, N.
    pub actuator_force: [Real; 6],
    /// Share of the wanted forces that is left, the same for all six; 1 without saturation.
    pub factor: Real,
    /// The leg whose coil is at its limit, 0 to 5; -1 without saturation.
    pub saturated_leg: i32,
}

/// What the baked model's platform file says that actuators and joints may do, and the directions of the rods at home, for
/// dyn_monitor and dyn_check_limits; what it does not limit is INFINITY (minima -INFINITY), to be filled in where wanted.
///
/// DYN_STATUS_NOT_IN_MODEL for models with parameters at run time, which no platform file is behind.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dyn_model_limits(
    model: *const Model,
    limits: *mut Limits,
    info: *mut Info,
) -> Status {
    // SAFETY: the caller keeps what the crate says.
    unsafe { convert(limits, info, || in_model(structure(model)?.platform()?.limits().map(Into::into))) }
}

/// The voice coils of the baked model's platform file, for dyn_currents: force constants, and the currents of the largest
/// forces, INFINITY for legs without a largest force.
///
/// DYN_STATUS_NOT_IN_MODEL where the platform file does not give all six force constants, and for models with parameters at
/// run time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dyn_model_voice_coils(
    model: *const Model,
    coils: *mut Coils,
    info: *mut Info,
) -> Status {
    // SAFETY: the caller keeps what the crate says.
    unsafe { convert(coils, info, || in_model(structure(model)?.platform()?.voice_coils().map(Into::into))) }
}

const QUANTITIES: &[(Quantity, &CStr)] = &[
    (Quantity::ActuatorLength, c"actuator_length"),
    (Quantity::ActuatorVelocity, c"actuator_velocity"),
    (Quantity::ActuatorForce, c"actuator_force"),
    (Quantity::HookeJointAngle, c"hooke_joint_angle"),
    (Quantity::PlatformJointAngle, c"platform_joint_angle"),
    (Quantity::Conditioning, c"conditioning"),
];

/// The name of a quantity: a static string, never null, also for numbers that are no quantity.
#[unsafe(no_mangle)]
pub extern "C" fn dyn_quantity_text(quantity: i32) -> *const c_char {
    text(QUANTITIES, |known| known as i32 == quantity, c"not a quantity of this library")
}

fn in_model<T>(carried: Option<T>) -> Result<T, Refusal> {
    carried.ok_or(Refusal::of(Status::NotInModel))
}

/// Margins of stroke, rate, force, joint angles and conditioning. Depends on poses, velocities and `actuator_force`. A state
/// beyond its limits is no error here: see dyn_check_limits.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dyn_monitor(
    model: *const Model,
    inputs: *const Inputs,
    limits: *const Limits,
    result: *mut Margins,
    info: *mut Info,
) -> Status {
    // SAFETY: the caller keeps what the crate says.
    unsafe { convert(result, info, || Ok(monitor(model, inputs, limits)?.into())) }
}

/// DYN_STATUS_BEYOND_LIMIT for the first quantity that is beyond its limit: `info.quantity` and `info.leg` say which,
/// `info.value` is the margin, negative. Depends on poses, velocities and `actuator_force`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dyn_check_limits(
    model: *const Model,
    inputs: *const Inputs,
    limits: *const Limits,
    info: *mut Info,
) -> Status {
    // SAFETY: the caller keeps what the crate says.
    unsafe { explain(info, || Ok(monitor(model, inputs, limits)?.check()?)) }
}

/// # Safety
/// As the crate says.
unsafe fn monitor(
    model: *const Model,
    inputs: *const Inputs,
    limits: *const Limits,
) -> Result<Monitor<Real>, Refusal> {
    // SAFETY: passed on to the caller.
    let (platform, s, limits): (_, crate::inputs::States, dyn_runtime::Limits<Real>) =
        unsafe { (structure(model)?.platform()?, structure(inputs)?.into(), structure(limits)?.into()) };
    Ok(with_hexapod!(&platform, |hexapod| hexapod.monitor(&s.base, &s.platform, &s.actuator_force, &limits))?)
}

/// Currents for wanted forces, N. Where one coil would be beyond its limit, all six forces are scaled by one factor, so that
/// the wrench on the platform keeps its direction; this is no error, `result.saturated_leg` tells.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dyn_currents(
    coils: *const Coils,
    actuator_force: *const Real,
    result: *mut CurrentsResult,
    info: *mut Info,
) -> Status {
    // SAFETY: the caller keeps what the crate says.
    unsafe {
        convert(result, info, || {
            let coils = VoiceCoils::from(structure(coils)?);
            Ok(coils.currents(&Vector6::from(array::<6>(actuator_force)?))?.into())
        })
    }
}

impl From<&Limits> for dyn_runtime::Limits<Real> {
    fn from(limits: &Limits) -> Self {
        Self {
            minimum_length_m: limits.minimum_length,
            maximum_length_m: limits.maximum_length,
            maximum_velocity_m_s: limits.maximum_velocity,
            maximum_force_n: limits.maximum_force,
            maximum_hooke_joint_angle_rad: limits.maximum_hooke_joint_angle,
            maximum_platform_joint_angle_rad: limits.maximum_platform_joint_angle,
            home_direction_in_base: limits.home_direction_in_base,
            home_direction_in_platform: limits.home_direction_in_platform,
            minimum_condition_bound: limits.minimum_condition_bound,
        }
    }
}

impl From<dyn_runtime::Limits<Real>> for Limits {
    fn from(limits: dyn_runtime::Limits<Real>) -> Self {
        Self {
            struct_size: size_of::<Self>(),
            minimum_length: limits.minimum_length_m,
            maximum_length: limits.maximum_length_m,
            maximum_velocity: limits.maximum_velocity_m_s,
            maximum_force: limits.maximum_force_n,
            maximum_hooke_joint_angle: limits.maximum_hooke_joint_angle_rad,
            maximum_platform_joint_angle: limits.maximum_platform_joint_angle_rad,
            home_direction_in_base: limits.home_direction_in_base,
            home_direction_in_platform: limits.home_direction_in_platform,
            minimum_condition_bound: limits.minimum_condition_bound,
        }
    }
}

impl From<&Coils> for VoiceCoils<Real> {
    fn from(coils: &Coils) -> Self {
        Self { force_constant_n_per_a: coils.force_constant, maximum_current_a: coils.maximum_current }
    }
}

impl From<VoiceCoils<Real>> for Coils {
    fn from(coils: VoiceCoils<Real>) -> Self {
        Self {
            struct_size: size_of::<Self>(),
            force_constant: coils.force_constant_n_per_a,
            maximum_current: coils.maximum_current_a,
        }
    }
}

impl From<dyn_runtime::Quantity> for Quantity {
    fn from(quantity: dyn_runtime::Quantity) -> Self {
        match quantity {
            dyn_runtime::Quantity::ActuatorLength => Self::ActuatorLength,
            dyn_runtime::Quantity::ActuatorVelocity => Self::ActuatorVelocity,
            dyn_runtime::Quantity::ActuatorForce => Self::ActuatorForce,
            dyn_runtime::Quantity::HookeJointAngle => Self::HookeJointAngle,
            dyn_runtime::Quantity::PlatformJointAngle => Self::PlatformJointAngle,
            dyn_runtime::Quantity::Conditioning => Self::Conditioning,
        }
    }
}

impl From<Monitor<Real>> for Margins {
    fn from(monitor: Monitor<Real>) -> Self {
        // Margins stand in the order of the quantities.
        Self {
            struct_size: size_of::<Self>(),
            margin: monitor.margins.map(|Margin { margin, .. }| margin),
            leg: monitor.margins.map(|Margin { leg, .. }| leg.map_or(-1, |leg| leg as i32)),
        }
    }
}

impl From<Currents<Real>> for CurrentsResult {
    fn from(currents: Currents<Real>) -> Self {
        Self {
            struct_size: size_of::<Self>(),
            current: currents.current_a.into(),
            actuator_force: currents.actuator_force_n.into(),
            factor: currents.saturation.map_or(1.0, |saturation| saturation.factor),
            saturated_leg: currents.saturation.map_or(-1, |saturation| saturation.leg as i32),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every number of a platform's limits and coils comes back from the structs of C.
    #[test]
    fn there_and_back() {
        let limits = dyn_runtime::Limits {
            minimum_length_m: [1.0; 6],
            maximum_length_m: [2.0; 6],
            maximum_velocity_m_s: [3.0; 6],
            maximum_force_n: [4.0; 6],
            maximum_hooke_joint_angle_rad: [5.0; 6],
            maximum_platform_joint_angle_rad: [6.0; 6],
            home_direction_in_base: [[7.0, 8.0, 9.0]; 6],
            home_direction_in_platform: [[10.0, 11.0, 12.0]; 6],
            minimum_condition_bound: 13.0,
        };
        assert_eq!(dyn_runtime::Limits::from(&Limits::from(limits)), limits);
        let coils = VoiceCoils { force_constant_n_per_a: [1.0; 6], maximum_current_a: [2.0; 6] };
        assert_eq!(VoiceCoils::from(&Coils::from(coils)), coils);
    }
}
