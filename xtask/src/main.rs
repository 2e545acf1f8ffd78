//! The workspace's own commands: orchestration only, each step is a command one can also type.

mod bare;
mod bench;
mod contract;
mod passes;
mod runner;
mod steps;
#[cfg(test)]
mod tests;
mod vectors;
mod workspace;

use std::process::ExitCode;

use clap::{Args, Parser, Subcommand};

use crate::runner::Failure;
use crate::steps::{RUN, Step, TEST};

/// Everything this workspace does, one command each.
///
/// Nothing needs setting up: Python environments are made under `target/` on first use. A step that fails names the
/// command that repeats it alone.
#[derive(Parser)]
#[command(name = "cargo xtask", bin_name = "cargo xtask")]
struct CommandLine {
    #[command(subcommand)]
    command: Task,
}

#[derive(Subcommand)]
enum Task {
    /// Derive, regenerate, check, print the paper's platform in figures, and repeat the paper's experiment
    ///
    /// Where Python or the network is missing it says so and goes on with the committed graph and without the
    /// virtual prototype.
    Run(Selection),
    /// Check everything: format, lints, freshness of derived files, Python and Rust tests, documentation
    ///
    /// Needs Python 3.11 or later and, the first time, the network.
    Test {
        #[command(flatten)]
        selection: Selection,
        /// Fetch the toolchain for the step `bare` first, which is skipped without it (155 MB, see `cargo xtask bare`)
        #[arg(long)]
        bare: bool,
    },
    /// Measure: generated code beside the hand-written reference, CasADi's own C and Pinocchio
    ///
    /// Prepares the peers under `target/bench/` (gcc, clang, Python with the network the first time; what is missing is said and
    /// left out), compiles everything for this very processor, checks that all agree, measures, and prints the table of
    /// ratios, which it writes as JSON and as a plot too. Close other programs first.
    Bench(bench::Options),
    /// Measure what each pass of the generator is worth: models without it, models by it alone
    ///
    /// Makes some thirty models of one platform, compiles them into one program for this very processor, times all of them turn by
    /// turn and prints operations and times as multiples of the complete pipeline's. Some minutes, nearly all of them compilation.
    Passes(passes::Options),
    /// Recompute the test vectors of the multibody engines and compare with the committed ones (long)
    ///
    /// Pinocchio and MuJoCo are installed from `tests/engines/requirements.lock` into an environment of their own.
    Vectors(vectors::Options),
    /// Show that no call of the runtime crate can panic or run on, the code and stack that each takes, and that debug and release agree
    ///
    /// Needs binutils (ar, objdump) and an x86-64. Stack and instructions are those of the worst way through a call and all that it calls, whatever
    /// the numbers: every function with a loop is named with a bound, as are the reasons, and none calls what the code does not name.
    Contract,
    /// Build the C library without operating system, for this machine, a Cortex-M and WebAssembly, and look into it
    ///
    /// No exported function may reach a panic or call itself; code and stack are listed for each; the WebAssembly module
    /// runs in Node over the test vectors, against the native library. The first time it unpacks Debian's `rustc-web`
    /// (155 MB, nothing is installed) under `target/`; where that cannot be had it says so and does the rest.
    Bare(bare::Options),
}

/// Which steps of a task.
#[derive(Args)]
struct Selection {
    /// Start at this step
    #[arg(long, value_name = "STEP", conflicts_with = "only")]
    from: Option<String>,
    /// Do this step alone
    #[arg(long, value_name = "STEP")]
    only: Option<String>,
    /// List the steps, their reasons and commands, and do nothing
    #[arg(long)]
    list: bool,
}

fn main() -> ExitCode {
    let result = match CommandLine::parse().command {
        Task::Run(selection) => perform("run", RUN, &selection),
        Task::Test { selection, bare } => fetched(bare).and_then(|()| perform("test", TEST, &selection)),
        Task::Bench(options) => bench::bench(&options),
        Task::Passes(options) => passes::passes(&options),
        Task::Vectors(options) => vectors::compare_or_write(&options),
        Task::Contract => contract::check(),
        Task::Bare(options) => bare::bare(&options),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("{failure}");
            ExitCode::FAILURE
        }
    }
}

/// The toolchain of the step `bare`, if it is wanted.
fn fetched(wanted: bool) -> Result<(), Failure> {
    if wanted { bare::fetch().map(drop) } else { Ok(()) }
}

fn perform(task: &str, steps: &[Step], selection: &Selection) -> Result<(), Failure> {
    let chosen = steps::select(steps, selection.from.as_deref(), selection.only.as_deref())?;
    if selection.list {
        runner::list(chosen);
        return Ok(());
    }
    runner::run(task, chosen)
}
