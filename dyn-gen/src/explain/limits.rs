//! What the platform's own limits leave: at home, and over the workspace that its geometry allows.

use dyn_platform::{Limit, Platform};
use nalgebra::{Matrix3, Vector3};
use serde::Serialize;

use super::Home;
use crate::error::GenerateError;
use crate::evidence::{Case, EvidenceError};
use crate::graph::{Environment, Graph};

/// A limit that some legs have, and how much of it is used. Legs without it have none.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Margin {
    /// The key of the platform file.
    pub limit: &'static str,
    /// Its value.
    pub value: Limit,
    /// What is left of it at home; negative where it is exceeded.
    pub left_at_home: Limit,
    /// What is left of it at the worst sampled pose.
    pub left_at_worst: Limit,
}

/// Every limit of the platform file that a pose can exceed, and the share of sampled poses that keep them all.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Margins {
    /// One row per limit.
    pub limits: Vec<Margin>,
    /// From 0 to 1.
    pub share_of_poses_within: f64,
}

/// What poses can exceed, leg by leg.
struct Used {
    /// m
    length: [f64; 6],
    /// Angle between the rod and its direction at home, base axes, rad.
    hooke_angle: [f64; 6],
    /// The same in platform axes, rad.
    platform_angle: [f64; 6],
}

/// None where the platform has no such limit.
pub(super) fn margins(
    home: &Home,
    platform: &Platform,
    cases: &[Case],
) -> Result<Option<Margins>, GenerateError> {
    let limits = &platform.limits;
    // What is left of a limit, given what is used.
    type Left = fn(f64, &Used, usize) -> f64;
    let table: [(&'static str, Limit, Left); 4] = [
        ("minimum_length_m", limits.minimum_length, |limit, used, leg| used.length[leg] - limit),
        ("maximum_length_m", limits.maximum_length, |limit, used, leg| limit - used.length[leg]),
        ("maximum_hooke_joint_angle_rad", limits.maximum_hooke_joint_angle, |limit, used, leg| {
            limit - used.hooke_angle[leg]
        }),
        ("maximum_platform_joint_angle_rad", limits.maximum_platform_joint_angle, |limit, used, leg| {
            limit - used.platform_angle[leg]
        }),
    ];
    let table: Vec<_> = table.into_iter().filter(|(_, value, _)| value.iter().any(Option::is_some)).collect();
    if table.is_empty() {
        return Ok(None);
    }
    let graph = home.graph("rod_direction")?;
    let look = |state: &Environment| Look::at(&graph, state);
    let start = look(&home.environment)?;
    let used = |state: &Environment| -> Result<Used, GenerateError> {
        let now = look(state)?;
        let angle = |one: &[Vector3<f64>; 6], other: &[Vector3<f64>; 6]| {
            std::array::from_fn(|leg| one[leg].cross(&other[leg]).norm().atan2(one[leg].dot(&other[leg])))
        };
        Ok(Used {
            length: now.length,
            hooke_angle: angle(&now.in_base, &start.in_base),
            platform_angle: angle(&now.in_platform, &start.in_platform),
        })
    };
    let at_home = used(&home.environment)?;
    let sampled = cases.iter().map(|case| used(&case.environment)).collect::<Result<Vec<_>, _>>()?;
    let left = |used: &Used, value: &Limit, left: Left| -> Limit {
        std::array::from_fn(|leg| value[leg].map(|limit| left(limit, used, leg)))
    };
    let within = |used: &&Used| {
        table
            .iter()
            .all(|(_, value, rule)| left(used, value, *rule).iter().flatten().all(|left| *left >= 0.0))
    };
    let share = sampled.iter().filter(within).count() as f64 / sampled.len().max(1) as f64;
    let rows = table.iter().map(|(limit, value, rule)| {
        let left_at_home = left(&at_home, value, *rule);
        let worst = sampled.iter().map(|used| left(used, value, *rule)).fold(left_at_home, |worst, left| {
            std::array::from_fn(|leg| worst[leg].zip(left[leg]).map(|(worst, left)| worst.min(left)))
        });
        Margin { limit, value: *value, left_at_home, left_at_worst: worst }
    });
    Ok(Some(Margins { limits: rows.collect(), share_of_poses_within: share }))
}

/// Actuator lengths and rod directions at a state.
struct Look {
    length: [f64; 6],
    in_base: [Vector3<f64>; 6],
    in_platform: [Vector3<f64>; 6],
}

impl Look {
    /// By a graph that has both.
    fn at(graph: &Graph, state: &Environment) -> Result<Look, GenerateError> {
        let outputs = graph.evaluate(state).map_err(EvidenceError::from)?;
        let output = |name: &str, k: usize| {
            outputs.get(name).and_then(|values| values.get(k)).copied().unwrap_or(f64::NAN)
        };
        let to_body =
            |name: &str| Matrix3::from_row_slice(state.get(name).map_or(&[][..], Vec::as_slice)).transpose();
        let turned = |axes: Matrix3<f64>| {
            std::array::from_fn(|leg| axes * Vector3::from_fn(|k, _| output("rod_direction", 3 * leg + k)))
        };
        Ok(Look {
            length: std::array::from_fn(|leg| output("actuator_length", leg)),
            in_base: turned(to_body("base_rotation")),
            in_platform: turned(to_body("platform_rotation")),
        })
    }
}
