//! Amplitudes of a sampled signal at frequencies.
//!
//! A signal `|A| sin(2 pi f t + p)` has the complex amplitude `A = |A| exp(i p)` at f, t counted from the scenario's
//! beginning; so two simulations with the same samples compare by magnitude and phase.
//!
//! # Window
//!
//! If the samples span a whole number of periods of every named frequency, each falls on a line of the discrete Fourier
//! transform: no window is wanted then (rectangular), and amplitudes are exact to rounding. Otherwise a rectangular
//! window leaks every line into every other, falling off as 1/distance only; Hann's falls off with the third power, at the
//! price of lines twice as wide. So [`Window::Auto`] is rectangular for whole periods, else Hann with a warning.

use std::f64::consts::TAU;

use realfft::RealFftPlanner;
use realfft::num_complex::Complex;

/// A span counts as whole periods if it misses them by less than this fraction of a period.
const WHOLE: f64 = 1e-6;

/// Weights of the samples before the transform.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Window {
    /// Rectangular for whole periods, else Hann.
    Auto,
    /// All samples alike.
    Rectangular,
    /// Hann's, `1 - cos`, periodic.
    Hann,
}

/// Which samples are transformed, and how.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// Index of the first sample.
    first: usize,
    /// Number of samples.
    count: usize,
    step_s: f64,
    hann: bool,
    /// What a reader should know.
    pub warning: Option<String>,
}

impl Plan {
    /// For the samples at `k step_s`, k = `first` to `last`, of which `last` is left out: it begins the next period.
    pub fn new(first: usize, last: usize, step_s: f64, frequencies_hz: &[f64], window: Window) -> Self {
        let count = last.saturating_sub(first);
        let span = count as f64 * step_s;
        let partial: Vec<String> = frequencies_hz
            .iter()
            .filter(|f| ((span * **f).round() - span * **f).abs() > WHOLE || (span * **f).round() < 1.0)
            .map(|f| format!("{f} Hz ({:.3} periods)", span * f))
            .collect();
        let whole = partial.is_empty();
        let hann = match window {
            Window::Auto => !whole,
            Window::Rectangular => false,
            Window::Hann => true,
        };
        let consequence = if hann {
            "Hann's window is used, and neighbouring lines still leak a little"
        } else {
            "without a window every line leaks into the others"
        };
        let warning = (!whole).then(|| {
            format!(
                "the spectrum spans {span:.6} s, not a whole number of periods of {}: {consequence}",
                partial.join(", ")
            )
        });
        Self { first, count, step_s, hann, warning }
    }

    /// Whether Hann's window weights the samples.
    pub fn is_hann(&self) -> bool {
        self.hann
    }

    fn weight(&self, k: usize) -> f64 {
        if self.hann { 1.0 - (TAU * k as f64 / self.count as f64).cos() } else { 1.0 }
    }

    /// The windowed samples of component `i`.
    fn samples(&self, signal: &[[f64; 6]], i: usize) -> Vec<f64> {
        signal[self.first..self.first + self.count]
            .iter()
            .enumerate()
            .map(|(k, sample)| sample[i] * self.weight(k))
            .collect()
    }

    /// Complex amplitudes of the six components at each of `frequencies_hz`: lines of the transform where a frequency
    /// falls on one, otherwise the transform's sum at that very frequency. Empty without samples.
    pub fn amplitudes(&self, signal: &[[f64; 6]], frequencies_hz: &[f64]) -> Vec<[Complex<f64>; 6]> {
        let mut amplitudes = vec![[Complex::default(); 6]; frequencies_hz.len()];
        if signal.len() < self.first + self.count || self.count == 0 {
            return Vec::new();
        }
        for i in 0..6 {
            let samples = self.samples(signal, i);
            let lines = transformed(&samples);
            for (amplitude, &f) in amplitudes.iter_mut().zip(frequencies_hz) {
                let place = f * self.count as f64 * self.step_s;
                let on_line = (place - place.round()).abs() < WHOLE && (place.round() as usize) < lines.len();
                let line =
                    if on_line { lines[place.round() as usize] } else { directly(&samples, f * self.step_s) };
                amplitude[i] = line * self.scale(place) * self.origin(f);
            }
        }
        amplitudes
    }

    /// Frequencies (Hz) and magnitudes of every line, for curves.
    pub fn magnitudes(&self, signal: &[[f64; 6]]) -> (Vec<f64>, Vec<[f64; 6]>) {
        if signal.len() < self.first + self.count || self.count == 0 {
            return (Vec::new(), Vec::new());
        }
        let count = self.count / 2 + 1;
        let frequencies = (0..count).map(|k| k as f64 / (self.count as f64 * self.step_s)).collect();
        let mut magnitudes = vec![[0.0; 6]; count];
        for i in 0..6 {
            let lines = transformed(&self.samples(signal, i));
            for (k, (magnitude, line)) in magnitudes.iter_mut().zip(&lines).enumerate() {
                magnitude[i] = line.norm() * self.scale(k as f64);
            }
        }
        (frequencies, magnitudes)
    }

    /// From a line to an amplitude: the mean of the window's weights is 1, and positive and negative frequencies share
    /// an amplitude, except at 0 and at half the sampling rate.
    fn scale(&self, place: f64) -> f64 {
        let alone = place.round() == 0.0 || 2 * place.round() as usize == self.count;
        if alone { 1.0 / self.count as f64 } else { 2.0 / self.count as f64 }
    }

    /// Turns the phase to time zero, and from cosine to sine.
    fn origin(&self, f: f64) -> Complex<f64> {
        let start = self.first as f64 * self.step_s;
        Complex::<f64>::i() * Complex::cis(-TAU * (f * start).fract())
    }
}

fn transformed(samples: &[f64]) -> Vec<Complex<f64>> {
    let plan = RealFftPlanner::new().plan_fft_forward(samples.len());
    let mut input = samples.to_vec();
    let mut lines = plan.make_output_vec();
    plan.process(&mut input, &mut lines).expect("both buffers were made for this plan");
    lines
}

/// The transform's sum at `cycles` per sample.
fn directly(samples: &[f64], cycles: f64) -> Complex<f64> {
    let term = |(k, x): (usize, &f64)| Complex::cis(-TAU * (cycles * k as f64).fract()) * *x;
    samples.iter().enumerate().map(term).sum()
}
