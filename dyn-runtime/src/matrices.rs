//! The 6x6 matrices of the equation of motion (49): Jacobians, masses, velocity terms, stiffnesses.
//!
//! Subscript p multiplies the platform's `[r_p'; w_p]`, subscript b the base's `[r_b'; w_b]`, all in O axes.
//! So blocks have the units of translational and rotational quantities: in a mass matrix kg, kg m and kg m^2.

use nalgebra::Matrix6;

use crate::error::Error;
use crate::evaluate::evaluate;
use crate::hexapod::{Hexapod, arrays};
use crate::kernels;
use crate::real::Real;
use crate::state::{BaseMotion, PlatformState};

/// Velocity terms in their natural factorisation: `C_p v_p - C_b v_b` are the exact velocity terms of (49),
/// and `M_p' - 2 C_p` is skew-symmetric.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct CoriolisMatrices<T = f64> {
    /// C_p, N per m/s or rad/s (forces) and N m (moments).
    pub coriolis_matrix_p: Matrix6<T>,
    /// C_b, likewise.
    pub coriolis_matrix_b: Matrix6<T>,
}

/// The paper's stiffnesses for small displacements of platform and base. They leave out the preload's share,
/// so they are not the tangent stiffness of the equation of motion.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct StiffnessMatrices<T = f64> {
    /// `K_p = J_dp^T k_e J_dp`, N/m, N and N m.
    pub stiffness_matrix_p: Matrix6<T>,
    /// `K_b = J_dp^T k_e J_db`, likewise.
    pub stiffness_matrix_b: Matrix6<T>,
}

/// Masses, velocity terms and Jacobians from one shared evaluation.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Matrices<T = f64> {
    /// M_p, as [`Hexapod::mass_matrix_p`] gives it.
    pub mass_matrix_p: Matrix6<T>,
    /// C_p, as in [`CoriolisMatrices`].
    pub coriolis_matrix_p: Matrix6<T>,
    /// J_dp, as [`Hexapod::jacobian_dp`] gives it.
    pub jacobian_dp: Matrix6<T>,
    /// M_b, as [`Hexapod::mass_matrix_b`] gives it.
    pub mass_matrix_b: Matrix6<T>,
    /// C_b, as in [`CoriolisMatrices`].
    pub coriolis_matrix_b: Matrix6<T>,
    /// J_db, as [`Hexapod::jacobian_db`] gives it.
    pub jacobian_db: Matrix6<T>,
}

impl<M: kernels::RodAlignment<T>, T: Real> Hexapod<M, T> {
    /// J_dp, of `d' = J_dp v_p - J_db v_b` (30), (32): a row per leg, `[u; (R_p p) x u]^T / (u.a)`; three
    /// columns without unit, three in m. Depends on the poses.
    ///
    /// # Errors
    /// See [`Hexapod`].
    pub fn jacobian_dp(&self, base: &BaseMotion<T>, platform: &PlatformState<T>) -> Result<Matrix6<T>, Error>
    where
        M: kernels::JacobianDp<T>,
    {
        let (b, p) = arrays(base, platform);
        self.check_poses(&b, &p)?;
        evaluate!(self.model.jacobian_dp(b.position, b.rotation, p.position, p.rotation) -> jacobian_dp)
    }

    /// J_db, of `d' = J_dp v_p - J_db v_b` (30), (31): a row per leg, `[u; (R_b b + d a) x u]^T / (u.a)`;
    /// three columns without unit, three in m. Depends on the poses.
    ///
    /// # Errors
    /// See [`Hexapod`].
    pub fn jacobian_db(&self, base: &BaseMotion<T>, platform: &PlatformState<T>) -> Result<Matrix6<T>, Error>
    where
        M: kernels::JacobianDb<T>,
    {
        let (b, p) = arrays(base, platform);
        self.check_poses(&b, &p)?;
        evaluate!(self.model.jacobian_db(b.position, b.rotation, p.position, p.rotation) -> jacobian_db)
    }

    /// M_p, of payload, rods and movers, for the platform's acceleration in (49): kg, kg m, kg m^2;
    /// symmetric and positive definite. Depends on the poses.
    ///
    /// ```
    /// use dyn_runtime::nalgebra::Vector3;
    /// use dyn_runtime::{BaseMotion, Hexapod, PlatformState, Pose, models::Uhp2016};
    ///
    /// let base = BaseMotion::at_rest(Pose::identity());
    /// let home = Pose::from_paper_angles(Vector3::new(0.0, 0.0, 0.382), [0.0; 3]);
    /// let mass_matrix_p = Hexapod::new(Uhp2016).mass_matrix_p(&base, &PlatformState::at_rest(home))?;
    /// // Along the actuators, payload, rods and movers move as one: 6.092 + 6 (1.024 + 0.611) kg.
    /// assert!((mass_matrix_p[(2, 2)] - 15.902).abs() < 1e-9);
    /// # Ok::<(), dyn_runtime::Error>(())
    /// ```
    ///
    /// # Errors
    /// See [`Hexapod`].
    pub fn mass_matrix_p(
        &self,
        base: &BaseMotion<T>,
        platform: &PlatformState<T>,
    ) -> Result<Matrix6<T>, Error>
    where
        M: kernels::MassMatrixP<T>,
    {
        let (b, p) = arrays(base, platform);
        self.check_poses(&b, &p)?;
        evaluate!(self.model.mass_matrix_p(b.position, b.rotation, p.position, p.rotation) -> mass_matrix_p)
    }

    /// M_b, for the base's acceleration, on the right side of (49): kg, kg m, kg m^2; not symmetric.
    /// Depends on the poses.
    ///
    /// # Errors
    /// See [`Hexapod`].
    pub fn mass_matrix_b(
        &self,
        base: &BaseMotion<T>,
        platform: &PlatformState<T>,
    ) -> Result<Matrix6<T>, Error>
    where
        M: kernels::MassMatrixB<T>,
    {
        let (b, p) = arrays(base, platform);
        self.check_poses(&b, &p)?;
        evaluate!(self.model.mass_matrix_b(b.position, b.rotation, p.position, p.rotation) -> mass_matrix_b)
    }

    /// C_p and C_b of (49). Depends on poses and velocities.
    ///
    /// # Errors
    /// See [`Hexapod`].
    pub fn coriolis_matrices(
        &self,
        base: &BaseMotion<T>,
        platform: &PlatformState<T>,
    ) -> Result<CoriolisMatrices<T>, Error>
    where
        M: kernels::CoriolisMatrices<T>,
    {
        let (b, p) = arrays(base, platform);
        self.check_states(&b, &p)?;
        evaluate!(self.model.coriolis_matrices(
            b.position, b.rotation, b.velocity, p.position, p.rotation, p.velocity
        ) -> CoriolisMatrices {
            coriolis_matrix_p, coriolis_matrix_b,
        })
    }

    /// K_p and K_b of (49), linearised. Depends on the poses.
    ///
    /// # Errors
    /// See [`Hexapod`].
    pub fn stiffness_matrices(
        &self,
        base: &BaseMotion<T>,
        platform: &PlatformState<T>,
    ) -> Result<StiffnessMatrices<T>, Error>
    where
        M: kernels::StiffnessMatrices<T>,
    {
        let (b, p) = arrays(base, platform);
        self.check_poses(&b, &p)?;
        evaluate!(self.model.stiffness_matrices(
            b.position, b.rotation, p.position, p.rotation
        ) -> StiffnessMatrices {
            stiffness_matrix_p, stiffness_matrix_b,
        })
    }

    /// M_p, C_p, J_dp, M_b, C_b and J_db in one shared call. Depends on poses and velocities.
    ///
    /// # Errors
    /// See [`Hexapod`].
    pub fn matrices(&self, base: &BaseMotion<T>, platform: &PlatformState<T>) -> Result<Matrices<T>, Error>
    where
        M: kernels::Matrices<T>,
    {
        let (b, p) = arrays(base, platform);
        self.check_states(&b, &p)?;
        evaluate!(self.model.matrices(
            b.position, b.rotation, b.velocity, p.position, p.rotation, p.velocity
        ) -> Matrices {
            mass_matrix_p, coriolis_matrix_p, jacobian_dp, mass_matrix_b, coriolis_matrix_b, jacobian_db,
        })
    }
}
