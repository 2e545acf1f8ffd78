//! Prints the ratios of times that criterion measured.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;
use dyn_benches::ratios::{results_folder, summarise};

/// Ratios between reference and generated code, from the last `cargo bench --package dyn-benches`
#[derive(Parser)]
struct Arguments {
    /// Print JSON instead of a table
    #[arg(long)]
    json: bool,
    /// Criterion's folder, if it is not in cargo's target folder
    #[arg(long, value_name = "FOLDER")]
    results: Option<PathBuf>,
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let result = summarise(&arguments.results.unwrap_or_else(results_folder)).and_then(|summary| {
        if arguments.json {
            serde_json::to_string_pretty(&summary).map(|text| text + "\n").map_err(|error| error.to_string())
        } else {
            Ok(summary.text())
        }
    });
    match result {
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
