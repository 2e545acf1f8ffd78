//! Prints the times and ratios that a benchmark left behind, and writes them as JSON, as a plot and in Markdown.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;
use dyn_benches::ratios::summarise;
use dyn_benches::results::results_folder;

/// Times and ratios of the last `cargo xtask bench`
#[derive(Parser)]
struct Arguments {
    /// Print JSON instead of tables
    #[arg(long)]
    json: bool,
    /// Criterion's folder, if it is not in cargo's target folder
    #[arg(long, value_name = "FOLDER")]
    results: Option<PathBuf>,
    /// Write `ratios.json`, `ratios.svg` and `table.md` into this folder too
    #[arg(long, value_name = "FOLDER")]
    write: Option<PathBuf>,
}

fn main() -> ExitCode {
    match run(&Arguments::parse()) {
        Ok(text) => {
            print!("{text}");
            ExitCode::SUCCESS
        }
        Err(reason) => {
            eprintln!("error: {reason}");
            ExitCode::FAILURE
        }
    }
}

fn run(arguments: &Arguments) -> Result<String, String> {
    let summary = summarise(&arguments.results.clone().unwrap_or_else(results_folder))?;
    let written = arguments.write.as_deref().map(|folder| summary.write(folder)).transpose()?;
    if arguments.json { summary.json() } else { Ok(summary.text() + &written.unwrap_or_default()) }
}
