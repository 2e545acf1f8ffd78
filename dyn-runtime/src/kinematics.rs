//! Kinematics of legs and bodies.

use nalgebra::{Matrix3x6, Vector3, Vector6};

use crate::arrays::{matrices, matrix, vectors};
use crate::check::{finite, finite_result};
use crate::error::{Error, Input};
use crate::hexapod::{Hexapod, Poses, States};
use crate::kernels;
use crate::state::{Acceleration, BaseMotion, PlatformState};

/// Where the legs are and how they move; legs in the order of the platform file, vectors in O.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct LegKinematics {
    /// d, m (18).
    pub actuator_length_m: Vector6<f64>,
    /// d', m/s (30).
    pub actuator_velocity_m_s: Vector6<f64>,
    /// d'', m/s^2.
    pub actuator_acceleration_m_s2: Vector6<f64>,
    /// u, unit vector along the rod, from Hooke to platform joint (17).
    pub rod_direction: [Vector3<f64>; 6],
    /// Centre of the Hooke joint between actuator and rod, m.
    pub hooke_joint_position_m: [Vector3<f64>; 6],
    /// Centre of the universal joint between rod and platform, m.
    pub platform_joint_position_m: [Vector3<f64>; 6],
    /// Angular velocity of the platform relative to the rod, `w_p - w_s`, rad/s (23).
    pub universal_joint_rate_rad_s: [Vector3<f64>; 6],
}

/// Motion of the moving bodies, vectors in O.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct BodyKinematics {
    /// Payload's centre of mass, m (11).
    pub payload_com_position_m: Vector3<f64>,
    /// Its velocity, m/s (12).
    pub payload_com_velocity_m_s: Vector3<f64>,
    /// Its acceleration, m/s^2 (13).
    pub payload_com_acceleration_m_s2: Vector3<f64>,
    /// w_s of each rod, without spin, rad/s (22).
    pub rod_angular_velocity_rad_s: [Vector3<f64>; 6],
    /// w_s' of each rod, rad/s^2.
    pub rod_angular_acceleration_rad_s2: [Vector3<f64>; 6],
    /// Centre of mass of each rod, m (27).
    pub rod_com_position_m: [Vector3<f64>; 6],
    /// Its velocity, m/s (28).
    pub rod_com_velocity_m_s: [Vector3<f64>; 6],
    /// Its acceleration, m/s^2 (29).
    pub rod_com_acceleration_m_s2: [Vector3<f64>; 6],
    /// Each mover, m (24).
    pub mover_position_m: [Vector3<f64>; 6],
    /// Its velocity, m/s (25).
    pub mover_velocity_m_s: [Vector3<f64>; 6],
    /// Its acceleration, m/s^2 (26).
    pub mover_acceleration_m_s2: [Vector3<f64>; 6],
}

/// Derivatives of body velocities by the six platform speeds `v_p = [r_p'; w_p]`, O axes. Three columns for
/// the translational speeds, then three for the rotational ones.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct PartialVelocities {
    /// Velocity of the payload's centre of mass.
    pub payload_partial_velocity: Matrix3x6<f64>,
    /// Angular velocity of the payload.
    pub payload_partial_angular_velocity: Matrix3x6<f64>,
    /// Velocity of each rod's centre of mass.
    pub rod_partial_velocity: [Matrix3x6<f64>; 6],
    /// Angular velocity of each rod.
    pub rod_partial_angular_velocity: [Matrix3x6<f64>; 6],
    /// Velocity of each mover.
    pub mover_partial_velocity: [Matrix3x6<f64>; 6],
}

impl<M: kernels::RodAlignment> Hexapod<M> {
    /// `(u_i.a_i)^2 = 1 - n_i.n_i/s_i^2` of each leg: 1 where the rod lies along its actuator, 0 where it is
    /// perpendicular, negative where the platform joint is out of reach. Depends on the poses.
    ///
    /// # Errors
    /// Inputs that are not finite and rotations that are not rotations; every reach is a valid answer here.
    pub fn rod_alignment(&self, base: &BaseMotion, platform: &PlatformState) -> Result<Vector6<f64>, Error> {
        let rod_alignment = self.alignment_at(&Poses::checked(&base.pose, &platform.pose)?);
        finite_result(&[&rod_alignment])?;
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
        base: &BaseMotion,
        platform: &PlatformState,
        platform_acceleration: &Acceleration,
    ) -> Result<LegKinematics, Error>
    where
        M: kernels::LegKinematics,
    {
        let base_acceleration = finite(Input::BaseAcceleration, base.acceleration.to_array())?;
        let platform_acceleration = finite(Input::PlatformAcceleration, platform_acceleration.to_array())?;
        let States {
            base_position,
            base_rotation,
            base_velocity,
            platform_position,
            platform_rotation,
            platform_velocity,
        } = self.states(base, platform)?;
        let mut actuator_length = [0.0; 6];
        let mut actuator_velocity = [0.0; 6];
        let mut actuator_acceleration = [0.0; 6];
        let mut rod_direction = [[0.0; 3]; 6];
        let mut hooke_joint_position = [[0.0; 3]; 6];
        let mut platform_joint_position = [[0.0; 3]; 6];
        let mut universal_joint_rate = [[0.0; 3]; 6];
        self.model.leg_kinematics(
            &base_position,
            &base_rotation,
            &base_velocity,
            &base_acceleration,
            &platform_position,
            &platform_rotation,
            &platform_velocity,
            &platform_acceleration,
            &mut actuator_length,
            &mut actuator_velocity,
            &mut actuator_acceleration,
            &mut rod_direction,
            &mut hooke_joint_position,
            &mut platform_joint_position,
            &mut universal_joint_rate,
        );
        finite_result(&[&actuator_length, &actuator_velocity, &actuator_acceleration])?;
        finite_result(&[
            &rod_direction,
            &hooke_joint_position,
            &platform_joint_position,
            &universal_joint_rate,
        ])?;
        Ok(LegKinematics {
            actuator_length_m: actuator_length.into(),
            actuator_velocity_m_s: actuator_velocity.into(),
            actuator_acceleration_m_s2: actuator_acceleration.into(),
            rod_direction: vectors(&rod_direction),
            hooke_joint_position_m: vectors(&hooke_joint_position),
            platform_joint_position_m: vectors(&platform_joint_position),
            universal_joint_rate_rad_s: vectors(&universal_joint_rate),
        })
    }

    /// Motion of payload, rods and movers (11)-(13), (22), (24)-(29). Depends on poses, velocities and
    /// accelerations of both bodies.
    ///
    /// # Errors
    /// See [`Hexapod`].
    pub fn body_kinematics(
        &self,
        base: &BaseMotion,
        platform: &PlatformState,
        platform_acceleration: &Acceleration,
    ) -> Result<BodyKinematics, Error>
    where
        M: kernels::BodyKinematics,
    {
        let base_acceleration = finite(Input::BaseAcceleration, base.acceleration.to_array())?;
        let platform_acceleration = finite(Input::PlatformAcceleration, platform_acceleration.to_array())?;
        let States {
            base_position,
            base_rotation,
            base_velocity,
            platform_position,
            platform_rotation,
            platform_velocity,
        } = self.states(base, platform)?;
        let mut payload_com_position = [0.0; 3];
        let mut payload_com_velocity = [0.0; 3];
        let mut payload_com_acceleration = [0.0; 3];
        let mut rod_angular_velocity = [[0.0; 3]; 6];
        let mut rod_angular_acceleration = [[0.0; 3]; 6];
        let mut rod_com_position = [[0.0; 3]; 6];
        let mut rod_com_velocity = [[0.0; 3]; 6];
        let mut rod_com_acceleration = [[0.0; 3]; 6];
        let mut mover_position = [[0.0; 3]; 6];
        let mut mover_velocity = [[0.0; 3]; 6];
        let mut mover_acceleration = [[0.0; 3]; 6];
        self.model.body_kinematics(
            &base_position,
            &base_rotation,
            &base_velocity,
            &base_acceleration,
            &platform_position,
            &platform_rotation,
            &platform_velocity,
            &platform_acceleration,
            &mut payload_com_position,
            &mut payload_com_velocity,
            &mut payload_com_acceleration,
            &mut rod_angular_velocity,
            &mut rod_angular_acceleration,
            &mut rod_com_position,
            &mut rod_com_velocity,
            &mut rod_com_acceleration,
            &mut mover_position,
            &mut mover_velocity,
            &mut mover_acceleration,
        );
        finite_result(&[&payload_com_position, &payload_com_velocity, &payload_com_acceleration])?;
        finite_result(&[&rod_angular_velocity, &rod_angular_acceleration])?;
        finite_result(&[&rod_com_position, &rod_com_velocity, &rod_com_acceleration])?;
        finite_result(&[&mover_position, &mover_velocity, &mover_acceleration])?;
        Ok(BodyKinematics {
            payload_com_position_m: payload_com_position.into(),
            payload_com_velocity_m_s: payload_com_velocity.into(),
            payload_com_acceleration_m_s2: payload_com_acceleration.into(),
            rod_angular_velocity_rad_s: vectors(&rod_angular_velocity),
            rod_angular_acceleration_rad_s2: vectors(&rod_angular_acceleration),
            rod_com_position_m: vectors(&rod_com_position),
            rod_com_velocity_m_s: vectors(&rod_com_velocity),
            rod_com_acceleration_m_s2: vectors(&rod_com_acceleration),
            mover_position_m: vectors(&mover_position),
            mover_velocity_m_s: vectors(&mover_velocity),
            mover_acceleration_m_s2: vectors(&mover_acceleration),
        })
    }

    /// Partial velocities and partial angular velocities of payload, rods and movers (33)-(38). Depends on
    /// the poses.
    ///
    /// # Errors
    /// See [`Hexapod`].
    pub fn partial_velocities(
        &self,
        base: &BaseMotion,
        platform: &PlatformState,
    ) -> Result<PartialVelocities, Error>
    where
        M: kernels::PartialVelocities,
    {
        let Poses { base_position, base_rotation, platform_position, platform_rotation } =
            self.poses(base, platform)?;
        let mut payload_partial_velocity = [[0.0; 6]; 3];
        let mut payload_partial_angular_velocity = [[0.0; 6]; 3];
        let mut rod_partial_velocity = [[[0.0; 6]; 3]; 6];
        let mut rod_partial_angular_velocity = [[[0.0; 6]; 3]; 6];
        let mut mover_partial_velocity = [[[0.0; 6]; 3]; 6];
        self.model.partial_velocities(
            &base_position,
            &base_rotation,
            &platform_position,
            &platform_rotation,
            &mut payload_partial_velocity,
            &mut payload_partial_angular_velocity,
            &mut rod_partial_velocity,
            &mut rod_partial_angular_velocity,
            &mut mover_partial_velocity,
        );
        finite_result(&[&payload_partial_velocity, &payload_partial_angular_velocity])?;
        finite_result(&[&rod_partial_velocity, &rod_partial_angular_velocity, &mover_partial_velocity])?;
        Ok(PartialVelocities {
            payload_partial_velocity: matrix(&payload_partial_velocity),
            payload_partial_angular_velocity: matrix(&payload_partial_angular_velocity),
            rod_partial_velocity: matrices(&rod_partial_velocity),
            rod_partial_angular_velocity: matrices(&rod_partial_angular_velocity),
            mover_partial_velocity: matrices(&mover_partial_velocity),
        })
    }
}
