//! Limits of the actuators and joints: optional, and only checked, never part of the dynamics.

use std::ops::Range;

use serde::{Deserialize, Serialize};
use toml::Spanned;

use crate::findings::Findings;
use crate::keys::{self, Key};
use crate::leg_tables::LegTables;
use crate::legs::{Geometry, named};
use crate::refusal::Refusal;

/// One limit for each leg that has it.
pub type Limit = [Option<f64>; 6];

/// What actuators and joints may do. A limit that no leg has is absent from the JSON.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Limits {
    /// Shortest actuator length, m.
    #[serde(skip_serializing_if = "absent")]
    pub minimum_length: Limit,
    /// Longest actuator length, m.
    #[serde(skip_serializing_if = "absent")]
    pub maximum_length: Limit,
    /// Highest actuator speed, m/s.
    #[serde(skip_serializing_if = "absent")]
    pub maximum_velocity: Limit,
    /// Largest actuator force, either way, N.
    #[serde(skip_serializing_if = "absent")]
    pub maximum_force: Limit,
    /// Force of the voice coil per current, N/A.
    #[serde(skip_serializing_if = "absent")]
    pub force_constant: Limit,
    /// Largest angle between the rod and its direction at home, both in base axes, rad.
    #[serde(skip_serializing_if = "absent")]
    pub maximum_hooke_joint_angle: Limit,
    /// Largest angle between the rod and its direction at home, both in platform axes, rad.
    #[serde(skip_serializing_if = "absent")]
    pub maximum_platform_joint_angle: Limit,
}

fn absent(limit: &Limit) -> bool {
    limit.iter().all(Option::is_none)
}

/// Keys of limits, in `[legs]` and `[[leg]]`.
pub(crate) const KEYS: [&Key; 7] = [
    &keys::MINIMUM_LENGTH,
    &keys::MAXIMUM_LENGTH,
    &keys::MAXIMUM_VELOCITY,
    &keys::MAXIMUM_FORCE,
    &keys::FORCE_CONSTANT,
    &keys::MAXIMUM_HOOKE_JOINT_ANGLE,
    &keys::MAXIMUM_PLATFORM_JOINT_ANGLE,
];

impl Limits {
    /// Whether no leg has any limit.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }
}

/// A limit of each leg that has one, with its place.
type Placed = [Option<Spanned<f64>>; 6];

/// Limits as they stand in the file.
pub(crate) struct PlacedLimits {
    minimum_length: Placed,
    maximum_length: Placed,
    limits: Limits,
}

impl PlacedLimits {
    /// Reads all limits and refuses what contradicts itself.
    pub fn read(tables: &LegTables, findings: &mut Findings) -> Self {
        let mut read = |key: &Key| tables.optional(key, findings);
        let (minimum_length, maximum_length) = (read(&keys::MINIMUM_LENGTH), read(&keys::MAXIMUM_LENGTH));
        let mut value = |key: &Key| plain(&read(key));
        let limits = Limits {
            minimum_length: plain(&minimum_length),
            maximum_length: plain(&maximum_length),
            maximum_velocity: value(&keys::MAXIMUM_VELOCITY),
            maximum_force: value(&keys::MAXIMUM_FORCE),
            force_constant: value(&keys::FORCE_CONSTANT),
            maximum_hooke_joint_angle: value(&keys::MAXIMUM_HOOKE_JOINT_ANGLE),
            maximum_platform_joint_angle: value(&keys::MAXIMUM_PLATFORM_JOINT_ANGLE),
        };
        let placed = Self { minimum_length, maximum_length, limits };
        placed.refuse_strokes(findings);
        placed
    }

    /// The plain numbers.
    pub fn limits(&self) -> Limits {
        self.limits
    }

    /// A stroke must have a length.
    fn refuse_strokes(&self, findings: &mut Findings) {
        let faulty = |leg: usize| {
            let (shortest, longest) = (self.limits.minimum_length[leg]?, self.limits.maximum_length[leg]?);
            (shortest >= longest).then_some((shortest, longest))
        };
        for (at, legs) in by_place(&self.maximum_length, |leg| faulty(leg).is_some()) {
            let Some((shortest, longest)) = faulty(legs[0] - 1) else { continue };
            let (label, what) = if shortest == longest {
                (
                    "no stroke",
                    format!(
                        "the stroke is zero ({}): shortest and longest length are both {longest} m",
                        named(&legs)
                    ),
                )
            } else {
                let what = format!(
                    "the stroke is reversed ({}): the shortest length, {shortest} m, exceeds the longest, {longest} m",
                    named(&legs)
                );
                ("shorter than the shortest", what)
            };
            let help = "make `maximum_length_m` larger than `minimum_length_m`";
            findings.refuse(Refusal::new(at, label, what, help));
        }
    }

    /// The stroke must hold the actuator's length at home.
    pub fn refuse_home_outside(&self, home: &[Geometry; 6], findings: &mut Findings) {
        let is_stroke = |leg: usize| {
            let (shortest, longest) = (self.limits.minimum_length[leg], self.limits.maximum_length[leg]);
            // A stroke that is none has its own refusal.
            shortest.zip(longest).is_none_or(|(shortest, longest)| shortest < longest)
        };
        let length = |leg: usize| home[leg].actuator_length;
        for (placed, end) in [(&self.minimum_length, &SHORTEST), (&self.maximum_length, &LONGEST)] {
            let beyond = |leg: usize, limit: f64| end.inwards * (length(leg) - limit) < 0.0;
            let faulty = |leg: usize| {
                is_stroke(leg) && placed[leg].as_ref().is_some_and(|limit| beyond(leg, *limit.get_ref()))
            };
            for (at, legs) in by_place(placed, faulty) {
                let what = format!(
                    "home is outside the stroke ({}): the actuator of leg {} is {:.6} m long there, {}",
                    named(&legs),
                    legs[0],
                    length(legs[0] - 1),
                    end.relation
                );
                let farthest =
                    legs.iter().map(|leg| end.inwards * length(leg - 1)).fold(f64::INFINITY, f64::min);
                let needed = end.inwards * (farthest * 1e6).floor() / 1e6;
                let help = format!("{} {needed:.6} m, or move the home pose", end.change);
                findings.refuse(Refusal::new(at, end.label, what, help));
            }
        }
    }
}

/// An end of the stroke.
struct End {
    /// 1 where lengths above the limit are inside, -1 where those below are.
    inwards: f64,
    label: &'static str,
    relation: &'static str,
    change: &'static str,
}

const SHORTEST: End = End {
    inwards: 1.0,
    label: "home is shorter",
    relation: "below its shortest length",
    change: "make `minimum_length_m` at most",
};

const LONGEST: End = End {
    inwards: -1.0,
    label: "home is longer",
    relation: "above its longest length",
    change: "make `maximum_length_m` at least",
};

fn plain(placed: &Placed) -> Limit {
    placed.each_ref().map(|value| value.as_ref().map(|value| *value.get_ref()))
}

/// Numbers of the faulty legs, grouped by the place of their limit in the file.
fn by_place(placed: &Placed, faulty: impl Fn(usize) -> bool) -> Vec<(Range<usize>, Vec<usize>)> {
    let mut places: Vec<(Range<usize>, Vec<usize>)> = Vec::new();
    for leg in (0..6).filter(|&leg| faulty(leg)) {
        let Some(span) = placed[leg].as_ref().map(Spanned::span) else { continue };
        match places.iter_mut().find(|(place, _)| *place == span) {
            Some((_, legs)) => legs.push(leg + 1),
            None => places.push((span, vec![leg + 1])),
        }
    }
    places
}
