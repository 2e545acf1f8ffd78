//! Counts instructions per call under callgrind and compares them with the committed budget.

use std::process::ExitCode;

use clap::Parser;
use dyn_benches::budget::{Budget, SLACK};
use dyn_benches::cases::{FUNCTIONS, IMPLEMENTATIONS};
use dyn_benches::counts::{CountError, Counts, Workload, count_all, run};
use dyn_benches::{CODEGEN, table};

/// Instructions per call of each function by each implementation, counted by callgrind
///
/// Unlike times they repeat, however busy the machine. Build with --release.
#[derive(Parser)]
struct Arguments {
    /// Fail if a count exceeds `benches/instruction_budget.json`; pass without counting where there is no valgrind
    #[arg(long, conflicts_with_all = ["write", "json"])]
    check: bool,
    /// Write `benches/instruction_budget.json`, which never raises the reference's counts for the same compiler
    #[arg(long)]
    write: bool,
    /// Print JSON in the budget's format instead of tables
    #[arg(long)]
    json: bool,
    /// What runs under callgrind, with the states on standard input
    #[arg(long, hide = true, num_args = 3, value_names = ["FUNCTION", "IMPLEMENTATION", "VARIANT"])]
    workload: Option<Vec<String>>,
    /// How often the workload goes through the states
    #[arg(long, hide = true, default_value_t = 1)]
    passes: usize,
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let result = match arguments.workload.as_deref() {
        Some([function, implementation, variant]) => {
            run(&Workload { function, implementation, variant, passes: arguments.passes })
        }
        _ => count(&arguments),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(CountError::NoValgrind) if arguments.check => {
            println!("skipped: counting instructions needs valgrind, which is not installed");
            ExitCode::SUCCESS
        }
        Err(CountError::NoValgrind) => {
            eprintln!("error: counting instructions needs valgrind\n help: install the package valgrind");
            ExitCode::FAILURE
        }
        Err(CountError::Failed(reason)) => {
            eprintln!("error: {reason}");
            ExitCode::FAILURE
        }
    }
}

fn count(arguments: &Arguments) -> Result<(), CountError> {
    if cfg!(debug_assertions) {
        return failed("counts of an unoptimised build say nothing\n help: cargo run --release");
    }
    if arguments.check {
        return check();
    }
    let counted = counted()?;
    if arguments.json {
        println!("{}", json(&counted)?);
    } else {
        print(&counted.instructions_per_call);
    }
    if arguments.write {
        // A budget that cannot be read is replaced.
        let before = Budget::committed().unwrap_or_else(|_| counted.clone());
        let path = Budget::path();
        let written = std::fs::write(&path, json(&before.lowered(counted))? + "\n");
        return written.or_else(|error| failed(format!("{}: {error}", path.display())));
    }
    Ok(())
}

fn check() -> Result<(), CountError> {
    let budget = Budget::committed().map_err(CountError::Failed)?;
    if budget.codegen != build() {
        println!("skipped: the budget holds for  {}", budget.codegen);
        println!("         this program is       {}", build());
        return Ok(());
    }
    let counts = counted()?.instructions_per_call;
    print(&counts);
    judge(&budget, &counts)
}

fn counted() -> Result<Budget, CountError> {
    let instructions_per_call = count_all(
        |Workload { function, implementation, variant, passes }| {
            let passes = passes.to_string();
            ["--workload", function, implementation, variant, "--passes", &passes].map(str::to_owned).into()
        },
        |function, implementation| eprintln!("counting {function} by {implementation}"),
    )?;
    Ok(Budget { codegen: build(), instructions_per_call })
}

fn failed<T>(reason: impl Into<String>) -> Result<T, CountError> {
    Err(CountError::Failed(reason.into()))
}

fn print(counts: &Counts) {
    println!("instructions per call, {CODEGEN}\n{}", as_table(counts));
}

fn json(budget: &Budget) -> Result<String, CountError> {
    serde_json::to_string_pretty(budget).map_err(|error| CountError::Failed(error.to_string()))
}

fn as_table(counts: &Counts) -> String {
    let heading: Vec<&str> =
        ["function"].into_iter().chain(IMPLEMENTATIONS).chain(["reference/shortest"]).collect();
    let rows: Vec<Vec<String>> = FUNCTIONS
        .iter()
        .map(|&function| {
            let count = |implementation: &str| counts.get(function)?.get(implementation).copied();
            let cell = |implementation| count(implementation).map_or("absent".into(), |n| n.to_string());
            let single_state = ["generated", "generated_lanes"].into_iter().filter_map(count).min();
            let ratio = count("reference").zip(single_state);
            let ratio = ratio.map_or("absent".into(), |(by, of)| format!("{:.2}", by as f64 / of as f64));
            [function.to_owned()].into_iter().chain(IMPLEMENTATIONS.map(cell)).chain([ratio]).collect()
        })
        .collect();
    table::text(&heading, &rows, 1)
}

/// Fails with every case beyond its budget.
fn judge(budget: &Budget, counts: &Counts) -> Result<(), CountError> {
    let comparisons = budget.compare(counts);
    let beyond: Vec<String> = comparisons
        .iter()
        .filter(|case| !case.holds())
        .map(|case| {
            let granted = case.granted.map_or("none".to_owned(), |granted| granted.to_string());
            format!("  {} by {}: {}, budget {granted}", case.function, case.implementation, case.counted)
        })
        .collect();
    if beyond.is_empty() {
        println!("all {} counts are within the budget and {:.0} %", comparisons.len(), 100.0 * SLACK);
        return Ok(());
    }
    failed(format!(
        "more instructions per call than the budget and {:.0} %:\n{}\n help: where that is meant, \
         cargo run --release --package dyn-benches --bin instruction_counts -- --write",
        100.0 * SLACK,
        beyond.join("\n")
    ))
}

/// How this program was compiled, and whether the processor has registers for single calls: without, they are other code.
fn build() -> String {
    let registers = if dyn_runtime::triple::in_registers() { "with" } else { "without" };
    format!("{CODEGEN}, {registers} registers of three numbers")
}
