//! The dynamics, one function per row of the model's table.

use crate::inputs::Inputs;
use crate::model::{Model, with_hexapod};
use crate::outputs::{
    CoriolisMatrices, Energy, EquationOfMotion, LegKinematics, Matrices, PassiveForces, StiffnessMatrices,
    rows,
};
use crate::pointers::answer;
use crate::real::Real;
use crate::status::{Info, Status};

/// (u.a)^2 of each leg: 1 where the rod lies along its actuator, 0 where it is perpendicular, negative out of reach (which is no
/// error here). Depends on the poses.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dyn_rod_alignment(
    model: *const Model,
    inputs: *const Inputs,
    alignment: *mut [Real; 6],
    info: *mut Info,
) -> Status {
    // SAFETY: the caller keeps what the crate says.
    unsafe {
        answer(model, inputs, alignment, info, |platform, s| {
            with_hexapod!(platform, |hexapod| hexapod.rod_alignment(&s.base, &s.platform).map(Into::into))
        })
    }
}

/// Lengths, rates and accelerations of the actuators, directions and joints of the rods. Depends on poses, velocities and
/// accelerations of both bodies.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dyn_leg_kinematics(
    model: *const Model,
    inputs: *const Inputs,
    result: *mut LegKinematics,
    info: *mut Info,
) -> Status {
    // SAFETY: the caller keeps what the crate says.
    unsafe {
        answer(model, inputs, result, info, |platform, s| {
            with_hexapod!(platform, |hexapod| hexapod
                .leg_kinematics(&s.base, &s.platform, &s.platform_acceleration)
                .map(Into::into))
        })
    }
}

/// J_dp, d' = J_dp v_p - J_db v_b; no unit, then m. Depends on the poses.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dyn_jacobian_dp(
    model: *const Model,
    inputs: *const Inputs,
    jacobian: *mut [[Real; 6]; 6],
    info: *mut Info,
) -> Status {
    // SAFETY: the caller keeps what the crate says.
    unsafe {
        answer(model, inputs, jacobian, info, |platform, s| {
            with_hexapod!(platform, |hexapod| hexapod.jacobian_dp(&s.base, &s.platform).map(rows))
        })
    }
}

/// J_db, d' = J_dp v_p - J_db v_b; no unit, then m. Depends on the poses.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dyn_jacobian_db(
    model: *const Model,
    inputs: *const Inputs,
    jacobian: *mut [[Real; 6]; 6],
    info: *mut Info,
) -> Status {
    // SAFETY: the caller keeps what the crate says.
    unsafe {
        answer(model, inputs, jacobian, info, |platform, s| {
            with_hexapod!(platform, |hexapod| hexapod.jacobian_db(&s.base, &s.platform).map(rows))
        })
    }
}

/// M_p, kg, kg m, kg m^2, O; symmetric. Depends on the poses.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dyn_mass_matrix_p(
    model: *const Model,
    inputs: *const Inputs,
    matrix: *mut [[Real; 6]; 6],
    info: *mut Info,
) -> Status {
    // SAFETY: the caller keeps what the crate says.
    unsafe {
        answer(model, inputs, matrix, info, |platform, s| {
            with_hexapod!(platform, |hexapod| hexapod.mass_matrix_p(&s.base, &s.platform).map(rows))
        })
    }
}

/// M_b, for the base's acceleration, on the right side of the equation of motion; not symmetric. Depends on the poses.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dyn_mass_matrix_b(
    model: *const Model,
    inputs: *const Inputs,
    matrix: *mut [[Real; 6]; 6],
    info: *mut Info,
) -> Status {
    // SAFETY: the caller keeps what the crate says.
    unsafe {
        answer(model, inputs, matrix, info, |platform, s| {
            with_hexapod!(platform, |hexapod| hexapod.mass_matrix_b(&s.base, &s.platform).map(rows))
        })
    }
}

/// C_p and C_b. Depends on poses and velocities.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dyn_coriolis_matrices(
    model: *const Model,
    inputs: *const Inputs,
    result: *mut CoriolisMatrices,
    info: *mut Info,
) -> Status {
    // SAFETY: the caller keeps what the crate says.
    unsafe {
        answer(model, inputs, result, info, |platform, s| {
            with_hexapod!(platform, |hexapod| hexapod.coriolis_matrices(&s.base, &s.platform).map(Into::into))
        })
    }
}

/// K_p and K_b, linearised. Depends on the poses.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dyn_stiffness_matrices(
    model: *const Model,
    inputs: *const Inputs,
    result: *mut StiffnessMatrices,
    info: *mut Info,
) -> Status {
    // SAFETY: the caller keeps what the crate says.
    unsafe {
        answer(model, inputs, result, info, |platform, s| {
            with_hexapod!(platform, |hexapod| hexapod
                .stiffness_matrices(&s.base, &s.platform)
                .map(Into::into))
        })
    }
}

/// M_p, C_p, J_dp, M_b, C_b and J_db together. Depends on poses and velocities.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dyn_matrices(
    model: *const Model,
    inputs: *const Inputs,
    result: *mut Matrices,
    info: *mut Info,
) -> Status {
    // SAFETY: the caller keeps what the crate says.
    unsafe {
        answer(model, inputs, result, info, |platform, s| {
            with_hexapod!(platform, |hexapod| hexapod.matrices(&s.base, &s.platform).map(Into::into))
        })
    }
}

/// Gravity, springs and dampers. Depends on poses and velocities.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dyn_passive_forces(
    model: *const Model,
    inputs: *const Inputs,
    result: *mut PassiveForces,
    info: *mut Info,
) -> Status {
    // SAFETY: the caller keeps what the crate says.
    unsafe {
        answer(model, inputs, result, info, |platform, s| {
            with_hexapod!(platform, |hexapod| hexapod.passive_forces(&s.base, &s.platform).map(Into::into))
        })
    }
}

/// C_p v_p - C_b v_b + G + J_dp^T (k_e (d - d0) + c_e d'), N and N m, O: everything on the left side of the equation of motion
/// except M_p v_p'. Depends on poses and velocities.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dyn_bias(
    model: *const Model,
    inputs: *const Inputs,
    force: *mut [Real; 6],
    info: *mut Info,
) -> Status {
    // SAFETY: the caller keeps what the crate says.
    unsafe {
        answer(model, inputs, force, info, |platform, s| {
            with_hexapod!(platform, |hexapod| hexapod.bias(&s.base, &s.platform).map(Into::into))
        })
    }
}

/// Every term of the equation of motion. Depends on poses and velocities.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dyn_equation_of_motion(
    model: *const Model,
    inputs: *const Inputs,
    result: *mut EquationOfMotion,
    info: *mut Info,
) -> Status {
    // SAFETY: the caller keeps what the crate says.
    unsafe {
        answer(model, inputs, result, info, |platform, s| {
            with_hexapod!(platform, |hexapod| hexapod
                .equation_of_motion(&s.base, &s.platform)
                .map(Into::into))
        })
    }
}

/// Forces of the actuators, N, that give the platform `platform_acceleration`. Depends on poses, velocities and accelerations of
/// both bodies and on the external wrench.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dyn_inverse_dynamics(
    model: *const Model,
    inputs: *const Inputs,
    force: *mut [Real; 6],
    info: *mut Info,
) -> Status {
    // SAFETY: the caller keeps what the crate says.
    unsafe {
        answer(model, inputs, force, info, |platform, s| {
            with_hexapod!(platform, |hexapod| hexapod
                .inverse_dynamics(&s.base, &s.platform, &s.platform_acceleration, &s.external_wrench)
                .map(Into::into))
        })
    }
}

/// Acceleration of the platform [r_p''; w_p'], m/s^2, rad/s^2, O, under `actuator_force`. Depends on poses and velocities of both
/// bodies, the base's acceleration, actuator forces and external wrench.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dyn_forward_dynamics(
    model: *const Model,
    inputs: *const Inputs,
    acceleration: *mut [Real; 6],
    info: *mut Info,
) -> Status {
    // SAFETY: the caller keeps what the crate says.
    unsafe {
        answer(model, inputs, acceleration, info, |platform, s| {
            with_hexapod!(platform, |hexapod| hexapod
                .forward_dynamics(&s.base, &s.platform, &s.actuator_force, &s.external_wrench)
                .map(|a| a.to_vector().into()))
        })
    }
}

/// Kinetic and potential energy. Depends on poses and velocities.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dyn_energy(
    model: *const Model,
    inputs: *const Inputs,
    result: *mut Energy,
    info: *mut Info,
) -> Status {
    // SAFETY: the caller keeps what the crate says.
    unsafe {
        answer(model, inputs, result, info, |platform, s| {
            with_hexapod!(platform, |hexapod| hexapod.energy(&s.base, &s.platform).map(Into::into))
        })
    }
}
