//! A scenario from beginning to end: forces along the target, both simulations, spectra, errors.

use std::path::Path;
use std::time::Instant;

use dyn_runtime::nalgebra::Vector6;
use dyn_runtime::{BaseMotion, Error, PlatformState};

use crate::compare;
use crate::limits;
use crate::mechanism::{self, Mechanism};
use crate::motion::BodyMotion;
use crate::outcome::{Outcome, Series};
use crate::prototype::{self, PrototypeError};
use crate::scenario::{Integrator, Scenario, Steering};
use crate::simulate::{self, Drive, Run};
use crate::spectrum::Plan;
use crate::stop::Stop;

/// Relative and absolute tolerance of the adaptive reference.
pub const ADAPTIVE_TOLERANCE: f64 = 1e-12;

/// Name of the step in which dyn-sim itself simulates, among the seconds of an [`Outcome`].
pub const SIMULATION: &str = "simulation by dyn-gen";

/// Name of the step in which the virtual prototype runs.
pub const PROTOTYPE: &str = "virtual prototype (Exudyn)";

/// Who is told how far a long step is.
pub trait Progress {
    /// A step begins.
    fn begin(&mut self, step: &str);
    /// So much of it is done, 0 to 1.
    fn at(&mut self, fraction: f64);
    /// It has ended, after this many seconds.
    fn end(&mut self, seconds: f64);
}

/// Nobody.
#[derive(Clone, Copy, Debug)]
pub struct Silent;

impl Progress for Silent {
    fn begin(&mut self, _: &str) {}
    fn at(&mut self, _: f64) {}
    fn end(&mut self, _: f64) {}
}

/// What a scenario gave.
#[derive(Debug)]
pub struct Experiment {
    /// Curves, tables, times.
    pub outcome: Outcome,
    /// Why the motion ended early, if it did; the outcome holds what came before.
    pub stop: Option<Stop>,
    /// Why the prototype's part is missing, if it was asked for and is.
    pub prototype_error: Option<PrototypeError>,
}

/// Runs a scenario. `workspace` is the root of the repository, where the prototype lives; without it, or where the
/// scenario does not ask for one, there is no prototype. `command` repeats the run.
pub fn run(
    scenario: &Scenario,
    workspace: Option<&Path>,
    command: &str,
    progress: &mut dyn Progress,
) -> Experiment {
    let (mechanism, model) = mechanism::of_platform(&scenario.platform, scenario.gravity_on);
    let mut steps = Steps { seconds: Vec::new(), progress };
    let prepared =
        steps.time("excitation and actuator forces", |progress| prepare(scenario, &*mechanism, progress));
    let (drive, start) = (&prepared.drive, &prepared.start);

    let mut stop = prepared.stop;
    let mut simulations = Vec::new();
    let own =
        steps.time(SIMULATION, |progress| own_simulation(scenario, &*mechanism, drive, start, progress));
    stop = stop.or(own.stop);
    simulations.push(own.series);

    let mut versions = vec![
        ("dyn-sim".to_owned(), env!("CARGO_PKG_VERSION").to_owned()),
        ("model".to_owned(), model.to_owned()),
        ("integrator".to_owned(), integrator_name(scenario)),
    ];
    let mut prototype_error = None;
    if let (Some(workspace), true, None) = (workspace, scenario.prototype, &stop) {
        match run_prototype(scenario, workspace, drive, start, &mut steps) {
            Ok(found) => {
                versions.push(("virtual prototype".into(), found.series.label.clone()));
                let halved = if scenario.prototype_half_steps { 0.5 } else { 1.0 };
                let step_ms = milliseconds(halved * scenario.grid.step_s);
                versions.push(("its integrator".into(), format!("{}, {step_ms} ms", found.integrator)));
                versions.push(("its closure residual".into(), format!("{:.1e} m", found.closure_residual)));
                simulations.push(found.series);
            }
            Err(error) => prototype_error = Some(error),
        }
    }

    let mut warnings = scenario.notes.clone();
    let (amplitude_tables, time_errors) = steps.time("spectra and comparison", |_| {
        compared(scenario, &prepared.target, &simulations, &mut warnings)
    });
    warnings.extend(limits::exceeded(&scenario.platform, &*mechanism, drive, &simulations[0]));
    warnings.extend(stop.as_ref().map(ToString::to_string));
    warnings.extend(prototype_error.as_ref().map(PrototypeError::remark));
    let outcome = Outcome {
        scenario_name: scenario.name.clone(),
        description: scenario.description.clone(),
        scenario_text: scenario.text.clone(),
        platform: scenario.platform.clone(),
        step_s: scenario.grid.step_s,
        actuator_length_m: actuator_lengths(&*mechanism, drive, &simulations[0]),
        base: prepared.base,
        target: prepared.target,
        actuator_force_n: drive.actuator_force_n.iter().step_by(2).map(|force| (*force).into()).collect(),
        simulations,
        amplitude_tables,
        time_errors,
        versions,
        seconds: steps.seconds,
        warnings,
        command: command.to_owned(),
    };
    Experiment { outcome, stop, prototype_error }
}

fn integrator_name(scenario: &Scenario) -> String {
    match scenario.integrator {
        Integrator::LieRk4 => {
            format!("Runge-Kutta-Munthe-Kaas, order 4, {} ms", milliseconds(scenario.grid.step_s))
        }
        Integrator::Adaptive => {
            format!("Dormand-Prince 8(5,3) (ode_solvers), tolerance {ADAPTIVE_TOLERANCE:e}")
        }
    }
}

/// Without the noise of a decimal step in binary.
fn milliseconds(step_s: f64) -> f64 {
    (1e9 * step_s).round() / 1e6
}

/// Times steps and tells of them.
struct Steps<'a> {
    seconds: Vec<(String, f64)>,
    progress: &'a mut dyn Progress,
}

impl Steps<'_> {
    fn time<R>(&mut self, step: &str, work: impl FnOnce(&mut dyn Progress) -> R) -> R {
        self.progress.begin(step);
        let started = Instant::now();
        let result = work(self.progress);
        let seconds = started.elapsed().as_secs_f64();
        self.progress.end(seconds);
        self.seconds.push((step.to_owned(), seconds));
        result
    }
}

struct Prepared {
    drive: Drive,
    start: PlatformState,
    base: Series,
    target: Series,
    stop: Option<Stop>,
}

fn prepare(scenario: &Scenario, mechanism: &dyn Mechanism, progress: &mut dyn Progress) -> Prepared {
    let grid = scenario.grid;
    // Three parts that take about the same time.
    let mut tell = |part: f64, fraction: f64| progress.at((part + fraction) / 3.0);
    let base = simulate::sample(grid, &scenario.base, |fraction| tell(0.0, fraction));
    match &scenario.steering {
        Steering::Target(motion) => {
            let target = simulate::sample(grid, motion, |fraction| tell(1.0, fraction));
            let (drive, stop) =
                simulate::forces_along(mechanism, grid, &base, &target, scenario.stroke, |fraction| {
                    tell(2.0, fraction)
                });
            let samples = drive.base.len();
            let start = target[0].as_platform();
            let base = series("base", &drive, &base[..samples]);
            let target = series("target", &drive, &target[..samples]);
            Prepared { drive, start, base, target, stop }
        }
        Steering::Free(start, force) => {
            let drive = Drive {
                grid,
                base: base.iter().map(BodyMotion::as_base).collect(),
                actuator_force_n: vec![*force; base.len()],
            };
            let base = series("base", &drive, &base);
            Prepared { drive, start: *start, base, target: Series::empty("target"), stop: None }
        }
    }
}

/// Every second sample: those at whole steps.
fn series(label: &str, drive: &Drive, halves: &[BodyMotion]) -> Series {
    let mut series = Series::empty(label);
    for (k, motion) in halves.iter().step_by(2).enumerate() {
        series.push(drive.grid.time(k), motion);
    }
    series
}

fn own_simulation(
    scenario: &Scenario,
    mechanism: &dyn Mechanism,
    drive: &Drive,
    start: &PlatformState,
    progress: &mut dyn Progress,
) -> Run {
    if drive.base.is_empty() {
        return Run { series: Series::empty("dyn-gen"), stop: None };
    }
    match scenario.integrator {
        Integrator::LieRk4 => {
            simulate::simulate(mechanism, drive, start, scenario.stroke, |fraction| progress.at(fraction))
        }
        Integrator::Adaptive => {
            let drive_at = |t: f64| drive_at(scenario, mechanism, t);
            let (grid, tolerance) = (drive.grid, ADAPTIVE_TOLERANCE);
            let tell = |fraction| progress.at(fraction);
            simulate::simulate_adaptively(mechanism, grid, tolerance, start, scenario.stroke, drive_at, tell)
        }
    }
}

/// Base and forces at any time.
fn drive_at(
    scenario: &Scenario,
    mechanism: &dyn Mechanism,
    t: f64,
) -> Result<(BaseMotion, Vector6<f64>), Error> {
    let base = scenario.base.at(t).as_base();
    let force = match &scenario.steering {
        Steering::Target(motion) => {
            let target = motion.at(t);
            mechanism.inverse_dynamics(&base, &target.as_platform(), &target.acceleration)?
        }
        Steering::Free(_, force) => *force,
    };
    Ok((base, force))
}

fn run_prototype(
    scenario: &Scenario,
    workspace: &Path,
    drive: &Drive,
    start: &PlatformState,
    steps: &mut Steps,
) -> Result<prototype::Found, PrototypeError> {
    let environment = prototype::environment(workspace)?;
    let task = prototype::Task {
        platform: &scenario.platform,
        gravity_on: scenario.gravity_on,
        drive,
        start,
        half_steps: scenario.prototype_half_steps,
    };
    steps.time(PROTOTYPE, |progress| {
        prototype::run(&environment, workspace, &task, |fraction| progress.at(fraction))
    })
}

fn compared(
    scenario: &Scenario,
    target: &Series,
    simulations: &[Series],
    warnings: &mut Vec<String>,
) -> (Vec<crate::outcome::AmplitudeTable>, Vec<crate::outcome::TimeErrors>) {
    if target.is_empty() {
        // The independent engine is then compared with dyn-gen itself.
        let others = simulations.iter().skip(1);
        return (Vec::new(), others.map(|series| compare::time_errors(&simulations[0], series)).collect());
    }
    let time_errors = simulations.iter().map(|series| compare::time_errors(target, series)).collect();
    let request = &scenario.spectrum;
    let last = simulations.iter().map(Series::len).min().unwrap_or(0).saturating_sub(1);
    if request.frequencies_hz.is_empty() || last <= request.first_step {
        return (Vec::new(), time_errors);
    }
    let frequencies = &request.frequencies_hz;
    let plan = Plan::new(request.first_step, last, scenario.grid.step_s, frequencies, request.window);
    warnings.extend(plan.warning.clone());
    let paper = request.paper_percent.as_deref();
    let table = |series| compare::amplitude_table(&plan, frequencies, target, series, paper);
    let tables: Vec<_> = simulations.iter().map(table).collect();
    if tables.iter().flat_map(|table| table.error_percent.iter().flatten()).all(|error| error.is_nan()) {
        let named: Vec<String> = frequencies.iter().map(f64::to_string).collect();
        warnings.push(format!("the target does not move at {} Hz: no table of amplitudes", named.join(", ")));
        return (Vec::new(), time_errors);
    }
    (tables, time_errors)
}

fn actuator_lengths(mechanism: &dyn Mechanism, drive: &Drive, series: &Series) -> Vec<[f64; 6]> {
    let states: Vec<PlatformState> = (0..series.len()).map(|k| series.state(k)).collect();
    // Every sample was reached by the simulation, so every leg has a length there.
    simulate::lengths(mechanism, &drive.base, &states).unwrap_or_default()
}
