//! The virtual prototype: the mechanism body by body in the multibody engine Exudyn, run by Python.
//!
//! It gets the platform's numbers, the base's motion and the actuator forces, and gives back the platform's motion. None
//! of the equations of this workspace take part; the exchange is one JSON file in each direction, described in
//! `dyn-sim/prototype/exchange.py`.

use std::fs::File;
use std::io::{self, BufRead, BufReader, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::process::Stdio;

use dyn_platform::Platform;
use dyn_python::{Environment, Recipe, target_directory};
use dyn_runtime::PlatformState;
use miette::Diagnostic;
use serde::{Deserialize, Serialize};

use crate::outcome::Series;
use crate::rotation::rows;
use crate::simulate::Drive;

/// Folder of the Python package's parent, seen from the root of the repository.
const FOLDER: &str = "dyn-sim";
/// Its pinned packages.
const LOCK_FILE: &str = "dyn-sim/prototype/requirements.lock";
/// Version of both exchange files.
const VERSION: u32 = 1;

/// Why there is no result of the prototype.
#[derive(Debug, thiserror::Error, Diagnostic)]
pub enum PrototypeError {
    /// No Python environment with Exudyn.
    #[error("{0}")]
    #[diagnostic(help("{}; --no-prototype does without it", .0.remedy()))]
    Environment(dyn_python::Error),
    /// The package is not there.
    #[error("the virtual prototype is part of the repository, and {} is not there", .0.display())]
    #[diagnostic(help("run inside the repository, or with --no-prototype"))]
    NoPackage(PathBuf),
    /// The exchange files cannot be written or read.
    #[error("cannot exchange data with the prototype: {0}")]
    #[diagnostic(help("the files lie in the system's temporary folder; is its disk full?"))]
    Exchange(#[from] io::Error),
    /// The prototype ran and failed.
    #[error("the prototype failed ({status}):\n{said}")]
    #[diagnostic(help(
        "dyn-sim/prototype/README.md tells how to run it by hand; --no-prototype does without it"
    ))]
    Failed {
        /// How it ended.
        status: std::process::ExitStatus,
        /// Last lines of its standard error.
        said: String,
    },
    /// Its output is not what was agreed.
    #[error("the prototype's output is not understood: {0}")]
    #[diagnostic(help("package and dyn-sim must come from the same revision of the repository"))]
    Output(String),
}

impl PrototypeError {
    /// What a reader of the results has to know, in one line where the environment is missing.
    pub fn remark(&self) -> String {
        match self {
            Self::Environment(error) if error.is_environment_missing() => {
                format!("no virtual prototype, as with --no-prototype: {error}; {}", error.remedy())
            }
            error => format!("no virtual prototype: {error}"),
        }
    }

    /// Whether this machine merely lacks Python or the network, so that one may go on without the prototype.
    pub fn is_environment_missing(&self) -> bool {
        matches!(self, Self::Environment(error) if error.is_environment_missing())
    }
}

/// What the prototype found.
#[derive(Clone, Debug)]
pub struct Found {
    /// The platform's motion, labelled with the engine and its version.
    pub series: Series,
    /// Largest constraint residual of the initial configuration, m, by the engine.
    pub closure_residual: f64,
    /// The engine's integrator.
    pub integrator: String,
}

/// What the prototype is to do.
#[derive(Clone, Copy, Debug)]
pub struct Task<'a> {
    /// The mechanism.
    pub platform: &'a Platform,
    /// Whether its gravity acts.
    pub gravity_on: bool,
    /// Base and forces.
    pub drive: &'a Drive,
    /// The platform's pose and velocity at the start.
    pub start: &'a PlatformState,
    /// Whether the engine's steps are half of the drive's: a quarter of its error. Its method takes base and forces at
    /// the ends of its steps, so it needs no value that the drive does not have.
    pub half_steps: bool,
}

#[derive(Serialize)]
struct Input<'a> {
    version: u32,
    platform: &'a Platform,
    gravity_on: bool,
    step_s: f64,
    steps: usize,
    base: Base,
    actuator_force: Vec<[f64; 6]>,
    initial: Initial,
    half_steps: bool,
}

#[derive(Serialize)]
struct Base {
    position: Vec<[f64; 3]>,
    rotation: Vec<[f64; 9]>,
    velocity: Vec<[f64; 6]>,
    acceleration: Vec<[f64; 6]>,
}

#[derive(Serialize)]
struct Initial {
    platform_position: [f64; 3],
    platform_rotation: [f64; 9],
    platform_velocity: [f64; 6],
}

#[derive(Deserialize)]
struct Output {
    version: u32,
    engine: String,
    integrator: String,
    closure_residual: f64,
    time: Vec<f64>,
    platform_position: Vec<[f64; 3]>,
    platform_rotation: Vec<[f64; 9]>,
    platform_velocity: Vec<[f64; 6]>,
    platform_acceleration: Vec<[f64; 6]>,
}

/// The Python environment of the prototype, made on first use; `workspace` is the root of the repository.
///
/// # Errors
/// The package is missing, or no environment can be made.
pub fn environment(workspace: &Path) -> Result<Environment, PrototypeError> {
    let lock_file = workspace.join(LOCK_FILE);
    if !lock_file.is_file() {
        return Err(PrototypeError::NoPackage(lock_file));
    }
    let target_directory = target_directory(workspace);
    let recipe = Recipe { name: "prototype", lock_file: &lock_file, target_directory: &target_directory };
    Environment::prepare(&recipe).map_err(PrototypeError::Environment)
}

/// Runs the prototype; `progress` hears fractions. `workspace` is the root of the repository.
///
/// # Errors
/// See [`PrototypeError`].
pub fn run(
    environment: &Environment,
    workspace: &Path,
    task: &Task,
    progress: impl FnMut(f64),
) -> Result<Found, PrototypeError> {
    let folder = tempfile::tempdir()?;
    let (input, output) = (folder.path().join("input.json"), folder.path().join("output.json"));
    write_input(&input, task)?;
    let mut command = environment.command();
    command.args(["-m", "prototype"]).arg(&input).arg(&output).current_dir(workspace.join(FOLDER));
    let mut child = command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::piped()).spawn()?;
    let said =
        child.stderr.take().map_or(Ok(String::new()), |stderr| listen(BufReader::new(stderr), progress));
    let status = child.wait()?;
    let said = said?;
    if !status.success() {
        return Err(PrototypeError::Failed { status, said });
    }
    let text = std::fs::read_to_string(&output)?;
    let output: Output =
        serde_json::from_str(&text).map_err(|error| PrototypeError::Output(error.to_string()))?;
    found(output, task.drive.grid.steps + 1)
}

/// Passes progress on and keeps the last other lines.
fn listen(stderr: impl BufRead, mut progress: impl FnMut(f64)) -> io::Result<String> {
    const KEPT: usize = 12;
    let mut lines: Vec<String> = Vec::new();
    for line in stderr.split(b'\n') {
        let line = String::from_utf8_lossy(&line?).trim_end().to_owned();
        let fraction = line.strip_prefix("progress ").and_then(|rest| rest.parse::<f64>().ok());
        match fraction {
            Some(fraction) => progress(fraction),
            None => lines.push(line),
        }
        if lines.len() > KEPT {
            lines.remove(0);
        }
    }
    Ok(lines.join("\n"))
}

fn write_input(path: &Path, task: &Task) -> io::Result<()> {
    let Task { platform, gravity_on, drive, start, half_steps } = *task;
    let every = if half_steps { 1 } else { 2 };
    let base = drive.base.iter().step_by(every);
    let input = Input {
        version: VERSION,
        platform,
        gravity_on,
        step_s: drive.grid.step_s,
        steps: drive.grid.steps,
        base: Base {
            position: base.clone().map(|b| b.pose.position_m.into()).collect(),
            rotation: base.clone().map(|b| flat(&rows(&b.pose.rotation))).collect(),
            velocity: base.clone().map(|b| b.velocity.to_vector().into()).collect(),
            acceleration: base.map(|b| b.acceleration.to_vector().into()).collect(),
        },
        actuator_force: drive.actuator_force_n.iter().step_by(every).map(|force| (*force).into()).collect(),
        initial: Initial {
            platform_position: start.pose.position_m.into(),
            platform_rotation: flat(&rows(&start.pose.rotation)),
            platform_velocity: start.velocity.to_vector().into(),
        },
        half_steps,
    };
    let mut file = BufWriter::new(File::create(path)?);
    serde_json::to_writer(&mut file, &input)?;
    file.flush()
}

fn flat(rows: &[[f64; 3]; 3]) -> [f64; 9] {
    std::array::from_fn(|i| rows[i / 3][i % 3])
}

fn found(output: Output, samples: usize) -> Result<Found, PrototypeError> {
    if output.version != VERSION {
        return Err(PrototypeError::Output(format!("version {} instead of {VERSION}", output.version)));
    }
    let lengths = [
        output.time.len(),
        output.platform_position.len(),
        output.platform_rotation.len(),
        output.platform_velocity.len(),
        output.platform_acceleration.len(),
    ];
    if lengths.iter().any(|length| *length != samples) {
        return Err(PrototypeError::Output(format!("{lengths:?} samples instead of {samples}")));
    }
    let engine = match output.engine.strip_prefix("exudyn") {
        Some(version) => format!("Exudyn{version}"),
        None => output.engine,
    };
    let unflat = |r: &[f64; 9]| std::array::from_fn(|i| std::array::from_fn(|j| r[3 * i + j]));
    Ok(Found {
        series: Series {
            label: engine,
            time_s: output.time,
            position_m: output.platform_position,
            rotation: output.platform_rotation.iter().map(unflat).collect(),
            velocity: output.platform_velocity,
            acceleration: output.platform_acceleration,
        },
        closure_residual: output.closure_residual,
        integrator: output.integrator,
    })
}
