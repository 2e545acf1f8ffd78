//! Subcommands.

mod progress;
mod run;
mod sweep;

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Parser, Subcommand};

use run::{Options, scenario_file};

/// How a command ended without an error of its own.
pub enum Ending {
    /// All was done.
    Done,
    /// An input was refused or something failed.
    Refused,
    /// The motion ended early; what came before was kept.
    Stopped,
}

impl Ending {
    /// 0, 1, 3; 2 is wrong usage, by clap.
    pub fn exit_code(&self) -> ExitCode {
        match self {
            Self::Done => ExitCode::SUCCESS,
            Self::Refused => ExitCode::from(1),
            Self::Stopped => ExitCode::from(3),
        }
    }
}

/// Experiments with a parallel platform on a moving base, against an independent multibody engine.
#[derive(Parser)]
#[command(version, after_help = EXAMPLES)]
pub struct Arguments {
    #[command(subcommand)]
    command: Command,
}

const EXAMPLES: &str = "\
Examples:
  dyn-sim reproduce                      the paper's experiment: its Table 4 and a report with every figure
  dyn-sim reproduce --scenario large     the same where every term of the equations counts
  dyn-sim run my_experiment.toml         your own scenario; scenarios/README.md describes the file
  dyn-sim check my_experiment.toml       only look for mistakes in it
  dyn-sim sweep my_sweep.toml            the scenario for thousands of designs or starts at once

Exit codes: 0 done, 1 refused or failed, 2 wrong usage, 3 the motion ended early and what came before was kept.";

const SWEEP_EXAMPLES: &str = "\
A sweep file, complete:
  version = 1
  name = \"payload_and_springs\"
  scenario = \"my_experiment.toml\"
  [[vary]]
  platform = \"payload.mass_kg\"                        # a number of the platform file
  from = 5.0
  to = 7.0
  steps = 21
  [[vary]]
  platform = \"legs.axial_stiffness_n_per_m\"
  values = [15000.0, 20000.0, 25000.0]

Examples:
  dyn-sim sweep my_sweep.toml                 63 designs: table, figures, page
  dyn-sim sweep my_sweep.toml --threads 1     leave the other processors to others
  dyn-sim sweep my_sweep.toml --json          every design, for other programs

scenarios/README.md describes the file: random tolerances, starts, held platforms.";

#[derive(Subcommand)]
enum Command {
    /// Repeat a published experiment: forces, both simulations, spectra, tables, report
    Reproduce {
        /// `published`, `large`, or a scenario file
        #[arg(long, default_value = "published")]
        scenario: String,
        #[command(flatten)]
        options: Options,
    },
    /// Run a scenario file
    Run {
        /// The scenario file
        file: PathBuf,
        #[command(flatten)]
        options: Options,
    },
    /// Compute a scenario for many designs of the platform, or from many starts
    #[command(after_help = SWEEP_EXAMPLES)]
    Sweep {
        /// The sweep file: a scenario, and what varies
        file: PathBuf,
        #[command(flatten)]
        options: sweep::Options,
    },
    /// Check a scenario file and run nothing
    Check {
        /// The scenario file
        file: PathBuf,
    },
}

/// What one types in the repository.
const TOOL: &str = "cargo run --release -p dyn-sim --";

/// Does what the command line says.
pub fn run(arguments: Arguments) -> miette::Result<Ending> {
    match arguments.command {
        Command::Reproduce { scenario, options } => {
            let command = format!("{TOOL} reproduce --scenario {scenario}");
            run::run(&scenario_file(&scenario)?, &options, &command)
        }
        Command::Run { file, options } => {
            let command = format!("{TOOL} run {}", file.display());
            run::run(&file, &options, &command)
        }
        Command::Sweep { file, options } => {
            let command = format!("{TOOL} sweep {}", file.display());
            sweep::run(&file, &options, &command)
        }
        Command::Check { file } => run::check(&file),
    }
}
