//! Partial velocities (33)-(38) of all moving bodies and their inertial time derivatives, in O coordinates.
//!
//! A body's velocity is `J_p v_p + J_b v_b`, its angular velocity `J_wp v_p + J_wb v_b`. Kane's equations for
//! the six platform speeds project on `J_p` and `J_wp`; `J_b` and `J_wb` carry the base's motion into them.
//! The payload does not depend on `v_b`. With the dot for the derivative seen from O, accelerations are `J_p
//! v_p' + J_b v_b' + J_p' v_p + J_b' v_b`.

use core::array::from_fn;

use nalgebra::{Matrix3, Matrix3x6, RowVector6, Vector3};

use crate::bodies::mover_arm;
use crate::leg::{LegGeometry, LegVelocity, leg_geometries};
use crate::parameters::{Leg, Parameters};
use crate::state::{RigidBodyMotion, State, stack};

/// Velocity of a body's point at `arm` from the body's origin, as a matrix on the body's `[r'; w]`: `[1,
/// -[arm]x]`.
fn point_partial(arm: &Vector3<f64>) -> Matrix3x6<f64> {
    blocks(&Matrix3::identity(), &-arm.cross_matrix())
}

/// Time derivative of [`point_partial`] for an arm that changes by `arm_rate`, 1/s.
fn point_partial_rate(arm_rate: &Vector3<f64>) -> Matrix3x6<f64> {
    blocks(&Matrix3::zeros(), &-arm_rate.cross_matrix())
}

fn blocks(left: &Matrix3<f64>, right: &Matrix3<f64>) -> Matrix3x6<f64> {
    let mut joined = Matrix3x6::zeros();
    joined.fixed_columns_mut::<3>(0).copy_from(left);
    joined.fixed_columns_mut::<3>(3).copy_from(right);
    joined
}

/// Partial velocities of the payload by `v_p`, or their time derivatives (1/s more).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PayloadPartials {
    /// Of the centre of mass.
    pub velocity: Matrix3x6<f64>,
    /// Of the angular velocity.
    pub angular_velocity: Matrix3x6<f64>,
}

impl PayloadPartials {
    /// `[1, -[R_p r_c]x]` and `[0, 1]` (33), (34).
    pub fn new(parameters: &Parameters, platform: &RigidBodyMotion) -> Self {
        Self {
            velocity: point_partial(&(platform.rotation * parameters.payload.com_m)),
            angular_velocity: blocks(&Matrix3::zeros(), &Matrix3::identity()),
        }
    }

    /// Time derivatives of [`PayloadPartials::new`].
    pub fn rates(parameters: &Parameters, platform: &RigidBodyMotion) -> Self {
        let arm = platform.rotation * parameters.payload.com_m;
        Self {
            velocity: point_partial_rate(&platform.angular_velocity().cross(&arm)),
            angular_velocity: Matrix3x6::zeros(),
        }
    }
}

/// Partial velocities of one leg's bodies by `v_p` or by `v_b`, or their time derivatives (1/s more).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LegPartials {
    /// Of the actuator's velocity `d'`: a row of `J_dp`, or of `-J_db`.
    pub length: RowVector6<f64>,
    /// Of the Hooke joint.
    pub hooke: Matrix3x6<f64>,
    /// Of the platform joint; zero by `v_b`.
    pub platform_joint: Matrix3x6<f64>,
    /// Of the mover's centre of mass.
    pub mover: Matrix3x6<f64>,
    /// Of the rod's centre of mass.
    pub rod: Matrix3x6<f64>,
    /// Of the rod's angular velocity.
    pub rod_angular: Matrix3x6<f64>,
}

impl LegPartials {
    /// By the platform's speeds `v_p`.
    pub fn by_platform(leg: &Leg, geometry: &LegGeometry) -> Self {
        let length = geometry.jacobian_dp();
        let slide = geometry.axis * length;
        Self::of_ends(leg, geometry, length, slide, point_partial(&geometry.platform_arm), slide)
    }

    /// By the base's speeds `v_b`.
    pub fn by_base(leg: &Leg, geometry: &LegGeometry) -> Self {
        let length = -geometry.jacobian_db();
        let slide = geometry.axis * length;
        let hooke = point_partial(&geometry.hooke_arm) + slide;
        let mover = point_partial(&mover_arm(leg, geometry)) + slide;
        Self::of_ends(leg, geometry, length, hooke, Matrix3x6::zeros(), mover)
    }

    /// The rod from its ends: centre of mass as in (28), angular velocity as in (22).
    fn of_ends(
        leg: &Leg,
        geometry: &LegGeometry,
        length: RowVector6<f64>,
        hooke: Matrix3x6<f64>,
        platform_joint: Matrix3x6<f64>,
        mover: Matrix3x6<f64>,
    ) -> Self {
        let k = leg.rod_com_fraction;
        Self {
            length,
            hooke,
            platform_joint,
            mover,
            rod: (1.0 - k) * hooke + k * platform_joint,
            rod_angular: geometry.direction.cross_matrix() * (platform_joint - hooke) / leg.rod_length_m,
        }
    }

    /// Time derivatives of [`LegPartials::by_platform`], whose result is `self`.
    pub fn rates_by_platform(
        &self,
        leg: &Leg,
        geometry: &LegGeometry,
        velocity: &LegVelocity,
        platform: &RigidBodyMotion,
    ) -> Self {
        let arm = &geometry.platform_arm;
        let arm_rate = platform.angular_velocity().cross(arm);
        let length = self.length_partial_rate(geometry, velocity, arm, &arm_rate, 1.0);
        let slide = velocity.axis_rate * self.length + geometry.axis * length;
        self.rates_of_ends(leg, geometry, velocity, length, slide, point_partial_rate(&arm_rate), slide)
    }

    /// Time derivatives of [`LegPartials::by_base`], whose result is `self`.
    pub fn rates_by_base(
        &self,
        leg: &Leg,
        geometry: &LegGeometry,
        velocity: &LegVelocity,
        base: &RigidBodyMotion,
    ) -> Self {
        let w_b = base.angular_velocity();
        let arm = &geometry.hooke_arm;
        let arm_rate = w_b.cross(arm) + velocity.length_rate * geometry.axis;
        let mover_rate = w_b.cross(&mover_arm(leg, geometry)) + velocity.length_rate * geometry.axis;
        let length = self.length_partial_rate(geometry, velocity, arm, &arm_rate, -1.0);
        let slide = velocity.axis_rate * self.length + geometry.axis * length;
        let hooke = point_partial_rate(&arm_rate) + slide;
        let mover = point_partial_rate(&mover_rate) + slide;
        self.rates_of_ends(leg, geometry, velocity, length, hooke, Matrix3x6::zeros(), mover)
    }

    /// Time derivative of `sign [u, arm x u]^T / (u . a)`, the rows (32) and (31), by the quotient rule.
    fn length_partial_rate(
        &self,
        geometry: &LegGeometry,
        velocity: &LegVelocity,
        arm: &Vector3<f64>,
        arm_rate: &Vector3<f64>,
        sign: f64,
    ) -> RowVector6<f64> {
        let (u, u_rate) = (&geometry.direction, &velocity.direction_rate);
        let cosine_rate = u_rate.dot(&geometry.axis) + u.dot(&velocity.axis_rate);
        let numerator_rate = stack(u_rate, &(arm_rate.cross(u) + arm.cross(u_rate))).transpose();
        (sign * numerator_rate - cosine_rate * self.length) / geometry.cosine
    }

    fn rates_of_ends(
        &self,
        leg: &Leg,
        geometry: &LegGeometry,
        velocity: &LegVelocity,
        length: RowVector6<f64>,
        hooke: Matrix3x6<f64>,
        platform_joint: Matrix3x6<f64>,
        mover: Matrix3x6<f64>,
    ) -> Self {
        let k = leg.rod_com_fraction;
        let turned = velocity.direction_rate.cross_matrix() * (self.platform_joint - self.hooke);
        let moved = geometry.direction.cross_matrix() * (platform_joint - hooke);
        Self {
            length,
            hooke,
            platform_joint,
            mover,
            rod: (1.0 - k) * hooke + k * platform_joint,
            rod_angular: (turned + moved) / leg.rod_length_m,
        }
    }
}

/// What [`partial_velocities`] returns: 3x6 matrices on `v_p = [r_p'; w_p]`, in O.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PartialVelocities {
    /// Payload's centre of mass.
    pub payload_partial_velocity: Matrix3x6<f64>,
    /// Payload's angular velocity.
    pub payload_partial_angular_velocity: Matrix3x6<f64>,
    /// Rods' centres of mass.
    pub rod_partial_velocity: [Matrix3x6<f64>; 6],
    /// Rods' angular velocities.
    pub rod_partial_angular_velocity: [Matrix3x6<f64>; 6],
    /// Movers' centres of mass.
    pub mover_partial_velocity: [Matrix3x6<f64>; 6],
}

/// Derivatives by `v_p` of the velocities of all moving bodies (33)-(38).
pub fn partial_velocities(parameters: &Parameters, state: &State) -> PartialVelocities {
    let geometries = leg_geometries(parameters, state);
    let payload = PayloadPartials::new(parameters, &state.platform);
    let legs: [LegPartials; 6] = from_fn(|i| LegPartials::by_platform(&parameters.legs[i], &geometries[i]));
    PartialVelocities {
        payload_partial_velocity: payload.velocity,
        payload_partial_angular_velocity: payload.angular_velocity,
        rod_partial_velocity: legs.map(|leg| leg.rod),
        rod_partial_angular_velocity: legs.map(|leg| leg.rod_angular),
        mover_partial_velocity: legs.map(|leg| leg.mover),
    }
}
