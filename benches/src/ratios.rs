//! Ratios from the results that criterion left behind.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

use serde::{Deserialize, Serialize};

use crate::cases::{FUNCTIONS, IMPLEMENTATIONS};
use crate::table;

/// The two ways to measure, in the order of tables.
pub const MEASURES: [&str; 2] = ["throughput", "latency"];

/// How many times faster than the reference the baked model shall be.
pub const TARGETS: [(&str, f64); 2] = [("inverse_dynamics", 4.0), ("forward_dynamics", 6.0)];

/// Results further apart in time than this are taken for results of different runs; a whole run takes a few minutes.
const ONE_RUN: Duration = Duration::from_secs(20 * 60);

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
    fn disturbed(&self) -> bool {
        self.median > QUIET * self.fastest
    }
}

/// One function measured in one way.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    /// The function.
    pub function: String,
    /// One of [`MEASURES`].
    pub measure: String,
    /// Times in nanoseconds by implementation; what was not measured is absent.
    pub nanoseconds: BTreeMap<String, Time>,
    /// Reference over each generated implementation, medians.
    pub faster_than_reference: BTreeMap<String, f64>,
    /// What the baked model's ratio shall be.
    pub target: Option<f64>,
    /// Whether it is; absent without target or without both times.
    pub met: Option<bool>,
}

/// Everything found.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Summary {
    /// The processor, where it has a name.
    pub processor: Option<String>,
    /// Whether all times were taken within minutes of one another.
    pub one_run: bool,
    /// By function and measure.
    pub rows: Vec<Row>,
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

/// Reads the results in `folder`.
///
/// # Errors
/// If there are none, or one is not what criterion writes; in words.
pub fn summarise(folder: &Path) -> Result<Summary, String> {
    let mut taken = Vec::new();
    let mut rows = Vec::new();
    for function in FUNCTIONS {
        for measure in MEASURES {
            let mut nanoseconds = BTreeMap::new();
            for implementation in IMPLEMENTATIONS {
                let path = folder.join(function).join(implementation).join(measure).join("new");
                if let Some((time, when)) = read(&path)? {
                    nanoseconds.insert(implementation.to_owned(), time);
                    taken.push(when);
                }
            }
            rows.push(Row::new(function, measure, nanoseconds));
        }
    }
    let (Some(first), Some(last)) = (taken.iter().min(), taken.iter().max()) else {
        return Err(format!("{}: no results\n help: cargo bench --package dyn-benches", folder.display()));
    };
    let one_run = last.duration_since(*first).is_ok_and(|apart| apart <= ONE_RUN);
    Ok(Summary { processor: processor(), one_run, rows })
}

/// The result in a folder and when it was written, or nothing if it was not measured.
fn read(folder: &Path) -> Result<Option<(Time, SystemTime)>, String> {
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

fn refusal(path: &Path, reason: &dyn std::fmt::Display) -> String {
    format!("{}: {reason}", path.display())
}

/// Linux's name of the processor.
fn processor() -> Option<String> {
    let text = fs::read_to_string("/proc/cpuinfo").ok()?;
    let line = text.lines().find(|line| line.starts_with("model name"))?;
    Some(line.split_once(':')?.1.trim().to_owned())
}

impl Row {
    fn new(function: &str, measure: &str, nanoseconds: BTreeMap<String, Time>) -> Self {
        let [baked, _, reference] = IMPLEMENTATIONS;
        let by_hand = nanoseconds.get(reference).map(|time| time.median);
        let generated = nanoseconds.iter().filter(|(name, _)| *name != reference);
        let faster_than_reference: BTreeMap<String, f64> =
            generated.filter_map(|(name, time)| Some((name.clone(), by_hand? / time.median))).collect();
        let target = TARGETS.iter().find(|(name, _)| *name == function).map(|&(_, target)| target);
        let met = target.and_then(|target| Some(*faster_than_reference.get(baked)? >= target));
        Self {
            function: function.to_owned(),
            measure: measure.to_owned(),
            nanoseconds,
            faster_than_reference,
            target,
            met,
        }
    }
}

impl Summary {
    /// The table, and what one must know to read it.
    pub fn text(&self) -> String {
        let [baked, runtime, _] = IMPLEMENTATIONS;
        let absent = || "absent".to_owned();
        let rows: Vec<Vec<String>> = self
            .rows
            .iter()
            .map(|row| {
                let time = |name: &str| {
                    row.nanoseconds.get(name).map_or_else(absent, |time| {
                        format!("{:.1}{}", time.median, if time.disturbed() { "*" } else { " " })
                    })
                };
                let ratio = |name: &str| {
                    row.faster_than_reference.get(name).map_or_else(absent, |ratio| format!("{ratio:.2}"))
                };
                let target = match (row.target, row.met) {
                    (None, _) => String::new(),
                    (Some(target), None) => format!("{target} not measured"),
                    (Some(target), Some(true)) => format!("{target} met"),
                    (Some(target), Some(false)) => format!("{target} MISSED"),
                };
                let names = [row.function.clone(), row.measure.clone()];
                names
                    .into_iter()
                    .chain(IMPLEMENTATIONS.map(time))
                    .chain([ratio(baked), ratio(runtime), target])
                    .collect()
            })
            .collect();
        let heading = [
            "function",
            "measure",
            "generated",
            "generated_runtime",
            "reference",
            "reference/generated",
            "reference/generated_runtime",
            "target",
        ];
        let processor = self.processor.as_deref().unwrap_or("unnamed processor");
        let mut text = format!("nanoseconds per call (median) and ratios, {processor}\n");
        text += &table::text(&heading, &rows, 2);
        let mut times = self.rows.iter().flat_map(|row| row.nanoseconds.values());
        if times.any(Time::disturbed) {
            text +=
                "* disturbed: the median is more than 10 % above the fastest sample. Close other programs.\n";
        }
        if !self.one_run {
            text +=
                "These times come from different runs: their ratios mean little. Run all benchmarks again.\n";
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Leaves a result like criterion's: two samples, one as fast as the median.
    fn write(folder: &Path, id: &str, median: f64) -> PathBuf {
        let path = folder.join(id).join("new");
        fs::create_dir_all(&path).unwrap();
        let estimate = format!(
            r#"{{"confidence_interval":{{"confidence_level":0.95,"lower_bound":{median},"upper_bound":{median}}},
                "point_estimate":{median},"standard_error":0.5}}"#
        );
        let estimates = format!(r#"{{"mean":{estimate},"median":{estimate}}}"#);
        fs::write(path.join("estimates.json"), estimates).unwrap();
        let times = format!("[{},{}]", 10.0 * median, 40.0 * median);
        let samples = format!(r#"{{"sampling_mode":"Linear","iters":[10.0,20.0],"times":{times}}}"#);
        fs::write(path.join("sample.json"), samples).unwrap();
        path
    }

    #[test]
    fn ratios_targets_and_gaps() {
        let folder = tempfile::tempdir().unwrap();
        for (id, median) in [
            ("inverse_dynamics/generated/throughput", 100.0),
            ("inverse_dynamics/generated_runtime/throughput", 200.0),
            ("inverse_dynamics/reference/throughput", 400.0),
            ("forward_dynamics/generated/latency", 100.0),
            ("forward_dynamics/reference/latency", 599.0),
            ("forward_dynamics/generated/throughput", 100.0),
        ] {
            write(folder.path(), id, median);
        }
        let summary = summarise(folder.path()).unwrap();
        assert!(summary.one_run);
        let row = |function, measure| {
            summary.rows.iter().find(|row| row.function == function && row.measure == measure).unwrap()
        };
        let inverse = row("inverse_dynamics", "throughput");
        assert_eq!(inverse.faster_than_reference["generated"], 4.0);
        assert_eq!(inverse.faster_than_reference["generated_runtime"], 2.0);
        assert_eq!(inverse.met, Some(true));
        assert_eq!(row("forward_dynamics", "latency").met, Some(false));
        assert_eq!(row("forward_dynamics", "throughput").met, None);
        assert_eq!(row("jacobian_dp", "latency").nanoseconds.len(), 0);
        let text = summary.text();
        for expected in ["4 met", "6 MISSED", "6 not measured", "absent"] {
            assert!(text.contains(expected), "{text}");
        }
        assert!(!text.contains("disturbed"), "{text}");
    }

    #[test]
    fn a_median_far_above_the_fastest_sample_is_marked() {
        let folder = tempfile::tempdir().unwrap();
        let path = write(folder.path(), "matrices/reference/latency", 1000.0).join("sample.json");
        let samples = r#"{"sampling_mode":"Linear","iters":[10.0,20.0],"times":[9000.0,30000.0]}"#;
        fs::write(path, samples).unwrap();
        let text = summarise(folder.path()).unwrap().text();
        assert!(text.contains("1000.0*") && text.contains("* disturbed"), "{text}");
    }

    #[test]
    fn times_of_different_runs_are_told_apart() {
        let folder = tempfile::tempdir().unwrap();
        write(folder.path(), "matrices/reference/latency", 1.0);
        let old = write(folder.path(), "matrices/generated/latency", 1.0);
        let before = SystemTime::now() - 2 * ONE_RUN;
        fs::File::options()
            .write(true)
            .open(old.join("estimates.json"))
            .unwrap()
            .set_modified(before)
            .unwrap();
        let summary = summarise(folder.path()).unwrap();
        assert!(!summary.one_run);
        assert!(summary.text().contains("different runs"));
    }

    #[test]
    fn nothing_measured_and_nonsense_are_errors() {
        let folder = tempfile::tempdir().unwrap();
        assert!(summarise(folder.path()).unwrap_err().contains("cargo bench"));
        let path = write(folder.path(), "matrices/reference/latency", 1.0);
        fs::write(path.join("estimates.json"), "{}").unwrap();
        assert!(summarise(folder.path()).unwrap_err().contains("estimates.json"));
    }
}
