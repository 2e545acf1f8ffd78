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
use hdrhistogram::Histogram;
use serde::Serialize;

/// Largest ratio of the time that 999 of 1000 cycles keep to the median.
const MAX_RATIO: f64 = 3.0;
/// Fewer cycles than this share say nothing about the model.
const LEAST_STEADY: f64 = 0.5;

/// Times of everything that a controller asks of the model, in a loop at 10 kHz
///
/// In every cycle one state goes in, and lengths, rates, J_dp, M_p, bias and forces come out: by generated code with all
/// checks, and by the reference. Each takes its turn, several times, and so does nothing: two readings of the clock, which
/// show what the clock itself adds. Close other programs first. While it waits for the next
/// cycle the loop repeats the call of the last one and needs a processor for itself. Where the last two of these rehearsals
/// took their usual time and the cycle began when it should, the machine was steady: these cycles are shown once more by themselves.
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
    /// Fail if 999 of 1000 cycles that found the machine steady keep more than 3 times the median only, or fewer than half found it so
    #[arg(long, conflicts_with = "idle")]
    check: bool,
}

/// All about an implementation.
#[derive(Serialize)]
struct Report {
    implementation: &'static str,
    median: Summary,
    /// Of the cycles that found the machine steady.
    steady: Summary,
    /// How many those are, of all.
    steady_share: f64,
    lateness: Summary,
    runs: Vec<Summary>,
}

fn main() -> ExitCode {
    match measure(&Arguments::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn measure(arguments: &Arguments) -> Result<(), Box<dyn Error>> {
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
        let curves = [
            curve("generated, checked", &generated, |run| &run.model),
            curve("reference", &reference, |run| &run.model),
            curve("generated, machine steady", &generated, |run| &run.steady),
        ];
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
    let ratio = reports[0].steady.p99_9_by_median;
    let share = reports[0].steady_share;
    if arguments.check && share < LEAST_STEADY {
        let percent = 100.0 * share;
        return Err(format!(
            "undecided, the machine was steady in {percent:.0} % of the cycles only; close other programs"
        )
        .into());
    }
    if arguments.check && (ratio.is_nan() || ratio > MAX_RATIO) {
        return Err(format!(
            "999 of 1000 cycles on a steady machine keep {ratio:.1} times the median only, more than {MAX_RATIO}"
        )
        .into());
    }
    Ok(())
}

fn report(implementation: &'static str, runs: &[Run]) -> Report {
    let summaries = |of: fn(&Run) -> &Histogram<u64>| -> Vec<Summary> {
        runs.iter().map(|run| Summary::of(of(run))).collect()
    };
    let cycles = |of: fn(&Run) -> &Histogram<u64>| runs.iter().map(|run| of(run).len()).sum::<u64>() as f64;
    let all = summaries(|run| &run.model);
    Report {
        implementation,
        median: Summary::median(&all),
        steady: Summary::median(&summaries(|run| &run.steady)),
        steady_share: cycles(|run| &run.steady) / cycles(|run| &run.model),
        lateness: Summary::median(&summaries(|run| &run.lateness)),
        runs: all,
    }
}

/// Of the runs that have such cycles at all.
fn curve<'a>(name: &'a str, runs: &'a [Run], of: fn(&Run) -> &Histogram<u64>) -> Curve<'a> {
    Curve { name, runs: runs.iter().map(of).filter(|histogram| !histogram.is_empty()).collect() }
}

fn text(reports: &[Report], arguments: &Arguments, before: &Machine, after: &Machine) -> String {
    let row = |name: String, summary: &Summary, ratio: Option<f64>| {
        let numbers = [summary.median_ns, summary.p99_ns, summary.p99_9_ns, summary.max_ns];
        let ratio = ratio.map_or("-".into(), |ratio| format!("{ratio:.1}"));
        [name].into_iter().chain(numbers.map(|number| number.to_string())).chain([ratio]).collect::<Vec<_>>()
    };
    let mut rows = Vec::new();
    for report in reports {
        let Report { implementation, median, steady, steady_share, lateness, .. } = report;
        rows.push(row((*implementation).into(), median, Some(median.p99_9_by_median)));
        if *steady_share > 0.0 {
            let name = format!("  machine steady: {:.0} % of cycles", 100.0 * steady_share);
            rows.push(row(name, steady, Some(steady.p99_9_by_median)));
        }
        rows.push(row("  start of the cycle late by".into(), lateness, None));
    }
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
