//! Seeded states of the mechanism over its workspace, the same on every machine: only `+ - * /` and square roots.
//!
//! Passes choose pivot orders by them and tests compare models on them. Say the seed when you report a result.

use std::fmt;

use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::{Rng, SeedableRng};

use crate::graph::Environment;

/// A position and a row-major rotation.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Pose {
    /// m
    pub position: [f64; 3],
    /// To the frame the position is in.
    pub rotation: [[f64; 3]; 3],
}

/// Where a platform can be.
pub struct Workspace<'a> {
    /// The platform's home pose relative to the base.
    pub home: Pose,
    /// For a platform pose relative to the base, the smallest (u.a)^2 over the legs: 1 for a rod along its actuator, 0 for one
    /// perpendicular to it, negative out of reach. 1 - c^2 where that is less, with c the largest used share of a stroke.
    pub alignment: &'a dyn Fn(&Pose) -> f64,
    /// For a platform pose relative to the base, the condition number of J_dp, moments over the radius of the platform
    /// joints so that forces and moments compare. Anything that is not a number counts as infinite.
    pub condition: &'a dyn Fn(&Pose) -> f64,
}

/// How far from rest states are.
#[derive(Clone, Copy, PartialEq, Eq, Debug, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// At home, everything at rest, no load.
    Home,
    /// Up to 2 cm and 0.1 rad from home, less where legs do not reach that far; base nearly level, moderate rates.
    Random,
    /// Base turned up to 1.2 rad, platform where the least u.a is between 0.4 and 0.95 of that at home, several m/s and rad/s.
    /// Where a stroke limits the reach, sqrt(1 - c^2) stands for u.a, with c the share of it that is used.
    Large,
    /// As large, with a leg at u.a between 0.1 and 0.2: at the end of its stroke or its rod nearly across.
    NearEdge,
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Kind::Home => "home",
            Kind::Random => "near home",
            Kind::Large => "large",
            Kind::NearEdge => "near edge",
        })
    }
}

/// Condition of J_dp above which no [`Kind::Large`] or [`Kind::NearEdge`] state lies: actuator forces lose as many digits as
/// it has, and what is left must still tell a wrong model from a rounded one.
pub const LARGEST_CONDITION: f64 = 1e3;

/// Rays from home tried for one pose.
const RAYS: usize = 200;

/// No pose of a kind was found within reach and away from singular poses.
#[derive(Clone, Copy, PartialEq, Debug, thiserror::Error)]
pub enum NoPose {
    /// The legs keep or lose their reach as they are; no ray from home crosses the wanted band of u.a.
    #[error(
        "no pose with the wanted reach of the legs was found around home (u.a of the worst leg at home: {at_home:.3})"
    )]
    Reach {
        /// Least u.a at home.
        at_home: f64,
    },
    /// J_dp is nearly singular wherever it was looked at.
    #[error("J_dp is singular or nearly so at every sampled pose (least condition number: {least:.1e})")]
    Singular {
        /// The least condition number met.
        least: f64,
    },
}

/// `count` states of a kind: every state input of the contract by name, flat.
///
/// # Errors
/// If poses of that kind cannot be found.
pub fn states(
    workspace: &Workspace<'_>,
    kind: Kind,
    count: usize,
    seed: u64,
) -> Result<Vec<Environment>, NoPose> {
    let mut source = Source(Pcg64Mcg::seed_from_u64(seed));
    (0..count).map(|_| source.state(workspace, kind)).collect()
}

/// Random numbers.
#[derive(Clone)]
struct Source(Pcg64Mcg);

impl Source {
    /// Uniform in (-1, 1).
    fn symmetric(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    fn array<const N: usize>(&mut self, size: f64) -> [f64; N] {
        std::array::from_fn(|_| size * self.symmetric())
    }

    /// A vector in the ball of this radius.
    fn ball(&mut self, radius: f64) -> [f64; 3] {
        loop {
            let v: [f64; 3] = self.array(1.0);
            if dot(v, v) <= 1.0 {
                return v.map(|x| radius * x);
            }
        }
    }

    fn state(&mut self, workspace: &Workspace<'_>, kind: Kind) -> Result<Environment, NoPose> {
        // Half-angle tangents: 0.68 is 1.2 rad.
        let (turn, reach, speed, acceleration, force) = match kind {
            Kind::Home => (0.0, 0.0, 0.0, 0.0, 0.0),
            Kind::Random => (0.1, 0.1, 0.3, 3.0, 20.0),
            Kind::Large | Kind::NearEdge => (0.68, 1.0, 4.0, 30.0, 100.0),
        };
        let base = Pose { position: self.array(reach), rotation: rotation(self.ball(turn)) };
        let relative = self.relative_pose(workspace, kind)?;
        let turned = apply(base.rotation, relative.position);
        let platform_position: [f64; 3] = std::array::from_fn(|k| base.position[k] + turned[k]);
        let platform_rotation = product(base.rotation, relative.rotation);

        let mut state = Environment::new();
        let mut put = |name: &str, values: &[f64]| drop(state.insert(name.to_owned(), values.to_vec()));
        put("base_position", &base.position);
        put("base_rotation", base.rotation.as_flattened());
        put("base_velocity", &self.array::<6>(speed));
        put("base_acceleration", &self.array::<6>(acceleration));
        put("platform_position", &platform_position);
        put("platform_rotation", platform_rotation.as_flattened());
        put("platform_velocity", &self.array::<6>(speed));
        put("platform_acceleration", &self.array::<6>(acceleration));
        put("actuator_force", &self.array::<6>(force));
        put("external_wrench", &self.array::<6>(0.1 * force));
        // From a copy of the source: states do not depend on whether a function takes it.
        put("reference_velocity", &self.clone().array::<6>(speed));
        Ok(state)
    }

    /// A platform pose relative to the base, within reach.
    fn relative_pose(&mut self, workspace: &Workspace<'_>, kind: Kind) -> Result<Pose, NoPose> {
        let least = |pose: &Pose| (workspace.alignment)(pose);
        let at_home = least(&workspace.home).sqrt();
        match kind {
            Kind::Home => Ok(workspace.home),
            Kind::Random => {
                let (direction, axis) = (self.ball(0.02), self.ball(0.05));
                // Halved until it is as well within reach as large states are, which near home it is.
                let mut near = (0..50).map(|k| displaced(workspace.home, direction, axis, 0.5_f64.powi(k)));
                let wanted = 0.4 * at_home;
                near.find(|pose| least(pose) >= wanted * wanted).ok_or(NoPose::Reach { at_home })
            }
            Kind::Large => {
                let wanted = (0.4 + 0.55 * self.symmetric().abs()) * at_home;
                self.pose_on_a_ray(workspace, wanted)
            }
            Kind::NearEdge => {
                let wanted = 0.1 + 0.1 * self.symmetric().abs();
                self.pose_on_a_ray(workspace, wanted)
            }
        }
    }

    /// A ray from home, followed to the pose where the least u.a falls to `wanted`. It may not do so in any direction, and
    /// J_dp may be too near singular there: then others are tried.
    fn pose_on_a_ray(&mut self, workspace: &Workspace<'_>, wanted: f64) -> Result<Pose, NoPose> {
        let mut best_condition: Option<f64> = None;
        for _ in 0..RAYS {
            let (direction, axis) = (self.ball(0.3), self.ball(0.6));
            let on_ray = |t: f64| displaced(workspace.home, direction, axis, t);
            let Some(t) = last_within(|t| (workspace.alignment)(&on_ray(t)) >= wanted * wanted) else {
                continue;
            };
            let pose = on_ray(t);
            let condition = (workspace.condition)(&pose);
            if condition <= LARGEST_CONDITION {
                return Ok(pose);
            }
            let condition = if condition.is_nan() { f64::INFINITY } else { condition };
            best_condition = Some(best_condition.map_or(condition, |best| best.min(condition)));
        }
        Err(match best_condition {
            Some(least) => NoPose::Singular { least },
            None => NoPose::Reach { at_home: (workspace.alignment)(&workspace.home).sqrt() },
        })
    }
}

/// The largest t up to the place where `within`, having held, first fails; none if it never holds or never fails.
fn last_within(within: impl Fn(f64) -> bool) -> Option<f64> {
    const STEPS: u32 = 64;
    const STEP: f64 = 1.0 / 16.0;
    let mut places = (0..=STEPS).map(|k| STEP * f64::from(k)).skip_while(|t| !within(*t));
    places.next()?;
    let mut outside = places.find(|t| !within(*t))?;
    let mut inside = outside - STEP;
    for _ in 0..50 {
        let middle = 0.5 * (inside + outside);
        if within(middle) { inside = middle } else { outside = middle }
    }
    Some(inside)
}

/// `home` moved by t * direction and turned by the rotation of half-angle tangent t * axis.
fn displaced(home: Pose, direction: [f64; 3], axis: [f64; 3], t: f64) -> Pose {
    Pose {
        position: std::array::from_fn(|k| home.position[k] + t * direction[k]),
        rotation: product(rotation(axis.map(|x| t * x)), home.rotation),
    }
}

/// The rotation matrix of the normalised quaternion (1, v).
fn rotation(v: [f64; 3]) -> [[f64; 3]; 3] {
    let norm = (1.0 + dot(v, v)).sqrt();
    let (w, [x, y, z]) = (1.0 / norm, v.map(|component| component / norm));
    [
        [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)],
        [2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)],
        [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)],
    ]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn apply(matrix: [[f64; 3]; 3], v: [f64; 3]) -> [f64; 3] {
    matrix.map(|row| dot(row, v))
}

fn product(a: [[f64; 3]; 3], b: [[f64; 3]; 3]) -> [[f64; 3]; 3] {
    let column = |j: usize| [b[0][j], b[1][j], b[2][j]];
    a.map(|row| std::array::from_fn(|j| dot(row, column(j))))
}
