//! The 6x6 matrices of the equation of motion (49): Jacobians, masses, velocity terms, stiffnesses.
//!
//! Subscript p multiplies the platform's `[r_p'; w_p]`, subscript b the base's `[r_b'; w_b]`, all in O axes.
//! So blocks have the units of translational and rotational quantities: in a mass matrix kg, kg m and kg m^2.

use nalgebra::Matrix6;

use crate::arrays::matrix;
use crate::check::finite_result;
use crate::error::Error;
use crate::hexapod::{Hexapod, Poses, States};
use crate::kernels;
use crate::state::{BaseMotion, PlatformState};

/// Velocity terms in their natural factorisation: `C_p v_p - C_b v_b` are the exact velocity terms of (49),
/// and `M_p' - 2 C_p` is skew-symmetric.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct CoriolisMatrices {
    /// C_p, N per m/s or rad/s (forces) and N m (moments).
    pub coriolis_matrix_p: Matrix6<f64>,
    /// C_b, likewise.
    pub coriolis_matrix_b: Matrix6<f64>,
}

/// The paper's stiffnesses for small displacements of platform and base. They leave out the preload's share,
/// so they are not the tangent stiffness of the equation of motion.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct StiffnessMatrices {
    /// `K_p = J_dp^T k_e J_dp`, N/m, N and N m.
    pub stiffness_matrix_p: Matrix6<f64>,
    /// `K_b = J_dp^T k_e J_db`, likewise.
    pub stiffness_matrix_b: Matrix6<f64>,
}

/// Masses, velocity terms and Jacobians from one shared evaluation.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Matrices {
    /// M_p, as [`Hexapod::mass_matrix_p`] gives it.
    pub mass_matrix_p: Matrix6<f64>,
    /// C_p, as in [`CoriolisMatrices`].
    pub coriolis_matrix_p: Matrix6<f64>,
    /// J_dp, as [`Hexapod::jacobian_dp`] gives it.
    pub jacobian_dp: Matrix6<f64>,
    /// M_b, as [`Hexapod::mass_matrix_b`] gives it.
    pub mass_matrix_b: Matrix6<f64>,
    /// C_b, as in [`CoriolisMatrices`].
    pub coriolis_matrix_b: Matrix6<f64>,
    /// J_db, as [`Hexapod::jacobian_db`] gives it.
    pub jacobian_db: Matrix6<f64>,
}

/// A method for a function with poses in and one 6x6 matrix out.
macro_rules! matrix_of_poses {
    ($(#[$documentation:meta])* $function:ident, $kernel:ident) => {
        $(#[$documentation])*
        ///
        /// # Errors
        /// See [`Hexapod`].
        pub fn $function(&self, base: &BaseMotion, platform: &PlatformState) -> Result<Matrix6<f64>, Error>
        where
            M: kernels::$kernel,
        {
            let Poses { base_position, base_rotation, platform_position, platform_rotation } =
                self.poses(base, platform)?;
            let mut rows = [[0.0; 6]; 6];
            self.model.$function(
                &base_position,
                &base_rotation,
                &platform_position,
                &platform_rotation,
                &mut rows,
            );
            finite_result(&[&rows])?;
            Ok(matrix(&rows))
        }
    };
}

impl<M: kernels::RodAlignment> Hexapod<M> {
    matrix_of_poses! {
        /// J_dp, of `d' = J_dp v_p - J_db v_b` (30), (32): a row per leg, `[u; (R_p p) x u]^T / (u.a)`; three
        /// columns without unit, three in m. Depends on the poses.
        jacobian_dp, JacobianDp
    }

    matrix_of_poses! {
        /// J_db, of `d' = J_dp v_p - J_db v_b` (30), (31): a row per leg, `[u; (R_b b + d a) x u]^T / (u.a)`;
        /// three columns without unit, three in m. Depends on the poses.
        jacobian_db, JacobianDb
    }

    matrix_of_poses! {
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
        mass_matrix_p, MassMatrixP
    }

    matrix_of_poses! {
        /// M_b, for the base's acceleration, on the right side of (49): kg, kg m, kg m^2; not symmetric.
        /// Depends on the poses.
        mass_matrix_b, MassMatrixB
    }

    /// C_p and C_b of (49). Depends on poses and velocities.
    ///
    /// # Errors
    /// See [`Hexapod`].
    pub fn coriolis_matrices(
        &self,
        base: &BaseMotion,
        platform: &PlatformState,
    ) -> Result<CoriolisMatrices, Error>
    where
        M: kernels::CoriolisMatrices,
    {
        let States {
            base_position,
            base_rotation,
            base_velocity,
            platform_position,
            platform_rotation,
            platform_velocity,
        } = self.states(base, platform)?;
        let mut coriolis_matrix_p = [[0.0; 6]; 6];
        let mut coriolis_matrix_b = [[0.0; 6]; 6];
        self.model.coriolis_matrices(
            &base_position,
            &base_rotation,
            &base_velocity,
            &platform_position,
            &platform_rotation,
            &platform_velocity,
            &mut coriolis_matrix_p,
            &mut coriolis_matrix_b,
        );
        finite_result(&[&coriolis_matrix_p, &coriolis_matrix_b])?;
        Ok(CoriolisMatrices {
            coriolis_matrix_p: matrix(&coriolis_matrix_p),
            coriolis_matrix_b: matrix(&coriolis_matrix_b),
        })
    }

    /// K_p and K_b of (49), linearised. Depends on the poses.
    ///
    /// # Errors
    /// See [`Hexapod`].
    pub fn stiffness_matrices(
        &self,
        base: &BaseMotion,
        platform: &PlatformState,
    ) -> Result<StiffnessMatrices, Error>
    where
        M: kernels::StiffnessMatrices,
    {
        let Poses { base_position, base_rotation, platform_position, platform_rotation } =
            self.poses(base, platform)?;
        let mut stiffness_matrix_p = [[0.0; 6]; 6];
        let mut stiffness_matrix_b = [[0.0; 6]; 6];
        self.model.stiffness_matrices(
            &base_position,
            &base_rotation,
            &platform_position,
            &platform_rotation,
            &mut stiffness_matrix_p,
            &mut stiffness_matrix_b,
        );
        finite_result(&[&stiffness_matrix_p, &stiffness_matrix_b])?;
        Ok(StiffnessMatrices {
            stiffness_matrix_p: matrix(&stiffness_matrix_p),
            stiffness_matrix_b: matrix(&stiffness_matrix_b),
        })
    }

    /// M_p, C_p, J_dp, M_b, C_b and J_db in one shared call. Depends on poses and velocities.
    ///
    /// # Errors
    /// See [`Hexapod`].
    pub fn matrices(&self, base: &BaseMotion, platform: &PlatformState) -> Result<Matrices, Error>
    where
        M: kernels::Matrices,
    {
        let States {
            base_position,
            base_rotation,
            base_velocity,
            platform_position,
            platform_rotation,
            platform_velocity,
        } = self.states(base, platform)?;
        let mut mass_matrix_p = [[0.0; 6]; 6];
        let mut coriolis_matrix_p = [[0.0; 6]; 6];
        let mut jacobian_dp = [[0.0; 6]; 6];
        let mut mass_matrix_b = [[0.0; 6]; 6];
        let mut coriolis_matrix_b = [[0.0; 6]; 6];
        let mut jacobian_db = [[0.0; 6]; 6];
        self.model.matrices(
            &base_position,
            &base_rotation,
            &base_velocity,
            &platform_position,
            &platform_rotation,
            &platform_velocity,
            &mut mass_matrix_p,
            &mut coriolis_matrix_p,
            &mut jacobian_dp,
            &mut mass_matrix_b,
            &mut coriolis_matrix_b,
            &mut jacobian_db,
        );
        finite_result(&[&mass_matrix_p, &coriolis_matrix_p, &jacobian_dp])?;
        finite_result(&[&mass_matrix_b, &coriolis_matrix_b, &jacobian_db])?;
        Ok(Matrices {
            mass_matrix_p: matrix(&mass_matrix_p),
            coriolis_matrix_p: matrix(&coriolis_matrix_p),
            jacobian_dp: matrix(&jacobian_dp),
            mass_matrix_b: matrix(&mass_matrix_b),
            coriolis_matrix_b: matrix(&coriolis_matrix_b),
            jacobian_db: matrix(&jacobian_db),
        })
    }
}
