//! The leg of the paper: an actuator fixed to the base (P), a Hooke joint (H) on its mover, a rod of fixed length, a
//! universal joint (U) on the platform.

use std::ops::Range as Span;

use super::common::{AXIAL_DAMPING, AXIAL_STIFFNESS, REST_LENGTH};
use super::{Body, Geometry, Leg, LegKind, Place, Property, by_place, named};
use crate::keys::{Key, Range, Value};
use crate::platform::LegType;
use crate::refusal::Refusal;

/// A leg whose `u.a` (cosine between rod and actuator) at home is below this is refused: forces grow as its inverse.
const SMALLEST_ALIGNMENT: f64 = 0.01;

pub(super) const KIND: LegKind = LegKind {
    leg_type: LegType::Uhp,
    properties: PROPERTIES,
    at_home,
    geometry,
    size: |leg| leg.scalar("rod_length"),
    bodies: &[
        Body { mass: "rod_mass", inertia: Some("rod_inertia") },
        Body { mass: "mover_mass", inertia: None },
    ],
};

const PROPERTIES: &[Property] = &[
    Property::new(
        Key {
            name: "base_point_m",
            value: Value::Vector,
            meaning: "the point in base axes where the actuator's axis starts, m",
            example: "base_point_m = [0.1, -0.1, 0.0]",
        },
        "base_point",
        "m",
        Place::BaseJoint,
    ),
    Property::new(
        Key {
            name: "actuator_axis",
            value: Value::UnitVector,
            meaning: "the unit vector along the actuator, from the base up, in base axes",
            example: "actuator_axis = [0.0, 0.0, 1.0]",
        },
        "actuator_axis",
        "1",
        Place::Legs,
    ),
    Property::new(
        Key {
            name: "platform_point_m",
            value: Value::Vector,
            meaning: "the platform joint in platform axes, m",
            example: "platform_point_m = [0.1, -0.03, 0.0]",
        },
        "platform_point",
        "m",
        Place::PlatformJoint,
    ),
    Property::new(
        Key {
            name: "rod_length_m",
            value: Value::Number(Range::Positive),
            meaning: "the rod's length from Hooke joint to platform joint, m",
            example: "rod_length_m = 0.206",
        },
        "rod_length",
        "m",
        Place::Legs,
    ),
    Property::new(
        Key {
            name: "rod_mass_kg",
            value: Value::Number(Range::Positive),
            meaning: "the mass of one rod, kg",
            example: "rod_mass_kg = 1.024",
        },
        "rod_mass",
        "kg",
        Place::Legs,
    ),
    Property::new(
        Key {
            name: "rod_inertia_kg_m2",
            value: Value::Number(Range::Positive),
            meaning: "the rod's transverse inertia about its centre of mass, kg m^2",
            example: "rod_inertia_kg_m2 = 0.0036",
        },
        "rod_inertia",
        "kg m^2",
        Place::LegsOr(slender_rod),
    ),
    Property::new(
        Key {
            name: "rod_com_fraction",
            value: Value::Number(Range::Fraction),
            meaning: "the place of the rod's centre of mass between Hooke joint (0) and platform joint (1)",
            example: "rod_com_fraction = 0.5",
        },
        "rod_com_fraction",
        "1",
        Place::Legs,
    ),
    Property::new(
        Key {
            name: "mover_mass_kg",
            value: Value::Number(Range::Positive),
            meaning: "the moving mass of one actuator, kg",
            example: "mover_mass_kg = 0.611",
        },
        "mover_mass",
        "kg",
        Place::Legs,
    ),
    Property::new(
        Key {
            name: "mover_offset_m",
            value: Value::Number(Range::Any),
            meaning: "the distance of the mover's centre of mass below the Hooke joint, m",
            example: "mover_offset_m = 0.05",
        },
        "mover_offset",
        "m",
        Place::Legs,
    ),
    REST_LENGTH,
    AXIAL_STIFFNESS,
    AXIAL_DAMPING,
];

/// `m_s s^2 / 12`: the slender uniform rod, from the leg's own mass and length.
fn slender_rod(leg: &Leg) -> f64 {
    leg.scalar("rod_mass") * leg.scalar("rod_length").powi(2) / 12.0
}

/// How far the rod must reach across the actuator's axis: `|n|`, `n = x - (a.x) a`, m.
fn across(leg: &Leg) -> f64 {
    let (x, a) = (leg.between_joints(), leg.vector("actuator_axis"));
    (x - a * a.dot(&x)).norm()
}

/// `(u.a)^2 = 1 - n.n/s^2`, the squared cosine between rod and actuator; negative out of reach.
fn alignment_squared(leg: &Leg) -> f64 {
    1.0 - (across(leg) / leg.scalar("rod_length")).powi(2)
}

/// (18): `d = a.x - h`, `h = sqrt(s^2 - n.n)`, the Hooke joint below the platform joint; the rod is `n + h a`.
fn geometry(leg: &Leg) -> Geometry {
    let (x, a, s) = (leg.between_joints(), leg.vector("actuator_axis"), leg.scalar("rod_length"));
    let n = x - a * a.dot(&x);
    let h = (s * s - n.norm_squared()).sqrt();
    Geometry { actuator_length: a.dot(&x) - h, line_of_force: n + a * h }
}

/// Refuses rods that do not reach at home; legs that share one `rod_length_m` share one refusal.
fn at_home(legs: &[Leg; 6]) -> Vec<Refusal> {
    by_place(legs, "rod_length").into_iter().filter_map(|(at, legs)| out_of_reach(at, &legs)).collect()
}

/// Refuses legs whose rod is too short at home, or so short that it stands across its actuator.
fn out_of_reach(at: Span<usize>, legs: &[&Leg]) -> Option<Refusal> {
    let faulty: Vec<&Leg> =
        legs.iter().copied().filter(|leg| alignment_squared(leg) < SMALLEST_ALIGNMENT.powi(2)).collect();
    let farthest = faulty.iter().max_by(|one, other| across(one).total_cmp(&across(other)))?;
    let numbers: Vec<usize> = faulty.iter().map(|leg| leg.number).collect();
    let (number, across, rod_length) = (farthest.number, across(farthest), farthest.scalar("rod_length"));
    let (label, what) = if alignment_squared(farthest) < 0.0 {
        let what = format!(
            "the rod is too short to reach at home ({}): the platform joint of leg {number} is {across:.6} m \
             off its actuator's axis, the rod is {rod_length} m long",
            named(&numbers)
        );
        ("too short", what)
    } else {
        let what = format!(
            "the rod is perpendicular to its actuator at home ({}): the platform joint of leg {number} is \
             {across:.6} m off its actuator's axis, the rod is {rod_length} m long, so the actuator cannot push it",
            named(&numbers)
        );
        ("only just reaches", what)
    };
    let needed = across / (1.0 - SMALLEST_ALIGNMENT.powi(2)).sqrt();
    let help = format!(
        "make it longer than {:.6} m, or move the joints, the axis or the home pose",
        (needed * 1e6).ceil() / 1e6
    );
    Some(Refusal::new(at, label, what, help))
}
