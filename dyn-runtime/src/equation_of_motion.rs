//! The whole equation of motion (49) in one shared call.

use nalgebra::{Matrix6, Vector6};

use crate::error::Error;
use crate::evaluate::evaluate;
use crate::hexapod::{Hexapod, arrays};
use crate::kernels;
use crate::real::Real;
use crate::state::{BaseMotion, PlatformState};

/// Every term of (49), O axes:
///
/// ```text
/// M_p v_p' + bias = J_dp^T F + W_ext + M_b v_b'
/// bias = C_p v_p - C_b v_b + gravity_force + spring_force + damping_force
/// W_ext = [F_D; M_D + (R_p r_c) x F_D]
/// ```
///
/// The stiffness matrices are for linearised models; the exact springs stand in `spring_force`.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct EquationOfMotion<T = f64> {
    /// M_p, as [`Hexapod::mass_matrix_p`] gives it.
    pub mass_matrix_p: Matrix6<T>,
    /// C_p, as in [`CoriolisMatrices`](crate::CoriolisMatrices).
    pub coriolis_matrix_p: Matrix6<T>,
    /// K_p, as in [`StiffnessMatrices`](crate::StiffnessMatrices).
    pub stiffness_matrix_p: Matrix6<T>,
    /// J_dp, as [`Hexapod::jacobian_dp`] gives it.
    pub jacobian_dp: Matrix6<T>,
    /// M_b, as [`Hexapod::mass_matrix_b`] gives it.
    pub mass_matrix_b: Matrix6<T>,
    /// C_b, as in [`CoriolisMatrices`](crate::CoriolisMatrices).
    pub coriolis_matrix_b: Matrix6<T>,
    /// K_b, as in [`StiffnessMatrices`](crate::StiffnessMatrices).
    pub stiffness_matrix_b: Matrix6<T>,
    /// J_db, as [`Hexapod::jacobian_db`] gives it.
    pub jacobian_db: Matrix6<T>,
    /// G, N and N m, O, as in [`PassiveForces`](crate::PassiveForces).
    pub gravity_force: Vector6<T>,
    /// `J_dp^T k_e (d - d0)`, N and N m, O.
    pub spring_force: Vector6<T>,
    /// `J_dp^T c_e d'`, N and N m, O.
    pub damping_force: Vector6<T>,
    /// As [`Hexapod::bias`] gives it, N and N m, O.
    pub bias: Vector6<T>,
}

impl<M: kernels::RodAlignment<T>, T: Real> Hexapod<M, T> {
    /// Every term of the equation of motion (49), from one shared evaluation. Depends on poses and
    /// velocities.
    ///
    /// # Errors
    /// See [`Hexapod`].
    pub fn equation_of_motion(
        &self,
        base: &BaseMotion<T>,
        platform: &PlatformState<T>,
    ) -> Result<EquationOfMotion<T>, Error>
    where
        M: kernels::EquationOfMotion<T>,
    {
        let (b, p) = arrays(base, platform);
        self.check_states(&b, &p)?;
        evaluate!(self.model.equation_of_motion(
            b.position, b.rotation, b.velocity, p.position, p.rotation, p.velocity
        ) -> EquationOfMotion {
            mass_matrix_p, coriolis_matrix_p, stiffness_matrix_p, jacobian_dp, mass_matrix_b,
            coriolis_matrix_b, stiffness_matrix_b, jacobian_db, gravity_force, spring_force, damping_force,
            bias,
        })
    }
}
