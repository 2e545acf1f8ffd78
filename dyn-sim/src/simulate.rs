//! Forces from a target (inverse dynamics), motion from forces (forward dynamics).

use dyn_runtime::nalgebra::Vector6;
use dyn_runtime::{Acceleration, BaseMotion, Error, PlatformState};

use crate::adaptive::{self, AdaptiveError};
use crate::integrator::{self, Stage};
use crate::mechanism::Mechanism;
use crate::motion::{BodyMotion, Motion};
use crate::outcome::Series;
use crate::stop::{Stop, StopReason, Stroke, Watch};

/// Fixed steps over a duration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    /// h, s.
    pub step_s: f64,
    /// Number of steps.
    pub steps: usize,
}

impl Grid {
    /// Time after `halves` half steps, s.
    pub fn half_step_time(&self, halves: usize) -> f64 {
        self.step_s * (halves as f64 * 0.5)
    }

    /// Time after `steps` steps, s.
    pub fn time(&self, steps: usize) -> f64 {
        self.step_s * steps as f64
    }
}

/// What drives the platform: the base's motion and the actuator forces at every half step, which is where a
/// Runge-Kutta method of fourth order looks. At `k h/2`, k = 0 to 2 N.
#[derive(Clone, Debug)]
pub struct Drive {
    /// The steps.
    pub grid: Grid,
    /// Base.
    pub base: Vec<BaseMotion>,
    /// F, N.
    pub actuator_force_n: Vec<Vector6<f64>>,
}

/// A simulated or prescribed motion of the platform.
#[derive(Clone, Debug)]
pub struct Run {
    /// At `k h`.
    pub series: Series,
    /// Why it is shorter than the grid, if it is.
    pub stop: Option<Stop>,
}

/// The fixed-step simulation looks for a singular pose behind it once in so many steps: each look takes a tenth of a step.
const LOOK_EVERY: usize = 8;

/// Progress is told once in so many steps.
const TELL_EVERY: usize = 256;

/// A motion at every half step; `progress` hears fractions.
pub fn sample(grid: Grid, motion: &Motion, mut progress: impl FnMut(f64)) -> Vec<BodyMotion> {
    let count = 2 * grid.steps + 1;
    let at = |halves| {
        if halves % TELL_EVERY == 0 {
            progress(halves as f64 / count as f64);
        }
        motion.at(grid.half_step_time(halves))
    };
    (0..count).map(at).collect()
}

/// The forces that move the platform along `target` on a moving base; both at every half step. A target that the
/// mechanism cannot follow gives a shorter drive and the reason. `progress` hears fractions.
pub fn forces_along(
    mechanism: &dyn Mechanism,
    grid: Grid,
    base: &[BodyMotion],
    target: &[BodyMotion],
    stroke: Option<Stroke>,
    mut progress: impl FnMut(f64),
) -> (Drive, Option<Stop>) {
    let mut drive = Drive { grid, base: Vec::new(), actuator_force_n: Vec::new() };
    let mut watch = Watch::new(stroke);
    for (halves, (base, target)) in base.iter().zip(target).enumerate() {
        if halves % TELL_EVERY == 0 {
            progress(halves as f64 / (2 * grid.steps + 1) as f64);
        }
        let (base, platform) = (base.as_base(), target.as_platform());
        let force = watch.stroke(mechanism, &base, &platform).and_then(|()| {
            let force = mechanism.inverse_dynamics(&base, &platform, &target.acceleration);
            watch.singularity(mechanism, &base, &platform)?;
            force.map_err(StopReason::Dynamics)
        });
        match force {
            Ok(force) => {
                drive.base.push(base);
                drive.actuator_force_n.push(force);
            }
            Err(reason) => {
                let steps = drive.base.len().saturating_sub(1) / 2;
                drive.grid.steps = steps;
                drive.base.truncate(2 * steps + 1);
                drive.actuator_force_n.truncate(2 * steps + 1);
                let time_s = grid.half_step_time(halves);
                return (drive, Some(Stop { doing: "the target motion", time_s, reason }));
            }
        }
    }
    (drive, None)
}

/// Simulates the platform by the fixed-step method of [`integrator`]; `progress` hears fractions.
pub fn simulate(
    mechanism: &dyn Mechanism,
    drive: &Drive,
    start: &PlatformState,
    stroke: Option<Stroke>,
    mut progress: impl FnMut(f64),
) -> Run {
    let grid = drive.grid;
    let mut run = Recorder::new(grid.steps);
    let mut watch = Watch::new(stroke);
    let mut state = *start;
    for k in 0..=grid.steps {
        let (base, force) = (&drive.base, &drive.actuator_force_n);
        let next = watch.stroke(mechanism, &base[2 * k], &state).and_then(|()| {
            let first = mechanism
                .forward_dynamics(&base[2 * k], &state, &force[2 * k])
                .map_err(StopReason::Dynamics)?;
            if k % LOOK_EVERY == 0 {
                watch.singularity(mechanism, &base[2 * k], &state)?;
            }
            run.push(grid.time(k), &state, &first);
            if k == grid.steps {
                return Ok(state);
            }
            integrator::step(&state, &first, grid.step_s, |stage, state| {
                let halves = match stage {
                    Stage::Middle => 2 * k + 1,
                    Stage::End => 2 * k + 2,
                };
                mechanism.forward_dynamics_within_step(&base[halves], state, &force[halves])
            })
            .map_err(StopReason::Dynamics)
        });
        match next {
            Ok(next) => state = next,
            Err(reason) => return run.stopped(grid.time(k), reason),
        }
        if k % TELL_EVERY == 0 {
            progress(k as f64 / grid.steps.max(1) as f64);
        }
    }
    run.finished()
}

/// Simulates by the adaptive reference, with base and forces at the times that the solver asks for; `progress` hears
/// fractions.
pub fn simulate_adaptively(
    mechanism: &dyn Mechanism,
    grid: Grid,
    tolerance: f64,
    start: &PlatformState,
    stroke: Option<Stroke>,
    drive_at: impl Fn(f64) -> Result<(BaseMotion, Vector6<f64>), Error>,
    progress: impl FnMut(f64),
) -> Run {
    let mut run = Recorder::new(grid.steps);
    let acceleration = |t: f64, state: &PlatformState| -> Result<Acceleration, Error> {
        let (base, force) = drive_at(t)?;
        mechanism.forward_dynamics(&base, state, &force)
    };
    let (states, failure) =
        adaptive::integrate(start, grid.step_s, grid.steps, tolerance, acceleration, progress);
    let mut watch = Watch::new(stroke);
    for (k, state) in states.iter().enumerate() {
        let t = grid.time(k);
        let recorded = drive_at(t).map_err(StopReason::Dynamics).and_then(|(base, force)| {
            watch.stroke(mechanism, &base, state)?;
            let found = mechanism.forward_dynamics(&base, state, &force).map_err(StopReason::Dynamics)?;
            watch.singularity(mechanism, &base, state).map(|()| found)
        });
        match recorded {
            Ok(acceleration) => run.push(t, state, &acceleration),
            Err(reason) => return run.stopped(t, reason),
        }
    }
    match failure {
        None => run.finished(),
        Some(AdaptiveError::Dynamics(t, error)) => run.stopped(t, StopReason::Dynamics(error)),
        Some(AdaptiveError::Solver(said)) => {
            let reached = grid.time(states.len().saturating_sub(1));
            run.stopped(reached, StopReason::Solver(said))
        }
    }
}

/// d of each leg (m) along a motion of the platform; `base` at every half step, as in a [`Drive`].
///
/// # Errors
/// Poses that the legs do not reach.
pub fn lengths(
    mechanism: &dyn Mechanism,
    base: &[BaseMotion],
    platform: &[PlatformState],
) -> Result<Vec<[f64; 6]>, Error> {
    base.iter()
        .step_by(2)
        .zip(platform)
        .map(|(b, p)| Ok(mechanism.leg_kinematics(b, p)?.actuator_length_m.into()))
        .collect()
}

/// Collects samples.
struct Recorder {
    series: Series,
}

impl Recorder {
    fn new(steps: usize) -> Self {
        let mut series = Series::empty("dyn-gen");
        series.time_s.reserve(steps + 1);
        series.position_m.reserve(steps + 1);
        series.rotation.reserve(steps + 1);
        series.velocity.reserve(steps + 1);
        series.acceleration.reserve(steps + 1);
        Self { series }
    }

    fn push(&mut self, t: f64, state: &PlatformState, acceleration: &Acceleration) {
        let motion = BodyMotion { pose: state.pose, velocity: state.velocity, acceleration: *acceleration };
        self.series.push(t, &motion);
    }

    fn stopped(self, time_s: f64, reason: StopReason) -> Run {
        Run { stop: Some(Stop { doing: "the simulation", time_s, reason }), ..self.finished() }
    }

    fn finished(self) -> Run {
        Run { series: self.series, stop: None }
    }
}
