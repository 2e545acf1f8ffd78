//! Times of single calls, one reading of the clock before and one after each: median and 99th percentile. A call follows the
//! previous one strictly, and the time of an empty interval is taken off.

use std::collections::BTreeMap;
use std::time::Instant;

use dyn_platform::Platform;
use hdrhistogram::Histogram;

use crate::call::{Call, latency};
use crate::cases::{Case, FUNCTIONS, Visitor, visit};
use crate::selection::Selection;
use crate::states::{COUNT, States};

/// Calls per case.
const CALLS: usize = 100_000;
/// Calls before them.
const WARM_UP: usize = 5_000;

/// Nanoseconds of single calls.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Tail {
    /// Half of the calls take longer.
    pub median: u64,
    /// One in a hundred takes longer.
    pub p99: u64,
}

/// By function and implementation.
pub type Tails = BTreeMap<String, BTreeMap<String, Tail>>;

/// Times single calls of everything, of peers the variant with the best latency.
pub fn measure(platform: &Platform, states: &States, selection: &Selection) -> Tails {
    let mut timer = Timer { selection, empty: empty_interval(), tails: Tails::new() };
    for function in FUNCTIONS {
        visit(function, platform, states, &mut timer);
    }
    timer.tails
}

struct Timer<'a> {
    selection: &'a Selection,
    empty: u64,
    tails: Tails,
}

impl Visitor for Timer<'_> {
    fn visit<C: Call>(&mut self, case: Case, states: &[C::State; COUNT], mut call: C) {
        if !self.selection.is_best(case, "latency") {
            return;
        }
        let mut run = latency(&mut call, states);
        (0..WARM_UP).for_each(|_| run());
        let histogram = times(CALLS, run);
        let less_empty = |quantile| histogram.value_at_quantile(quantile).saturating_sub(self.empty);
        let tail = Tail { median: less_empty(0.5), p99: less_empty(0.99) };
        let row = self.tails.entry(case.function.to_owned()).or_default();
        row.insert(case.implementation.to_owned(), tail);
    }
}

/// Median of what the clock itself takes.
fn empty_interval() -> u64 {
    times(CALLS, || {}).value_at_quantile(0.5)
}

fn times(count: usize, mut run: impl FnMut()) -> Histogram<u64> {
    let mut histogram = Histogram::new_with_bounds(1, 1_000_000_000, 3).expect("bounds in order");
    for _ in 0..count {
        let start = Instant::now();
        run();
        let nanoseconds = start.elapsed().as_nanos() as u64;
        histogram.saturating_record(nanoseconds);
    }
    histogram
}

#[cfg(test)]
mod tests {
    #[test]
    fn a_longer_call_takes_longer() {
        let nap = || std::thread::sleep(std::time::Duration::from_micros(200));
        assert!(super::times(20, nap).value_at_quantile(0.5) >= 200_000);
        assert!(super::empty_interval() < 100_000);
    }
}
