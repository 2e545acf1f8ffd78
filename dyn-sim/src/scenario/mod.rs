//! Scenario files: platform, excitation, target or free platform, duration, step, integrator, prototype, outputs.
//!
//! A scenario is checked before anything runs. Each mistake comes with its file, line, caret and remedy, as those of
//! platform files do. The format is described for users in `scenarios/README.md`.

mod checks;
mod csv;
mod error;
mod motions;
mod schema;
pub(crate) mod syntax;

use std::path::{Path, PathBuf};

use dyn_platform::{FileError, LegType, Platform, Refusal, read_text};
use dyn_runtime::PlatformState;
use dyn_runtime::nalgebra::Vector6;

pub(crate) use checks::name as check_name;
pub use error::ScenarioError;
pub use schema::{Integrator, Outputs};

use crate::motion::Motion;
use crate::simulate::Grid;
use crate::spectrum::Window;
use crate::stop::Stroke;

/// Version of the scenario file format.
pub const VERSION: i64 = 1;

/// A scenario after all checks.
#[derive(Clone, Debug)]
pub struct Scenario {
    /// Short name; reports are filed under it.
    pub name: String,
    /// One sentence for people.
    pub description: String,
    /// The file as read.
    pub text: String,
    /// The platform.
    pub platform: Platform,
    /// Whether the platform file's gravity acts.
    pub gravity_on: bool,
    /// Steps and duration.
    pub grid: Grid,
    /// How dyn-sim simulates.
    pub integrator: Integrator,
    /// Whether the virtual prototype runs as well.
    pub prototype: bool,
    /// Whether its steps are half as long.
    pub prototype_half_steps: bool,
    /// Motion of the base.
    pub base: Motion,
    /// What the platform does.
    pub steering: Steering,
    /// Ends of the actuators' stroke, of the platform file and of the scenario.
    pub stroke: Option<Stroke>,
    /// What is compared at which frequencies.
    pub spectrum: SpectrumRequest,
    /// What is written.
    pub outputs: Outputs,
    /// What a reader must know: bias removed from measured motion.
    pub notes: Vec<String>,
}

/// What the platform does.
#[derive(Clone, Debug)]
pub enum Steering {
    /// Actuator forces move it along this motion (O).
    Target(Box<Motion>),
    /// It starts in this state (O) under constant forces (N).
    Free(PlatformState, Vector6<f64>),
}

/// Which amplitudes are compared.
#[derive(Clone, Debug, PartialEq)]
pub struct SpectrumRequest {
    /// Named frequencies, Hz; none: no table.
    pub frequencies_hz: Vec<f64>,
    /// Index of the first step that counts.
    pub first_step: usize,
    /// Weights of the samples.
    pub window: Window,
    /// The paper's errors, percent, beside ours.
    pub paper_percent: Option<Vec<[f64; 6]>>,
}

impl Scenario {
    /// Reads and checks a scenario file, its platform file and its measured motions; their paths count from the
    /// scenario file's folder.
    ///
    /// # Errors
    /// A file cannot be read, or holds mistakes; each mistake comes with line, caret and remedy.
    pub fn from_file(path: impl AsRef<Path>) -> Result<Self, ScenarioError> {
        let path = path.as_ref();
        let help = "check the path and its permissions; scenarios/published.toml is an example";
        let text = read_text(path, "scenario", help).map_err(ScenarioError::File)?;
        Self::from_toml(&path.display().to_string(), &text, path.parent().unwrap_or(Path::new("")))
    }

    /// Checks the text of a scenario file; `source_name` stands for the file in messages, paths in it count from
    /// `folder`.
    ///
    /// # Errors
    /// As [`Scenario::from_file`].
    pub fn from_toml(source_name: &str, text: &str, folder: &Path) -> Result<Self, ScenarioError> {
        let file = parsed(source_name, text)?;
        let platform_path = folder.join(file.platform.get_ref());
        if !platform_path.is_file() {
            let what = format!("there is no platform file {}", platform_path.display());
            let help = "give its path, counted from the folder of the scenario file";
            let refusal = Refusal::new(file.platform.span(), "no such file", what, help);
            return Err(ScenarioError::File(FileError::new(source_name, text, vec![refusal])));
        }
        let platform = Platform::from_file(&platform_path).map_err(ScenarioError::Platform)?;
        Self::checked(source_name, text, folder, file, platform)
    }

    /// The same with another platform than that of the file.
    ///
    /// # Errors
    /// As [`Scenario::from_file`].
    pub fn with_platform(
        source_name: &str,
        text: &str,
        folder: &Path,
        platform: Platform,
    ) -> Result<Self, ScenarioError> {
        Self::checked(source_name, text, folder, parsed(source_name, text)?, platform)
    }

    fn checked(
        source_name: &str,
        text: &str,
        folder: &Path,
        file: schema::File,
        platform: Platform,
    ) -> Result<Self, ScenarioError> {
        let refused = |refusals| ScenarioError::File(FileError::new(source_name, text, refusals));
        let mut refusals = Vec::new();
        if platform.leg_type != LegType::Uhp {
            let what = format!("a platform with legs {:?} cannot be simulated", platform.leg_type.name());
            let help = format!("give a platform with legs {:?}", LegType::Uhp.name());
            refusals.push(Refusal::new(file.platform.span(), "other legs", what, help));
            return Err(refused(refusals));
        }
        match checks::scenario(file, text, platform, folder, &mut refusals).map_err(ScenarioError::File)? {
            Some(scenario) if refusals.is_empty() => Ok(scenario),
            _ => Err(refused(refusals)),
        }
    }
}

/// The keys of a scenario file of this version.
fn parsed(source_name: &str, text: &str) -> Result<schema::File, ScenarioError> {
    let refused = |refusals| ScenarioError::File(FileError::new(source_name, text, refusals));
    let file: schema::File =
        toml::from_str(text).map_err(|error| refused(vec![syntax::refusal(&error, text)]))?;
    let mut refusals = Vec::new();
    checks::version(&file, &mut refusals);
    // Another version may mean other things: say nothing about them.
    if refusals.is_empty() { Ok(file) } else { Err(refused(refusals)) }
}

/// The path of the platform file in the text of a sound scenario file.
pub(crate) fn platform_of(source_name: &str, text: &str, folder: &Path) -> Result<PathBuf, ScenarioError> {
    Ok(folder.join(parsed(source_name, text)?.platform.get_ref()))
}
