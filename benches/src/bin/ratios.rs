//! Prints the times and ratios that a benchmark left behind, and writes them as JSON, as a plot and in Markdown.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Parser;
use dyn_benches::ratio_plot;
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
    let json = serde_json::to_string_pretty(&summary).map_err(|error| error.to_string())? + "\n";
    let mut text = if arguments.json { json.clone() } else { summary.text() };
    if let Some(folder) = &arguments.write {
        let [data, plot, table] = ["ratios.json", "ratios.svg", "table.md"].map(|name| folder.join(name));
        std::fs::write(&data, json).map_err(|error| refusal(&data, &error))?;
        std::fs::write(&table, summary.markdown()).map_err(|error| refusal(&table, &error))?;
        ratio_plot::write(&plot, &summary).map_err(|error| refusal(&plot, &*error))?;
        if !arguments.json {
            for path in [&data, &plot, &table] {
                text += &format!("written: {}\n", path.display());
            }
        }
    }
    Ok(text)
}

fn refusal(path: &Path, reason: &dyn std::error::Error) -> String {
    format!("{}: {reason}", path.display())
}
