//! `dyn-gen derive`: the derivation in Python, in an environment of its own.

use std::fs;
use std::path::Path;

use clap::Args;
use dyn_gen::GraphFile;
use dyn_gen::output::{NewFile, write_all};
use dyn_python::{Environment, Recipe, target_directory};
use miette::{Diagnostic, IntoDiagnostic, Result, WrapErr};

use super::Outcome;
use super::files::{DERIVATION, GRAPH, LOCK_FILE, repository};
use super::progress::with_progress;

/// Arguments of `derive`.
#[derive(Args)]
pub struct Derive {
    /// Compare only: exit code 1 if the committed graph is not what the derivation gives
    #[arg(long)]
    check: bool,
}

impl Derive {
    /// Derives, then writes or compares.
    pub fn run(self) -> Result<Outcome> {
        let root = repository()?;
        let file = NewFile { path: root.join(GRAPH), text: derive(&root)?.text };
        if file.is_current() {
            eprintln!("{GRAPH} is what the derivation gives");
        } else if self.check {
            eprintln!("{GRAPH} is not what the derivation gives; run `cargo regen --derive`");
            return Ok(Outcome::Differs);
        } else {
            write_all(&[file])?;
            eprintln!("wrote {GRAPH}");
        }
        Ok(Outcome::Done)
    }
}

/// A graph fresh from the derivation, read and checked.
pub struct Derived {
    /// The file's text.
    pub text: String,
    /// What it holds.
    pub graph: GraphFile,
}

/// Why there is no new graph. The committed one is as it was.
#[derive(Debug, thiserror::Error, Diagnostic)]
pub enum DeriveError {
    /// No environment to run in.
    #[error("{0}")]
    #[diagnostic(help("{}", .0.remedy()))]
    Environment(dyn_python::Error),
    /// The derivation ran and failed.
    #[error("the derivation failed ({status}); the committed graph is unchanged\n{output}")]
    #[diagnostic(help("to repeat it by hand: {command}"))]
    Failed {
        /// How it ended.
        status: std::process::ExitStatus,
        /// What it said.
        output: String,
        /// The command.
        command: String,
    },
}

impl DeriveError {
    /// Whether this machine merely lacks Python or the network.
    pub fn is_environment_missing(&self) -> bool {
        matches!(self, DeriveError::Environment(error) if error.is_environment_missing())
    }
}

/// Runs the derivation into a temporary file and reads it as every later step will.
pub fn derive(root: &Path) -> Result<Derived> {
    let environment = Environment::prepare(&Recipe {
        name: "derivation",
        lock_file: &root.join(LOCK_FILE),
        target_directory: &target_directory(root),
    })
    .map_err(DeriveError::Environment)?;
    let folder = tempfile::tempdir().into_diagnostic().wrap_err("cannot make a temporary folder")?;
    let output = folder.path().join("uhp.json");
    let mut command = environment.command();
    command.args(["-m", "derivation", "--output"]).arg(&output).current_dir(root.join(DERIVATION));
    let result = with_progress("deriving the equations with CasADi", || command.output())
        .into_diagnostic()
        .wrap_err_with(|| format!("cannot run {}", environment.python().display()))?;
    if !result.status.success() {
        let said = [result.stdout, result.stderr].concat();
        return Err(DeriveError::Failed {
            status: result.status,
            output: String::from_utf8_lossy(&said).trim().to_owned(),
            command: format!(
                "cd {DERIVATION} && {} -m derivation --output graph.json",
                environment.python().display()
            ),
        }
        .into());
    }
    let text = fs::read_to_string(&output).into_diagnostic().wrap_err("the derivation wrote no graph")?;
    let graph = GraphFile::from_json("uhp.json", &text)
        .map_err(miette::Report::from)
        .wrap_err("the derived graph is refused; the committed graph is unchanged")?;
    check_samples(&graph)?;
    Ok(Derived { text, graph })
}

/// The derivation and this reader must agree on what the graph computes.
fn check_samples(graph: &GraphFile) -> Result<()> {
    const TOLERANCE: f64 = 1e-10;
    let (error, place) = graph.program.check_samples().into_diagnostic()?;
    miette::ensure!(
        error <= TOLERANCE,
        "the derived graph does not give the derivation's own sample outputs ({place}: relative error {error:.1e}); \
         the committed graph is unchanged"
    );
    Ok(())
}
