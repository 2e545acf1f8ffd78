//! The platform's physical parameters (Table 1), plain numbers in SI units.

use nalgebra::{Matrix3, Vector3};

/// One leg, from the base up: prismatic actuator fixed to the base, mover, Hooke joint, rod, universal joint.
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

/// The platform together with its payload, one rigid body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Payload {
    /// Mass `m_p`, kg.
    pub mass_kg: f64,
    /// Centre of mass `r_c`, m, in P.
    pub com_m: Vector3<f64>,
    /// Inertia `I_c` about the centre of mass, kg m^2, in P; symmetric.
    pub inertia_kg_m2: Matrix3<f64>,
}

/// All parameters of a 6-UHP platform.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameters {
    /// The six legs.
    pub legs: [Leg; 6],
    /// Platform and payload.
    pub payload: Payload,
    /// Gravitational acceleration `g`, m/s^2, in O; zero for the paper's simulation.
    pub gravity_m_s2: Vector3<f64>,
}
