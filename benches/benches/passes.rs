//! What each pass is worth: operations and times of models made without it or by it alone, all measured turn by turn in one run.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;
use dyn_benches::call::Generated;
use dyn_benches::cases::{Case, Visitor, forward_dynamics, inverse_dynamics, matrices};
use dyn_benches::flat::Flat;
use dyn_benches::machine::Machine;
use dyn_benches::pass_variants::{FUNCTIONS, operations, variants};
use dyn_benches::selection::{Selection, Variant};
use dyn_benches::states::{States, platform, sampled};
use dyn_benches::table;

/// Operations and times of a model made without each pass, and by each pass alone
#[derive(Parser)]
struct Arguments {
    /// Write `passes.md` and `passes.json` into this folder
    #[arg(long, value_name = "FOLDER")]
    write: PathBuf,
    /// What cargo tells a benchmark
    #[arg(long, hide = true)]
    bench: bool,
}

/// Shows a visitor the functions of one variant's model.
macro_rules! show {
    ($name:literal, $module:ident, $states:ident, $visitor:ident) => {{
        let case = |function, implementation| Case { function, implementation, variant: $name };
        macro_rules! function {
            ($function:ident, $output:ty) => {{
                let output = <$output>::default();
                let flat =
                    Generated { model: Flat::<$module::Model>::default(), function: $function, output };
                $visitor.visit(case(stringify!($function), "generated"), &$states.inputs, flat);
                let lanes = Generated { model: $module::Model, function: $function, output };
                $visitor.visit(case(stringify!($function), "generated_lanes"), &$states.inputs, lanes);
            }};
        }
        function!(inverse_dynamics, [f64; 6]);
        function!(forward_dynamics, [f64; 6]);
        function!(matrices, [[[f64; 6]; 6]; 6]);
    }};
}

include!(concat!(env!("OUT_DIR"), "/variants.rs"));

/// A variant of the pipeline: operations and nanoseconds of each of [`FUNCTIONS`], without lanes and in lanes.
#[derive(serde::Serialize)]
struct Row {
    name: String,
    operations: [[usize; 2]; 3],
    throughput: [[f64; 2]; 3],
    latency: [[f64; 2]; 3],
}

fn main() -> ExitCode {
    match run(&Arguments::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(reason) => {
            eprintln!("error: {reason}");
            ExitCode::FAILURE
        }
    }
}

fn run(arguments: &Arguments) -> Result<(), String> {
    let platform = platform();
    let states = States::new(&sampled(&platform));
    let measured = Selection::of(|selection| visit(&states, selection)).variants();
    let machine = Machine::now();
    let mut rows = Vec::new();
    for variant in variants() {
        rows.push(Row {
            operations: operations(&platform, &variant)?,
            throughput: times(&measured, &variant.name, "throughput"),
            latency: times(&measured, &variant.name, "latency"),
            name: variant.name,
        });
    }
    let (heading, cells) = cells(&rows);
    println!("{}", table::text(&heading, &cells, 1));
    let markdown = format!("{}.\n\n{}", machine.text(), table::markdown(&heading, &cells, 1));
    let json = serde_json::to_string_pretty(&rows).map_err(|error| error.to_string())? + "\n";
    for (name, text) in [("passes.md", markdown), ("passes.json", json)] {
        let path = arguments.write.join(name);
        std::fs::write(&path, text).map_err(|error| format!("{}: {error}", path.display()))?;
        println!("written: {}", path.display());
    }
    Ok(())
}

/// Nanoseconds of a variant's functions, without lanes and in lanes; no number where one was not measured.
fn times(measured: &[Variant], name: &str, measure: &str) -> [[f64; 2]; 3] {
    FUNCTIONS.map(|function| {
        ["generated", "generated_lanes"].map(|implementation| {
            let is = |row: &&Variant| {
                row.function == function && row.implementation == implementation && row.variant == name
            };
            measured.iter().find(is).and_then(|row| row.nanoseconds.get(measure).copied()).unwrap_or(f64::NAN)
        })
    })
}

/// Heading and rows: the first row in operations and nanoseconds, all others in multiples of it; inverse dynamics / forward
/// dynamics / matrices.
fn cells(rows: &[Row]) -> (Vec<&'static str>, Vec<Vec<String>>) {
    let heading = vec![
        "passes",
        "operations",
        "throughput",
        "latency",
        "operations in lanes",
        "throughput in lanes",
        "latency in lanes",
    ];
    let counts = |row: &Row, lanes: usize| row.operations.map(|counts| counts[lanes] as f64);
    let columns = |row: &Row| -> Vec<[f64; 3]> {
        let of = |lanes: usize| {
            let time = |times: &[[f64; 2]; 3]| times.map(|times| times[lanes]);
            [counts(row, lanes), time(&row.throughput), time(&row.latency)]
        };
        [of(0), of(1)].concat()
    };
    let first = columns(&rows[0]);
    let join = |values: [String; 3]| values.join(" / ");
    let line = |row: &Row| {
        let cells = columns(row).into_iter().zip(&first).map(|(values, first)| {
            let relative = [0, 1, 2].map(|k| format!("{:.2}", values[k] / first[k]));
            if row.name == rows[0].name {
                join(values.map(|value| format!("{value:.0}")))
            } else {
                join(relative)
            }
        });
        std::iter::once(row.name.clone()).chain(cells).collect()
    };
    (heading, rows.iter().map(line).collect())
}
