//! Running a scenario: experiment, tables on the screen, report on disk.

use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::Args;
use dyn_python::target_directory;
use dyn_sim::experiment::{self, Experiment, Progress};
use dyn_sim::outcome::Outcome;
use dyn_sim::report::{tables_json, terminal_table, write_report, write_tables};
use dyn_sim::scenario::Scenario;
use miette::{Diagnostic, IntoDiagnostic, Report, Result, WrapErr};

use super::Ending;
use super::progress::Bars;

/// What the root of the repository has.
const SIGN: &str = "scenarios/published.toml";

#[derive(Args)]
pub struct Options {
    /// Leave out the virtual prototype (and Python)
    #[arg(long)]
    no_prototype: bool,
    /// Folder of the report [default: target/dyn-sim/<scenario> in the repository, else dyn-sim-<scenario>]
    #[arg(long, short, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Print the tables as JSON on standard output
    #[arg(long)]
    json: bool,
}

/// A named scenario away from the repository.
#[derive(Debug, thiserror::Error, Diagnostic)]
#[error("the scenario `{name}` is part of the repository, which is not around the current folder")]
#[diagnostic(help("change into the repository, or give the path of a scenario file"))]
struct NoRepository {
    name: String,
}

/// The file behind `published`, `large` or a path.
pub fn scenario_file(scenario: &str) -> Result<PathBuf> {
    let named = Path::new(scenario).components().count() == 1 && !scenario.ends_with(".toml");
    if !named {
        return Ok(scenario.into());
    }
    let Some(root) = repository() else { return Err(NoRepository { name: scenario.into() }.into()) };
    Ok(root.join("scenarios").join(format!("{scenario}.toml")))
}

/// The root of the repository, searched upwards from the current folder and then from where this tool was built.
pub fn repository() -> Option<PathBuf> {
    let current = std::env::current_dir().unwrap_or_default();
    let built_in = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut folders = current.ancestors().chain(built_in.ancestors());
    folders.find(|folder| folder.join(SIGN).is_file()).map(Path::to_owned)
}

/// The scenario of a file. Hints at what may be wrong with its platform are printed.
fn read(file: &Path) -> Result<Scenario> {
    let scenario = Scenario::from_file(file)?;
    for warning in &scenario.platform.warnings {
        eprintln!("{:?}", Report::new(warning.clone()));
    }
    Ok(scenario)
}

/// Reads a scenario and says what it is.
pub fn check(file: &Path) -> Result<Ending> {
    let scenario = read(file)?;
    let (grid, platform) = (scenario.grid, &scenario.platform.name);
    println!(
        "{}: scenario `{}` of platform `{platform}`, {} steps of {} s",
        file.display(),
        scenario.name,
        grid.steps,
        grid.step_s
    );
    for note in &scenario.notes {
        println!("note: {note}");
    }
    Ok(Ending::Done)
}

/// Runs a scenario file.
pub fn run(file: &Path, options: &Options, command: &str) -> Result<Ending> {
    let scenario = read(file)?;
    let root = repository();
    let workspace = root.as_deref().filter(|_| !options.no_prototype);
    let mut bars = Bars::default();
    let mut experiment = experiment::run(&scenario, workspace, command, &mut bars);
    if scenario.prototype && !options.no_prototype && root.is_none() {
        let warning =
            "no virtual prototype: it is part of the repository, which is not around the current folder";
        experiment.outcome.warnings.push(warning.into());
    }

    let folder = options.output.clone().unwrap_or_else(|| default_folder(root.as_deref(), &scenario.name));
    let started = Instant::now();
    let written = write_outputs(&scenario, &experiment, &folder, &mut bars)?;
    let writing_s = started.elapsed().as_secs_f64();
    for warning in &experiment.outcome.warnings {
        eprintln!("warning: {warning}");
    }
    if options.json {
        print(&format!("{:#}\n", tables_json(&experiment.outcome)))?;
    } else {
        let mut text = terminal_table(&experiment.outcome) + &times(&experiment.outcome, writing_s);
        if let Some(written) = written {
            text += &format!("report: {}\n", written.display());
        }
        print(&text)?;
    }
    if experiment.stop.is_some() {
        return Ok(Ending::Stopped);
    }
    match experiment.prototype_error {
        // Without Python or the network everything else was done, and a warning has told.
        Some(error) if !error.is_environment_missing() => Err(Report::new(error)),
        _ => Ok(Ending::Done),
    }
}

/// How long it took, in one line.
fn times(outcome: &Outcome, writing_s: f64) -> String {
    let of = |name: &str| outcome.seconds.iter().find(|(step, _)| step == name).map(|(_, seconds)| *seconds);
    let total: f64 = writing_s + outcome.seconds.iter().map(|(_, seconds)| seconds).sum::<f64>();
    let prototype = of(experiment::PROTOTYPE);
    let mut text = format!("time: {:.2} s", total - prototype.unwrap_or(0.0));
    if prototype.is_some() {
        text += &format!(" by dyn-sim itself, {total:.2} s with the virtual prototype");
    }
    let simulated_s = outcome.simulations.first().and_then(|series| series.time_s.last().copied());
    if let (Some(simulation), Some(simulated_s)) = (of(experiment::SIMULATION), simulated_s)
        && simulated_s > 0.0
    {
        let (per_second_ms, step_ms) = (1e3 * simulation / simulated_s, 1e3 * outcome.step_s);
        text += &format!("; {per_second_ms:.1} ms per simulated second in steps of {step_ms:.3} ms");
    }
    text + "\n"
}

/// Prints to standard output; a reader that has heard enough (`| head`) is no error.
pub fn print(text: &str) -> Result<()> {
    match std::io::stdout().write_all(text.as_bytes()) {
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
        result => result.into_diagnostic().wrap_err("cannot print"),
    }
}

pub fn default_folder(root: Option<&Path>, name: &str) -> PathBuf {
    match root {
        Some(root) => target_directory(root).join("dyn-sim").join(name),
        None => format!("dyn-sim-{name}").into(),
    }
}

/// What the scenario asks for; the path to open, if there is one.
fn write_outputs(
    scenario: &Scenario,
    experiment: &Experiment,
    folder: &Path,
    progress: &mut dyn Progress,
) -> Result<Option<PathBuf>> {
    let outputs = scenario.outputs;
    if outputs.report {
        progress.begin("report");
        let started = Instant::now();
        let files = write_report(&experiment.outcome, folder, outputs.json)?;
        progress.end(started.elapsed().as_secs_f64());
        return Ok(Some(files.html));
    }
    if outputs.json {
        return Ok(Some(write_tables(&experiment.outcome, folder)?));
    }
    Ok(None)
}
