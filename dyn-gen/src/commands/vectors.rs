//! `dyn-gen vectors`: inputs and outputs for whoever ports the equations.

use std::path::PathBuf;

use clap::Args;
use dyn_gen::GraphFile;
use dyn_gen::evidence::{Sampling, cases};
use dyn_gen::output::{NewFile, write_all};
use dyn_gen::vectors::{read_states, vectors};
use miette::{IntoDiagnostic, Report, Result, WrapErr};

use super::Outcome;
use super::files::{keeps_input, read, read_platform};

/// Arguments of `vectors`.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub struct Vectors {
    /// Platform file
    #[arg(value_name = "PLATFORM.toml")]
    platform: PathBuf,
    /// File to write
    #[arg(short, long, value_name = "OUT.json")]
    output: PathBuf,
    /// States to use, in the format of a file of vectors; its outputs, if it has any, are ignored
    #[arg(long, value_name = "STATES.json", conflicts_with_all = ["count", "seed"])]
    states: Option<PathBuf>,
    /// Number of sampled states
    #[arg(short = 'n', long, value_name = "N", default_value_t = 20)]
    count: usize,
    /// Seed of the sampled states; of as many states, generate and explain look at the same ones
    #[arg(long, value_name = "S", default_value_t = Sampling::default().seed)]
    seed: u64,
}

const EXAMPLES: &str = "\
Examples:
  dyn-gen vectors my_platform.toml -o vectors.json
  dyn-gen vectors my_platform.toml -n 500 --seed 7 -o vectors.json
  dyn-gen vectors my_platform.toml --states states.json -o vectors.json

The file has the platform's resolved numbers and, for each state, every output of every function,
in SI units and inertial axes. docs/vectors.md describes the format and lists the outputs.";

impl Vectors {
    /// Writes the vectors.
    pub fn run(self) -> Result<Outcome> {
        keeps_input(&self.platform, &self.output)?;
        let platform = read_platform(&self.platform)?;
        let file = GraphFile::of(platform.leg_type)?;
        let states = match &self.states {
            Some(path) => {
                let given = read_states(&read(path)?)
                    .map_err(Report::from)
                    .wrap_err_with(|| format!("{} is refused", path.display()))?;
                let own = serde_json::to_value(&platform).into_diagnostic()?;
                if given.platform.is_some_and(|platform| platform != own) {
                    eprintln!(
                        "warning: {} carries the numbers of another platform; the outputs are those of {}",
                        path.display(),
                        self.platform.display()
                    );
                }
                given.states
            }
            None => {
                let sampling = Sampling { states: self.count, seed: self.seed };
                let cases = cases(&file.program, &platform, sampling)?;
                cases.into_iter().map(|case| case.environment).collect()
            }
        };
        let text = vectors(&file, &platform, &states)?;
        write_all(&[NewFile { path: self.output.clone(), text }])?;
        eprintln!("wrote {}: {} states", self.output.display(), states.len());
        Ok(Outcome::Done)
    }
}
