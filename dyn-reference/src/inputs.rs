//! Parameters and states from flat row-major numbers, looked up by name. Outside the numeric core: this may
//! allocate.

use core::error::Error;
use core::fmt;

use nalgebra::{Matrix3, Vector3, Vector6};

use crate::parameters::{Leg, Parameters, Payload};
use crate::state::{RigidBodyMotion, State};

/// Names and shapes of the parameters; a leading 6 counts the legs, an empty shape is a scalar.
pub const PARAMETERS: &[(&str, &[usize])] = &[
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
    ("payload_mass", &[]),
    ("payload_com", &[3]),
    ("payload_inertia", &[3, 3]),
    ("gravity", &[3]),
];

/// Names and shapes of a state's parts.
pub const STATE: &[(&str, &[usize])] = &[
    ("base_position", &[3]),
    ("base_rotation", &[3, 3]),
    ("base_velocity", &[6]),
    ("base_acceleration", &[6]),
    ("platform_position", &[3]),
    ("platform_rotation", &[3, 3]),
    ("platform_velocity", &[6]),
    ("platform_acceleration", &[6]),
    ("reference_velocity", &[6]),
    ("actuator_force", &[6]),
    ("external_wrench", &[6]),
];

/// A value that the lookup did not give, or gave with the wrong number of entries.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct InputError {
    /// Name of the value.
    pub name: &'static str,
    /// Number of entries it must have.
    pub expected: usize,
    /// Number of entries found, `None` where the value is missing.
    pub found: Option<usize>,
}

impl fmt::Display for InputError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { name, expected, found } = self;
        match found {
            None => write!(f, "`{name}` is missing; give {expected} numbers"),
            Some(found) => write!(f, "`{name}` has {found} numbers; give {expected}"),
        }
    }
}

impl Error for InputError {}

fn array<const N: usize>(
    lookup: &mut impl FnMut(&str) -> Option<Vec<f64>>,
    name: &'static str,
) -> Result<[f64; N], InputError> {
    let values = lookup(name).ok_or(InputError { name, expected: N, found: None })?;
    let found = Some(values.len());
    values.try_into().map_err(|_| InputError { name, expected: N, found })
}

impl Parameters {
    /// Parameters from flat row-major arrays under the names of [`PARAMETERS`], in SI units. Of the payload's
    /// inertia the upper triangle counts.
    ///
    /// # Errors
    /// A value is missing or has the wrong number of entries.
    pub fn from_arrays(mut lookup: impl FnMut(&str) -> Option<Vec<f64>>) -> Result<Self, InputError> {
        let lookup = &mut lookup;
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
        let [payload_mass] = array::<1>(lookup, "payload_mass")?;
        let payload_com = array::<3>(lookup, "payload_com")?;
        let inertia = array::<9>(lookup, "payload_inertia")?;
        let gravity = array::<3>(lookup, "gravity")?;

        let row = |matrix: &[f64; 18], i: usize| Vector3::from_column_slice(&matrix[3 * i..3 * i + 3]);
        let [xx, xy, xz, _, yy, yz, _, _, zz] = inertia;
        Ok(Self {
            legs: core::array::from_fn(|i| Leg {
                base_point_m: row(&base_point, i),
                actuator_axis: row(&actuator_axis, i),
                platform_point_m: row(&platform_point, i),
                rod_length_m: rod_length[i],
                rod_mass_kg: rod_mass[i],
                rod_inertia_kg_m2: rod_inertia[i],
                rod_com_fraction: rod_com_fraction[i],
                mover_mass_kg: mover_mass[i],
                mover_offset_m: mover_offset[i],
                rest_length_m: rest_length[i],
                axial_stiffness_n_m: axial_stiffness[i],
                axial_damping_n_s_m: axial_damping[i],
            }),
            payload: Payload {
                mass_kg: payload_mass,
                com_m: Vector3::from(payload_com),
                inertia_kg_m2: Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz),
            },
            gravity_m_s2: Vector3::from(gravity),
        })
    }
}

impl State {
    /// A state from flat row-major arrays under the names of [`STATE`], in SI units and O coordinates.
    ///
    /// # Errors
    /// A value is missing or has the wrong number of entries.
    pub fn from_arrays(mut lookup: impl FnMut(&str) -> Option<Vec<f64>>) -> Result<Self, InputError> {
        let lookup = &mut lookup;
        Ok(Self {
            base: RigidBodyMotion {
                position_m: Vector3::from(array::<3>(lookup, "base_position")?),
                rotation: Matrix3::from_row_slice(&array::<9>(lookup, "base_rotation")?),
                velocity: Vector6::from(array::<6>(lookup, "base_velocity")?),
                acceleration: Vector6::from(array::<6>(lookup, "base_acceleration")?),
            },
            platform: RigidBodyMotion {
                position_m: Vector3::from(array::<3>(lookup, "platform_position")?),
                rotation: Matrix3::from_row_slice(&array::<9>(lookup, "platform_rotation")?),
                velocity: Vector6::from(array::<6>(lookup, "platform_velocity")?),
                acceleration: Vector6::from(array::<6>(lookup, "platform_acceleration")?),
            },
            reference_velocity: Vector6::from(array::<6>(lookup, "reference_velocity")?),
            actuator_force_n: Vector6::from(array::<6>(lookup, "actuator_force")?),
            external_wrench: Vector6::from(array::<6>(lookup, "external_wrench")?),
        })
    }
}
