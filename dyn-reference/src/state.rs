//! Motion of the base and the platform, and the forces applied: everything that changes from call to call.
//!
//! The generalised speeds are those of section 3: `v_b = [r_b'; w_b]`, `v_p = [r_p'; w_p]` in O coordinates,
//! where `w` is the angular velocity, never the rates of Euler angles.

use nalgebra::{Matrix3, Vector3, Vector6};

/// Pose, velocity and acceleration of the base or the platform.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigidBodyMotion {
    /// Position of the body's origin, m, in O. The platform's origin is the centre of its joint circle.
    pub position_m: Vector3<f64>,
    /// Rotation from body to inertial coordinates, orthonormal.
    pub rotation: Matrix3<f64>,
    /// `[r'; w]`, m/s and rad/s, in O.
    pub velocity: Vector6<f64>,
    /// `[r''; w']`, m/s^2 and rad/s^2, in O.
    pub acceleration: Vector6<f64>,
}

impl RigidBodyMotion {
    /// At rest in the given pose.
    pub fn at_rest(position_m: Vector3<f64>, rotation: Matrix3<f64>) -> Self {
        Self { position_m, rotation, velocity: Vector6::zeros(), acceleration: Vector6::zeros() }
    }

    /// Velocity `r'` of the origin, m/s, in O.
    #[inline]
    pub fn linear_velocity(&self) -> Vector3<f64> {
        linear(&self.velocity)
    }

    /// Angular velocity `w`, rad/s, in O.
    #[inline]
    pub fn angular_velocity(&self) -> Vector3<f64> {
        angular(&self.velocity)
    }

    /// Acceleration `r''` of the origin, m/s^2, in O.
    #[inline]
    pub fn linear_acceleration(&self) -> Vector3<f64> {
        linear(&self.acceleration)
    }

    /// Angular acceleration `w'`, rad/s^2, in O.
    #[inline]
    pub fn angular_acceleration(&self) -> Vector3<f64> {
        angular(&self.acceleration)
    }

    /// Velocity of the body's point at `arm` (m, in O, from the origin), m/s, in O.
    #[inline]
    pub fn point_velocity(&self, arm: &Vector3<f64>) -> Vector3<f64> {
        self.linear_velocity() + self.angular_velocity().cross(arm)
    }

    /// Acceleration of the body's point at `arm` (m, in O, from the origin), m/s^2, in O.
    #[inline]
    pub fn point_acceleration(&self, arm: &Vector3<f64>) -> Vector3<f64> {
        let w = self.angular_velocity();
        self.linear_acceleration() + self.angular_acceleration().cross(arm) + w.cross(&w.cross(arm))
    }
}

/// Motion and applied forces at one instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State {
    /// Motion of the base B.
    pub base: RigidBodyMotion,
    /// Motion of the platform P.
    pub platform: RigidBodyMotion,
    /// Reference velocity `[r_r'; w_r]` of the platform, m/s and rad/s, in O; only passivity-based control reads it.
    pub reference_velocity: Vector6<f64>,
    /// Actuator forces `F_i` along the axes, on the movers, N.
    pub actuator_force_n: Vector6<f64>,
    /// `[F_D; M_D]`, N and N m, in O, at the payload's centre of mass.
    pub external_wrench: Vector6<f64>,
}

/// The first three components of a speed, acceleration or wrench.
#[inline]
pub(crate) fn linear(v: &Vector6<f64>) -> Vector3<f64> {
    Vector3::new(v[0], v[1], v[2])
}

/// The last three components of a speed, acceleration or wrench.
#[inline]
pub(crate) fn angular(v: &Vector6<f64>) -> Vector3<f64> {
    Vector3::new(v[3], v[4], v[5])
}

/// A speed, acceleration or wrench from its two halves.
#[inline]
pub(crate) fn stack(linear: &Vector3<f64>, angular: &Vector3<f64>) -> Vector6<f64> {
    Vector6::new(linear.x, linear.y, linear.z, angular.x, angular.y, angular.z)
}
