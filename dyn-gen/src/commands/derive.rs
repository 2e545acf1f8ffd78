//! `dyn-gen derive`: the derivation in Python, in an environment of its own.

use std::fs;
use std::path::Path;

use clap::Args;
use dyn_gen::GraphFile;
use dyn_gen::output::{NewFile, write_all};
use dyn_platform::LegType;
use dyn_python::{Environment, Recipe, target_directory};
use miette::{Diagnostic, IntoDiagnostic, Result, WrapErr};

use super::Outcome;
use super::files::{DERIVATION, GRAPHS, LOCK_FILE, graph_name, repository};
use super::progress::with_progress;

/// Arguments of `derive`.
#[derive(Args)]
pub struct Derive {
    /// Compare only: exit code 1 if a committed graph is not what the derivation gives
    #[arg(long)]
    check: bool,
}

impl Derive {
    /// Derives, then writes or compares.
    pub fn run(self) -> Result<Outcome> {
        let root = repository()?;
        let mut files: Vec<NewFile> = derive(&root)?.into_iter().map(|derived| derived.file(&root)).collect();
        files.retain(|file| !file.is_current());
        let changed: Vec<String> = files
            .iter()
            .filter_map(|file| file.path.file_name())
            .map(|name| format!("{GRAPHS}/{}", name.to_string_lossy()))
            .collect();
        let changed = changed.join(", ");
        if files.is_empty() {
            eprintln!("{GRAPHS} holds what the derivation gives");
        } else if self.check {
            eprintln!("not what the derivation gives: {changed}; run `cargo regen --derive`");
            return Ok(Outcome::Differs);
        } else {
            write_all(&files)?;
            eprintln!("wrote {changed}");
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

impl Derived {
    /// The file in the repository.
    pub fn file(self, root: &Path) -> NewFile {
        NewFile { path: root.join(GRAPHS).join(&self.graph.name), text: self.text }
    }
}

/// Why there are no new graphs. The committed ones are as they were.
#[derive(Debug, thiserror::Error, Diagnostic)]
pub enum DeriveError {
    /// No environment to run in.
    #[error("{0}")]
    #[diagnostic(help("{}", .0.remedy()))]
    Environment(dyn_python::Error),
    /// The derivation ran and failed.
    #[error("the derivation failed ({status}); the committed graphs are unchanged\n{output}")]
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

/// Runs the derivation into a temporary folder and reads the graphs of all leg types as every later step will.
pub fn derive(root: &Path) -> Result<Vec<Derived>> {
    let environment = Environment::prepare(&Recipe {
        name: "derivation",
        lock_file: &root.join(LOCK_FILE),
        target_directory: &target_directory(root),
    })
    .map_err(DeriveError::Environment)?;
    let folder = tempfile::tempdir().into_diagnostic().wrap_err("cannot make a temporary folder")?;
    let mut command = environment.command();
    command.args(["-m", "derivation", "--folder"]).arg(folder.path()).current_dir(root.join(DERIVATION));
    let result = with_progress("deriving the equations with CasADi", || command.output())
        .into_diagnostic()
        .wrap_err_with(|| format!("cannot run {}", environment.python().display()))?;
    if !result.status.success() {
        let said = [result.stdout, result.stderr].concat();
        return Err(DeriveError::Failed {
            status: result.status,
            output: String::from_utf8_lossy(&said).trim().to_owned(),
            command: format!(
                "cd {DERIVATION} && {} -m derivation --folder graphs",
                environment.python().display()
            ),
        }
        .into());
    }
    LegType::ALL.into_iter().map(|leg_type| read_derived(folder.path(), leg_type)).collect()
}

fn read_derived(folder: &Path, leg_type: LegType) -> Result<Derived> {
    let name = graph_name(leg_type);
    let text = fs::read_to_string(folder.join(&name))
        .into_diagnostic()
        .wrap_err_with(|| format!("the derivation wrote no {name}"))?;
    let graph = GraphFile::from_json(&name, &text)
        .map_err(miette::Report::from)
        .wrap_err_with(|| format!("the derived {name} is refused; the committed graphs are unchanged"))?;
    check_samples(&graph)?;
    Ok(Derived { text, graph })
}

/// The derivation and this reader must agree on what the graph computes.
fn check_samples(graph: &GraphFile) -> Result<()> {
    const TOLERANCE: f64 = 1e-10;
    let (error, place) = graph.program.check_samples().into_diagnostic()?;
    miette::ensure!(
        error <= TOLERANCE,
        "the derived {} does not give the derivation's own sample outputs ({place}: relative error {error:.1e}); \
         the committed graphs are unchanged",
        graph.name
    );
    Ok(())
}
