//! Parameters of models that have them at run time: one struct per leg type, and the runtime's model made of it.

#[cfg(any(feature = "uhp", feature = "ups"))]
use dyn_runtime::models;

use crate::real::Real;

/// Parameters of a platform with UHP legs. SI units; the first index of leg quantities is the leg.
///
/// `dyn-gen resolve platform.toml` prints these numbers under these names.
#[repr(C)]
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct UhpParameters {
    /// Set to sizeof(dyn_uhp_parameters).
    pub struct_size: usize,
    /// Point b of the actuator's axis, m, B.
    pub base_point: [[Real; 3]; 6],
    /// Unit vector a of the actuator, towards the platform, B.
    pub actuator_axis: [[Real; 3]; 6],
    /// Platform joint p, m, P.
    pub platform_point: [[Real; 3]; 6],
    /// Rod length s, m.
    pub rod_length: [Real; 6],
    /// Rod mass m_s, kg.
    pub rod_mass: [Real; 6],
    /// Transverse inertia J_s of the rod about its centre of mass, kg m^2.
    pub rod_inertia: [Real; 6],
    /// The rod's centre of mass, from Hooke joint (0) to platform joint (1).
    pub rod_com_fraction: [Real; 6],
    /// Mover mass m_d, kg.
    pub mover_mass: [Real; 6],
    /// Distance of the mover's centre of mass below the Hooke joint, m.
    pub mover_offset: [Real; 6],
    /// Actuator length d0 at which the leaf springs are relaxed, m.
    pub rest_length: [Real; 6],
    /// Axial stiffness k_e of the leaf springs, N/m.
    pub axial_stiffness: [Real; 6],
    /// Axial viscous damping c_e, N s/m.
    pub axial_damping: [Real; 6],
    /// Mass of platform and payload, kg.
    pub payload_mass: Real,
    /// Centre of mass of platform and payload, m, P.
    pub payload_com: [Real; 3],
    /// Inertia of platform and payload about their centre of mass, kg m^2, P; symmetric, the upper triangle is read.
    pub payload_inertia: [[Real; 3]; 3],
    /// Acceleration of gravity, m/s^2, O.
    pub gravity: [Real; 3],
}

/// Parameters of a platform with UPS legs. SI units; the first index of leg quantities is the leg.
///
/// `dyn-gen resolve platform.toml` prints these numbers under these names.
#[repr(C)]
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct UpsParameters {
    /// Set to sizeof(dyn_ups_parameters).
    pub struct_size: usize,
    /// Universal joint b on the base, m, B.
    pub base_point: [[Real; 3]; 6],
    /// Platform joint p, m, P.
    pub platform_point: [[Real; 3]; 6],
    /// Mass of the lower part, kg.
    pub lower_mass: [Real; 6],
    /// Distance of the lower part's centre of mass from the base joint, m.
    pub lower_com_distance: [Real; 6],
    /// Transverse inertia of the lower part about its centre of mass, kg m^2.
    pub lower_inertia: [Real; 6],
    /// Mass of the upper part, kg.
    pub upper_mass: [Real; 6],
    /// Distance of the upper part's centre of mass from the platform joint, m.
    pub upper_com_distance: [Real; 6],
    /// Transverse inertia of the upper part about its centre of mass, kg m^2.
    pub upper_inertia: [Real; 6],
    /// Actuator length d0 at which the axial spring is relaxed, m.
    pub rest_length: [Real; 6],
    /// Axial stiffness k_e, N/m.
    pub axial_stiffness: [Real; 6],
    /// Axial viscous damping c_e, N s/m.
    pub axial_damping: [Real; 6],
    /// Mass of platform and payload, kg.
    pub payload_mass: Real,
    /// Centre of mass of platform and payload, m, P.
    pub payload_com: [Real; 3],
    /// Inertia of platform and payload about their centre of mass, kg m^2, P; symmetric, the upper triangle is read.
    pub payload_inertia: [[Real; 3]; 3],
    /// Acceleration of gravity, m/s^2, O.
    pub gravity: [Real; 3],
}

#[cfg(feature = "uhp")]
impl From<&UhpParameters> for models::Uhp<Real> {
    fn from(parameters: &UhpParameters) -> Self {
        let &UhpParameters {
            struct_size: _,
            base_point,
            actuator_axis,
            platform_point,
            rod_length,
            rod_mass,
            rod_inertia,
            rod_com_fraction,
            mover_mass,
            mover_offset,
            rest_length,
            axial_stiffness,
            axial_damping,
            payload_mass,
            payload_com,
            payload_inertia,
            gravity,
        } = parameters;
        Self {
            parameters: models::uhp::Parameters {
                base_point,
                actuator_axis,
                platform_point,
                rod_length,
                rod_mass,
                rod_inertia,
                rod_com_fraction,
                mover_mass,
                mover_offset,
                rest_length,
                axial_stiffness,
                axial_damping,
                payload_mass,
                payload_com,
                payload_inertia,
                gravity,
            },
        }
    }
}

#[cfg(feature = "ups")]
impl From<&UpsParameters> for models::Ups<Real> {
    fn from(parameters: &UpsParameters) -> Self {
        let &UpsParameters {
            struct_size: _,
            base_point,
            platform_point,
            lower_mass,
            lower_com_distance,
            lower_inertia,
            upper_mass,
            upper_com_distance,
            upper_inertia,
            rest_length,
            axial_stiffness,
            axial_damping,
            payload_mass,
            payload_com,
            payload_inertia,
            gravity,
        } = parameters;
        Self {
            parameters: models::ups::Parameters {
                base_point,
                platform_point,
                lower_mass,
                lower_com_distance,
                lower_inertia,
                upper_mass,
                upper_com_distance,
                upper_inertia,
                rest_length,
                axial_stiffness,
                axial_damping,
                payload_mass,
                payload_com,
                payload_inertia,
                gravity,
            },
        }
    }
}
