//! A control loop at 10 kHz on the machine at hand: how long the model takes in every cycle.
//!
//! What happens between cycles belongs to it: a processor that has nothing to do is taken away, by other programs or by the host
//! of a virtual machine, and its caches and branch predictors forget. A controller that has a processor for itself therefore
//! waits actively, and rehearses: it repeats the call of the cycle before, so that the next one finds code and data at hand.
//! Without that, the loop sleeps for the first part of each period.

use std::hint::{black_box, spin_loop};
use std::thread;
use std::time::{Duration, Instant};

use hdrhistogram::Histogram;
use serde::Serialize;

/// Time from one cycle to the next.
pub const PERIOD: Duration = Duration::from_micros(100);

/// How long before a cycle a loop that does not rehearse stops sleeping; an ordinary kernel wakes a thread some 60 us late.
const AWAKE: Duration = Duration::from_micros(75);

/// Rehearsals end when this many of them, each as long as the last one, would no longer fit: an interrupt after the last
/// rehearsal makes the machine forget again, so little time is left for one.
const ROOM: u32 = 2;

/// What the loop does between cycles.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Waiting {
    /// It repeats the call of the cycle before, all the time.
    Rehearsing,
    /// It sleeps.
    Idle,
}

/// Longest time that is told apart from longer ones, ns.
const LONGEST_NS: u64 = 1_000_000_000;

/// A machine that is steady lets a rehearsal take this much more than the median one at most...
const STEADY: f64 = 1.15;

/// ...or this much, ns, which two readings of the clock may differ by...
const CLOCK_NS: u64 = 20;

/// ...and the cycle begin this late, ns.
const PUNCTUAL_NS: u64 = 1000;

/// Times of all cycles of one run, ns.
pub struct Run {
    /// Of the model itself.
    pub model: Histogram<u64>,
    /// The same of those cycles alone that found the machine steady: the last two rehearsals took their usual time, and the
    /// cycle began when it should. What the model took in the cycle itself has no say in this. Empty without rehearsals.
    pub steady: Histogram<u64>,
    /// From when a cycle should have begun to when it began: the operating system's share, not the model's.
    pub lateness: Histogram<u64>,
}

/// What was measured of one cycle, ns.
#[derive(Clone, Default)]
struct Cycle {
    model: u64,
    lateness: u64,
    /// The last two.
    rehearsals: Option<[u64; 2]>,
}

/// What a histogram says in five numbers, ns.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Summary {
    /// Half of the cycles took at most this.
    pub median_ns: u64,
    /// 99 of 100.
    pub p99_ns: u64,
    /// 999 of 1000.
    pub p99_9_ns: u64,
    /// All.
    pub max_ns: u64,
    /// `p99_9_ns / median_ns`.
    pub p99_9_by_median: f64,
}

/// Runs `model` in every period of `duration` with one of the states after the other, which arrives before the clock is read,
/// as from an estimator. The model is a reference, so that rehearsals and cycles run the same code.
///
/// # Errors
/// If a histogram cannot be made.
pub fn run<State: Clone>(
    duration: Duration,
    waiting: Waiting,
    states: &[State],
    model: &mut dyn FnMut(&State),
) -> Result<Run, hdrhistogram::CreationError> {
    let number = (duration.as_nanos() / PERIOD.as_nanos()) as usize;
    let mut cycles = vec![Cycle::default(); number];
    // The memory stays, and has been written to: no page fault falls into the loop.
    cycles.clear();
    let mut before: Option<State> = None;
    let mut due = Instant::now() + PERIOD;
    for state in states.iter().cycle().take(number) {
        let rehearsals = match &before {
            Some(state) if waiting == Waiting::Rehearsing => rehearse(due, || model(black_box(state))),
            _ => {
                sleep_until(due - AWAKE);
                None
            }
        };
        let state = black_box(state.clone());
        let begun = wait_until(due);
        model(&state);
        let ended = Instant::now();
        cycles.push(Cycle {
            model: nanoseconds(ended - begun),
            lateness: nanoseconds(begun - due),
            rehearsals: rehearsals.map(|two| two.map(nanoseconds)),
        });
        before = Some(state);
        // A cycle that was missed is not made up for: a controller would act on old measurements.
        due += PERIOD;
        while due < ended {
            due += PERIOD;
        }
    }
    histograms(&cycles)
}

/// Longer than the longest counts as the longest.
fn histograms(cycles: &[Cycle]) -> Result<Run, hdrhistogram::CreationError> {
    let empty = || Histogram::new_with_bounds(1, LONGEST_NS, 3);
    let (mut model, mut steady, mut lateness) = (empty()?, empty()?, empty()?);
    // The last one is the longest of its cycle too often: nothing fits behind it.
    let mut usual = empty()?;
    for [last_but_one, _] in cycles.iter().filter_map(|cycle| cycle.rehearsals) {
        usual.saturating_record(last_but_one);
    }
    let usual = usual.value_at_quantile(0.5);
    let longest = ((usual as f64 * STEADY) as u64).max(usual + CLOCK_NS);
    for cycle in cycles {
        model.saturating_record(cycle.model);
        lateness.saturating_record(cycle.lateness);
        let rehearsed = |two: [u64; 2]| two.iter().all(|&time| time <= longest);
        if cycle.lateness < PUNCTUAL_NS && cycle.rehearsals.is_some_and(rehearsed) {
            steady.saturating_record(cycle.model);
        }
    }
    Ok(Run { model, steady, lateness })
}

/// Repeats the call as long as there is time; what the last two took.
fn rehearse(due: Instant, mut call: impl FnMut()) -> Option<[Duration; 2]> {
    let (mut now, mut two) = (Instant::now(), [None; 2]);
    while now + ROOM * two[1].unwrap_or_default() < due {
        call();
        let ended = Instant::now();
        two = [two[1], Some(ended - now)];
        now = ended;
    }
    let [last_but_one, last] = two;
    Some([last_but_one?, last?])
}

fn sleep_until(awake: Instant) {
    if let Some(left) = awake.checked_duration_since(Instant::now()) {
        thread::sleep(left);
    }
}

/// Waits actively; when it is that time, which time it is.
fn wait_until(due: Instant) -> Instant {
    loop {
        let now = Instant::now();
        if now >= due {
            return now;
        }
        spin_loop();
    }
}

fn nanoseconds(duration: Duration) -> u64 {
    duration.as_nanos().try_into().unwrap_or(u64::MAX).max(1)
}

impl Summary {
    /// Of a histogram.
    pub fn of(histogram: &Histogram<u64>) -> Self {
        let [median_ns, p99_ns, p99_9_ns] = [0.5, 0.99, 0.999].map(|q| histogram.value_at_quantile(q));
        Self {
            median_ns,
            p99_ns,
            p99_9_ns,
            max_ns: histogram.max(),
            p99_9_by_median: p99_9_ns as f64 / median_ns as f64,
        }
    }

    /// Each number's median over runs.
    ///
    /// # Panics
    /// Without any run.
    pub fn median(runs: &[Self]) -> Self {
        let median = |number: fn(&Self) -> f64| {
            let mut numbers: Vec<f64> = runs.iter().map(number).collect();
            numbers.sort_by(f64::total_cmp);
            numbers[numbers.len() / 2]
        };
        Self {
            median_ns: median(|run| run.median_ns as f64) as u64,
            p99_ns: median(|run| run.p99_ns as f64) as u64,
            p99_9_ns: median(|run| run.p99_9_ns as f64) as u64,
            max_ns: median(|run| run.max_ns as f64) as u64,
            p99_9_by_median: median(|run| run.p99_9_by_median),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_period_has_a_cycle_and_times_are_told_apart() {
        let (states, mut cycles) = ([0, 1, 2, 3, 4, 5, 6], Vec::new());
        let run = run(10 * PERIOD, Waiting::Idle, &states, &mut |cycle| {
            cycles.push(*cycle);
            if *cycle == 5 {
                thread::sleep(Duration::from_millis(2));
            }
        })
        .unwrap();
        assert_eq!(cycles, [0, 1, 2, 3, 4, 5, 6, 0, 1, 2]);
        assert_eq!((run.model.len(), run.steady.len(), run.lateness.len()), (10, 0, 10));
        let summary = Summary::of(&run.model);
        assert!(summary.max_ns >= 2_000_000 && summary.median_ns < 2_000_000, "{summary:?}");
    }

    #[test]
    fn rehearsals_repeat_the_cycle_before_and_are_not_measured() {
        // Enough of them that a busy machine leaves time to some.
        const CYCLES: usize = 2000;
        let (states, mut cycles): (Vec<usize>, Vec<usize>) = ((0..CYCLES).collect(), Vec::new());
        let duration = CYCLES as u32 * PERIOD;
        let run = run(duration, Waiting::Rehearsing, &states, &mut |cycle| cycles.push(*cycle)).unwrap();
        assert_eq!(run.model.len() as usize, CYCLES);
        assert!(!run.steady.is_empty() && run.steady.len() < run.model.len());
        assert!(cycles.is_sorted() && cycles.len() > CYCLES);
        cycles.dedup();
        assert!(cycles.into_iter().eq(0..CYCLES));
    }

    #[test]
    fn steady_is_what_was_steady_before_and_whatever_the_cycle_took() {
        let cycle = |model, lateness, rehearsals| Cycle { model, lateness, rehearsals };
        let usual = Some([300, 300]);
        let mut cycles: Vec<Cycle> = (0..20).map(|_| cycle(310, 20, usual)).collect();
        cycles.extend([
            cycle(9000, 20, usual),
            cycle(1, 20, Some([300, 346])),
            cycle(2, 20, Some([346, 300])),
            cycle(3, 1000, usual),
            cycle(4, 20, None),
        ]);
        let run = histograms(&cycles).unwrap();
        assert_eq!((run.model.len(), run.steady.len()), (25, 21));
        assert_eq!(run.steady.min(), 310);
        assert!(run.steady.max() >= 9000);
    }

    #[test]
    fn medians_of_runs_are_taken_number_by_number() {
        let run =
            |median_ns, max_ns| Summary { median_ns, p99_ns: 2, p99_9_ns: 3, max_ns, p99_9_by_median: 1.0 };
        let median = Summary::median(&[run(5, 10), run(7, 90), run(6, 50)]);
        assert_eq!((median.median_ns, median.max_ns), (6, 50));
    }
}
