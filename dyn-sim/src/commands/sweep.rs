//! Running a sweep file: a summary on the screen, table and figures on disk.

use std::path::{Path, PathBuf};

use clap::Args;
use dyn_sim::report::{sweep_json, sweep_summary, write_sweep};
use dyn_sim::sweep::{self, Sweep};
use miette::{Diagnostic, IntoDiagnostic, Result, WrapErr};

use super::Ending;
use super::progress::Bars;
use super::run::{default_folder, print, repository};

#[derive(Args)]
pub struct Options {
    /// How many threads compute [default: all]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=512))]
    threads: Option<u16>,
    /// Folder of the report [default: target/dyn-sim/<sweep> in the repository, else dyn-sim-<sweep>]
    #[arg(long, short, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Print all designs as JSON on standard output, and write them beside the report
    #[arg(long)]
    json: bool,
}

/// Not one design could be made or computed.
#[derive(Debug, thiserror::Error, Diagnostic)]
#[error("none of the {count} designs can be computed; the first one: {reason}")]
#[diagnostic(help("let the numbers vary around a platform and a scenario that `dyn-sim run` can compute"))]
struct NothingComputed {
    count: usize,
    reason: String,
}

/// Runs a sweep file.
pub fn run(file: &Path, options: &Options, command: &str) -> Result<Ending> {
    let sweep = Sweep::from_file(file)?;
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(options.threads.unwrap_or(0).into())
        .build()
        .into_diagnostic()
        .wrap_err("cannot start threads")?;
    let mut bars = Bars::default();
    let swept = sweep::run(&sweep, &pool, &mut bars);
    if let Some(reason) = swept.why_nothing() {
        return Err(NothingComputed { count: swept.designs.len(), reason: reason.to_owned() }.into());
    }
    let folder =
        options.output.clone().unwrap_or_else(|| default_folder(repository().as_deref(), &sweep.name));
    let written = write_sweep(&sweep, &swept, command, &folder, options.json)?;
    if options.json {
        print(&format!("{:#}\n", sweep_json(&sweep, &swept)))?;
    } else {
        let summary = sweep_summary(&sweep, &swept, pool.current_num_threads());
        print(&format!("{summary}report: {}\n", written.display()))?;
    }
    Ok(Ending::Done)
}
