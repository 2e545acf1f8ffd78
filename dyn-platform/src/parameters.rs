//! The resolved physical parameters as plain arrays, and their names and shapes.

use serde::Serialize;
use serde::ser::{SerializeMap, Serializer};

use crate::legs;
use crate::nested::Nested;
use crate::platform::LegType;

/// A vector in the frame its field names.
pub type Vector3 = [f64; 3];
/// A 3x3 matrix, row by row.
pub type Matrix3 = [[f64; 3]; 3];

/// Every physical parameter of a platform, SI units. Arrays over legs are in the order of leg numbers 1 to 6.
///
/// What legs of every type have is a field; what only legs of this type have goes by its name, as in
/// `parameters.legs("rod_length")`. By name, [`Parameters::get`] gives either.
///
/// B is the frame of the base, P that of the platform, O the inertial frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Parameters {
    /// `b_i`: where leg i meets the base, m, B: a point on the actuator's axis (`uhp`), the universal joint (`ups`).
    pub base_point: [Vector3; 6],
    /// `p_i`: joint of leg i on the platform, m, P.
    pub platform_point: [Vector3; 6],
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
    leg_type: LegType,
    /// The parameters of the leg type that are not fields above, flat, in the order of its table.
    of_leg_type: Vec<(&'static str, Vec<f64>)>,
}

/// Name, shape and unit of a parameter.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ParameterInfo {
    /// Name, the same in the derivation, the graph, the generated code and this crate.
    pub name: &'static str,
    /// Shape; empty for a scalar. A leading 6 counts the legs.
    pub shape: &'static [usize],
    /// SI unit; `1` where there is none.
    pub unit: &'static str,
}

/// Parameters that are not of the legs; they follow those in stored and printed order.
const OF_THE_PLATFORM: [ParameterInfo; 4] = [
    ParameterInfo { name: "payload_mass", shape: &[], unit: "kg" },
    ParameterInfo { name: "payload_com", shape: &[3], unit: "m" },
    ParameterInfo { name: "payload_inertia", shape: &[3, 3], unit: "kg m^2" },
    ParameterInfo { name: "gravity", shape: &[3], unit: "m/s^2" },
];

impl LegType {
    /// Every parameter of a platform with legs of this type, in the order in which they are stored and printed.
    pub fn parameters(self) -> impl Iterator<Item = ParameterInfo> {
        legs::kind(self).properties.iter().map(|property| property.parameter).chain(OF_THE_PLATFORM)
    }
}

impl Parameters {
    /// All numbers zero, to be filled by name.
    pub(crate) fn zero(leg_type: LegType) -> Self {
        let mut parameters = Self {
            base_point: [[0.0; 3]; 6],
            platform_point: [[0.0; 3]; 6],
            rest_length: [0.0; 6],
            axial_stiffness: [0.0; 6],
            axial_damping: [0.0; 6],
            payload_mass: 0.0,
            payload_com: [0.0; 3],
            payload_inertia: [[0.0; 3]; 3],
            gravity: [0.0; 3],
            leg_type,
            of_leg_type: Vec::new(),
        };
        for info in leg_type.parameters() {
            if parameters.get(info.name).is_none() {
                parameters.of_leg_type.push((info.name, vec![0.0; info.len()]));
            }
        }
        parameters
    }

    /// The parameter called `name`, flat and row-major; `None` if legs of this type have none of this name.
    pub fn get(&self, name: &str) -> Option<&[f64]> {
        Some(match name {
            "base_point" => self.base_point.as_flattened(),
            "platform_point" => self.platform_point.as_flattened(),
            "rest_length" => &self.rest_length,
            "axial_stiffness" => &self.axial_stiffness,
            "axial_damping" => &self.axial_damping,
            "payload_mass" => std::slice::from_ref(&self.payload_mass),
            "payload_com" => &self.payload_com,
            "payload_inertia" => self.payload_inertia.as_flattened(),
            "gravity" => &self.gravity,
            _ => self.of_leg_type.iter().find(|(known, _)| *known == name).map(|(_, values)| values)?,
        })
    }

    /// The same, to change its numbers.
    pub fn get_mut(&mut self, name: &str) -> Option<&mut [f64]> {
        Some(match name {
            "base_point" => self.base_point.as_flattened_mut(),
            "platform_point" => self.platform_point.as_flattened_mut(),
            "rest_length" => &mut self.rest_length,
            "axial_stiffness" => &mut self.axial_stiffness,
            "axial_damping" => &mut self.axial_damping,
            "payload_mass" => std::slice::from_mut(&mut self.payload_mass),
            "payload_com" => &mut self.payload_com,
            "payload_inertia" => self.payload_inertia.as_flattened_mut(),
            "gravity" => &mut self.gravity,
            _ => self.of_leg_type.iter_mut().find(|(known, _)| *known == name).map(|(_, values)| values)?,
        })
    }

    /// A parameter of one number per leg; `None` if legs of this type have none of this name and shape.
    pub fn legs(&self, name: &str) -> Option<[f64; 6]> {
        self.get(name)?.try_into().ok()
    }

    /// A parameter of one vector per leg; `None` if legs of this type have none of this name and shape.
    pub fn leg_vectors(&self, name: &str) -> Option<[Vector3; 6]> {
        self.get(name)?.as_chunks().0.try_into().ok()
    }

    /// From the JSON form.
    pub(crate) fn from_nested(
        leg_type: LegType,
        mut nested: std::collections::BTreeMap<String, Nested>,
    ) -> Result<Self, String> {
        let mut parameters = Self::zero(leg_type);
        for info in leg_type.parameters() {
            let value =
                nested.remove(info.name).ok_or_else(|| format!("parameter `{}` is missing", info.name))?;
            let numbers = value.flat(info.shape).ok_or_else(|| {
                format!("parameter `{}` is not an array of shape {:?}", info.name, info.shape)
            })?;
            let place = parameters.get_mut(info.name).expect("every parameter of the leg type has a place");
            place.copy_from_slice(&numbers);
        }
        match nested.keys().next() {
            Some(unknown) => Err(format!("unknown parameter `{unknown}` for leg type {}", leg_type.name())),
            None => Ok(parameters),
        }
    }
}

impl ParameterInfo {
    /// Number of numbers.
    pub fn len(&self) -> usize {
        self.shape.iter().product()
    }

    /// Whether there are none: never.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// A map from names to arrays in their natural nesting.
impl Serialize for Parameters {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        for info in self.leg_type.parameters() {
            let values = self.get(info.name).expect("every parameter of the leg type has a place");
            map.serialize_entry(info.name, &Nested::of(values, info.shape))?;
        }
        map.end()
    }
}
