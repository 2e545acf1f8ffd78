//! What it means that a law holds.

use dyn_gen::graph::Environment;
use dyn_tests::platforms::SEED;
use nalgebra::SMatrix;

use crate::subject::{Subject, cases};

/// A law and how exactly it must hold.
pub struct Law {
    /// The law in words or as an equation.
    pub name: &'static str,
    /// Largest relative deviation.
    pub tolerance: f64,
    /// Why not tighter.
    pub reason: &'static str,
}

impl Law {
    /// Asserts the law for every subject in every large state, given how far a subject deviates from it in a state.
    pub fn holds(&self, deviation: impl Fn(&Subject, &Environment) -> f64) {
        let cases = cases().iter();
        self.judge(cases.flat_map(|(subject, states)| {
            let deviations = states.iter().map(|state| deviation(subject, state));
            deviations
                .enumerate()
                .map(|(k, found)| (format!("{}, state {k}", subject.label), found))
                .collect::<Vec<_>>()
        }));
    }

    /// Asserts that every labelled deviation is within the tolerance.
    pub fn judge(&self, deviations: impl Iterator<Item = (String, f64)>) {
        let deviations: Vec<(String, f64)> = deviations.collect();
        assert!(!deviations.is_empty(), "{}: nothing was measured", self.name);
        let worst = deviations.iter().max_by(|a, b| a.1.abs().total_cmp(&b.1.abs())).expect("not empty");
        println!("{:76} {:8.1e}  (tolerance {:.0e}), {}", self.name, worst.1, self.tolerance, worst.0);
        let failures =
            deviations.iter().filter(|(_, found)| found.is_nan() || *found > self.tolerance).count();
        assert!(
            failures == 0,
            "{}: {failures} of {} fail with seed {SEED}, worst {:.1e} at {}; tolerance {:.0e}: {}",
            self.name,
            deviations.len(),
            worst.1,
            worst.0,
            self.tolerance,
            self.reason
        );
    }
}

/// How far terms that should cancel are from it: largest entry of the sum over the largest entry of any term.
pub fn unbalance<const R: usize, const C: usize>(terms: &[SMatrix<f64, R, C>]) -> f64 {
    let largest = terms.iter().fold(0.0_f64, |most, term| most.max(term.amax()));
    let rest: SMatrix<f64, R, C> = terms.iter().sum();
    // A sum over all entries, unlike `amax`, cannot lose a NaN.
    if rest.sum().is_nan() {
        return f64::NAN;
    }
    if largest == 0.0 { 0.0 } else { rest.amax() / largest }
}

/// Relative difference of two arrays.
pub fn difference<const R: usize, const C: usize>(
    actual: SMatrix<f64, R, C>,
    expected: SMatrix<f64, R, C>,
) -> f64 {
    unbalance(&[actual, -expected])
}

/// The largest of some deviations; NaN if one is.
pub fn largest(deviations: impl IntoIterator<Item = f64>) -> f64 {
    deviations
        .into_iter()
        .fold(0.0, |most: f64, x| if x.is_nan() || most.is_nan() { f64::NAN } else { most.max(x) })
}
