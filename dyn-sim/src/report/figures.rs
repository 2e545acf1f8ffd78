//! Which figures the report shows: base, platform against target, their difference, actuators, spectra.

use super::analysis::{Analysis, whole_run};
use super::curves::{COMPONENTS, file_name};
use super::figure::{Column, Curve, Figure, Panel, Scale};
use super::svg::Stroke;
use crate::outcome::Outcome;

const LINE: Stroke = Stroke::solid("#0b5cad", 1.4);
/// Wide and pale: what lies on it stays visible.
const TARGET: Stroke = Stroke::solid("#f0b429", 5.0);
const SIMULATIONS: [Stroke; 4] = [
    Stroke::solid("#0b5cad", 1.5),
    Stroke { color: "#c8302b", width: 1.5, dash: "5 4" },
    Stroke { color: "#2e7d32", width: 1.5, dash: "2 3" },
    Stroke { color: "#7b3fa0", width: 1.5, dash: "8 3 2 3" },
];
/// In spectra, for differences: full lines of the simulations' colours, paler.
const DIFFERENCES: [Stroke; 4] = [
    Stroke::solid("#6ea6d8", 1.3),
    Stroke::solid("#e58a85", 1.3),
    Stroke::solid("#82bf86", 1.3),
    Stroke::solid("#b98fd0", 1.3),
];
/// Spectra are shown down to this fraction of their peak.
const SPECTRUM_FLOOR: f64 = 1e-10;

/// A line of a spectrum stands out if it is above this fraction of the peak.
const STANDS_OUT: f64 = 1e-5;

/// So many lines of a spectrum are shown at least.
const FEWEST: f64 = 20.0;

/// All figures, in reading order.
pub(super) fn figures(outcome: &Outcome, analysis: &Analysis) -> Vec<Figure> {
    let mut figures = vec![base(outcome, analysis), platform(outcome, analysis)];
    figures.extend((0..analysis.differences.len()).map(|index| difference(outcome, analysis, index)));
    figures.extend(actuator_forces(outcome, analysis));
    figures.extend(actuator_lengths(outcome, analysis));
    figures.extend(spectra(analysis));
    figures
}

/// "The last 0.1 s" or "The whole run".
fn window_words(outcome: &Outcome, window: [f64; 2]) -> String {
    if window == whole_run(outcome) {
        "The whole run.".into()
    } else {
        format!("The last {} s: two common periods of the excitation.", rounded(window[1] - window[0]))
    }
}

fn rounded(value: f64) -> f64 {
    (value * 1e6).round() / 1e6
}

/// Six components drawn alike.
struct Line<'a> {
    /// Index into the legend.
    entry: usize,
    x: &'a [f64],
    samples: &'a [[f64; 6]],
}

impl Line<'_> {
    fn curve(&self, i: usize) -> Curve {
        let count = self.x.len().min(self.samples.len());
        let y = self.samples[..count].iter().map(|sample| sample[i]).collect();
        Curve { entry: self.entry, x: self.x[..count].to_vec(), y, dots: false }
    }
}

/// Panels of the three linear and the three angular accelerations.
fn acceleration_columns(lines: &[Line<'_>]) -> Vec<Column> {
    let column = |heading, unit, first: usize| {
        let panel = |i: usize| Panel {
            label: COMPONENTS[i].into(),
            curves: lines.iter().map(|line| line.curve(i)).collect(),
        };
        Column { heading, unit, panels: (first..first + 3).map(panel).collect() }
    };
    vec![column("linear acceleration", "m/s²", 0), column("angular acceleration", "rad/s²", 3)]
}

fn base(outcome: &Outcome, analysis: &Analysis) -> Figure {
    let window = analysis.detail(outcome);
    Figure {
        name: "base_acceleration".into(),
        title: "Base disturbance".into(),
        caption: format!("Acceleration of the base, inertial axes. {}", window_words(outcome, window)),
        x_label: "time, s".into(),
        x_range: window,
        scale: Scale::Linear,
        columns: acceleration_columns(&[Line {
            entry: 0,
            x: &outcome.base.time_s,
            samples: &outcome.base.acceleration,
        }]),
        legend: vec![("base".into(), LINE)],
        marks: Vec::new(),
    }
}

fn platform(outcome: &Outcome, analysis: &Analysis) -> Figure {
    let window = analysis.detail(outcome);
    let mut legend = Vec::new();
    let mut lines = Vec::new();
    let target = Some(&outcome.target).filter(|target| !target.time_s.is_empty());
    let simulations = outcome.simulations.iter().zip(SIMULATIONS.into_iter().cycle());
    for (series, stroke) in target.map(|target| (target, TARGET)).into_iter().chain(simulations) {
        lines.push(Line { entry: legend.len(), x: &series.time_s, samples: &series.acceleration });
        legend.push((series.label.clone(), stroke));
    }
    let what = if target.is_some() { "wanted and simulated" } else { "simulated" };
    Figure {
        name: "platform_acceleration".into(),
        title: format!("Platform acceleration, {what}"),
        caption: format!(
            "Acceleration of the platform (centre of its joint circle), inertial axes. {}",
            window_words(outcome, window)
        ),
        x_label: "time, s".into(),
        x_range: window,
        scale: Scale::Linear,
        columns: acceleration_columns(&lines),
        legend,
        marks: Vec::new(),
    }
}

fn difference(outcome: &Outcome, analysis: &Analysis, index: usize) -> Figure {
    let difference = &analysis.differences[index];
    let label = &difference.label;
    Figure {
        name: format!("difference_{}_{}", index + 1, file_name(label)),
        title: format!("Difference from the target, {label}"),
        caption: format!(
            "Acceleration of the platform by {label} minus the wanted one, over the whole run; mind the units."
        ),
        x_label: "time, s".into(),
        x_range: whole_run(outcome),
        scale: Scale::Linear,
        columns: acceleration_columns(&[Line {
            entry: 0,
            x: &difference.time_s,
            samples: &difference.acceleration,
        }]),
        legend: vec![(
            format!("{label} \u{2212} target"),
            Stroke { dash: "", width: 1.0, ..SIMULATIONS[index % SIMULATIONS.len()] },
        )],
        marks: Vec::new(),
    }
}

/// Legs 1 to 3 and 4 to 6 side by side.
fn leg_columns(
    time_s: &[f64],
    samples: &[[f64; 6]],
    heading: &'static str,
    unit: &'static str,
    label: &dyn Fn(usize) -> String,
) -> Vec<Column> {
    let line = Line { entry: 0, x: time_s, samples };
    let panel = |leg: usize| Panel { label: label(leg), curves: vec![line.curve(leg)] };
    [0, 3]
        .map(|first| Column { heading, unit, panels: (first..first + 3).map(panel).collect() })
        .into_iter()
        .collect()
}

fn actuator_forces(outcome: &Outcome, analysis: &Analysis) -> Option<Figure> {
    let window = analysis.detail(outcome);
    let forces = &outcome.actuator_force_n;
    // Those of a free platform are constant: nothing to see.
    forces.windows(2).any(|pair| pair[0] != pair[1]).then(|| Figure {
        name: "actuator_force".into(),
        title: "Actuator forces".into(),
        caption: format!(
            "Force of each actuator on its mover, positive away from the base. {}",
            window_words(outcome, window)
        ),
        x_label: "time, s".into(),
        x_range: window,
        scale: Scale::Linear,
        columns: leg_columns(&outcome.base.time_s, forces, "force", "N", &|leg| format!("leg {}", leg + 1)),
        legend: vec![("actuator force".into(), LINE)],
        marks: Vec::new(),
    })
}

fn actuator_lengths(outcome: &Outcome, analysis: &Analysis) -> Option<Figure> {
    let window = analysis.detail(outcome);
    let lengths = &outcome.actuator_length_m;
    if lengths.is_empty() {
        return None;
    }
    let mean: [f64; 6] =
        std::array::from_fn(|leg| lengths.iter().map(|row| row[leg]).sum::<f64>() / lengths.len() as f64);
    let about_mean: Vec<[f64; 6]> =
        lengths.iter().map(|row| std::array::from_fn(|leg| row[leg] - mean[leg])).collect();
    let label = |leg: usize| format!("leg {}, mean {:.3} mm", leg + 1, 1e3 * mean[leg]);
    Some(Figure {
        name: "actuator_length".into(),
        title: "Actuator lengths".into(),
        caption: format!(
            "Length of each actuator less its mean, which stands above the curve. {}",
            window_words(outcome, window)
        ),
        x_label: "time, s".into(),
        x_range: window,
        scale: Scale::Linear,
        columns: leg_columns(&outcome.base.time_s, &about_mean, "length less mean", "m", &label),
        legend: vec![("actuator length".into(), LINE)],
        marks: Vec::new(),
    })
}

/// Where the spectra end in the figure: half as far again as what is excited or, unnamed, as what stands out.
fn highest_frequency(analysis: &Analysis) -> Option<f64> {
    let lines = || {
        let spectra = analysis.spectra.iter();
        spectra.flat_map(|spectrum| spectrum.frequency_hz.iter().zip(&spectrum.amplitude))
    };
    let highest = lines().map(|(frequency, _)| *frequency).fold(0.0, f64::max);
    let mut peak = [0.0; 6];
    for (_, amplitude) in lines() {
        peak = std::array::from_fn(|i| f64::max(peak[i], amplitude[i]));
    }
    let stands_out = |amplitude: &[f64; 6]| (0..6).any(|i| amplitude[i] > STANDS_OUT * peak[i]);
    let reach = analysis.frequencies_hz.last().copied().unwrap_or_else(|| {
        lines().filter(|(_, row)| stands_out(row)).map(|(frequency, _)| *frequency).fold(0.0, f64::max)
    });
    let resolution = lines().map(|(frequency, _)| *frequency).find(|frequency| *frequency > 0.0)?;
    let shown = if reach > 0.0 { highest.min(f64::max(1.5 * reach, FEWEST * resolution)) } else { highest };
    (shown > 0.0).then_some(shown)
}

fn spectra(analysis: &Analysis) -> Option<Figure> {
    let spectra = &analysis.spectra;
    let simulated = spectra.len() - analysis.differences.len();
    let targets = simulated.min(analysis.differences.len().min(1));
    let highest = highest_frequency(analysis)?;
    let stroke = |index: usize| {
        if index < targets {
            TARGET
        } else if index < simulated {
            SIMULATIONS[(index - targets) % SIMULATIONS.len()]
        } else {
            DIFFERENCES[(index - simulated) % DIFFERENCES.len()]
        }
    };
    // Differences lie under everything else.
    let order = (simulated..spectra.len()).chain(0..simulated);
    let lines: Vec<Line<'_>> = order
        .map(|entry| Line { entry, x: &spectra[entry].frequency_hz, samples: &spectra[entry].amplitude })
        .collect();
    let caption = if analysis.period_s.is_some() {
        let excited: Vec<String> = analysis.frequencies_hz.iter().map(f64::to_string).collect();
        format!(
            "Amplitudes over whole common periods of the excitation. Lines mark the excited frequencies: {} Hz.",
            excited.join(", ")
        )
    } else {
        "Amplitudes under Hann\u{2019}s window.".into()
    };
    Some(Figure {
        name: "spectra".into(),
        title: "Amplitude spectra of the platform\u{2019}s acceleration".into(),
        caption,
        x_label: "frequency, Hz".into(),
        x_range: [0.0, highest],
        scale: Scale::Logarithmic { floor: SPECTRUM_FLOOR },
        columns: acceleration_columns(&lines),
        legend: (0..spectra.len()).map(|index| (spectra[index].label.clone(), stroke(index))).collect(),
        marks: analysis
            .frequencies_hz
            .iter()
            .map(|frequency| (*frequency, format!("{frequency} Hz")))
            .collect(),
    })
}
