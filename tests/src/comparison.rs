//! Collects deviations of many arrays and judges them at the end, so that one run shows all that is wrong.

use std::collections::BTreeMap;

use dyn_gen::deviation::{Scale, larger, relative_error, tolerance, within};

/// Failures in words that are shown.
const SHOWN: usize = 20;

/// Largest deviation per output, and failures in words.
#[derive(Debug, Default)]
pub struct Comparison {
    worst: BTreeMap<String, f64>,
    failures: Vec<String>,
}

impl Comparison {
    /// Compares one array; `label` says what it comes from.
    pub fn add(&mut self, label: &str, output: &str, values: &[f64], expected: &[f64], scale: Scale) {
        let found = relative_error(values, expected, scale);
        if !within(found, output) {
            self.failures.push(format!("{label}, {output} deviates by {found:.1e}"));
        }
        let worst = self.worst.entry(output.into()).or_default();
        *worst = larger(*worst, found);
    }

    /// Prints the largest deviation of every output.
    ///
    /// # Panics
    /// If any array was beyond its tolerance.
    pub fn finish(self) {
        for (output, worst) in &self.worst {
            println!("{output:36} {worst:8.1e}  (tolerance {:.0e})", tolerance(output));
        }
        let count = self.failures.len();
        assert!(count == 0, "{count} failures:\n{}", self.failures[..count.min(SHOWN)].join("\n"));
    }
}
