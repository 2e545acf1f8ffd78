//! Inverse dynamics: actuator forces for a wanted acceleration.

use nalgebra::Vector6;

use crate::check::finite;
use crate::error::{Error, Input};
use crate::evaluate::evaluate;
use crate::hexapod::{Hexapod, arrays};
use crate::kernels;
use crate::real::Real;
use crate::state::{Acceleration, BaseMotion, PlatformState, Wrench};

impl<M: kernels::RodAlignment<T>, T: Real> Hexapod<M, T> {
    /// F, N, along the actuators' axes on the movers, that gives the platform `platform_acceleration`: the
    /// solution of `J_dp^T F = M_p v_p' + bias - W_ext - M_b v_b'` (49). Depends on poses, velocities and
    /// accelerations of both bodies and on the external wrench.
    ///
    /// # Errors
    /// See [`Hexapod`]; besides, [`Error::SingularJacobian`]. That check evaluates J_dp and a
    /// bound of its condition, which costs as much as the forces themselves; [`control`](Self::control) has J_dp anyway.
    ///
    /// ```
    /// use dyn_runtime::nalgebra::{Vector3, Vector6};
    /// use dyn_runtime::{Acceleration, BaseMotion, Hexapod, PlatformState, Pose, Wrench, models::Uhp2016};
    ///
    /// let hexapod = Hexapod::new(Uhp2016);
    /// let base = BaseMotion::at_rest(Pose::identity());
    /// let home = Pose::from_paper_angles(Vector3::new(0.0, 0.0, 0.382), [0.0; 3]);
    /// let platform = PlatformState::at_rest(home);
    ///
    /// // The actuators stand upright at home, so their forces together carry springs and weight.
    /// let forces = hexapod.inverse_dynamics(&base, &platform, &Acceleration::zero(), &Wrench::zero())?;
    /// let passive = hexapod.passive_forces(&base, &platform)?;
    /// assert!((forces.sum() - (passive.spring_force[2] + passive.gravity_force[2])).abs() < 1e-9);
    /// # Ok::<(), dyn_runtime::Error>(())
    /// ```
    pub fn inverse_dynamics(
        &self,
        base: &BaseMotion<T>,
        platform: &PlatformState<T>,
        platform_acceleration: &Acceleration<T>,
        external_wrench: &Wrench<T>,
    ) -> Result<Vector6<T>, Error>
    where
        M: kernels::InverseDynamics<T> + kernels::ActuatorGeometry<T>,
    {
        let base_acceleration = finite(Input::BaseAcceleration, base.acceleration.to_array())?;
        let platform_acceleration = finite(Input::PlatformAcceleration, platform_acceleration.to_array())?;
        let external_wrench = finite(Input::ExternalWrench, external_wrench.to_array())?;
        let (b, p) = arrays(base, platform);
        self.check_determinate(&b, &p)?;
        evaluate!(self.model.inverse_dynamics(
            b.position, b.rotation, b.velocity, base_acceleration,
            p.position, p.rotation, p.velocity, platform_acceleration,
            external_wrench,
        ) -> forces)
    }
}
