//! Times and ratios from the results that a run left behind.

use std::collections::BTreeMap;
use std::path::Path;
use std::time::Duration;

use serde::Serialize;

use crate::cases::{FUNCTIONS, IMPLEMENTATIONS};
use crate::machine::Machine;
use crate::results::{self, MACHINE, MEASURES, SINGLE_CALLS, Time, VARIANTS};
use crate::selection::Variant;
use crate::tail::Tails;

/// Results further apart in time than this are taken for results of different runs; a whole run takes some minutes.
const ONE_RUN: Duration = Duration::from_secs(30 * 60);

/// What is compared: our side, one of several where the better one counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Ours {
    /// One state per call, numbers baked in: flat code or legs in lanes, whichever is faster.
    SingleState,
    /// Many states per call.
    Batch,
    /// All parameters at run time.
    RunTime,
    /// Payload, gravity and stiffnesses at run time.
    Payload,
}

impl Ours {
    fn implementations(self) -> &'static [&'static str] {
        match self {
            Self::SingleState => &["generated", "generated_lanes"],
            Self::Batch => &["generated_batch"],
            Self::RunTime => &["generated_runtime"],
            Self::Payload => &["generated_payload"],
        }
    }

    /// As tables name it.
    pub fn name(self) -> &'static str {
        match self {
            Self::SingleState => "single state",
            Self::Batch => "batch",
            Self::RunTime => "run time",
            Self::Payload => "run time, payload",
        }
    }
}

/// A row of [`COMPARISONS`]: measure, ours, the other, and for inverse dynamics, forward dynamics and matrices how many times
/// faster ours shall be; zero where nothing is asked.
type Comparison = (&'static str, Ours, &'static str, [f64; 3]);

/// Every ratio that is formed, with the factors that this workspace aims at.
const COMPARISONS: [Comparison; 10] = [
    ("latency", Ours::SingleState, "casadi_c_same", [1.6, 1.6, 1.4]),
    ("throughput", Ours::SingleState, "casadi_c_same", [1.9, 1.9, 1.5]),
    ("throughput", Ours::SingleState, "casadi_c_naive", [7.0, 50.0, 15.0]),
    ("throughput", Ours::SingleState, "reference", [9.0, 14.0, 9.0]),
    ("latency", Ours::SingleState, "reference", [0.0; 3]),
    ("throughput", Ours::SingleState, "pinocchio", [0.0, 90.0, 0.0]),
    ("throughput", Ours::Batch, "casadi_c_same", [6.0, 6.0, 4.0]),
    ("throughput", Ours::RunTime, "reference", [0.0; 3]),
    // Run-time parameters cost at most 1.35 times the baked model.
    ("throughput", Ours::RunTime, BAKED, [1.0 / 1.35, 1.0 / 1.35, 1.0 / 1.35]),
    ("throughput", Ours::Payload, BAKED, [1.0 / 1.35, 1.0 / 1.35, 1.0 / 1.35]),
];

/// The other side of a comparison that is [`Ours::SingleState`] too.
const BAKED: &str = "baked";

/// The functions that [`COMPARISONS`] has factors for.
const AIMED: [&str; 3] = ["inverse_dynamics", "forward_dynamics", "matrices"];

/// One function measured in one way.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    /// The function.
    pub function: String,
    /// One of [`MEASURES`].
    pub measure: String,
    /// Times in nanoseconds by implementation; what was not measured is absent.
    pub nanoseconds: BTreeMap<String, Time>,
}

/// How many times faster ours is.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Ratio {
    /// The function.
    pub function: String,
    /// One of [`MEASURES`].
    pub measure: String,
    /// Our side.
    pub ours: Ours,
    /// The other implementation; `baked` is the faster one of [`Ours::SingleState`].
    pub against: String,
    /// Its median over ours; nothing where one of them was not measured.
    pub ratio: Option<f64>,
    /// Whether something else kept the machine busy during one of the two, so that the ratio should not be quoted.
    pub disturbed: bool,
    /// What it shall be.
    pub target: Option<f64>,
}

impl Ratio {
    /// Whether the target is met; absent without target or without both times.
    pub fn met(&self) -> Option<bool> {
        Some(self.ratio? >= self.target?)
    }
}

/// Everything found.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Summary {
    /// The machine at the end of the measurement, if the benchmark has ended.
    pub machine: Option<Machine>,
    /// Whether all times were taken within minutes of one another.
    pub one_run: bool,
    /// By function and measure.
    pub rows: Vec<Row>,
    /// Every comparison.
    pub ratios: Vec<Ratio>,
    /// Nanoseconds of single calls.
    pub single_calls: Tails,
    /// Every way in which peers were compiled, from the short run that chose among them.
    pub variants: Vec<Variant>,
}

/// Reads the results in `folder`.
///
/// # Errors
/// If there are none, or one is not what the benchmark writes; in words.
pub fn summarise(folder: &Path) -> Result<Summary, String> {
    let mut taken = Vec::new();
    let mut rows = Vec::new();
    for function in FUNCTIONS {
        for measure in MEASURES {
            let mut nanoseconds = BTreeMap::new();
            for implementation in IMPLEMENTATIONS {
                let path = folder.join(function).join(implementation).join(measure).join("new");
                if let Some((time, when)) = results::read(&path)? {
                    nanoseconds.insert(implementation.to_owned(), time);
                    taken.push(when);
                }
            }
            rows.push(Row { function: function.to_owned(), measure: measure.to_owned(), nanoseconds });
        }
    }
    let (Some(first), Some(last)) = (taken.iter().min(), taken.iter().max()) else {
        return Err(format!("{}: no results\n help: cargo xtask bench", folder.display()));
    };
    let one_run = last.duration_since(*first).is_ok_and(|apart| apart <= ONE_RUN);
    let ratios = ratios(&rows);
    Ok(Summary {
        machine: results::read_own(folder, MACHINE)?,
        one_run,
        rows,
        ratios,
        single_calls: results::read_own(folder, SINGLE_CALLS)?,
        variants: results::read_own(folder, VARIANTS)?,
    })
}

fn ratios(rows: &[Row]) -> Vec<Ratio> {
    let mut ratios = Vec::new();
    for function in FUNCTIONS {
        let aim = AIMED.iter().position(|&name| name == function);
        for (measure, ours, against, targets) in COMPARISONS {
            let target = aim.map(|index| targets[index]).filter(|&target| target > 0.0);
            let row = rows.iter().find(|row| row.function == function && row.measure == measure);
            let time = |name: &str| row?.nanoseconds.get(name).copied();
            let fastest = |ours: Ours| {
                let times = ours.implementations().iter().filter_map(|&name| time(name));
                times.min_by(|a, b| a.median.total_cmp(&b.median))
            };
            let other = if against == BAKED { fastest(Ours::SingleState) } else { time(against) };
            let both = other.zip(fastest(ours));
            let ratio = both.map(|(other, ours)| other.median / ours.median);
            if target.is_some() || ratio.is_some() {
                ratios.push(Ratio {
                    function: function.to_owned(),
                    measure: measure.to_owned(),
                    ours,
                    against: against.to_owned(),
                    ratio,
                    disturbed: both.is_some_and(|(other, ours)| other.disturbed() || ours.disturbed()),
                    target,
                });
            }
        }
    }
    ratios
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::path::PathBuf;
    use std::time::SystemTime;

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
            ("inverse_dynamics/generated_lanes/throughput", 80.0),
            ("inverse_dynamics/generated_runtime/throughput", 150.0),
            ("inverse_dynamics/reference/throughput", 800.0),
            ("inverse_dynamics/casadi_c_same/throughput", 136.0),
            ("forward_dynamics/generated/latency", 100.0),
        ] {
            write(folder.path(), id, median);
        }
        let summary = summarise(folder.path()).unwrap();
        assert!(summary.one_run);
        let ratio = |ours, against| {
            let same = |row: &&Ratio| {
                row.function == "inverse_dynamics"
                    && row.measure == "throughput"
                    && row.ours == ours
                    && row.against == against
            };
            summary.ratios.iter().find(same).unwrap()
        };
        // The faster of two single-state implementations counts.
        assert_eq!(ratio(Ours::SingleState, "reference").ratio, Some(10.0));
        assert_eq!(ratio(Ours::SingleState, "reference").met(), Some(true));
        assert_eq!(ratio(Ours::SingleState, "casadi_c_same").met(), Some(false));
        assert_eq!(ratio(Ours::Batch, "casadi_c_same").met(), None);
        assert_eq!(ratio(Ours::RunTime, "baked").met(), Some(false));
        assert_eq!(ratio(Ours::RunTime, "baked").ratio, Some(80.0 / 150.0));
        let text = summary.text();
        for expected in ["9.00 met", "1.90 MISSED by 11 %", "6.00 not measured", "absent"] {
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
        write(folder.path(), "matrices/generated/latency", 100.0);
        let text = summarise(folder.path()).unwrap().text();
        assert!(text.contains("10.00*"), "{text}");
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
        assert!(summarise(folder.path()).unwrap_err().contains("xtask bench"));
        let path = write(folder.path(), "matrices/reference/latency", 1.0);
        fs::write(path.join("estimates.json"), "{}").unwrap();
        assert!(summarise(folder.path()).unwrap_err().contains("estimates.json"));
    }
}
