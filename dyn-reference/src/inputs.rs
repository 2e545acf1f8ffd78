//! Parameters and states from flat row-major numbers, looked up by name. Outside the numeric core: this may
//! allocate.

use core::error::Error;
use core::fmt;

use nalgebra::{Matrix3, Vector3, Vector6};

use crate::legs::LegType;
use crate::parameters::{Parameters, Payload};
use crate::state::{RigidBodyMotion, State};

/// Names and shapes of the parameters that every leg type has; those of its legs are in [`LegType::PARAMETERS`]. An
/// empty shape is a scalar.
pub const PARAMETERS: &[(&str, &[usize])] =
    &[("payload_mass", &[]), ("payload_com", &[3]), ("payload_inertia", &[3, 3]), ("gravity", &[3])];

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
    ("actuator_force", &[6]),
    ("external_wrench", &[6]),
    ("reference_velocity", &[6]),
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

pub(crate) fn array<const N: usize>(
    lookup: &mut impl FnMut(&str) -> Option<Vec<f64>>,
    name: &'static str,
) -> Result<[f64; N], InputError> {
    let values = lookup(name).ok_or(InputError { name, expected: N, found: None })?;
    let found = Some(values.len());
    values.try_into().map_err(|_| InputError { name, expected: N, found })
}

impl<L: LegType> Parameters<L> {
    /// Parameters from flat row-major arrays under the names of [`LegType::PARAMETERS`] and [`PARAMETERS`], in SI
    /// units. Of the payload's inertia the upper triangle counts.
    ///
    /// # Errors
    /// A value is missing or has the wrong number of entries.
    pub fn from_arrays(mut lookup: impl FnMut(&str) -> Option<Vec<f64>>) -> Result<Self, InputError> {
        let lookup = &mut lookup;
        let legs = L::from_arrays(lookup)?;
        let [payload_mass] = array::<1>(lookup, "payload_mass")?;
        let payload_com = array::<3>(lookup, "payload_com")?;
        let [xx, xy, xz, _, yy, yz, _, _, zz] = array::<9>(lookup, "payload_inertia")?;
        let gravity = array::<3>(lookup, "gravity")?;
        Ok(Self {
            legs,
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
