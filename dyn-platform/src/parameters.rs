//! The resolved physical parameters as plain arrays, and the one table of their names and shapes.

use serde::{Deserialize, Serialize};

/// A vector in the frame its field names.
pub type Vector3 = [f64; 3];
/// A 3x3 matrix, row by row.
pub type Matrix3 = [[f64; 3]; 3];

/// Every physical parameter of a platform, SI units. Arrays over legs are in the order of leg numbers 1 to 6.
///
/// B is the frame of the base, P that of the platform, O the inertial frame.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Parameters {
    /// `b_i`: where actuator i meets the base, m, B.
    pub base_point: [Vector3; 6],
    /// `a_i`: axis of actuator i, unit vector from the base up, B.
    pub actuator_axis: [Vector3; 6],
    /// `p_i`: universal joint of leg i on the platform, m, P.
    pub platform_point: [Vector3; 6],
    /// `s`: from the Hooke joint to the platform joint, m.
    pub rod_length: [f64; 6],
    /// `m_s`: kg.
    pub rod_mass: [f64; 6],
    /// `J_s`: transverse, about the rod's centre of mass, kg m^2.
    pub rod_inertia: [f64; 6],
    /// `k`: centre of mass of the rod, from the Hooke joint (0) to the platform joint (1).
    pub rod_com_fraction: [f64; 6],
    /// `m_d`: kg.
    pub mover_mass: [f64; 6],
    /// `d*`: the mover's centre of mass lies this far below the Hooke joint, along the axis, m.
    pub mover_offset: [f64; 6],
    /// `d0`: actuator length at which the axial spring is relaxed, m.
    pub rest_length: [f64; 6],
    /// `k_e`: N/m.
    pub axial_stiffness: [f64; 6],
    /// `c_e`: N s/m.
    pub axial_damping: [f64; 6],
    /// Platform and payload together, kg.
    pub payload_mass: f64,
    /// `r_c`: centre of mass of platform and payload, m, P.
    pub payload_com: Vector3,
    /// `I_c`: inertia of platform and payload about their centre of mass, kg m^2, P; symmetric.
    pub payload_inertia: Matrix3,
    /// `g`: m/s^2, O.
    pub gravity: Vector3,
}

/// One row of [`PARAMETERS`].
#[derive(Debug, Clone, Copy)]
pub struct ParameterInfo {
    /// Name, the same in the derivation, the graph, the generated code and this crate.
    pub name: &'static str,
    /// Shape; empty for a scalar. A leading 6 counts the legs.
    pub shape: &'static [usize],
    /// SI unit; `1` where there is none.
    pub unit: &'static str,
    flat: fn(&Parameters) -> Vec<f64>,
}

/// Every parameter, in the order in which they are stored and printed.
pub const PARAMETERS: [ParameterInfo; 16] = [
    row("base_point", &[6, 3], "m", |p| p.base_point.as_flattened().to_vec()),
    row("actuator_axis", &[6, 3], "1", |p| p.actuator_axis.as_flattened().to_vec()),
    row("platform_point", &[6, 3], "m", |p| p.platform_point.as_flattened().to_vec()),
    row("rod_length", &[6], "m", |p| p.rod_length.to_vec()),
    row("rod_mass", &[6], "kg", |p| p.rod_mass.to_vec()),
    row("rod_inertia", &[6], "kg m^2", |p| p.rod_inertia.to_vec()),
    row("rod_com_fraction", &[6], "1", |p| p.rod_com_fraction.to_vec()),
    row("mover_mass", &[6], "kg", |p| p.mover_mass.to_vec()),
    row("mover_offset", &[6], "m", |p| p.mover_offset.to_vec()),
    row("rest_length", &[6], "m", |p| p.rest_length.to_vec()),
    row("axial_stiffness", &[6], "N/m", |p| p.axial_stiffness.to_vec()),
    row("axial_damping", &[6], "N s/m", |p| p.axial_damping.to_vec()),
    row("payload_mass", &[], "kg", |p| vec![p.payload_mass]),
    row("payload_com", &[3], "m", |p| p.payload_com.to_vec()),
    row("payload_inertia", &[3, 3], "kg m^2", |p| p.payload_inertia.as_flattened().to_vec()),
    row("gravity", &[3], "m/s^2", |p| p.gravity.to_vec()),
];

const fn row(
    name: &'static str,
    shape: &'static [usize],
    unit: &'static str,
    flat: fn(&Parameters) -> Vec<f64>,
) -> ParameterInfo {
    ParameterInfo { name, shape, unit, flat }
}

impl Parameters {
    /// The parameter called `name`, flat and row-major; `None` for a name that is not in [`PARAMETERS`].
    pub fn get(&self, name: &str) -> Option<Vec<f64>> {
        PARAMETERS.iter().find(|info| info.name == name).map(|info| (info.flat)(self))
    }
}
