//! What the benchmark left behind: criterion's estimates and samples, figures of peers' variants, times of single calls, the machine.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use serde::{Deserialize, Serialize};

/// The two ways to measure, in the order of tables.
pub const MEASURES: [&str; 2] = ["throughput", "latency"];

/// Figures of all variants of peers, in criterion's folder.
pub const VARIANTS: &str = "variants.json";
/// Times of single calls, in criterion's folder.
pub const SINGLE_CALLS: &str = "single_calls.json";

/// Processor and load at the end of the measurement, in criterion's folder.
pub const MACHINE: &str = "machine.json";

/// How far the median of a quiet machine lies above the fastest sample at most.
const QUIET: f64 = 1.1;

/// A time per call, in nanoseconds: criterion's median with its 95 % confidence interval, and the fastest sample.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Time {
    /// Median over criterion's samples.
    pub median: f64,
    /// Lower end of the interval.
    pub low: f64,
    /// Upper end of the interval.
    pub high: f64,
    /// The sample that was disturbed least.
    pub fastest: f64,
}

impl Time {
    /// Whether something else kept the machine busy.
    pub fn disturbed(&self) -> bool {
        self.median > QUIET * self.fastest
    }
}

/// The part of criterion's `estimates.json` that is read.
#[derive(Deserialize)]
struct Estimates {
    median: Estimate,
}

#[derive(Deserialize)]
struct Estimate {
    point_estimate: f64,
    confidence_interval: Interval,
}

#[derive(Deserialize)]
struct Interval {
    lower_bound: f64,
    upper_bound: f64,
}

/// The part of criterion's `sample.json` that is read: calls and nanoseconds of each sample.
#[derive(Deserialize)]
struct Samples {
    iters: Vec<f64>,
    times: Vec<f64>,
}

/// Where criterion leaves its results: `CRITERION_HOME`, or `criterion` in cargo's target folder.
pub fn results_folder() -> PathBuf {
    let folder = |name: &str| std::env::var_os(name).filter(|value| !value.is_empty()).map(PathBuf::from);
    folder("CRITERION_HOME").unwrap_or_else(|| {
        let target = folder("CARGO_TARGET_DIR");
        target.unwrap_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join("../target")).join("criterion")
    })
}

/// Criterion's result in a folder and when it was written, or nothing if it was not measured.
///
/// # Errors
/// If it is not what criterion writes, in words.
pub fn read(folder: &Path) -> Result<Option<(Time, SystemTime)>, String> {
    let path = folder.join("estimates.json");
    let Ok(text) = fs::read_to_string(&path) else { return Ok(None) };
    let when =
        fs::metadata(&path).and_then(|file| file.modified()).map_err(|error| refusal(&path, &error))?;
    let Estimates { median: Estimate { point_estimate: median, confidence_interval: interval } } =
        serde_json::from_str(&text).map_err(|error| refusal(&path, &error))?;
    let path = folder.join("sample.json");
    let text = fs::read_to_string(&path).map_err(|error| refusal(&path, &error))?;
    let Samples { iters, times } = serde_json::from_str(&text).map_err(|error| refusal(&path, &error))?;
    let per_call = times.iter().zip(&iters).map(|(time, calls)| time / calls);
    let fastest = per_call.fold(f64::INFINITY, f64::min);
    Ok(Some((Time { median, low: interval.lower_bound, high: interval.upper_bound, fastest }, when)))
}

/// A file of ours beside criterion's; what is missing is empty.
///
/// # Errors
/// If it is there and not what was written, in words.
pub fn read_own<T: for<'a> Deserialize<'a> + Default>(folder: &Path, name: &str) -> Result<T, String> {
    let path = folder.join(name);
    match fs::read_to_string(&path) {
        Ok(text) => serde_json::from_str(&text).map_err(|error| refusal(&path, &error)),
        Err(_) => Ok(T::default()),
    }
}

/// Writes a file beside criterion's.
///
/// # Errors
/// If it cannot be written, in words.
pub fn write_own(folder: &Path, name: &str, value: &impl Serialize) -> Result<(), String> {
    let path = folder.join(name);
    let text = serde_json::to_string_pretty(value).map_err(|error| refusal(&path, &error))?;
    fs::create_dir_all(folder).and_then(|()| fs::write(&path, text)).map_err(|error| refusal(&path, &error))
}

fn refusal(path: &Path, reason: &dyn std::fmt::Display) -> String {
    format!("{}: {reason}", path.display())
}
