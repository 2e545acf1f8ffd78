//! The classical Gough-Stewart leg: a universal joint (U) on the base, a telescopic actuator (P) along the leg, a
//! spherical joint (S) on the platform. Its two parts, lower and upper, have mass and transverse inertia.

use super::common::{AXIAL_DAMPING, AXIAL_STIFFNESS, REST_LENGTH};
use super::{Body, Geometry, Leg, LegKind, Place, Property, by_place, named};
use crate::keys::{Key, Range, Value};
use crate::platform::LegType;
use crate::refusal::Refusal;

/// Joints nearer than this fraction of the lengths involved coincide: rounding alone gives such a leg its direction.
const COINCIDENT: f64 = 1e-9;

pub(super) const KIND: LegKind = LegKind {
    leg_type: LegType::Ups,
    properties: PROPERTIES,
    at_home,
    geometry,
    size: |leg| leg.between_joints().norm(),
    bodies: &[
        Body { mass: "lower_mass", inertia: Some("lower_inertia") },
        Body { mass: "upper_mass", inertia: Some("upper_inertia") },
    ],
};

const PROPERTIES: &[Property] = &[
    Property::new(
        Key {
            name: "base_point_m",
            value: Value::Vector,
            meaning: "the leg's universal joint on the base in base axes, m",
            example: "base_point_m = [0.1, -0.1, 0.0]",
        },
        "base_point",
        "m",
        Place::BaseJoint,
    ),
    Property::new(
        Key {
            name: "platform_point_m",
            value: Value::Vector,
            meaning: "the leg's spherical joint in platform axes, m",
            example: "platform_point_m = [0.1, -0.03, 0.0]",
        },
        "platform_point",
        "m",
        Place::PlatformJoint,
    ),
    Property::new(
        Key {
            name: "lower_mass_kg",
            value: Value::Number(Range::Positive),
            meaning: "the mass of the leg's lower part, kg",
            example: "lower_mass_kg = 1.5",
        },
        "lower_mass",
        "kg",
        Place::Legs,
    ),
    Property::new(
        Key {
            name: "lower_com_distance_m",
            value: Value::Number(Range::Any),
            meaning: "the distance of the lower part's centre of mass from the base joint towards the platform joint, m",
            example: "lower_com_distance_m = 0.12",
        },
        "lower_com_distance",
        "m",
        Place::Legs,
    ),
    Property::new(
        Key {
            name: "lower_inertia_kg_m2",
            value: Value::Number(Range::Positive),
            meaning: "the lower part's transverse inertia about its centre of mass, kg m^2",
            example: "lower_inertia_kg_m2 = 0.008",
        },
        "lower_inertia",
        "kg m^2",
        Place::Legs,
    ),
    Property::new(
        Key {
            name: "upper_mass_kg",
            value: Value::Number(Range::Positive),
            meaning: "the mass of the leg's upper part, kg",
            example: "upper_mass_kg = 0.8",
        },
        "upper_mass",
        "kg",
        Place::Legs,
    ),
    Property::new(
        Key {
            name: "upper_com_distance_m",
            value: Value::Number(Range::Any),
            meaning: "the distance of the upper part's centre of mass from the platform joint towards the base joint, m",
            example: "upper_com_distance_m = 0.1",
        },
        "upper_com_distance",
        "m",
        Place::Legs,
    ),
    Property::new(
        Key {
            name: "upper_inertia_kg_m2",
            value: Value::Number(Range::Positive),
            meaning: "the upper part's transverse inertia about its centre of mass, kg m^2",
            example: "upper_inertia_kg_m2 = 0.003",
        },
        "upper_inertia",
        "kg m^2",
        Place::Legs,
    ),
    REST_LENGTH,
    AXIAL_STIFFNESS,
    AXIAL_DAMPING,
];

/// The actuator's length is the distance of the joints.
fn geometry(leg: &Leg) -> Geometry {
    let between = leg.between_joints();
    Geometry { actuator_length: between.norm(), line_of_force: between }
}

/// Refuses legs whose joints coincide at home: they have no direction.
fn at_home(legs: &[Leg; 6]) -> Vec<Refusal> {
    let coincide = |leg: &Leg| {
        let (p, b) = (leg.vector("platform_point"), leg.vector("base_point"));
        let size = nalgebra::Vector3::from(leg.home.position).norm() + p.norm() + b.norm();
        leg.between_joints().norm() <= COINCIDENT * size
    };
    let refusal = |(at, legs): (_, Vec<&Leg>)| {
        let numbers: Vec<usize> = legs.iter().filter(|leg| coincide(leg)).map(|leg| leg.number).collect();
        let what = format!("{}: the joints on base and platform coincide at home", named(&numbers));
        let help = "a leg needs a length: move the home position or the joints";
        (!numbers.is_empty()).then(|| Refusal::new(at, "no distance to the other joint", what, help))
    };
    by_place(legs, "platform_point").into_iter().filter_map(refusal).collect()
}
