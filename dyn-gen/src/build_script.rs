//! Generation from a build script.

use std::path::{Path, PathBuf};

use dyn_platform::{FileError, Platform};

use crate::emit::{RuntimePath, Scalar};
use crate::error::GenerateError;
use crate::evidence::Sampling;
use crate::generate::{Options, generate};
use crate::graph::FormatError;
use crate::output::{NewFile, WriteError, write_all};
use crate::{GraphFile, Numbers};

/// States at which a build script examines the model: enough to see any wrong operation, few enough not to be felt.
const STATES: usize = 50;

/// A model made by a build script, in pure Rust and whenever its platform file has changed.
///
/// In `build.rs`:
///
/// ```no_run
/// dyn_gen::Build::new("platform.toml").runtime(["payload"]).write_to_out_dir("model.rs");
/// ```
///
/// and in the crate:
///
/// ```text
/// mod model {
///     include!(concat!(env!("OUT_DIR"), "/model.rs"));
/// }
/// ```
#[derive(Clone, Debug)]
pub struct Build {
    platform: PathBuf,
    model: Option<String>,
    runtime: Vec<String>,
    scalars: Vec<Scalar>,
    functions: Option<Vec<String>>,
    evidence: Option<Sampling>,
}

/// Why nothing was built.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
pub enum BuildError {
    /// The platform file.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Platform(#[from] FileError),
    /// The graph file that this crate has inside.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Graph(#[from] FormatError),
    /// The generator.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Generate(#[from] GenerateError),
    /// The file.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Write(#[from] WriteError),
    /// No build script.
    #[error("OUT_DIR is not set")]
    #[diagnostic(help("call write_to_out_dir from a build script, or write_to with the path of a file"))]
    NoOutDir,
}

impl Build {
    /// The model of a platform file, seen from the package's folder.
    pub fn new(platform: impl Into<PathBuf>) -> Build {
        Build {
            platform: platform.into(),
            model: None,
            runtime: Vec::new(),
            scalars: vec![Scalar::F64],
            functions: None,
            evidence: Some(Sampling { states: STATES, ..Sampling::default() }),
        }
    }

    /// Name of the model, whose type is its CamelCase. Otherwise that of the platform.
    pub fn model(mut self, name: impl Into<String>) -> Build {
        self.model = Some(name.into());
        self
    }

    /// Numbers given at run time, as in [`Numbers::with_run_time`]. Otherwise all are baked in.
    pub fn runtime(mut self, names: impl IntoIterator<Item = impl Into<String>>) -> Build {
        self.runtime.extend(names.into_iter().map(Into::into));
        self
    }

    /// The types of number that the model computes with. Otherwise f64.
    pub fn scalars(mut self, scalars: impl IntoIterator<Item = Scalar>) -> Build {
        self.scalars = scalars.into_iter().collect();
        self
    }

    /// The functions to generate, as in [`Options::functions`]. Otherwise all.
    pub fn functions(mut self, names: impl IntoIterator<Item = impl Into<String>>) -> Build {
        self.functions.get_or_insert_default().extend(names.into_iter().map(Into::into));
        self
    }

    /// The states at which the model is examined before it is written, none for no examination. Otherwise 50.
    pub fn evidence(mut self, sampling: Option<Sampling>) -> Build {
        self.evidence = sampling;
        self
    }

    /// Writes the file `name` into `OUT_DIR` and tells cargo to come back when the platform file has changed. Whatever
    /// stands against it is printed as an error of the build, which then ends.
    pub fn write_to_out_dir(&self, name: &str) {
        println!("cargo::rerun-if-changed={}", self.platform.display());
        let written = std::env::var_os("OUT_DIR")
            .ok_or(BuildError::NoOutDir)
            .and_then(|folder| self.write_to(&Path::new(&folder).join(name)));
        if let Err(error) = written {
            // Without colours and links: cargo shows it indented, often in a log.
            let mut text = String::new();
            let handler =
                miette::GraphicalReportHandler::new_themed(miette::GraphicalTheme::unicode_nocolor());
            if handler.render_report(&mut text, &error).is_err() {
                text = error.to_string();
            }
            eprintln!("{text}");
            std::process::exit(1);
        }
    }

    /// Writes the file at `path`.
    ///
    /// # Errors
    /// See [`BuildError`]; then the file is as it was.
    pub fn write_to(&self, path: &Path) -> Result<(), BuildError> {
        let platform = Platform::from_file(&self.platform)?;
        for warning in &platform.warnings {
            println!("cargo::warning={warning}");
        }
        let options = Options {
            model: self.model.clone().unwrap_or_else(|| platform.name.clone()),
            runtime: RuntimePath::new("::dyn_runtime").map_err(GenerateError::from)?,
            scalars: self.scalars.clone(),
            functions: self.functions.clone(),
            command: "cargo build (dyn_gen::Build in build.rs)".into(),
            evidence: self.evidence,
            without: Vec::new(),
        };
        let numbers = Numbers::with_run_time(&platform, &self.runtime);
        let generated = generate(&GraphFile::of(platform.leg_type)?, &numbers, &options)?;
        Ok(write_all(&[NewFile { path: path.to_owned(), text: generated.source }])?)
    }
}
