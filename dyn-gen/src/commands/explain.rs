//! `dyn-gen explain`: a platform in figures.

use std::path::PathBuf;

use clap::Args;
use dyn_gen::evidence::Sampling;
use dyn_gen::explain::explain;
use dyn_gen::{GraphFile, Numbers};
use miette::{IntoDiagnostic, Result};

use super::Outcome;
use super::files::read_platform;
use super::model::{states, trimmed};
use super::progress::with_progress;

/// Arguments of `explain`.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub struct Explain {
    /// Platform file
    #[arg(value_name = "PLATFORM.toml")]
    platform: PathBuf,
    /// As JSON
    #[arg(long)]
    json: bool,
    /// Functions to explain, separated by commas [default: all]
    #[arg(long, value_delimiter = ',', value_parser = trimmed, value_name = "NAME,...")]
    functions: Option<Vec<String>>,
    /// Numbers given at run time, as for `generate`
    #[arg(long, value_delimiter = ',', value_parser = trimmed, value_name = "NAME,...")]
    runtime: Vec<String>,
    /// States looked at
    #[arg(long, value_name = "N", default_value_t = Sampling::default().states, value_parser = states)]
    states: usize,
    /// Seed of those states
    #[arg(long, value_name = "S", default_value_t = Sampling::default().seed)]
    seed: u64,
}

const EXAMPLES: &str = "\
Examples:
  dyn-gen explain my_platform.toml
  dyn-gen explain my_platform.toml --json > figures.json
  dyn-gen explain my_platform.toml --runtime payload

Exit codes: 0 done, 1 refused, or the generated functions disagree with the hand-written dynamics.";

impl Explain {
    /// Prints the explanation.
    pub fn run(self) -> Result<Outcome> {
        let platform = read_platform(&self.platform)?;
        let file = GraphFile::of(platform.leg_type)?;
        let numbers = Numbers::with_run_time(&platform, &self.runtime);
        let sampling = Sampling { states: self.states, seed: self.seed };
        let explanation = with_progress("comparing with the hand-written dynamics", || {
            explain(&file, &numbers, self.functions.as_deref(), sampling)
        })?;
        if self.json {
            println!("{}", serde_json::to_string_pretty(&explanation).into_diagnostic()?);
        } else {
            print!("{}", explanation.text());
        }
        if explanation.evidence.holds() {
            return Ok(Outcome::Done);
        }
        eprintln!("{}", explanation.evidence.first_failures());
        if !platform.warnings.is_empty() {
            eprintln!("first mend what the warnings above are about, if it is not meant");
        }
        Ok(Outcome::Differs)
    }
}
