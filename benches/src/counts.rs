//! Instructions per call, counted by callgrind: the same on every run of a program, however busy the machine.
//!
//! A program cannot count itself, so it starts itself again under valgrind, once with one pass over the states and
//! once with two. The difference is one call per state and the loop around it; start and end of the program cancel.

use std::collections::BTreeMap;
use std::io::{self, Write};
use std::process::{Command, Stdio};

use dyn_gen::graph::Environment;

use crate::call::{Call, throughput};
use crate::cases::{Case, Visitor, all, visit};
use crate::states::{COUNT, States, platform, sampled};

/// Instructions per call, mean over the states, by function and implementation.
pub type Counts = BTreeMap<String, BTreeMap<String, u64>>;

/// Why nothing was counted.
#[derive(Debug)]
pub enum CountError {
    /// There is no valgrind on this machine.
    NoValgrind,
    /// Something else, in words.
    Failed(String),
}

/// What the program that counts runs under valgrind.
#[derive(Clone, Debug)]
pub struct Workload<'a> {
    /// One of [`FUNCTIONS`](crate::cases::FUNCTIONS).
    pub function: &'a str,
    /// One of [`IMPLEMENTATIONS`](crate::cases::IMPLEMENTATIONS).
    pub implementation: &'a str,
    /// Which of its variants; empty where there is one.
    pub variant: &'a str,
    /// How often to go through the states.
    pub passes: usize,
}

/// Counts every function of every implementation. `arguments` makes this program call [`run`] with the workload;
/// `progress` hears of each case before it is counted.
///
/// # Errors
/// If valgrind is missing or fails.
pub fn count_all(
    arguments: impl Fn(&Workload<'_>) -> Vec<String>,
    mut progress: impl FnMut(&str, &str),
) -> Result<Counts, CountError> {
    let platform = platform();
    let sampled = sampled(&platform);
    let states = serde_json::to_vec(&sampled).map_err(failed)?;
    let mut counts = Counts::new();
    for Case { function, implementation, variant } in all(&platform, &States::new(&sampled)) {
        progress(function, implementation);
        let [once, twice] = [1, 2].map(|passes| {
            instructions(&arguments(&Workload { function, implementation, variant, passes }), &states)
        });
        let per_call = twice?.saturating_sub(once?) as f64 / COUNT as f64;
        let counted = per_call.round() as u64;
        // Of several variants the shortest one counts.
        let row = counts.entry(function.to_owned()).or_default();
        row.entry(implementation.to_owned())
            .and_modify(|least| *least = counted.min(*least))
            .or_insert(counted);
    }
    Ok(counts)
}

/// Instructions of this program from start to end, with these arguments and `input` on its standard input.
fn instructions(arguments: &[String], input: &[u8]) -> Result<u64, CountError> {
    let program = std::env::current_exe().map_err(failed)?;
    let mut child = Command::new("valgrind")
        .args(["--tool=callgrind", "--callgrind-out-file=/dev/null"])
        .arg(program)
        .args(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .map_err(|error| match error.kind() {
            io::ErrorKind::NotFound => CountError::NoValgrind,
            _ => failed(error),
        })?;
    if let Some(mut stdin) = child.stdin.take() {
        stdin.write_all(input).map_err(failed)?;
    }
    let output = child.wait_with_output().map_err(failed)?;
    let report = String::from_utf8_lossy(&output.stderr);
    let collected = collected(&report).filter(|_| output.status.success());
    collected.ok_or_else(|| failed(format!("callgrind gave no count ({}):\n{report}", output.status)))
}

/// The number in callgrind's line `==123== Collected : 456`.
fn collected(report: &str) -> Option<u64> {
    let line = report.lines().find_map(|line| line.split_once("Collected :"))?;
    line.1.split_whitespace().next()?.parse().ok()
}

fn failed(reason: impl ToString) -> CountError {
    CountError::Failed(reason.to_string())
}

/// The work to be counted, on states read from standard input.
///
/// # Errors
/// If the states cannot be read or there is no such implementation.
pub fn run(workload: &Workload<'_>) -> Result<(), CountError> {
    let states: Vec<Environment> = serde_json::from_reader(io::stdin().lock()).map_err(failed)?;
    let mut passes = Passes { workload: workload.clone(), found: false };
    visit(workload.function, &platform(), &States::new(&states), &mut passes);
    if passes.found {
        Ok(())
    } else {
        Err(failed(format!("no implementation `{}`", workload.implementation)))
    }
}

struct Passes<'a> {
    workload: Workload<'a>,
    found: bool,
}

impl Visitor for Passes<'_> {
    fn visit<C: Call>(&mut self, case: Case, states: &[C::State; COUNT], mut call: C) {
        if case.implementation == self.workload.implementation && case.variant == self.workload.variant {
            self.found = true;
            let mut once = throughput(&mut call, states);
            (0..self.workload.passes * COUNT).for_each(|_| once());
        }
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn callgrind_reports_are_understood() {
        let report = "==7== Events    : Ir\n==7== Collected : 3011251\n==7== \n";
        assert_eq!(super::collected(report), Some(3_011_251));
        assert_eq!(super::collected("valgrind: no such file"), None);
    }
}
