//! The bodies of legs of type `ups`, lower and upper part, each by itself.

use nalgebra::{Matrix3x6, Vector3, Vector6};

use crate::check::finite;
use crate::error::{Error, Input};
use crate::evaluate::evaluate;
use crate::hexapod::{Hexapod, arrays};
use crate::kernels;
use crate::real::Real;
use crate::state::{Acceleration, BaseMotion, PlatformState, Wrench};

/// Motion of the moving bodies, vectors in O.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct BodyKinematics<T = f64> {
    /// Payload's centre of mass, m, O (11).
    pub payload_com_position_m: Vector3<T>,
    /// Its velocity, m/s, O (12).
    pub payload_com_velocity_m_s: Vector3<T>,
    /// Its acceleration, m/s^2, O (13).
    pub payload_com_acceleration_m_s2: Vector3<T>,
    /// w_s of each leg, without spin, rad/s, O (22).
    pub leg_angular_velocity_rad_s: [Vector3<T>; 6],
    /// w_s' of each leg, rad/s^2, O.
    pub leg_angular_acceleration_rad_s2: [Vector3<T>; 6],
    /// Centre of mass of each lower part, m, O.
    pub lower_com_position_m: [Vector3<T>; 6],
    /// Its velocity, m/s, O.
    pub lower_com_velocity_m_s: [Vector3<T>; 6],
    /// Its acceleration, m/s^2, O.
    pub lower_com_acceleration_m_s2: [Vector3<T>; 6],
    /// Centre of mass of each upper part, m, O.
    pub upper_com_position_m: [Vector3<T>; 6],
    /// Its velocity, m/s, O.
    pub upper_com_velocity_m_s: [Vector3<T>; 6],
    /// Its acceleration, m/s^2, O.
    pub upper_com_acceleration_m_s2: [Vector3<T>; 6],
}

/// Derivatives of body velocities by the six platform speeds `v_p = [r_p'; w_p]`, O axes. Three columns for
/// the translational speeds, then three for the rotational ones.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct PartialVelocities<T = f64> {
    /// Of the velocity of the payload's centre of mass: three columns without unit, three in m; O.
    pub payload_partial_velocity: Matrix3x6<T>,
    /// Of the angular velocity of the payload: three columns in 1/m, three without unit; O.
    pub payload_partial_angular_velocity: Matrix3x6<T>,
    /// Of the velocity of each lower part's centre of mass: columns without unit and in m; O.
    pub lower_partial_velocity: [Matrix3x6<T>; 6],
    /// Of the velocity of each upper part's centre of mass: columns without unit and in m; O.
    pub upper_partial_velocity: [Matrix3x6<T>; 6],
    /// Of the angular velocity of each leg: columns in 1/m and without unit; O.
    pub leg_partial_angular_velocity: [Matrix3x6<T>; 6],
}

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
    /// Each lower part: gravity; what acts along the leg does no work on it; N and N m, O.
    pub lower_active_force: [Vector6<T>; 6],
    /// Each lower part: as for the payload, N and N m, O.
    pub lower_inertia_force: [Vector6<T>; 6],
    /// Each upper part: gravity, and along the leg `F - k_e (d - d0) - c_e d'`, N and N m, O.
    pub upper_active_force: [Vector6<T>; 6],
    /// Each upper part: as for the payload, N and N m, O.
    pub upper_inertia_force: [Vector6<T>; 6],
}

impl<M: kernels::RodAlignment<T>, T: Real> Hexapod<M, T> {
    /// Motion of payload and both parts of telescopic legs. Depends on poses, velocities and accelerations of both
    /// bodies.
    ///
    /// # Errors
    /// See [`Hexapod`].
    pub fn ups_body_kinematics(
        &self,
        base: &BaseMotion<T>,
        platform: &PlatformState<T>,
        platform_acceleration: &Acceleration<T>,
    ) -> Result<BodyKinematics<T>, Error>
    where
        M: kernels::ups::BodyKinematics<T>,
    {
        let base_acceleration = finite(Input::BaseAcceleration, base.acceleration.to_array())?;
        let platform_acceleration = finite(Input::PlatformAcceleration, platform_acceleration.to_array())?;
        let (b, p) = arrays(base, platform);
        self.check_states(&b, &p)?;
        evaluate!(self.model.body_kinematics(
            b.position, b.rotation, b.velocity, base_acceleration,
            p.position, p.rotation, p.velocity, platform_acceleration,
        ) -> BodyKinematics {
            payload_com_position_m, payload_com_velocity_m_s, payload_com_acceleration_m_s2,
            leg_angular_velocity_rad_s, leg_angular_acceleration_rad_s2, lower_com_position_m,
            lower_com_velocity_m_s, lower_com_acceleration_m_s2, upper_com_position_m, upper_com_velocity_m_s,
            upper_com_acceleration_m_s2,
        })
    }

    /// Partial velocities and partial angular velocities of payload and both parts of telescopic legs (33)-(38).
    /// Depends on the poses.
    ///
    /// # Errors
    /// See [`Hexapod`].
    pub fn ups_partial_velocities(
        &self,
        base: &BaseMotion<T>,
        platform: &PlatformState<T>,
    ) -> Result<PartialVelocities<T>, Error>
    where
        M: kernels::ups::PartialVelocities<T>,
    {
        let (b, p) = arrays(base, platform);
        self.check_poses(&b, &p)?;
        evaluate!(self.model.partial_velocities(
            b.position, b.rotation, p.position, p.rotation
        ) -> PartialVelocities {
            payload_partial_velocity, payload_partial_angular_velocity, lower_partial_velocity,
            upper_partial_velocity, leg_partial_angular_velocity,
        })
    }

    /// Active and inertia forces, body by body (39)-(46), of telescopic legs. `actuator_force_n` along the
    /// legs, N, pushes their parts apart. Depends on everything: poses, velocities and accelerations of both bodies, actuator
    /// forces, external wrench.
    ///
    /// # Errors
    /// See [`Hexapod`].
    pub fn ups_generalised_forces(
        &self,
        base: &BaseMotion<T>,
        platform: &PlatformState<T>,
        platform_acceleration: &Acceleration<T>,
        actuator_force_n: &Vector6<T>,
        external_wrench: &Wrench<T>,
    ) -> Result<GeneralisedForces<T>, Error>
    where
        M: kernels::ups::GeneralisedForces<T>,
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
            payload_active_force, payload_inertia_force, lower_active_force, lower_inertia_force,
            upper_active_force, upper_inertia_force,
        })
    }
}
