//! The fastest of several ways to write and compile a peer, found before criterion measures: a short run of every variant, taking
//! turns, so that the figure that is quoted against a peer is its best one and every other can be read beside it.

use std::collections::BTreeMap;
use std::time::Instant;

use dyn_platform::Platform;
use serde::{Deserialize, Serialize};

use crate::call::{Call, latency, throughput};
use crate::cases::{Case, FUNCTIONS, Visitor, visit};
use crate::states::{COUNT, States};

/// Rounds in which every variant is measured once; the median counts.
const ROUNDS: usize = 15;
/// Calls per round and variant.
const CALLS: u32 = 40 * COUNT as u32;

/// Nanoseconds per call of a variant in the short run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Variant {
    /// The function.
    pub function: String,
    /// The implementation.
    pub implementation: String,
    /// How it is written and compiled.
    pub variant: String,
    /// Median by measure.
    pub nanoseconds: BTreeMap<String, f64>,
    /// Whether it is the fastest one by measure.
    pub best: BTreeMap<String, bool>,
}

/// Figures of every variant.
#[derive(Default)]
pub struct Selection {
    times: BTreeMap<Case, BTreeMap<&'static str, Vec<f64>>>,
}

impl Selection {
    /// Measures every variant of every peer.
    pub fn measure(platform: &Platform, states: &States) -> Self {
        Self::of(|selection| {
            for function in FUNCTIONS {
                visit(function, platform, states, selection);
            }
        })
    }

    /// Measures every case with a variant that `show` shows, turn by turn.
    pub fn of(mut show: impl FnMut(&mut Self)) -> Self {
        let mut selection = Self::default();
        (0..ROUNDS).for_each(|_| show(&mut selection));
        selection
    }

    /// Whether a case is to be measured: it has no variants or is the fastest of them.
    pub fn is_best(&self, case: Case, measure: &str) -> bool {
        let Some(own) = self.median(case, measure) else { return true };
        self.rivals(case).all(|rival| self.median(rival, measure).is_none_or(|other| own <= other))
    }

    /// All figures.
    pub fn variants(&self) -> Vec<Variant> {
        let row = |case: &Case| {
            let by_measure = |value: &dyn Fn(&'static str) -> Option<f64>| {
                ["throughput", "latency"].iter().filter_map(|&m| Some((m.to_owned(), value(m)?))).collect()
            };
            Variant {
                function: case.function.into(),
                implementation: case.implementation.into(),
                variant: case.variant.into(),
                nanoseconds: by_measure(&|measure| self.median(*case, measure)),
                best: ["throughput", "latency"].map(|m| (m.to_owned(), self.is_best(*case, m))).into(),
            }
        };
        self.times.keys().map(row).collect()
    }

    fn rivals(&self, case: Case) -> impl Iterator<Item = Case> {
        let same = move |other: &Case| {
            other.function == case.function && other.implementation == case.implementation
        };
        self.times.keys().copied().filter(same)
    }

    fn median(&self, case: Case, measure: &str) -> Option<f64> {
        let mut times = self.times.get(&case)?.get(measure)?.clone();
        times.sort_by(f64::total_cmp);
        times.get(times.len() / 2).copied()
    }
}

impl Visitor for Selection {
    fn visit<C: Call>(&mut self, case: Case, states: &[C::State; COUNT], mut call: C) {
        if case.variant.is_empty() {
            return;
        }
        let per_call = |run: &mut dyn FnMut()| {
            (0..COUNT).for_each(|_| run());
            let start = Instant::now();
            (0..CALLS).for_each(|_| run());
            start.elapsed().as_secs_f64() * 1e9 / f64::from(CALLS)
        };
        let row = self.times.entry(case).or_default();
        row.entry("throughput").or_default().push(per_call(&mut throughput(&mut call, states)));
        row.entry("latency").or_default().push(per_call(&mut latency(&mut call, states)));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_fastest_variant_is_chosen_by_measure() {
        let case = |variant| Case { function: "matrices", implementation: "casadi_c_same", variant };
        let mut selection = Selection::default();
        for (variant, throughput, latency) in [("gcc", [3.0, 1.0, 1.1], 5.0), ("clang", [2.0, 2.0, 0.5], 4.0)]
        {
            let row = selection.times.entry(case(variant)).or_default();
            row.insert("throughput", throughput.to_vec());
            row.insert("latency", vec![latency]);
        }
        assert!(selection.is_best(case("gcc"), "throughput"));
        assert!(!selection.is_best(case("clang"), "throughput"));
        assert!(selection.is_best(case("clang"), "latency"));
        let without = Case { function: "matrices", implementation: "generated", variant: "" };
        assert!(selection.is_best(without, "latency"));
        assert_eq!(selection.variants().len(), 2);
    }
}
