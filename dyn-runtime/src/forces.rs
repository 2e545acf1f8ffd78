//! Generalised forces: per body as in Kane's equations, and collected as they stand in the equation of
//! motion.
//!
//! All are six numbers that go with the platform speeds `[r_p'; w_p]`: a force (N) and a moment about P's
//! origin (N m), O axes.

use nalgebra::Vector6;

use crate::arrays::vectors;
use crate::check::{finite, finite_result};
use crate::error::{Error, Input};
use crate::hexapod::{Hexapod, States};
use crate::kernels;
use crate::state::{Acceleration, BaseMotion, PlatformState, Wrench};

/// Active and inertia forces of every body (39)-(46). Their sum vanishes exactly where the equation of motion
/// holds.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct GeneralisedForces {
    /// Payload: gravity and external wrench (39).
    pub payload_active_force: Vector6<f64>,
    /// Payload: `-(J^T m a + J_w^T (I w' + w x I w))`.
    pub payload_inertia_force: Vector6<f64>,
    /// Each rod: gravity.
    pub rod_active_force: [Vector6<f64>; 6],
    /// Each rod: as for the payload.
    pub rod_inertia_force: [Vector6<f64>; 6],
    /// Each mover: gravity, and along its axis `F - k_e (d - d0) - c_e d'`.
    pub mover_active_force: [Vector6<f64>; 6],
    /// Each mover: `-J^T m a`.
    pub mover_inertia_force: [Vector6<f64>; 6],
}

/// Forces that neither acceleration nor actuators make, with the signs they have on the left side of the
/// equation of motion.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct PassiveForces {
    /// G, minus the weight of payload, rods and movers: what holds them up.
    pub gravity_force: Vector6<f64>,
    /// `J_dp^T k_e (d - d0)`.
    pub spring_force: Vector6<f64>,
    /// `J_dp^T c_e d'`.
    pub damping_force: Vector6<f64>,
}

impl<M: kernels::RodAlignment> Hexapod<M> {
    /// Active and inertia forces, body by body (39)-(46). `actuator_force_n` along the actuators' axes, on
    /// the movers, N. Depends on everything: poses, velocities and accelerations of both bodies, actuator
    /// forces, external wrench.
    ///
    /// # Errors
    /// See [`Hexapod`].
    pub fn generalised_forces(
        &self,
        base: &BaseMotion,
        platform: &PlatformState,
        platform_acceleration: &Acceleration,
        actuator_force_n: &Vector6<f64>,
        external_wrench: &Wrench,
    ) -> Result<GeneralisedForces, Error>
    where
        M: kernels::GeneralisedForces,
    {
        let base_acceleration = finite(Input::BaseAcceleration, base.acceleration.to_array())?;
        let platform_acceleration = finite(Input::PlatformAcceleration, platform_acceleration.to_array())?;
        let actuator_force = finite(Input::ActuatorForce, (*actuator_force_n).into())?;
        let external_wrench = finite(Input::ExternalWrench, external_wrench.to_array())?;
        let States {
            base_position,
            base_rotation,
            base_velocity,
            platform_position,
            platform_rotation,
            platform_velocity,
        } = self.states(base, platform)?;
        let mut payload_active_force = [0.0; 6];
        let mut payload_inertia_force = [0.0; 6];
        let mut rod_active_force = [[0.0; 6]; 6];
        let mut rod_inertia_force = [[0.0; 6]; 6];
        let mut mover_active_force = [[0.0; 6]; 6];
        let mut mover_inertia_force = [[0.0; 6]; 6];
        self.model.generalised_forces(
            &base_position,
            &base_rotation,
            &base_velocity,
            &base_acceleration,
            &platform_position,
            &platform_rotation,
            &platform_velocity,
            &platform_acceleration,
            &actuator_force,
            &external_wrench,
            &mut payload_active_force,
            &mut payload_inertia_force,
            &mut rod_active_force,
            &mut rod_inertia_force,
            &mut mover_active_force,
            &mut mover_inertia_force,
        );
        finite_result(&[&payload_active_force, &payload_inertia_force])?;
        finite_result(&[&rod_active_force, &rod_inertia_force, &mover_active_force, &mover_inertia_force])?;
        Ok(GeneralisedForces {
            payload_active_force: payload_active_force.into(),
            payload_inertia_force: payload_inertia_force.into(),
            rod_active_force: vectors(&rod_active_force),
            rod_inertia_force: vectors(&rod_inertia_force),
            mover_active_force: vectors(&mover_active_force),
            mover_inertia_force: vectors(&mover_inertia_force),
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
    pub fn passive_forces(&self, base: &BaseMotion, platform: &PlatformState) -> Result<PassiveForces, Error>
    where
        M: kernels::PassiveForces,
    {
        let States {
            base_position,
            base_rotation,
            base_velocity,
            platform_position,
            platform_rotation,
            platform_velocity,
        } = self.states(base, platform)?;
        let mut gravity_force = [0.0; 6];
        let mut spring_force = [0.0; 6];
        let mut damping_force = [0.0; 6];
        self.model.passive_forces(
            &base_position,
            &base_rotation,
            &base_velocity,
            &platform_position,
            &platform_rotation,
            &platform_velocity,
            &mut gravity_force,
            &mut spring_force,
            &mut damping_force,
        );
        finite_result(&[&gravity_force, &spring_force, &damping_force])?;
        Ok(PassiveForces {
            gravity_force: gravity_force.into(),
            spring_force: spring_force.into(),
            damping_force: damping_force.into(),
        })
    }

    /// Everything on the left side of the equation of motion except `M_p v_p'`, less `C_b v_b`:
    /// `C_p v_p - C_b v_b + G + J_dp^T (k_e (d - d0) + c_e d')`. Depends on poses and velocities.
    ///
    /// # Errors
    /// See [`Hexapod`].
    pub fn bias(&self, base: &BaseMotion, platform: &PlatformState) -> Result<Vector6<f64>, Error>
    where
        M: kernels::Bias,
    {
        let States {
            base_position,
            base_rotation,
            base_velocity,
            platform_position,
            platform_rotation,
            platform_velocity,
        } = self.states(base, platform)?;
        let mut bias = [0.0; 6];
        self.model.bias(
            &base_position,
            &base_rotation,
            &base_velocity,
            &platform_position,
            &platform_rotation,
            &platform_velocity,
            &mut bias,
        );
        finite_result(&[&bias])?;
        Ok(bias.into())
    }
}
