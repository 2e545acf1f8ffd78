//! A control loop at 10 kHz: what the model takes of every cycle, generated and written by hand.

use std::error::Error;
use std::hint::black_box;
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Duration;

use clap::Parser;
use dyn_benches::control_loop::{Run, Summary, Waiting, run};
use dyn_benches::loop_plot::{self, Curve};
use dyn_benches::machine::Machine;
use dyn_benches::states::{States, platform, reference_parameters, sampled};
use dyn_benches::{CODEGEN, bundle, table};
use serde::Serialize;

/// Largest ratio of the time that 999 of 1000 cycles keep to the median.
const MAX_RATIO: f64 = 3.0;

/// Times of everything that a controller asks of the model, in a loop at 10 kHz
///
/// In every cycle one state goes in, and lengths, rates, J_dp, M_p, bias and forces come out: by generated code with all
/// checks, and by the reference. Each takes its turn, several times, and so does nothing: two readings of the clock, which
/// show what the machine itself adds. Close other programs first. While it waits for the next
/// cycle the loop repeats the call of the last one, which is not measured, and needs a processor for itself.
#[derive(Parser)]
struct Arguments {
    /// Runs of each implementation; medians over them are reported
    #[arg(long, default_value_t = 5, value_parser = clap::value_parser!(u32).range(1..))]
    runs: u32,
    /// Length of a run
    #[arg(long, default_value_t = 3.0, value_name = "SECONDS")]
    seconds: f64,
    /// Print JSON instead of a table
    #[arg(long)]
    json: bool,
    /// Write a plot, SVG
    #[arg(long, value_name = "FILE")]
    plot: Option<PathBuf>,
    /// Sleep instead of repeating the last call: what a loop gets that leaves the processor to others between its cycles
    #[arg(long)]
    idle: bool,
    /// Fail if the time that 999 of 1000 cycles keep is more than 3 times the median
    #[arg(long)]
    check: bool,
}

/// All about an implementation.
#[derive(Serialize)]
struct Report {
    implementation: &'static str,
    median: Summary,
    lateness: Summary,
    runs: Vec<Summary>,
}

fn main() -> ExitCode {
    match measure(&Arguments::parse()) {
        Ok(code) => code,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn measure(arguments: &Arguments) -> Result<ExitCode, Box<dyn Error>> {
    let platform = platform();
    let states = States::new(&sampled(&platform));
    let typed = bundle::typed_states(&states);
    let parameters = reference_parameters(&platform);
    let duration = Duration::try_from_secs_f64(arguments.seconds)?;
    let waiting = if arguments.idle { Waiting::Idle } else { Waiting::Rehearsing };
    let before = Machine::now();

    let mut generated: Vec<Run> = Vec::new();
    let mut reference: Vec<Run> = Vec::new();
    let mut nothing: Vec<Run> = Vec::new();
    for number in 1..=arguments.runs {
        eprintln!("run {number} of {}", arguments.runs);
        let mut refused = false;
        generated.push(run(duration, waiting, &typed, &mut |state| {
            let result = bundle::generated(state);
            refused |= result.is_err();
            let _ = black_box(result);
        })?);
        if refused {
            return Err("a checked call refused a state that was sampled to be good".into());
        }
        reference.push(run(duration, waiting, &states.reference[..], &mut |state| {
            black_box(bundle::reference(&parameters, state));
        })?);
        nothing.push(run(duration, waiting, &[()], &mut |()| {})?);
    }
    let after = Machine::now();

    let reports =
        [report("generated", &generated), report("reference", &reference), report("nothing", &nothing)];
    if let Some(path) = &arguments.plot {
        let curves: Vec<Curve<'_>> = [("generated, checked", &generated), ("reference", &reference)]
            .map(|(name, runs)| Curve { name, runs: runs.iter().map(|run| &run.model).collect() })
            .into();
        let title = format!("full bundle at 10 kHz, {}", before.text());
        loop_plot::write(path, &title, &curves).map_err(|error| format!("{}: {error}", path.display()))?;
    }
    if arguments.json {
        let value = serde_json::json!({
            "build": CODEGEN, "machine": before, "load_after": after.load, "implementations": reports,
        });
        println!("{}", serde_json::to_string_pretty(&value)?);
    } else {
        print!("{}", text(&reports, arguments, &before, &after));
    }
    let ratio = reports[0].median.p99_9_by_median;
    let fails = arguments.check && (ratio.is_nan() || ratio > MAX_RATIO);
    if fails {
        eprintln!("error: 999 of 1000 cycles keep {ratio:.1} times the median only, more than {MAX_RATIO}");
    }
    Ok(if fails { ExitCode::FAILURE } else { ExitCode::SUCCESS })
}

fn report(implementation: &'static str, runs: &[Run]) -> Report {
    let summaries: Vec<Summary> = runs.iter().map(|run| Summary::of(&run.model)).collect();
    let lateness: Vec<Summary> = runs.iter().map(|run| Summary::of(&run.lateness)).collect();
    Report {
        implementation,
        median: Summary::median(&summaries),
        lateness: Summary::median(&lateness),
        runs: summaries,
    }
}

fn text(reports: &[Report], arguments: &Arguments, before: &Machine, after: &Machine) -> String {
    let row = |name: String, summary: &Summary| {
        let numbers = [summary.median_ns, summary.p99_ns, summary.p99_9_ns, summary.max_ns];
        let ratio = format!("{:.1}", summary.p99_9_by_median);
        [name].into_iter().chain(numbers.map(|number| number.to_string())).chain([ratio]).collect::<Vec<_>>()
    };
    let rows: Vec<_> = reports
        .iter()
        .flat_map(|report| {
            [
                row(report.implementation.into(), &report.median),
                row(format!("{}: start of the cycle late by", report.implementation), &report.lateness),
            ]
        })
        .collect();
    let heading = ["ns", "median", "99 %", "99.9 %", "longest", "99.9 % / median"];
    let load = after.load.map_or("unknown".into(), |load| format!("{load:.1}"));
    format!(
        "{}; load {load} at the end\n{CODEGEN}\n{} runs of {} s each at 10 kHz, medians over runs:\n\n{}",
        before.text(),
        arguments.runs,
        arguments.seconds,
        table::text(&heading, &rows, 1)
    )
}
