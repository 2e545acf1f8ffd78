//! Why a motion ends early: out of reach, past the stroke, singular.

use std::fmt;

use dyn_runtime::nalgebra::Vector6;
use dyn_runtime::{BaseMotion, Error, PlatformState};

use crate::mechanism::Mechanism;

/// Lengths between which each actuator has to stay, m; infinite where nothing limits it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stroke {
    /// Shortest d.
    pub shortest_m: [f64; 6],
    /// Longest d.
    pub longest_m: [f64; 6],
}

impl Stroke {
    /// The first leg whose actuator length is not allowed.
    fn left_by(&self, lengths: &Vector6<f64>) -> Option<usize> {
        (0..6).find(|leg| !(self.shortest_m[*leg]..=self.longest_m[*leg]).contains(&lengths[*leg]))
    }

    /// What a leg may have, in words.
    fn allowed(&self, leg: usize) -> String {
        let (shortest, longest) = (self.shortest_m[leg], self.longest_m[leg]);
        match (shortest.is_finite(), longest.is_finite()) {
            (true, true) => format!("{:.3} to {:.3} mm", 1e3 * shortest, 1e3 * longest),
            (true, false) => format!("{:.3} mm or more", 1e3 * shortest),
            (false, _) => format!("{:.3} mm or less", 1e3 * longest),
        }
    }
}

/// Why a motion ended early. What was computed before it is kept.
#[derive(Clone, Debug, PartialEq)]
pub struct Stop {
    /// What was being computed: "the target motion", "the simulation".
    pub doing: &'static str,
    /// When, s.
    pub time_s: f64,
    /// Why, with the leg.
    pub reason: StopReason,
}

/// What ended a motion.
#[derive(Clone, Debug, PartialEq)]
pub enum StopReason {
    /// A pose that the mechanism cannot have, or at which it cannot be driven.
    Dynamics(Error),
    /// An actuator at the end of its stroke.
    Stroke {
        /// Index of the leg, 0 to 5.
        leg: usize,
        /// d, m.
        length_m: f64,
        /// What was allowed.
        stroke: Stroke,
    },
    /// The legs passed a singular pose just before.
    Singular,
    /// The adaptive solver gave up.
    Solver(String),
}

impl fmt::Display for Stop {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} stops at {:.6} s: {}", self.doing, self.time_s, self.reason)
    }
}

impl fmt::Display for StopReason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Dynamics(error) => error.fmt(f),
            Self::Stroke { leg, length_m, stroke } => write!(
                f,
                "leg {} (index {leg}) is past its stroke: the actuator would be {:.3} mm long, and may have {}; reduce \
                 the motion, or change the limits in the platform file or the scenario",
                leg + 1,
                length_m * 1e3,
                stroke.allowed(*leg),
            ),
            Self::Singular => write!(
                f,
                "all legs together: just before they passed a singular pose, in which they cannot hold every wrench \
                 however large their forces; keep the motion nearer to home"
            ),
            Self::Solver(said) => write!(f, "the adaptive integrator gave up: {said}"),
        }
    }
}

impl std::error::Error for Stop {}

/// What a pose may not be, sample after sample of one motion.
pub(crate) struct Watch {
    stroke: Option<Stroke>,
    /// Sign of `det J_dp` at the first pose.
    hand: Option<f64>,
}

impl Watch {
    /// A motion begins.
    pub(crate) fn new(stroke: Option<Stroke>) -> Self {
        Self { stroke, hand: None }
    }

    /// Whether the stroke allows this pose.
    pub(crate) fn stroke(
        &self,
        mechanism: &dyn Mechanism,
        base: &BaseMotion,
        platform: &PlatformState,
    ) -> Result<(), StopReason> {
        let Some(stroke) = self.stroke else { return Ok(()) };
        let kinematics = mechanism.leg_kinematics(base, platform).map_err(StopReason::Dynamics)?;
        let lengths = kinematics.actuator_length_m;
        match stroke.left_by(&lengths) {
            Some(leg) => Err(StopReason::Stroke { leg, length_m: lengths[leg], stroke }),
            None => Ok(()),
        }
    }

    /// Whether the motion came here without a singular pose on its way. Between two samples the determinant of J_dp
    /// passes zero there, and keeps its sign elsewhere, however ill conditioned.
    pub(crate) fn singularity(
        &mut self,
        mechanism: &dyn Mechanism,
        base: &BaseMotion,
        platform: &PlatformState,
    ) -> Result<(), StopReason> {
        let determinant = mechanism.jacobian_determinant(base, platform);
        let hand = *self.hand.get_or_insert(determinant.signum());
        // Zero has changed its sign, and what is not a number is refused by the dynamics.
        if determinant * hand <= 0.0 { Err(StopReason::Singular) } else { Ok(()) }
    }
}
