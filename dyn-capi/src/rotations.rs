//! Rotation matrices from what sensors and planners speak: unit quaternions and the paper's angles.

use dyn_runtime::nalgebra::{Rotation3, Vector3};
use dyn_runtime::{Pose, angles};

use crate::pointers::{array, convert};
use crate::real::Real;
use crate::status::{Info, InputName, Refusal, Status};

/// Rotation matrix, body to O, from the unit quaternion [w, x, y, z] that turns body coordinates into O coordinates.
///
/// What rounding left of the norm (single precision is good enough) is divided out: the matrix is orthonormal.
///
/// DYN_STATUS_NON_FINITE, or DYN_STATUS_NOT_A_ROTATION (`info.value` is | |q|^2 - 1 |, `info.limit` how much is forgiven) if
/// its norm is not 1.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dyn_rotation_from_quaternion(
    quaternion: *const Real,
    rotation: *mut [[Real; 3]; 3],
    info: *mut Info,
) -> Status {
    // SAFETY: the caller keeps what the crate says.
    unsafe {
        convert(rotation, info, || {
            let quaternion = finite(array(quaternion)?, InputName::Quaternion)?;
            let pose = Pose::from_quaternion(Vector3::zeros(), quaternion).map_err(|defect| Refusal {
                value: (defect.norm_squared as Real - 1.0).abs(),
                limit: <Real as dyn_runtime::Real>::MAX_ROTATION_DEVIATION,
                ..Refusal::of_input(Status::NotARotation, InputName::Quaternion)
            })?;
            Ok(rows(&pose.rotation))
        })
    }
}

/// Rotation matrix, body to O, from the paper's angles [c1, c2, c3], rad: R = Rz(c3) Ry(c2) Rx(c1).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dyn_rotation_from_angles(
    angles: *const Real,
    rotation: *mut [[Real; 3]; 3],
    info: *mut Info,
) -> Status {
    // SAFETY: the caller keeps what the crate says.
    unsafe {
        convert(rotation, info, || Ok(rows(&angles::rotation(finite(array(angles)?, InputName::Angles)?))))
    }
}

/// Angular velocity w, rad/s, O, from the paper's angles (rad) and their rates (rad/s), which it is not itself.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dyn_angular_velocity(
    angles: *const Real,
    rates: *const Real,
    angular_velocity: *mut [Real; 3],
    info: *mut Info,
) -> Status {
    // SAFETY: the caller keeps what the crate says.
    unsafe {
        convert(angular_velocity, info, || {
            let angles = finite(array(angles)?, InputName::Angles)?;
            let rates = finite(array(rates)?, InputName::AngleRates)?;
            let velocity: [Real; 3] = angles::angular_velocity(angles, rates).into();
            finite_result(velocity)
        })
    }
}

/// Rates of the paper's angles, rad/s, from angles (rad) and angular velocity (rad/s, O).
///
/// DYN_STATUS_GIMBAL_LOCK where they have none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dyn_angle_rates(
    angles: *const Real,
    angular_velocity: *const Real,
    rates: *mut [Real; 3],
    info: *mut Info,
) -> Status {
    // SAFETY: the caller keeps what the crate says.
    unsafe {
        convert(rates, info, || {
            let angles = finite(array(angles)?, InputName::Angles)?;
            let velocity = finite(array(angular_velocity)?, InputName::AngularVelocity)?;
            let rates = angles::angle_rates(angles, Vector3::from(velocity)).map_err(|lock| Refusal {
                value: lock.cos_c2 as Real,
                limit: <Real as dyn_runtime::Real>::MIN_COS_C2,
                ..Refusal::of_input(Status::GimbalLock, InputName::Angles)
            })?;
            finite_result(rates)
        })
    }
}

fn rows(rotation: &Rotation3<Real>) -> [[Real; 3]; 3] {
    rotation.matrix().transpose().into()
}

fn finite<const N: usize>(numbers: [Real; N], input: InputName) -> Result<[Real; N], Refusal> {
    match numbers.iter().position(|number| !number.is_finite()) {
        None => Ok(numbers),
        Some(element) => {
            Err(Refusal { element: element as i32, ..Refusal::of_input(Status::NonFinite, input) })
        }
    }
}

fn finite_result<const N: usize>(numbers: [Real; N]) -> Result<[Real; N], Refusal> {
    if numbers.iter().all(|number| number.is_finite()) {
        Ok(numbers)
    } else {
        Err(Refusal::of(Status::NonFiniteResult))
    }
}
