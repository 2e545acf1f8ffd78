//! The paper's leg, from the base up: prismatic actuator fixed to the base, mover, Hooke joint, rod, universal joint.
//!
//! Its bodies are the rod (27)-(29) and the mover, a point mass (24)-(26).

use core::array::from_fn;

use nalgebra::{Matrix3x6, RowVector6, Vector3};

use super::{AxialElement, LegType};
use crate::inputs::{InputError, array};
use crate::leg::{LegAcceleration, LegGeometry, LegVelocity};
use crate::outputs::{Output, SIX_PARTIALS, SIX_VECTORS, SQUARE, put_all, put_body};
use crate::partial_velocities::{LegPartials, length_partial_rate, point_partial, point_partial_rate};
use crate::state::RigidBodyMotion;
use crate::{body_kinematics, generalised_forces, partial_velocities};

/// One leg (Table 1).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leg {
    /// Origin `b_i` of the actuator's axis, m, in B.
    pub base_point_m: Vector3<f64>,
    /// Direction `a_i` in which the actuator extends, unit vector, in B.
    pub actuator_axis: Vector3<f64>,
    /// Centre `p_i` of the platform's joint, m, in P.
    pub platform_point_m: Vector3<f64>,
    /// Distance `s` between the Hooke joint and the platform joint, m.
    pub rod_length_m: f64,
    /// Mass `m_s` of the rod, kg.
    pub rod_mass_kg: f64,
    /// Transverse moment of inertia `J_s` of the rod about its centre of mass, kg m^2.
    pub rod_inertia_kg_m2: f64,
    /// Place `k` of the rod's centre of mass: 0 at the Hooke joint, 1 at the platform joint; the paper has
    /// 1/2.
    pub rod_com_fraction: f64,
    /// Mass `m_d` of the actuator's mover, kg.
    pub mover_mass_kg: f64,
    /// Distance `d*` by which the mover's centre of mass lies below the Hooke joint, along the axis, m.
    pub mover_offset_m: f64,
    /// Actuator length `d_0` at which the axial spring is relaxed, m.
    pub rest_length_m: f64,
    /// Stiffness `k_e` of the axial spring, N/m.
    pub axial_stiffness_n_m: f64,
    /// Viscous damping `c_e` along the axis, N s/m; the paper has none.
    pub axial_damping_n_s_m: f64,
}

impl Leg {
    /// The radicand of (18), m^2: square of the rod's component along the actuator.
    fn axial_reach_squared(&self, axis: &Vector3<f64>, l: &Vector3<f64>) -> f64 {
        let along = axis.dot(l);
        along * along - l.norm_squared() + self.rod_length_m * self.rod_length_m
    }

    /// The mover's centre of mass seen from the base's origin, m, in O (24).
    fn mover_arm(&self, geometry: &LegGeometry) -> Vector3<f64> {
        geometry.base_arm + (geometry.length - self.mover_offset_m) * geometry.axis
    }

    /// The rod's centre of mass from the values of any one quantity (position, velocity, acceleration) at its two
    /// ends: (27)-(29) for `k = 1/2`. The paper's (29) lacks the parentheses that put all of the sum under the
    /// factor 1/2.
    fn rod_com(&self, hooke: &Vector3<f64>, platform_joint: &Vector3<f64>) -> Vector3<f64> {
        (1.0 - self.rod_com_fraction) * hooke + self.rod_com_fraction * platform_joint
    }

    /// The rod's partial velocities from those of its ends: centre of mass as in (28), angular velocity as in (22).
    fn partials_of_ends(
        &self,
        geometry: &LegGeometry,
        length: RowVector6<f64>,
        hooke: Matrix3x6<f64>,
        platform_joint: Matrix3x6<f64>,
        mover: Matrix3x6<f64>,
    ) -> LegPartials {
        let k = self.rod_com_fraction;
        LegPartials {
            length,
            hooke,
            platform_joint,
            com: [(1.0 - k) * hooke + k * platform_joint, mover],
            angular: geometry.direction.cross_matrix() * (platform_joint - hooke) / self.rod_length_m,
        }
    }

    #[allow(clippy::too_many_arguments, reason = "the ends' rates, each under its name")]
    fn partial_rates_of_ends(
        &self,
        partials: &LegPartials,
        geometry: &LegGeometry,
        velocity: &LegVelocity,
        length: RowVector6<f64>,
        hooke: Matrix3x6<f64>,
        platform_joint: Matrix3x6<f64>,
        mover: Matrix3x6<f64>,
    ) -> LegPartials {
        let k = self.rod_com_fraction;
        let turned = velocity.direction_rate.cross_matrix() * (partials.platform_joint - partials.hooke);
        let moved = geometry.direction.cross_matrix() * (platform_joint - hooke);
        LegPartials {
            length,
            hooke,
            platform_joint,
            com: [(1.0 - k) * hooke + k * platform_joint, mover],
            angular: (turned + moved) / self.rod_length_m,
        }
    }
}

/// Acceleration of a point that slides along the actuator's axis with `d'` and `d''`, now at `arm` from the
/// base's origin, m/s^2, in O. Holds for the mover (26) and the Hooke joint.
///
/// The Coriolis term is `2 d' w_b x a`; the paper prints it without `w_b x`.
fn sliding_point_acceleration(
    base: &RigidBodyMotion,
    arm: &Vector3<f64>,
    velocity: &LegVelocity,
    length_acceleration: f64,
    axis: &Vector3<f64>,
) -> Vector3<f64> {
    base.point_acceleration(arm)
        + 2.0 * velocity.length_rate * velocity.axis_rate
        + length_acceleration * axis
}

impl LegType for Leg {
    const PARAMETERS: &'static [(&'static str, &'static [usize])] = &[
        ("base_point", &[6, 3]),
        ("actuator_axis", &[6, 3]),
        ("platform_point", &[6, 3]),
        ("rod_length", &[6]),
        ("rod_mass", &[6]),
        ("rod_inertia", &[6]),
        ("rod_com_fraction", &[6]),
        ("mover_mass", &[6]),
        ("mover_offset", &[6]),
        ("rest_length", &[6]),
        ("axial_stiffness", &[6]),
        ("axial_damping", &[6]),
    ];

    #[rustfmt::skip]
    const OUTPUTS: &'static [Output<Self>] = &[
        Output { name: "rod_angular_velocity", shape: SIX_VECTORS, append: |p, s, out| put_all(&body_kinematics(p, s).leg_angular_velocity, out) },
        Output { name: "rod_angular_acceleration", shape: SIX_VECTORS, append: |p, s, out| put_all(&body_kinematics(p, s).leg_angular_acceleration, out) },
        Output { name: "rod_com_position", shape: SIX_VECTORS, append: |p, s, out| put_body(&body_kinematics(p, s).com_position, 0, out) },
        Output { name: "rod_com_velocity", shape: SIX_VECTORS, append: |p, s, out| put_body(&body_kinematics(p, s).com_velocity, 0, out) },
        Output { name: "rod_com_acceleration", shape: SIX_VECTORS, append: |p, s, out| put_body(&body_kinematics(p, s).com_acceleration, 0, out) },
        Output { name: "mover_position", shape: SIX_VECTORS, append: |p, s, out| put_body(&body_kinematics(p, s).com_position, 1, out) },
        Output { name: "mover_velocity", shape: SIX_VECTORS, append: |p, s, out| put_body(&body_kinematics(p, s).com_velocity, 1, out) },
        Output { name: "mover_acceleration", shape: SIX_VECTORS, append: |p, s, out| put_body(&body_kinematics(p, s).com_acceleration, 1, out) },
        Output { name: "rod_partial_velocity", shape: SIX_PARTIALS, append: |p, s, out| put_body(&partial_velocities(p, s).com_partial_velocity, 0, out) },
        Output { name: "rod_partial_angular_velocity", shape: SIX_PARTIALS, append: |p, s, out| put_all(&partial_velocities(p, s).leg_partial_angular_velocity, out) },
        Output { name: "mover_partial_velocity", shape: SIX_PARTIALS, append: |p, s, out| put_body(&partial_velocities(p, s).com_partial_velocity, 1, out) },
        Output { name: "rod_active_force", shape: SQUARE, append: |p, s, out| put_body(&generalised_forces(p, s).active_force, 0, out) },
        Output { name: "rod_inertia_force", shape: SQUARE, append: |p, s, out| put_body(&generalised_forces(p, s).inertia_force, 0, out) },
        Output { name: "mover_active_force", shape: SQUARE, append: |p, s, out| put_body(&generalised_forces(p, s).active_force, 1, out) },
        Output { name: "mover_inertia_force", shape: SQUARE, append: |p, s, out| put_body(&generalised_forces(p, s).inertia_force, 1, out) },
    ];

    fn from_arrays(lookup: &mut impl FnMut(&str) -> Option<Vec<f64>>) -> Result<[Self; 6], InputError> {
        let base_point = array::<18>(lookup, "base_point")?;
        let actuator_axis = array::<18>(lookup, "actuator_axis")?;
        let platform_point = array::<18>(lookup, "platform_point")?;
        let rod_length = array::<6>(lookup, "rod_length")?;
        let rod_mass = array::<6>(lookup, "rod_mass")?;
        let rod_inertia = array::<6>(lookup, "rod_inertia")?;
        let rod_com_fraction = array::<6>(lookup, "rod_com_fraction")?;
        let mover_mass = array::<6>(lookup, "mover_mass")?;
        let mover_offset = array::<6>(lookup, "mover_offset")?;
        let rest_length = array::<6>(lookup, "rest_length")?;
        let axial_stiffness = array::<6>(lookup, "axial_stiffness")?;
        let axial_damping = array::<6>(lookup, "axial_damping")?;
        let point = |of: &[f64; 18], i: usize| Vector3::new(of[3 * i], of[3 * i + 1], of[3 * i + 2]);
        Ok(from_fn(|i| Leg {
            base_point_m: point(&base_point, i),
            actuator_axis: point(&actuator_axis, i),
            platform_point_m: point(&platform_point, i),
            rod_length_m: rod_length[i],
            rod_mass_kg: rod_mass[i],
            rod_inertia_kg_m2: rod_inertia[i],
            rod_com_fraction: rod_com_fraction[i],
            mover_mass_kg: mover_mass[i],
            mover_offset_m: mover_offset[i],
            rest_length_m: rest_length[i],
            axial_stiffness_n_m: axial_stiffness[i],
            axial_damping_n_s_m: axial_damping[i],
        }))
    }

    /// The closure `l = d a + s u`.
    fn geometry(&self, base: &RigidBodyMotion, platform: &RigidBodyMotion) -> LegGeometry {
        let axis = base.rotation * self.actuator_axis;
        let base_arm = base.rotation * self.base_point_m;
        let platform_arm = platform.rotation * self.platform_point_m;
        let l = platform.position_m + platform_arm - base.position_m - base_arm; // (14)
        let along = axis.dot(&l);
        let length = along - self.axial_reach_squared(&axis, &l).sqrt(); // (18)
        let direction = (l - length * axis) / self.rod_length_m; // (17)
        LegGeometry {
            axis,
            base_arm,
            platform_arm,
            hooke_arm: base_arm + length * axis,
            length,
            direction,
            cosine: direction.dot(&axis),
        }
    }

    fn velocity(
        &self,
        geometry: &LegGeometry,
        base: &RigidBodyMotion,
        platform: &RigidBodyMotion,
    ) -> LegVelocity {
        let LegGeometry { axis, direction, .. } = geometry;
        let platform_joint = platform.point_velocity(&geometry.platform_arm);
        let hooke_locked = base.point_velocity(&geometry.hooke_arm);
        // The rod keeps its length: u . (r_pi' - hooke') = 0 with hooke' = hooke_locked + d' a. This is (30).
        let length_rate = direction.dot(&(platform_joint - hooke_locked)) / geometry.cosine;
        let hooke = hooke_locked + length_rate * axis;
        let rod_angular = direction.cross(&(platform_joint - hooke)) / self.rod_length_m; // (22)
        LegVelocity {
            axis_rate: base.angular_velocity().cross(axis),
            length_rate,
            hooke,
            platform_joint,
            rod_angular,
            direction_rate: rod_angular.cross(direction),
        }
    }

    fn acceleration(
        &self,
        geometry: &LegGeometry,
        velocity: &LegVelocity,
        base: &RigidBodyMotion,
        platform: &RigidBodyMotion,
    ) -> LegAcceleration {
        let LegGeometry { axis, direction, .. } = geometry;
        let platform_joint = platform.point_acceleration(&geometry.platform_arm);
        let hooke_unextended = sliding_point_acceleration(base, &geometry.hooke_arm, velocity, 0.0, axis);
        // (s u)'' . u = -s |w_s|^2, and (s u)'' = platform_joint - hooke_unextended - d'' a.
        let centripetal = self.rod_length_m * velocity.rod_angular.norm_squared();
        let length = (direction.dot(&(platform_joint - hooke_unextended)) + centripetal) / geometry.cosine;
        let hooke = hooke_unextended + length * axis;
        // The derivative of (22) also holds u' x (s u'), which is zero.
        let rod_angular = direction.cross(&(platform_joint - hooke)) / self.rod_length_m;
        LegAcceleration { length, hooke, platform_joint, rod_angular }
    }

    fn alignment(&self, base: &RigidBodyMotion, platform: &RigidBodyMotion) -> f64 {
        let base_point = base.position_m + base.rotation * self.base_point_m;
        let platform_point = platform.position_m + platform.rotation * self.platform_point_m;
        let axis = base.rotation * self.actuator_axis;
        let reach = self.axial_reach_squared(&axis, &(platform_point - base_point));
        reach / (self.rod_length_m * self.rod_length_m)
    }

    fn axial_element(&self) -> AxialElement {
        AxialElement {
            rest_length_m: self.rest_length_m,
            stiffness_n_m: self.axial_stiffness_n_m,
            damping_n_s_m: self.axial_damping_n_s_m,
        }
    }

    fn masses(&self) -> [f64; 2] {
        [self.rod_mass_kg, self.mover_mass_kg]
    }

    fn inertias(&self) -> [f64; 2] {
        [self.rod_inertia_kg_m2, 0.0]
    }

    fn turning_inertia(&self) -> f64 {
        self.rod_inertia_kg_m2
    }

    fn com_position(
        &self,
        geometry: &LegGeometry,
        base: &RigidBodyMotion,
        platform: &RigidBodyMotion,
    ) -> [Vector3<f64>; 2] {
        let hooke = base.position_m + geometry.hooke_arm;
        let rod = self.rod_com(&hooke, &(platform.position_m + geometry.platform_arm));
        [rod, base.position_m + self.mover_arm(geometry)]
    }

    fn com_velocity(
        &self,
        geometry: &LegGeometry,
        velocity: &LegVelocity,
        base: &RigidBodyMotion,
    ) -> [Vector3<f64>; 2] {
        let mover = base.point_velocity(&self.mover_arm(geometry)) + velocity.length_rate * geometry.axis;
        [self.rod_com(&velocity.hooke, &velocity.platform_joint), mover]
    }

    fn com_acceleration(
        &self,
        geometry: &LegGeometry,
        velocity: &LegVelocity,
        acceleration: &LegAcceleration,
        base: &RigidBodyMotion,
    ) -> [Vector3<f64>; 2] {
        let arm = self.mover_arm(geometry);
        let mover = sliding_point_acceleration(base, &arm, velocity, acceleration.length, &geometry.axis);
        [self.rod_com(&acceleration.hooke, &acceleration.platform_joint), mover]
    }

    fn active_force(
        &self,
        gravity: &Vector3<f64>,
        axial_force: f64,
        geometry: &LegGeometry,
    ) -> [Vector3<f64>; 2] {
        [self.rod_mass_kg * gravity, self.mover_mass_kg * gravity + axial_force * geometry.axis]
    }

    fn partials_by_platform(&self, geometry: &LegGeometry) -> LegPartials {
        let length = geometry.jacobian_dp();
        let slide = geometry.axis * length;
        self.partials_of_ends(geometry, length, slide, point_partial(&geometry.platform_arm), slide)
    }

    fn partials_by_base(&self, geometry: &LegGeometry) -> LegPartials {
        let length = -geometry.jacobian_db();
        let slide = geometry.axis * length;
        let hooke = point_partial(&geometry.hooke_arm) + slide;
        let mover = point_partial(&self.mover_arm(geometry)) + slide;
        self.partials_of_ends(geometry, length, hooke, Matrix3x6::zeros(), mover)
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
        let slide = velocity.axis_rate * partials.length + geometry.axis * length;
        let joint = point_partial_rate(&arm_rate);
        self.partial_rates_of_ends(partials, geometry, velocity, length, slide, joint, slide)
    }

    fn partial_rates_by_base(
        &self,
        partials: &LegPartials,
        geometry: &LegGeometry,
        velocity: &LegVelocity,
        base: &RigidBodyMotion,
    ) -> LegPartials {
        let w_b = base.angular_velocity();
        let arm = &geometry.hooke_arm;
        let arm_rate = w_b.cross(arm) + velocity.length_rate * geometry.axis;
        let mover_rate = w_b.cross(&self.mover_arm(geometry)) + velocity.length_rate * geometry.axis;
        let length = length_partial_rate(partials, geometry, velocity, arm, &arm_rate, -1.0);
        let slide = velocity.axis_rate * partials.length + geometry.axis * length;
        let hooke = point_partial_rate(&arm_rate) + slide;
        let mover = point_partial_rate(&mover_rate) + slide;
        self.partial_rates_of_ends(partials, geometry, velocity, length, hooke, Matrix3x6::zeros(), mover)
    }
}
