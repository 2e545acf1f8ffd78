//! Doing steps one after another: headings, times, the first failure, the closing table.

use std::fmt;
use std::io::{self, BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use crate::bare;
use crate::contract;
use crate::steps::{Action, Step};
use crate::workspace;

/// Bare-metal target of the `no-std` step: a common microcontroller with a floating-point unit.
const BARE_METAL: &str = "thumbv7em-none-eabihf";

/// What went wrong and what to do.
#[derive(Debug)]
pub struct Failure {
    message: String,
    remedy: String,
}

impl Failure {
    /// Both in one line each; an empty remedy is not shown.
    pub fn new(message: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self { message: message.into(), remedy: remedy.into() }
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "error: {}", self.message)?;
        if self.remedy.is_empty() { Ok(()) } else { write!(formatter, "\n help: {}", self.remedy) }
    }
}

/// How a step ended.
struct Done {
    took: Duration,
    /// A remark for the table, or the failure.
    result: Result<String, Failure>,
}

/// Does `steps` of `task` until one fails.
pub fn run(task: &str, steps: &[Step]) -> Result<(), Failure> {
    let started = Instant::now();
    let mut done = Vec::new();
    for (index, step) in steps.iter().enumerate() {
        let elapsed = started.elapsed().as_secs_f64();
        println!("\n== [{elapsed:.1} s] {}/{} {}: {}", index + 1, steps.len(), step.name, step.why);
        println!("   {}", command_line(&step.action));
        // Children write to the same stream.
        let _ = io::stdout().flush();
        let step_started = Instant::now();
        let result = perform(&step.action);
        let failed = result.is_err();
        done.push(Done { took: step_started.elapsed(), result });
        if failed {
            break;
        }
    }
    print_table(task, steps, &done, started.elapsed());
    match (done.pop(), steps.get(done.len())) {
        (Some(Done { result: Err(failure), .. }), Some(step)) => {
            eprintln!("\nstep `{}` failed", step.name);
            eprintln!("   repeat it alone:   {}", command_line(&step.action));
            eprintln!("   go on from there:  cargo xtask {task} --from {}", step.name);
            Err(failure)
        }
        _ => Ok(()),
    }
}

/// Prints what would be done.
pub fn list(steps: &[Step]) {
    for step in steps {
        println!("{:<14} {}\n{:<14} {}", step.name, step.why, "", command_line(&step.action));
    }
}

fn perform(action: &Action) -> Result<String, Failure> {
    let mut cargo = workspace::cargo();
    match *action {
        Action::Cargo(arguments) => succeed(cargo.args(arguments)).map(|()| String::new()),
        Action::CargoWith { arguments, component } => {
            require(arguments[0], component)?;
            succeed(cargo.args(arguments)).map(|()| String::new())
        }
        Action::CargoTests(arguments) => count_tests(cargo.args(arguments)),
        Action::Documentation(arguments) => {
            succeed(cargo.args(arguments).env("RUSTDOCFLAGS", "--deny warnings")).map(|()| String::new())
        }
        Action::NoStd(arguments) => {
            cargo.args(arguments);
            if has_target(BARE_METAL) {
                succeed(cargo.args(["--target", BARE_METAL])).map(|()| format!("for {BARE_METAL}"))
            } else {
                let remark =
                    format!("for this machine only; rustup target add {BARE_METAL} tries bare metal");
                succeed(&mut cargo).map(|()| remark)
            }
        }
        Action::Bare => bare::if_ready(),
        Action::Contract => contract::if_possible(),
        Action::Python { program, arguments } => {
            let environment = workspace::environment(program.environment, program.lock_file)?;
            let mut python = environment.command();
            succeed(python.args(arguments).current_dir(workspace::root().join(program.folder)))
                .map(|()| String::new())
        }
    }
}

/// Runs `command` with its output passed through.
pub fn succeed(command: &mut Command) -> Result<(), Failure> {
    let status = command.status().map_err(|error| not_started(command, &error))?;
    if status.success() { Ok(()) } else { Err(Failure::new(status.to_string(), "")) }
}

/// A program that cannot even be started.
pub fn not_started(command: &Command, error: &io::Error) -> Failure {
    Failure::new(format!("{} cannot be started: {error}", command.get_program().display()), "")
}

/// Runs `cargo test` with its output passed through and adds its closing lines up.
fn count_tests(command: &mut Command) -> Result<String, Failure> {
    let mut child = command.stdout(Stdio::piped()).spawn().map_err(|error| not_started(command, &error))?;
    let mut count = Count::default();
    if let Some(stdout) = child.stdout.take() {
        for line in BufReader::new(stdout).split(b'\n') {
            let line = line.map_err(|error| Failure::new(error.to_string(), ""))?;
            let line = String::from_utf8_lossy(&line);
            println!("{line}");
            count.add(&line);
        }
    }
    let status = child.wait().map_err(|error| not_started(command, &error))?;
    if !status.success() {
        return Err(Failure::new(status.to_string(), ""));
    }
    if count.passed == 0 {
        return Err(Failure::new("not one test ran", ""));
    }
    Ok(format!("{} passed, {} ignored", count.passed, count.ignored))
}

/// Sum of lines like `test result: ok. 12 passed; 0 failed; 1 ignored; 0 measured; ...`.
#[derive(Debug, Default, PartialEq, Eq)]
pub struct Count {
    /// Tests that passed.
    pub passed: u32,
    /// Tests that did not run.
    pub ignored: u32,
}

impl Count {
    /// Adds one line of output; any other line changes nothing.
    pub fn add(&mut self, line: &str) {
        let Some((_, figures)) = line.split_once("test result: ") else { return };
        for part in figures.split(['.', ';']) {
            match part.trim().split_once(' ') {
                Some((number, "passed")) => self.passed += number.parse().unwrap_or(0),
                Some((number, "ignored")) => self.ignored += number.parse().unwrap_or(0),
                _ => {}
            }
        }
    }
}

/// Refuses with the remedy where `cargo SUBCOMMAND` is not installed.
fn require(subcommand: &str, component: &str) -> Result<(), Failure> {
    let found = workspace::cargo().args([subcommand, "--version"]).output();
    if found.is_ok_and(|output| output.status.success()) {
        return Ok(());
    }
    Err(Failure::new(
        format!("{component} is not installed"),
        format!("rustup component add {component} (without rustup: the package of that name)"),
    ))
}

/// Whether this toolchain can build for `target`.
fn has_target(target: &str) -> bool {
    let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let output = Command::new(rustc)
        .args(["--print", "target-libdir", "--target", target])
        .current_dir(workspace::root())
        .output();
    output.is_ok_and(|output| Path::new(String::from_utf8_lossy(&output.stdout).trim()).is_dir())
}

/// What one would type, from the workspace's root.
pub fn command_line(action: &Action) -> String {
    match action {
        Action::Cargo(arguments)
        | Action::CargoWith { arguments, .. }
        | Action::CargoTests(arguments)
        | Action::NoStd(arguments) => format!("cargo {}", arguments.join(" ")),
        Action::Documentation(arguments) => {
            format!("RUSTDOCFLAGS='--deny warnings' cargo {}", arguments.join(" "))
        }
        Action::Bare => "cargo xtask bare".into(),
        Action::Contract => "cargo xtask contract".into(),
        Action::Python { program, arguments } => {
            let (folder, environment) = (program.folder, program.environment);
            format!("(in {folder}/, Python of target/python/{environment}-*) python {}", arguments.join(" "))
        }
    }
}

fn print_table(task: &str, steps: &[Step], done: &[Done], total: Duration) {
    println!("\n== cargo xtask {task}");
    for (index, step) in steps.iter().enumerate() {
        match done.get(index) {
            Some(Done { took, result }) => {
                let (mark, remark) = match result {
                    Ok(remark) => ("ok", remark.as_str()),
                    Err(_) => ("FAILED", ""),
                };
                println!("   {:<14} {mark:<7} {:>7.1} s  {remark}", step.name, took.as_secs_f64());
            }
            None => println!("   {:<14} not run", step.name),
        }
    }
    println!("   {:<14} {:<7} {:>7.1} s", "total", "", total.as_secs_f64());
    let _ = io::stdout().flush();
}
