//! Generalised forces: per body as in Kane's equations, and collected as they stand in the equation of
//! motion.

use nalgebra::Vector6;

use crate::check::finite;
use crate::error::{Error, Input};
use crate::evaluate::evaluate;
use crate::hexapod::{Hexapod, arrays};
use crate::kernels;
use crate::real::Real;
use crate::state::{Acceleration, BaseMotion, PlatformState, Wrench};

/// Active and inertia forces of every body (39)-(46). Their sum vanishes exactly where the equation of motion
/// holds.
///
/// Each is six numbers that go with the platform speeds `[r_p'; w_p]`: a force (N) and a moment about P's
/// origin (N m), O axes.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct GeneralisedForces<T = f64> {
    /// Payload: gravity and external wrench (39), N and N m, O.
    pub payload_active_force: Vector6<T>,
    /// Payload: `-(J^T m a + J_w^T (I w' + w x I w))`, N and N m, O.
    pub payload_inertia_force: Vector6<T>,
    /// Each rod: gravity, N and N m, O.
    pub rod_active_force: [Vector6<T>; 6],
    /// Each rod: as for the payload, N and N m, O.
    pub rod_inertia_force: [Vector6<T>; 6],
    /// Each mover: gravity, and along its axis `F - k_e (d - d0) - c_e d'`, N and N m, O.
    pub mover_active_force: [Vector6<T>; 6],
    /// Each mover: `-J^T m a`, N and N m, O.
    pub mover_inertia_force: [Vector6<T>; 6],
}

/// Forces that neither acceleration nor actuators make, with the signs they have on the left side of the
/// equation of motion: force (N) and moment about P's origin (N m), O axes.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct PassiveForces<T = f64> {
    /// G, minus the weight of payload, rods and movers: what holds them up; N and N m, O.
    pub gravity_force: Vector6<T>,
    /// `J_dp^T k_e (d - d0)`, N and N m, O.
    pub spring_force: Vector6<T>,
    /// `J_dp^T c_e d'`, N and N m, O.
    pub damping_force: Vector6<T>,
}

impl<M: kernels::RodAlignment<T>, T: Real> Hexapod<M, T> {
    /// Active and inertia forces, body by body (39)-(46). `actuator_force_n` along the actuators' axes, on
    /// the movers, N. Depends on everything: poses, velocities and accelerations of both bodies, actuator
    /// forces, external wrench.
    ///
    /// # Errors
    /// See [`Hexapod`].
    pub fn generalised_forces(
        &self,
        base: &BaseMotion<T>,
        platform: &PlatformState<T>,
        platform_acceleration: &Acceleration<T>,
        actuator_force_n: &Vector6<T>,
        external_wrench: &Wrench<T>,
    ) -> Result<GeneralisedForces<T>, Error>
    where
        M: kernels::uhp::GeneralisedForces<T>,
    {
        let base_acceleration = finite(Input::BaseAcceleration, base.acceleration.to_array())?;
        let platform_acceleration = finite(Input::PlatformAcceleration, platform_acceleration.to_array())?;
        let actuator_force = finite(Input::ActuatorForce, (*actuator_force_n).into())?;
        let external_wrench = finite(Input::ExternalWrench, external_wrench.to_array())?;
        let (b, p) = arrays(base, platform);
        self.check_states(&b, &p)?;
        evaluate!(self.model.generalised_forces(
            b.position, b.rotation, b.velocity, base_acceleration,
            p.position, p.rotation, p.velocity, platform_acceleration,
            actuator_force, external_wrench,
        ) -> GeneralisedForces {
            payload_active_force, payload_inertia_force, rod_active_force, rod_inertia_force,
            mover_active_force, mover_inertia_force,
        })
    }

    /// Gravity, springs and dampers. Depends on poses and velocities.
    ///
    /// # Errors
    /// See [`Hexapod`].
    ///
    /// ```
    /// use dyn_runtime::nalgebra::Vector3;
    /// use dyn_runtime::{BaseMotion, Hexapod, PlatformState, Pose, models::Uhp2016};
    ///
    /// let base = BaseMotion::at_rest(Pose::identity());
    /// let home = Pose::from_paper_angles(Vector3::new(0.0, 0.0, 0.382), [0.0; 3]);
    /// let passive = Hexapod::new(Uhp2016).passive_forces(&base, &PlatformState::at_rest(home))?;
    /// // Home is not where the springs rest: they pull the platform down with 26.96 N.
    /// assert!((passive.spring_force[2] - 26.96).abs() < 5e-3);
    /// # Ok::<(), dyn_runtime::Error>(())
    /// ```
    pub fn passive_forces(
        &self,
        base: &BaseMotion<T>,
        platform: &PlatformState<T>,
    ) -> Result<PassiveForces<T>, Error>
    where
        M: kernels::PassiveForces<T>,
    {
        let (b, p) = arrays(base, platform);
        self.check_states(&b, &p)?;
        evaluate!(self.model.passive_forces(
            b.position, b.rotation, b.velocity, p.position, p.rotation, p.velocity
        ) -> PassiveForces {
            gravity_force, spring_force, damping_force,
        })
    }

    /// Everything on the left side of the equation of motion except `M_p v_p'`, less `C_b v_b`:
    /// `C_p v_p - C_b v_b + G + J_dp^T (k_e (d - d0) + c_e d')`. Depends on poses and velocities.
    ///
    /// # Errors
    /// See [`Hexapod`].
    pub fn bias(&self, base: &BaseMotion<T>, platform: &PlatformState<T>) -> Result<Vector6<T>, Error>
    where
        M: kernels::Bias<T>,
    {
        let (b, p) = arrays(base, platform);
        self.check_states(&b, &p)?;
        evaluate!(self.model.bias(
            b.position, b.rotation, b.velocity, p.position, p.rotation, p.velocity
        ) -> bias)
    }
}
