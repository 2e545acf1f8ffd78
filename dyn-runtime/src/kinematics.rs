//! Kinematics of legs and bodies.

use nalgebra::{Matrix3x6, Vector3, Vector6};

use crate::arrays::AllFinite;
use crate::check::{finite, finite_result};
use crate::error::{Error, Input};
use crate::evaluate::evaluate;
use crate::hexapod::{Hexapod, arrays, check_poses};
use crate::kernels;
use crate::real::Real;
use crate::state::{Acceleration, BaseMotion, PlatformState};

/// Where the legs are and how they move; legs in the order of the platform file, vectors in O.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct LegKinematics<T = f64> {
    /// d, m (18).
    pub actuator_length_m: Vector6<T>,
    /// d', m/s (30).
    pub actuator_velocity_m_s: Vector6<T>,
    /// d'', m/s^2.
    pub actuator_acceleration_m_s2: Vector6<T>,
    /// u, unit vector along the rod, O, from Hooke to platform joint (17).
    pub rod_direction: [Vector3<T>; 6],
    /// Centre of the Hooke joint between actuator and rod, m, O.
    pub hooke_joint_position_m: [Vector3<T>; 6],
    /// Centre of the universal joint between rod and platform, m, O.
    pub platform_joint_position_m: [Vector3<T>; 6],
    /// Angular velocity of the platform relative to the rod, `w_p - w_s`, rad/s, O (23).
    pub platform_joint_rate_rad_s: [Vector3<T>; 6],
}

/// Motion of the moving bodies, vectors in O.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct BodyKinematics<T = f64> {
    /// Payload's centre of mass, m, O (11).
    pub payload_com_position_m: Vector3<T>,
    /// Its velocity, m/s, O (12).
    pub payload_com_velocity_m_s: Vector3<T>,
    /// Its acceleration, m/s^2, O (13).
    pub payload_com_acceleration_m_s2: Vector3<T>,
    /// w_s of each rod, without spin, rad/s, O (22).
    pub rod_angular_velocity_rad_s: [Vector3<T>; 6],
    /// w_s' of each rod, rad/s^2, O.
    pub rod_angular_acceleration_rad_s2: [Vector3<T>; 6],
    /// Centre of mass of each rod, m, O (27).
    pub rod_com_position_m: [Vector3<T>; 6],
    /// Its velocity, m/s, O (28).
    pub rod_com_velocity_m_s: [Vector3<T>; 6],
    /// Its acceleration, m/s^2, O (29).
    pub rod_com_acceleration_m_s2: [Vector3<T>; 6],
    /// Centre of mass of each mover, m, O (24).
    pub mover_position_m: [Vector3<T>; 6],
    /// Its velocity, m/s, O (25).
    pub mover_velocity_m_s: [Vector3<T>; 6],
    /// Its acceleration, m/s^2, O (26).
    pub mover_acceleration_m_s2: [Vector3<T>; 6],
}

/// Derivatives of body velocities by the six platform speeds `v_p = [r_p'; w_p]`, O axes. Three columns for
/// the translational speeds, then three for the rotational ones.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct PartialVelocities<T = f64> {
    /// Of the velocity of the payload's centre of mass: three columns without unit, three in m; O.
    pub payload_partial_velocity: Matrix3x6<T>,
    /// Of the angular velocity of the payload: three columns in 1/m, three without unit; O.
    pub payload_partial_angular_velocity: Matrix3x6<T>,
    /// Of the velocity of each rod's centre of mass: columns without unit and in m; O.
    pub rod_partial_velocity: [Matrix3x6<T>; 6],
    /// Of the angular velocity of each rod: columns in 1/m and without unit; O.
    pub rod_partial_angular_velocity: [Matrix3x6<T>; 6],
    /// Of the velocity of each mover: columns without unit and in m; O.
    pub mover_partial_velocity: [Matrix3x6<T>; 6],
}

impl<M: kernels::RodAlignment<T>, T: Real> Hexapod<M, T> {
    /// `(u_i.a_i)^2 = 1 - n_i.n_i/s_i^2` of each leg: 1 where the rod lies along its actuator, 0 where it is
    /// perpendicular, negative where the platform joint is out of reach. Depends on the poses.
    ///
    /// # Errors
    /// Inputs that are not finite, rotations that are not rotations, models that are not mechanisms
    /// ([`Error::InvalidModel`]); every reach is a valid answer here.
    pub fn rod_alignment(
        &self,
        base: &BaseMotion<T>,
        platform: &PlatformState<T>,
    ) -> Result<Vector6<T>, Error> {
        let (b, p) = arrays(base, platform);
        check_poses(&b, &p)?;
        let rod_alignment = self.alignment_at(&b, &p)?;
        finite_result(rod_alignment.all_finite())?;
        Ok(rod_alignment.into())
    }

    /// Lengths, rates and accelerations of the actuators, directions and joints of the rods (17), (18), (23),
    /// (30). Depends on poses, velocities and accelerations of both bodies.
    ///
    /// # Errors
    /// See [`Hexapod`].
    ///
    /// ```
    /// use dyn_runtime::nalgebra::Vector3;
    /// use dyn_runtime::{Acceleration, BaseMotion, Hexapod, PlatformState, Pose, Twist, models::Uhp2016};
    ///
    /// let base = BaseMotion::at_rest(Pose::identity());
    /// let home = Pose::from_paper_angles(Vector3::new(0.0, 0.0, 0.382), [0.0; 3]);
    /// // At home, rising at 10 mm/s: every actuator is 0.19821 m long and extends at the same rate.
    /// let velocity = Twist { linear_m_s: Vector3::new(0.0, 0.0, 0.01), ..Twist::zero() };
    /// let platform = PlatformState { pose: home, velocity };
    /// let legs = Hexapod::new(Uhp2016).leg_kinematics(&base, &platform, &Acceleration::zero())?;
    /// for leg in 0..6 {
    ///     assert!((legs.actuator_length_m[leg] - 0.19821).abs() < 5e-6);
    ///     assert!((legs.actuator_velocity_m_s[leg] - 0.01).abs() < 1e-15);
    /// }
    /// # Ok::<(), dyn_runtime::Error>(())
    /// ```
    pub fn leg_kinematics(
        &self,
        base: &BaseMotion<T>,
        platform: &PlatformState<T>,
        platform_acceleration: &Acceleration<T>,
    ) -> Result<LegKinematics<T>, Error>
    where
        M: kernels::LegKinematics<T>,
    {
        let base_acceleration = finite(Input::BaseAcceleration, base.acceleration.to_array())?;
        let platform_acceleration = finite(Input::PlatformAcceleration, platform_acceleration.to_array())?;
        let (b, p) = arrays(base, platform);
        self.check_states(&b, &p)?;
        evaluate!(self.model.leg_kinematics(
            b.position, b.rotation, b.velocity, base_acceleration,
            p.position, p.rotation, p.velocity, platform_acceleration,
        ) -> LegKinematics {
            actuator_length_m, actuator_velocity_m_s, actuator_acceleration_m_s2, rod_direction,
            hooke_joint_position_m, platform_joint_position_m, platform_joint_rate_rad_s,
        })
    }

    /// Motion of payload, rods and movers (11)-(13), (22), (24)-(29). Depends on poses, velocities and
    /// accelerations of both bodies.
    ///
    /// # Errors
    /// See [`Hexapod`].
    pub fn body_kinematics(
        &self,
        base: &BaseMotion<T>,
        platform: &PlatformState<T>,
        platform_acceleration: &Acceleration<T>,
    ) -> Result<BodyKinematics<T>, Error>
    where
        M: kernels::uhp::BodyKinematics<T>,
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
            rod_angular_velocity_rad_s, rod_angular_acceleration_rad_s2, rod_com_position_m,
            rod_com_velocity_m_s, rod_com_acceleration_m_s2, mover_position_m, mover_velocity_m_s,
            mover_acceleration_m_s2,
        })
    }

    /// Partial velocities and partial angular velocities of payload, rods and movers (33)-(38). Depends on
    /// the poses.
    ///
    /// # Errors
    /// See [`Hexapod`].
    pub fn partial_velocities(
        &self,
        base: &BaseMotion<T>,
        platform: &PlatformState<T>,
    ) -> Result<PartialVelocities<T>, Error>
    where
        M: kernels::uhp::PartialVelocities<T>,
    {
        let (b, p) = arrays(base, platform);
        self.check_poses(&b, &p)?;
        evaluate!(self.model.partial_velocities(
            b.position, b.rotation, p.position, p.rotation
        ) -> PartialVelocities {
            payload_partial_velocity, payload_partial_angular_velocity, rod_partial_velocity,
            rod_partial_angular_velocity, mover_partial_velocity,
        })
    }
}
