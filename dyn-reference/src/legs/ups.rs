//! The classical Gough-Stewart leg, from the base up: universal joint, lower part, actuator, upper part, spherical joint.
//!
//! The actuator lies along the line of the joints: `d = |l|`, `u = l/d` is direction and axis in one. Its bodies are the
//! lower part, which turns about the base joint, and the upper part, which turns about the platform joint; both are
//! rigid, axisymmetric about the line of the joints and have the leg's angular velocity
//! `w_s = u x (r_pi' - r_bi')/d` (22).

use core::array::from_fn;

use nalgebra::{Matrix3x6, RowVector6, Vector3};

use super::{AxialElement, LegType};
use crate::inputs::{InputError, array};
use crate::leg::{LegAcceleration, LegGeometry, LegVelocity};
use crate::outputs::{Output, SIX_PARTIALS, SIX_VECTORS, SQUARE, put_all, put_body};
use crate::partial_velocities::{LegPartials, length_partial_rate, point_partial, point_partial_rate};
use crate::state::RigidBodyMotion;
use crate::{body_kinematics, generalised_forces, partial_velocities};

/// One leg.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leg {
    /// Centre `b_i` of the universal joint on the base, m, in B.
    pub base_point_m: Vector3<f64>,
    /// Centre `p_i` of the spherical joint on the platform, m, in P.
    pub platform_point_m: Vector3<f64>,
    /// Mass of the lower part, kg.
    pub lower_mass_kg: f64,
    /// Distance of the lower part's centre of mass from the base joint, towards the platform joint, m.
    pub lower_com_distance_m: f64,
    /// Transverse moment of inertia of the lower part about its centre of mass, kg m^2.
    pub lower_inertia_kg_m2: f64,
    /// Mass of the upper part, kg.
    pub upper_mass_kg: f64,
    /// Distance of the upper part's centre of mass from the platform joint, towards the base joint, m.
    pub upper_com_distance_m: f64,
    /// Transverse moment of inertia of the upper part about its centre of mass, kg m^2.
    pub upper_inertia_kg_m2: f64,
    /// Actuator length `d_0` at which the axial spring is relaxed, m.
    pub rest_length_m: f64,
    /// Stiffness `k_e` of the axial spring, N/m.
    pub axial_stiffness_n_m: f64,
    /// Viscous damping `c_e` along the leg, N s/m.
    pub axial_damping_n_s_m: f64,
}

impl Leg {
    /// Centres of mass seen from their joints, m, in O: the lower part's from the base joint, the upper part's from the
    /// platform joint.
    fn com_arms(&self, geometry: &LegGeometry) -> [Vector3<f64>; 2] {
        let u = &geometry.direction;
        [self.lower_com_distance_m * u, -self.upper_com_distance_m * u]
    }

    /// Partial velocities of two bodies that turn with `w_s` about the joints: `v + w_s x arm`.
    fn partials_of_joints(
        &self,
        geometry: &LegGeometry,
        length: RowVector6<f64>,
        base_joint: Matrix3x6<f64>,
        platform_joint: Matrix3x6<f64>,
    ) -> LegPartials {
        let angular = geometry.direction.cross_matrix() * (platform_joint - base_joint) / geometry.length;
        let [lower, upper] = self.com_arms(geometry);
        LegPartials {
            length,
            hooke: base_joint,
            platform_joint,
            com: [
                base_joint - lower.cross_matrix() * angular,
                platform_joint - upper.cross_matrix() * angular,
            ],
            angular,
        }
    }

    /// Time derivatives of [`Leg::partials_of_joints`].
    fn partial_rates_of_joints(
        &self,
        partials: &LegPartials,
        geometry: &LegGeometry,
        velocity: &LegVelocity,
        length: RowVector6<f64>,
        base_joint: Matrix3x6<f64>,
        platform_joint: Matrix3x6<f64>,
    ) -> LegPartials {
        let turned = velocity.direction_rate.cross_matrix() * (partials.platform_joint - partials.hooke);
        let moved = geometry.direction.cross_matrix() * (platform_joint - base_joint);
        let angular = (turned + moved - velocity.length_rate * partials.angular) / geometry.length;
        let arms = self.com_arms(geometry);
        let [lower, upper] = arms.map(|arm| {
            let arm_rate = velocity.rod_angular.cross(&arm);
            arm_rate.cross_matrix() * partials.angular + arm.cross_matrix() * angular
        });
        LegPartials {
            length,
            hooke: base_joint,
            platform_joint,
            com: [base_joint - lower, platform_joint - upper],
            angular,
        }
    }
}

impl LegType for Leg {
    const PARAMETERS: &'static [(&'static str, &'static [usize])] = &[
        ("base_point", &[6, 3]),
        ("platform_point", &[6, 3]),
        ("lower_mass", &[6]),
        ("lower_com_distance", &[6]),
        ("lower_inertia", &[6]),
        ("upper_mass", &[6]),
        ("upper_com_distance", &[6]),
        ("upper_inertia", &[6]),
        ("rest_length", &[6]),
        ("axial_stiffness", &[6]),
        ("axial_damping", &[6]),
    ];

    #[rustfmt::skip]
    const OUTPUTS: &'static [Output<Self>] = &[
        Output { name: "leg_angular_velocity", shape: SIX_VECTORS, append: |p, s, out| put_all(&body_kinematics(p, s).leg_angular_velocity, out) },
        Output { name: "leg_angular_acceleration", shape: SIX_VECTORS, append: |p, s, out| put_all(&body_kinematics(p, s).leg_angular_acceleration, out) },
        Output { name: "lower_com_position", shape: SIX_VECTORS, append: |p, s, out| put_body(&body_kinematics(p, s).com_position, 0, out) },
        Output { name: "lower_com_velocity", shape: SIX_VECTORS, append: |p, s, out| put_body(&body_kinematics(p, s).com_velocity, 0, out) },
        Output { name: "lower_com_acceleration", shape: SIX_VECTORS, append: |p, s, out| put_body(&body_kinematics(p, s).com_acceleration, 0, out) },
        Output { name: "upper_com_position", shape: SIX_VECTORS, append: |p, s, out| put_body(&body_kinematics(p, s).com_position, 1, out) },
        Output { name: "upper_com_velocity", shape: SIX_VECTORS, append: |p, s, out| put_body(&body_kinematics(p, s).com_velocity, 1, out) },
        Output { name: "upper_com_acceleration", shape: SIX_VECTORS, append: |p, s, out| put_body(&body_kinematics(p, s).com_acceleration, 1, out) },
        Output { name: "lower_partial_velocity", shape: SIX_PARTIALS, append: |p, s, out| put_body(&partial_velocities(p, s).com_partial_velocity, 0, out) },
        Output { name: "upper_partial_velocity", shape: SIX_PARTIALS, append: |p, s, out| put_body(&partial_velocities(p, s).com_partial_velocity, 1, out) },
        Output { name: "leg_partial_angular_velocity", shape: SIX_PARTIALS, append: |p, s, out| put_all(&partial_velocities(p, s).leg_partial_angular_velocity, out) },
        Output { name: "lower_active_force", shape: SQUARE, append: |p, s, out| put_body(&generalised_forces(p, s).active_force, 0, out) },
        Output { name: "lower_inertia_force", shape: SQUARE, append: |p, s, out| put_body(&generalised_forces(p, s).inertia_force, 0, out) },
        Output { name: "upper_active_force", shape: SQUARE, append: |p, s, out| put_body(&generalised_forces(p, s).active_force, 1, out) },
        Output { name: "upper_inertia_force", shape: SQUARE, append: |p, s, out| put_body(&generalised_forces(p, s).inertia_force, 1, out) },
    ];

    fn from_arrays(lookup: &mut impl FnMut(&str) -> Option<Vec<f64>>) -> Result<[Self; 6], InputError> {
        let base_point = array::<18>(lookup, "base_point")?;
        let platform_point = array::<18>(lookup, "platform_point")?;
        let lower_mass = array::<6>(lookup, "lower_mass")?;
        let lower_com_distance = array::<6>(lookup, "lower_com_distance")?;
        let lower_inertia = array::<6>(lookup, "lower_inertia")?;
        let upper_mass = array::<6>(lookup, "upper_mass")?;
        let upper_com_distance = array::<6>(lookup, "upper_com_distance")?;
        let upper_inertia = array::<6>(lookup, "upper_inertia")?;
        let rest_length = array::<6>(lookup, "rest_length")?;
        let axial_stiffness = array::<6>(lookup, "axial_stiffness")?;
        let axial_damping = array::<6>(lookup, "axial_damping")?;
        let point = |of: &[f64; 18], i: usize| Vector3::new(of[3 * i], of[3 * i + 1], of[3 * i + 2]);
        Ok(from_fn(|i| Leg {
            base_point_m: point(&base_point, i),
            platform_point_m: point(&platform_point, i),
            lower_mass_kg: lower_mass[i],
            lower_com_distance_m: lower_com_distance[i],
            lower_inertia_kg_m2: lower_inertia[i],
            upper_mass_kg: upper_mass[i],
            upper_com_distance_m: upper_com_distance[i],
            upper_inertia_kg_m2: upper_inertia[i],
            rest_length_m: rest_length[i],
            axial_stiffness_n_m: axial_stiffness[i],
            axial_damping_n_s_m: axial_damping[i],
        }))
    }

    /// The closure `l = d u`.
    fn geometry(&self, base: &RigidBodyMotion, platform: &RigidBodyMotion) -> LegGeometry {
        let base_arm = base.rotation * self.base_point_m;
        let platform_arm = platform.rotation * self.platform_point_m;
        let l = platform.position_m + platform_arm - base.position_m - base_arm;
        let length = l.norm();
        let direction = l / length;
        LegGeometry {
            axis: direction,
            base_arm,
            platform_arm,
            hooke_arm: base_arm,
            length,
            direction,
            cosine: 1.0,
        }
    }

    fn velocity(
        &self,
        geometry: &LegGeometry,
        base: &RigidBodyMotion,
        platform: &RigidBodyMotion,
    ) -> LegVelocity {
        let u = &geometry.direction;
        let platform_joint = platform.point_velocity(&geometry.platform_arm);
        let base_joint = base.point_velocity(&geometry.base_arm);
        let span_rate = platform_joint - base_joint;
        let rod_angular = u.cross(&span_rate) / geometry.length;
        let direction_rate = rod_angular.cross(u);
        LegVelocity {
            axis_rate: direction_rate,
            length_rate: u.dot(&span_rate),
            hooke: base_joint,
            platform_joint,
            rod_angular,
            direction_rate,
        }
    }

    fn acceleration(
        &self,
        geometry: &LegGeometry,
        velocity: &LegVelocity,
        base: &RigidBodyMotion,
        platform: &RigidBodyMotion,
    ) -> LegAcceleration {
        let u = &geometry.direction;
        let platform_joint = platform.point_acceleration(&geometry.platform_arm);
        let base_joint = base.point_acceleration(&geometry.base_arm);
        let span_acceleration = platform_joint - base_joint;
        // l'' = d'' u + 2 d' w_s x u + d (w_s' x u + w_s x (w_s x u)), along u and across it.
        let length = u.dot(&span_acceleration) + geometry.length * velocity.rod_angular.norm_squared();
        let turning = u.cross(&span_acceleration) - 2.0 * velocity.length_rate * velocity.rod_angular;
        LegAcceleration { length, hooke: base_joint, platform_joint, rod_angular: turning / geometry.length }
    }

    /// The leg lies along its own line of force: 1, and NaN where the joints coincide.
    fn alignment(&self, base: &RigidBodyMotion, platform: &RigidBodyMotion) -> f64 {
        let direction = self.geometry(base, platform).direction;
        direction.norm_squared()
    }

    fn axial_element(&self) -> AxialElement {
        AxialElement {
            rest_length_m: self.rest_length_m,
            stiffness_n_m: self.axial_stiffness_n_m,
            damping_n_s_m: self.axial_damping_n_s_m,
        }
    }

    fn masses(&self) -> [f64; 2] {
        [self.lower_mass_kg, self.upper_mass_kg]
    }

    fn inertias(&self) -> [f64; 2] {
        [self.lower_inertia_kg_m2, self.upper_inertia_kg_m2]
    }

    fn turning_inertia(&self) -> f64 {
        self.lower_inertia_kg_m2 + self.upper_inertia_kg_m2
    }

    fn com_position(
        &self,
        geometry: &LegGeometry,
        base: &RigidBodyMotion,
        platform: &RigidBodyMotion,
    ) -> [Vector3<f64>; 2] {
        let [lower, upper] = self.com_arms(geometry);
        [base.position_m + geometry.base_arm + lower, platform.position_m + geometry.platform_arm + upper]
    }

    fn com_velocity(
        &self,
        geometry: &LegGeometry,
        velocity: &LegVelocity,
        _base: &RigidBodyMotion,
    ) -> [Vector3<f64>; 2] {
        let [lower, upper] = self.com_arms(geometry).map(|arm| velocity.rod_angular.cross(&arm));
        [velocity.hooke + lower, velocity.platform_joint + upper]
    }

    fn com_acceleration(
        &self,
        geometry: &LegGeometry,
        velocity: &LegVelocity,
        acceleration: &LegAcceleration,
        _base: &RigidBodyMotion,
    ) -> [Vector3<f64>; 2] {
        let w = &velocity.rod_angular;
        let turning = |arm: Vector3<f64>| acceleration.rod_angular.cross(&arm) + w.cross(&w.cross(&arm));
        let [lower, upper] = self.com_arms(geometry).map(turning);
        [acceleration.hooke + lower, acceleration.platform_joint + upper]
    }

    /// The actuator pushes the parts apart.
    fn active_force(
        &self,
        gravity: &Vector3<f64>,
        axial_force: f64,
        geometry: &LegGeometry,
    ) -> [Vector3<f64>; 2] {
        let apart = axial_force * geometry.axis;
        [self.lower_mass_kg * gravity - apart, self.upper_mass_kg * gravity + apart]
    }

    fn partials_by_platform(&self, geometry: &LegGeometry) -> LegPartials {
        let joint = point_partial(&geometry.platform_arm);
        self.partials_of_joints(geometry, geometry.jacobian_dp(), Matrix3x6::zeros(), joint)
    }

    fn partials_by_base(&self, geometry: &LegGeometry) -> LegPartials {
        let joint = point_partial(&geometry.base_arm);
        self.partials_of_joints(geometry, -geometry.jacobian_db(), joint, Matrix3x6::zeros())
    }

    fn partial_rates_by_platform(
        &self,
        partials: &LegPartials,
        geometry: &LegGeometry,
        velocity: &LegVelocity,
        platform: &RigidBodyMotion,
    ) -> LegPartials {
        let arm = &geometry.platform_arm;
        let arm_rate = platform.angular_velocity().cross(arm);
        let length = length_partial_rate(partials, geometry, velocity, arm, &arm_rate, 1.0);
        let joint = point_partial_rate(&arm_rate);
        self.partial_rates_of_joints(partials, geometry, velocity, length, Matrix3x6::zeros(), joint)
    }

    fn partial_rates_by_base(
        &self,
        partials: &LegPartials,
        geometry: &LegGeometry,
        velocity: &LegVelocity,
        base: &RigidBodyMotion,
    ) -> LegPartials {
        let arm = &geometry.base_arm;
        let arm_rate = base.angular_velocity().cross(arm);
        let length = length_partial_rate(partials, geometry, velocity, arm, &arm_rate, -1.0);
        let joint = point_partial_rate(&arm_rate);
        self.partial_rates_of_joints(partials, geometry, velocity, length, joint, Matrix3x6::zeros())
    }
}
