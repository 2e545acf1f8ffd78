//! Leg types. A leg type is one module here: the table of what its legs are made of (keys, checks, defaults,
//! parameters), what must hold at home, and where its legs stand there. The reader knows no leg type by name.

mod common;
mod uhp;
mod ups;

use std::ops::Range;

use nalgebra::Vector3 as Vector;
use toml::Spanned;

use crate::checks::from_rows;
use crate::keys::{Key, Value};
use crate::parameters::{ParameterInfo, Vector3};
use crate::platform::{LegType, Pose};
use crate::refusal::Refusal;

/// One thing that a leg is made of: its key in files and the parameter that it becomes.
pub(crate) struct Property {
    pub key: Key,
    /// Name and unit of the parameter, and its shape with the legs counted.
    pub parameter: ParameterInfo,
    /// Who gives it.
    pub place: Place,
}

/// Who gives a property of a leg.
pub(crate) enum Place {
    /// The layout: the leg's joint on the base.
    BaseJoint,
    /// The layout: the leg's joint on the platform.
    PlatformJoint,
    /// `[legs]` or the leg's own table.
    Legs,
    /// The same, but where neither has it, this follows from what is known of the leg.
    LegsOr(fn(&Leg) -> f64),
}

impl Property {
    /// A property of one number per leg or of one vector per leg, as its key says.
    const fn new(key: Key, parameter: &'static str, unit: &'static str, place: Place) -> Self {
        let shape: &[usize] = match key.value {
            Value::Vector | Value::UnitVector => &[6, 3],
            _ => &[6],
        };
        Self { key, parameter: ParameterInfo { name: parameter, shape, unit }, place }
    }
}

/// A leg type.
pub(crate) struct LegKind {
    pub leg_type: LegType,
    /// What a leg is made of, in the order in which parameters are stored and printed. A property that others follow
    /// from stands before them.
    pub properties: &'static [Property],
    /// What is wrong with legs at home that each for itself is well described.
    pub at_home: fn(&[Leg; 6]) -> Vec<Refusal>,
    /// Where a leg stands at home, once nothing is wrong there.
    pub geometry: fn(&Leg) -> Geometry,
    /// About how long a leg is at home, m.
    pub size: fn(&Leg) -> f64,
    /// The moving bodies of a leg.
    pub bodies: &'static [Body],
}

/// A moving body of a leg, by the names of its parameters.
pub(crate) struct Body {
    pub mass: &'static str,
    /// Transverse, about the body's own centre of mass.
    pub inertia: Option<&'static str>,
}

/// A leg at home.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Geometry {
    /// Length d of the actuator, m.
    pub actuator_length: f64,
    /// Along the force that the leg exerts on its platform joint, B, of any length.
    pub line_of_force: Vector<f64>,
}

impl LegKind {
    /// What the layout gives.
    pub fn joints(&self) -> impl Iterator<Item = &'static Property> {
        self.properties
            .iter()
            .filter(|property| matches!(property.place, Place::BaseJoint | Place::PlatformJoint))
    }

    /// The key of a parameter.
    pub fn key(&self, parameter: &str) -> &'static Key {
        let property = self.properties.iter().find(|property| property.parameter.name == parameter);
        &property.unwrap_or_else(|| panic!("no leg property {parameter}: a wrong name in a table")).key
    }

    /// What `[legs]` and `[[leg]]` give.
    pub fn shared(&self) -> impl Iterator<Item = &'static Property> {
        self.properties.iter().filter(|property| matches!(property.place, Place::Legs | Place::LegsOr(_)))
    }
}

/// Every leg type, or the one.
pub(crate) fn kinds(leg_type: Option<LegType>) -> impl Iterator<Item = &'static LegKind> {
    KINDS.into_iter().filter(move |kind| leg_type.is_none_or(|leg_type| kind.leg_type == leg_type))
}

/// The leg type's table.
pub(crate) fn kind(leg_type: LegType) -> &'static LegKind {
    match leg_type {
        LegType::Uhp => &uhp::KIND,
        LegType::Ups => &ups::KIND,
    }
}

const KINDS: [&LegKind; 2] = [&uhp::KIND, &ups::KIND];

/// What is known of one leg, with the place of each number in the file.
pub(crate) struct Leg<'p> {
    /// 1 to 6.
    pub number: usize,
    /// The platform's pose at home.
    pub home: &'p Pose,
    /// In the order of the leg type's table.
    pub values: Vec<(&'static str, Spanned<Vec<f64>>)>,
}

impl Leg<'_> {
    /// A property with its place.
    pub fn value(&self, parameter: &str) -> &Spanned<Vec<f64>> {
        let value = self.values.iter().find(|(name, _)| *name == parameter);
        &value
            .unwrap_or_else(|| {
                panic!("no leg property {parameter}: a wrong name, or a wrong order in its table")
            })
            .1
    }

    /// A property of one number.
    pub fn scalar(&self, parameter: &str) -> f64 {
        self.value(parameter).get_ref()[0]
    }

    /// A property of three numbers.
    pub fn vector(&self, parameter: &str) -> Vector<f64> {
        Vector::from_column_slice(self.value(parameter).get_ref())
    }

    /// Where a property stands in the file.
    pub fn span(&self, parameter: &str) -> Range<usize> {
        self.value(parameter).span()
    }

    /// From the platform's origin to the joint on the platform: `R p`, m, B.
    pub fn platform_arm(&self) -> Vector<f64> {
        from_rows(self.home.rotation) * self.vector("platform_point")
    }

    /// From the joint on the base to the joint on the platform with the platform at home: `r_p + R p - b`, m, B.
    pub fn between_joints(&self) -> Vector<f64> {
        Vector::from(self.home.position) + self.platform_arm() - self.vector("base_point")
    }
}

/// Groups legs that take the property from the same place in the file, in the order of legs.
fn by_place<'l, 'p>(legs: &'l [Leg<'p>; 6], parameter: &str) -> Vec<(Range<usize>, Vec<&'l Leg<'p>>)> {
    let mut places: Vec<(Range<usize>, Vec<&Leg>)> = Vec::new();
    for leg in legs {
        let span = leg.span(parameter);
        match places.iter_mut().find(|(place, _)| *place == span) {
            Some((_, legs)) => legs.push(leg),
            None => places.push((span, vec![leg])),
        }
    }
    places
}

/// "leg 4", "legs 1, 2 and 5".
pub(crate) fn named(numbers: &[usize]) -> String {
    match numbers {
        [] => "no leg".into(),
        [number] => format!("leg {number}"),
        [others @ .., last] => {
            let others: Vec<String> = others.iter().map(usize::to_string).collect();
            format!("legs {} and {last}", others.join(", "))
        }
    }
}

/// Where the joints are.
pub(crate) struct Layout {
    /// The joint of each leg on the base, with its place in the file.
    pub base: [Spanned<Vector3>; 6],
    /// The joint of each leg on the platform, with its place in the file.
    pub platform: [Spanned<Vector3>; 6],
    /// What to change in the file when the joints as a whole make no platform, and where.
    pub remedy: Spanned<String>,
}
