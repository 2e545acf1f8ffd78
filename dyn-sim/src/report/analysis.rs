//! What figures and CSV files show beyond the simulations themselves: differences from the target and spectra.

use crate::outcome::{Outcome, Series};
use crate::spectrum::{Plan, Window};

/// Simulated minus target acceleration at their common sample times.
pub(super) struct Difference {
    pub(super) label: String,
    pub(super) time_s: Vec<f64>,
    /// m/s^2, rad/s^2, O.
    pub(super) acceleration: Vec<[f64; 6]>,
}

/// One-sided amplitude spectrum of an acceleration.
pub(super) struct Spectrum {
    pub(super) label: String,
    pub(super) frequency_hz: Vec<f64>,
    /// m/s^2, rad/s^2.
    pub(super) amplitude: Vec<[f64; 6]>,
}

/// Everything derived from an [`Outcome`].
pub(super) struct Analysis {
    /// One per simulation that has a target.
    pub(super) differences: Vec<Difference>,
    /// Target, where there is one, simulations, differences.
    pub(super) spectra: Vec<Spectrum>,
    /// Named frequencies of target and tables, ascending, Hz.
    pub(super) frequencies_hz: Vec<f64>,
    /// Least common period of these, s.
    pub(super) period_s: Option<f64>,
}

impl Analysis {
    pub(super) fn new(outcome: &Outcome) -> Self {
        let mut frequencies_hz: Vec<f64> =
            outcome.amplitude_tables.iter().flat_map(|table| table.frequencies_hz.iter().copied()).collect();
        frequencies_hz.sort_by(f64::total_cmp);
        frequencies_hz.dedup();
        let period_s = common_period(&frequencies_hz);
        let differences: Vec<Difference> = outcome
            .simulations
            .iter()
            .filter_map(|simulation| difference(simulation, &outcome.target))
            .collect();
        let series = std::iter::once(&outcome.target).chain(&outcome.simulations);
        let curves = series.map(|series| (series.label.clone(), &series.time_s, &series.acceleration));
        let named = |difference: &Difference| format!("{} \u{2212} target", difference.label);
        let differing = differences
            .iter()
            .map(|difference| (named(difference), &difference.time_s, &difference.acceleration));
        let spectra = curves
            .chain(differing)
            .filter_map(|(label, time, samples)| spectrum(label, time, samples, period_s));
        Self { spectra: spectra.collect(), differences, frequencies_hz, period_s }
    }

    /// The part of the run in which single periods can be seen: the last two common periods, or all of it.
    pub(super) fn detail(&self, outcome: &Outcome) -> [f64; 2] {
        let [start, end] = whole_run(outcome);
        let length = self.period_s.map_or(end - start, |period| 2.0 * period);
        [start.max(end - length), end]
    }
}

/// First and last sample time of the motion of the base.
pub(super) fn whole_run(outcome: &Outcome) -> [f64; 2] {
    let start = outcome.base.time_s.first().copied().unwrap_or(0.0);
    let end = outcome.base.time_s.last().copied().unwrap_or(1.0);
    [start, if end > start { end } else { start + 1.0 }]
}

/// Simulated minus target; the samples of either may stop early or be sparser.
fn difference(simulation: &Series, target: &Series) -> Option<Difference> {
    let step = target.time_s.windows(2).map(|pair| pair[1] - pair[0]).fold(f64::INFINITY, f64::min);
    let mut found =
        Difference { label: simulation.label.clone(), time_s: Vec::new(), acceleration: Vec::new() };
    let mut k = 0;
    for (time, simulated) in simulation.time_s.iter().zip(&simulation.acceleration) {
        while k < target.time_s.len() && target.time_s[k] < time - 1e-6 * step {
            k += 1;
        }
        if k == target.time_s.len() {
            break;
        }
        if (target.time_s[k] - time).abs() <= 1e-6 * step {
            found.time_s.push(*time);
            found.acceleration.push(std::array::from_fn(|i| simulated[i] - target.acceleration[k][i]));
        }
    }
    (found.time_s.len() > 1).then_some(found)
}

/// The shortest time that is a whole number of periods of every frequency, to a thousandth of a hertz.
fn common_period(frequencies_hz: &[f64]) -> Option<f64> {
    let greatest_common_divisor = |mut a: u64, mut b: u64| {
        while b != 0 {
            (a, b) = (b, a % b);
        }
        a
    };
    let in_millihertz = frequencies_hz.iter().map(|frequency| (frequency * 1e3).round() as u64);
    let common = in_millihertz.fold(0, greatest_common_divisor);
    (common > 0).then(|| 1e3 / common as f64)
}

/// Amplitudes over the last whole common periods, or over everything under Hann's window where there is no period.
fn spectrum(label: String, time_s: &[f64], samples: &[[f64; 6]], period_s: Option<f64>) -> Option<Spectrum> {
    let last = time_s.len().min(samples.len()).checked_sub(1).filter(|last| *last > 1)?;
    let step_s = (time_s[last] - time_s[0]) / last as f64;
    let per_period = period_s.map(|period| period / step_s).filter(|count| {
        *count >= 2.0 && *count <= last as f64 + 0.5 && (count - count.round()).abs() < 1e-6 * count
    });
    let plan = match per_period {
        Some(per_period) => {
            let per_period = per_period.round() as usize;
            Plan::new(last % per_period, last, step_s, &[], Window::Rectangular)
        }
        None => Plan::new(0, last, step_s, &[], Window::Hann),
    };
    let (frequency_hz, amplitude) = plan.magnitudes(samples);
    (!amplitude.is_empty()).then_some(Spectrum { label, frequency_hz, amplitude })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn common_periods() {
        assert_eq!(common_period(&[40.0, 100.0, 200.0]), Some(0.05));
        assert_eq!(common_period(&[2.5]), Some(0.4));
        assert_eq!(common_period(&[]), None);
    }

    #[test]
    fn amplitudes_of_harmonics_come_out_exactly() {
        let wave = |t: f64| 3.0 + 2.0 * (std::f64::consts::TAU * 40.0 * t).cos();
        // 1.017 s: the spectrum must find the whole periods in it.
        let time_s: Vec<f64> = (0..=1017).map(|k| f64::from(k) * 1e-3).collect();
        let samples: Vec<[f64; 6]> = time_s.iter().map(|t| [wave(*t); 6]).collect();
        let found = spectrum(String::new(), &time_s, &samples, Some(0.05)).expect("long enough");
        assert!((found.frequency_hz[40] - 40.0).abs() < 1e-9);
        assert!((found.amplitude[0][5] - 3.0).abs() < 1e-12);
        assert!((found.amplitude[40][5] - 2.0).abs() < 1e-12);
        assert!(found.amplitude[41][5] < 1e-12);

        let windowed = spectrum(String::new(), &time_s[..=1000], &samples, None).expect("long enough");
        assert!((windowed.amplitude[40][0] - 2.0).abs() < 1e-12);
        assert!(spectrum(String::new(), &[0.0], &[[0.0; 6]], None).is_none());
    }

    #[test]
    fn differences_pair_equal_times() {
        let series = |times: &[f64], value: f64| Series {
            time_s: times.to_vec(),
            acceleration: times.iter().map(|t| [value + t; 6]).collect(),
            ..Series::default()
        };
        let target = series(&[0.0, 0.1, 0.2, 0.30000000000000004], 0.0);
        let found = difference(&series(&[0.0, 0.2, 0.3, 0.4], 1.0), &target).expect("common times");
        assert_eq!(found.time_s, [0.0, 0.2, 0.3]);
        assert!(found.acceleration.iter().flatten().all(|value| (value - 1.0).abs() < 1e-12));
        assert!(difference(&series(&[0.0, 0.1], 1.0), &Series::default()).is_none());
    }
}
