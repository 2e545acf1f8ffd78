//! Forward dynamics: the platform's acceleration under given actuator forces.

use nalgebra::Vector6;

use crate::check::finite;
use crate::error::{Error, Input};
use crate::evaluate::evaluate;
use crate::hexapod::{Hexapod, arrays};
use crate::kernels;
use crate::real::Real;
use crate::state::{Acceleration, BaseMotion, PlatformState, Wrench};

impl<M: kernels::RodAlignment<T>, T: Real> Hexapod<M, T> {
    /// v_p' under `actuator_force_n` (N, along the actuators' axes on the movers): the solution of
    /// `M_p v_p' = J_dp^T F + W_ext + M_b v_b' - bias` (49). Depends on poses and velocities of both bodies,
    /// the base's acceleration, actuator forces and external wrench.
    ///
    /// # Errors
    /// See [`Hexapod`].
    ///
    /// ```
    /// use dyn_runtime::nalgebra::Vector3;
    /// use dyn_runtime::{Acceleration, BaseMotion, Hexapod, PlatformState, Pose, Wrench, models::Uhp2016};
    ///
    /// let hexapod = Hexapod::new(Uhp2016);
    /// let base = BaseMotion::at_rest(Pose::identity());
    /// let home = Pose::from_paper_angles(Vector3::new(0.0, 0.0, 0.382), [0.0; 3]);
    /// let platform = PlatformState::at_rest(home);
    ///
    /// // Forces for 0.5 m/s^2 upwards give 0.5 m/s^2 upwards.
    /// let wanted = Acceleration { linear_m_s2: Vector3::new(0.0, 0.0, 0.5), ..Acceleration::zero() };
    /// let forces = hexapod.inverse_dynamics(&base, &platform, &wanted, &Wrench::zero())?;
    /// let acceleration = hexapod.forward_dynamics(&base, &platform, &forces, &Wrench::zero())?;
    /// assert!((acceleration.linear_m_s2.z - 0.5).abs() < 1e-12);
    /// # Ok::<(), dyn_runtime::Error>(())
    /// ```
    pub fn forward_dynamics(
        &self,
        base: &BaseMotion<T>,
        platform: &PlatformState<T>,
        actuator_force_n: &Vector6<T>,
        external_wrench: &Wrench<T>,
    ) -> Result<Acceleration<T>, Error>
    where
        M: kernels::ForwardDynamics<T>,
    {
        let base_acceleration = finite(Input::BaseAcceleration, base.acceleration.to_array())?;
        let actuator_force = finite(Input::ActuatorForce, (*actuator_force_n).into())?;
        let external_wrench = finite(Input::ExternalWrench, external_wrench.to_array())?;
        let (b, p) = arrays(base, platform);
        self.check_states(&b, &p)?;
        evaluate!(self.model.forward_dynamics(
            b.position, b.rotation, b.velocity, base_acceleration,
            p.position, p.rotation, p.velocity,
            actuator_force, external_wrench,
        ) -> acceleration)
    }
}
