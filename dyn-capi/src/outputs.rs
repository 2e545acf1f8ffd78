//! Results that have several parts: structs of plain arrays, row-major.

use core::mem::size_of;

use dyn_runtime::nalgebra::{Matrix6, Vector3};

use crate::real::Real;

/// Rows of a matrix, as C stores it.
pub(crate) fn rows(matrix: Matrix6<Real>) -> [[Real; 6]; 6] {
    matrix.transpose().into()
}

fn per_leg(vectors: [Vector3<Real>; 6]) -> [[Real; 3]; 6] {
    vectors.map(Into::into)
}

/// Where the legs are and how they move; vectors in O.
#[repr(C)]
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct LegKinematics {
    /// Set to sizeof(dyn_leg_kinematics_result) before the call.
    pub struct_size: usize,
    /// Actuator length d, m.
    pub actuator_length: [Real; 6],
    /// d', m/s.
    pub actuator_velocity: [Real; 6],
    /// d'', m/s^2.
    pub actuator_acceleration: [Real; 6],
    /// Unit vector u along the rod (UPS: the leg), towards the platform joint.
    pub rod_direction: [[Real; 3]; 6],
    /// Centre of the Hooke joint between actuator and rod (UPS: of the joint on the base), m.
    pub hooke_joint_position: [[Real; 3]; 6],
    /// Centre of the joint between rod and platform, m.
    pub platform_joint_position: [[Real; 3]; 6],
    /// Angular velocity of the platform relative to the rod (UPS: leg), w_p - w_s, rad/s.
    pub platform_joint_rate: [[Real; 3]; 6],
}

impl From<dyn_runtime::LegKinematics<Real>> for LegKinematics {
    fn from(result: dyn_runtime::LegKinematics<Real>) -> Self {
        Self {
            struct_size: size_of::<Self>(),
            actuator_length: result.actuator_length_m.into(),
            actuator_velocity: result.actuator_velocity_m_s.into(),
            actuator_acceleration: result.actuator_acceleration_m_s2.into(),
            rod_direction: per_leg(result.rod_direction),
            hooke_joint_position: per_leg(result.hooke_joint_position_m),
            platform_joint_position: per_leg(result.platform_joint_position_m),
            platform_joint_rate: per_leg(result.platform_joint_rate_rad_s),
        }
    }
}

/// Forces that neither acceleration nor actuators make, as they stand on the left side of the equation of motion: N, then N m
/// about P's origin, O.
#[repr(C)]
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct PassiveForces {
    /// Set to sizeof(dyn_passive_forces_result) before the call.
    pub struct_size: usize,
    /// What holds the weight of all bodies up.
    pub gravity_force: [Real; 6],
    /// J_dp^T k_e (d - d0).
    pub spring_force: [Real; 6],
    /// J_dp^T c_e d'.
    pub damping_force: [Real; 6],
}

impl From<dyn_runtime::PassiveForces<Real>> for PassiveForces {
    fn from(result: dyn_runtime::PassiveForces<Real>) -> Self {
        Self {
            struct_size: size_of::<Self>(),
            gravity_force: result.gravity_force.into(),
            spring_force: result.spring_force.into(),
            damping_force: result.damping_force.into(),
        }
    }
}

/// Velocity terms C_p v_p and C_b v_b as matrices; M_p' - 2 C_p is skew.
#[repr(C)]
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct CoriolisMatrices {
    /// Set to sizeof(dyn_coriolis_matrices_result) before the call.
    pub struct_size: usize,
    /// C_p.
    pub coriolis_matrix_p: [[Real; 6]; 6],
    /// C_b.
    pub coriolis_matrix_b: [[Real; 6]; 6],
}

impl From<dyn_runtime::CoriolisMatrices<Real>> for CoriolisMatrices {
    fn from(result: dyn_runtime::CoriolisMatrices<Real>) -> Self {
        Self {
            struct_size: size_of::<Self>(),
            coriolis_matrix_p: rows(result.coriolis_matrix_p),
            coriolis_matrix_b: rows(result.coriolis_matrix_b),
        }
    }
}

/// The leaf springs, linearised.
#[repr(C)]
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct StiffnessMatrices {
    /// Set to sizeof(dyn_stiffness_matrices_result) before the call.
    pub struct_size: usize,
    /// K_p = J_dp^T k_e J_dp.
    pub stiffness_matrix_p: [[Real; 6]; 6],
    /// K_b = J_dp^T k_e J_db.
    pub stiffness_matrix_b: [[Real; 6]; 6],
}

impl From<dyn_runtime::StiffnessMatrices<Real>> for StiffnessMatrices {
    fn from(result: dyn_runtime::StiffnessMatrices<Real>) -> Self {
        Self {
            struct_size: size_of::<Self>(),
            stiffness_matrix_p: rows(result.stiffness_matrix_p),
            stiffness_matrix_b: rows(result.stiffness_matrix_b),
        }
    }
}

/// Mass, Coriolis and Jacobian matrices, from one shared evaluation.
#[repr(C)]
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Matrices {
    /// Set to sizeof(dyn_matrices_result) before the call.
    pub struct_size: usize,
    /// M_p.
    pub mass_matrix_p: [[Real; 6]; 6],
    /// C_p.
    pub coriolis_matrix_p: [[Real; 6]; 6],
    /// J_dp.
    pub jacobian_dp: [[Real; 6]; 6],
    /// M_b.
    pub mass_matrix_b: [[Real; 6]; 6],
    /// C_b.
    pub coriolis_matrix_b: [[Real; 6]; 6],
    /// J_db.
    pub jacobian_db: [[Real; 6]; 6],
}

impl From<dyn_runtime::Matrices<Real>> for Matrices {
    fn from(result: dyn_runtime::Matrices<Real>) -> Self {
        Self {
            struct_size: size_of::<Self>(),
            mass_matrix_p: rows(result.mass_matrix_p),
            coriolis_matrix_p: rows(result.coriolis_matrix_p),
            jacobian_dp: rows(result.jacobian_dp),
            mass_matrix_b: rows(result.mass_matrix_b),
            coriolis_matrix_b: rows(result.coriolis_matrix_b),
            jacobian_db: rows(result.jacobian_db),
        }
    }
}

/// Every term of the equation of motion, from one shared evaluation:
/// M_p v_p' + bias = J_dp^T F + [F_D; M_D + (R_p r_c) x F_D] + M_b v_b'.
#[repr(C)]
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct EquationOfMotion {
    /// Set to sizeof(dyn_equation_of_motion_result) before the call.
    pub struct_size: usize,
    /// M_p.
    pub mass_matrix_p: [[Real; 6]; 6],
    /// C_p.
    pub coriolis_matrix_p: [[Real; 6]; 6],
    /// K_p.
    pub stiffness_matrix_p: [[Real; 6]; 6],
    /// J_dp.
    pub jacobian_dp: [[Real; 6]; 6],
    /// M_b.
    pub mass_matrix_b: [[Real; 6]; 6],
    /// C_b.
    pub coriolis_matrix_b: [[Real; 6]; 6],
    /// K_b.
    pub stiffness_matrix_b: [[Real; 6]; 6],
    /// J_db.
    pub jacobian_db: [[Real; 6]; 6],
    /// As in dyn_passive_forces, N and N m, O.
    pub gravity_force: [Real; 6],
    /// As in dyn_passive_forces, N and N m, O.
    pub spring_force: [Real; 6],
    /// As in dyn_passive_forces, N and N m, O.
    pub damping_force: [Real; 6],
    /// C_p v_p - C_b v_b + gravity_force + spring_force + damping_force, N and N m, O.
    pub bias: [Real; 6],
}

impl From<dyn_runtime::EquationOfMotion<Real>> for EquationOfMotion {
    fn from(result: dyn_runtime::EquationOfMotion<Real>) -> Self {
        Self {
            struct_size: size_of::<Self>(),
            mass_matrix_p: rows(result.mass_matrix_p),
            coriolis_matrix_p: rows(result.coriolis_matrix_p),
            stiffness_matrix_p: rows(result.stiffness_matrix_p),
            jacobian_dp: rows(result.jacobian_dp),
            mass_matrix_b: rows(result.mass_matrix_b),
            coriolis_matrix_b: rows(result.coriolis_matrix_b),
            stiffness_matrix_b: rows(result.stiffness_matrix_b),
            jacobian_db: rows(result.jacobian_db),
            gravity_force: result.gravity_force.into(),
            spring_force: result.spring_force.into(),
            damping_force: result.damping_force.into(),
            bias: result.bias.into(),
        }
    }
}

/// Energy of payload, rods, movers and springs.
#[repr(C)]
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Energy {
    /// Set to sizeof(dyn_energy_result) before the call.
    pub struct_size: usize,
    /// T, J, of the motion in O.
    pub kinetic_energy: Real,
    /// V, J: gravity, by height over O's origin along g, and springs.
    pub potential_energy: Real,
}

impl From<dyn_runtime::Energy<Real>> for Energy {
    fn from(result: dyn_runtime::Energy<Real>) -> Self {
        Self {
            struct_size: size_of::<Self>(),
            kinetic_energy: result.kinetic_j,
            potential_energy: result.potential_j,
        }
    }
}
