//! What a scenario may not be, and the scenario that is left.

use std::path::Path;

use dyn_platform::{FileError, Platform, Refusal, first_line};
use toml::Spanned;

use super::motions::Reader;
use super::schema::{File, Limits, Spectrum};
use super::{Scenario, SpectrumRequest, Steering, VERSION};
use crate::simulate::Grid;
use crate::spectrum::Window;
use crate::stop::Stroke;

/// More steps fill the memory: each keeps about 500 bytes.
const MOST_STEPS: f64 = 2e6;

/// No quantity of a scenario comes near this.
const LARGEST: f64 = 1e30;

/// Refuses other versions.
pub(super) fn version(file: &File, refusals: &mut Vec<Refusal>) {
    let version = *file.version.get_ref();
    if version != VERSION {
        let what = format!("the file has format version {version}, this reader knows version {VERSION} only");
        let help = "write `version = 1` and bring the file into the form of scenarios/README.md";
        refusals.push(Refusal::new(file.version.span(), format!("must be {VERSION}"), what, help));
    }
}

/// The scenario, or what is wrong with it.
pub(super) fn scenario(
    file: File,
    text: &str,
    platform: Platform,
    folder: &Path,
    refusals: &mut Vec<Refusal>,
) -> Result<Option<Scenario>, FileError> {
    name(&file.name, refusals);
    let grid = grid(&file, refusals);
    let stroke = stroke(&platform, file.limits.as_ref(), refusals);
    let mut reader = Reader { grid, folder, refusals, notes: Vec::new() };
    let base = reader.base(file.base.as_ref())?;
    let steering = match (&file.target, &file.free) {
        (Some(target), None) => Some(Steering::Target(Box::new(reader.target(target, &platform, &base)?))),
        (None, Some(free)) => Some(reader.free(free.get_ref(), &platform, &base)),
        (Some(_), Some(free)) => {
            let help = "remove [target] to let the platform go, or [free] to steer it";
            let what = "the platform cannot follow [target] and be [free]";
            reader.refusals.push(Refusal::new(free.span(), "and [target] as well", what, help));
            None
        }
        (None, None) => {
            let help = "add [target] with its [[target.harmonic]] tables, or [free]";
            let what = "nothing says what the platform does";
            reader.refusals.push(Refusal::new(first_line(text), "neither [target] nor [free]", what, help));
            None
        }
    };
    let notes = reader.notes;
    let (Some(grid), Some(steering)) = (grid, steering) else { return Ok(None) };
    let spectrum = spectrum(file.spectrum.as_ref(), grid, &steering, refusals);
    Ok(Some(Scenario {
        name: file.name.into_inner(),
        description: file.description,
        text: text.to_owned(),
        platform,
        gravity_on: file.gravity,
        grid,
        integrator: file.integrator,
        prototype: file.prototype,
        prototype_half_steps: file.prototype_half_steps,
        base,
        steering,
        stroke,
        spectrum,
        outputs: file.outputs,
        notes,
    }))
}

/// Names become folders.
pub(crate) fn name(name: &Spanned<String>, refusals: &mut Vec<Refusal>) {
    let written = name.get_ref();
    let allowed = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
    if written.is_empty() || !written.chars().all(allowed) {
        let what = format!("`name` is {written:?}, which cannot name a folder");
        let help = "use letters, digits, `_` and `-`: `name = \"my_experiment\"`";
        refusals.push(Refusal::new(name.span(), "cannot name a folder", what, help));
    }
}

fn grid(file: &File, refusals: &mut Vec<Refusal>) -> Option<Grid> {
    let before = refusals.len();
    let duration = positive("duration_s", "duration_s = 1.0", &file.duration_s, refusals);
    let step_s = positive("step_s", "step_s = 1e-4", &file.step_s, refusals);
    if refusals.len() > before {
        return None;
    }
    let steps = duration / step_s;
    if steps > MOST_STEPS {
        let what =
            format!("{steps:.0} steps are more than {MOST_STEPS:.0}, the most that memory is made for");
        let help = "shorten `duration_s` or lengthen `step_s`";
        refusals.push(Refusal::new(file.step_s.span(), "too many steps", what, help));
        return None;
    }
    let whole = steps.round();
    if whole < 1.0 || (steps - whole).abs() > 1e-6 {
        let what = format!("`duration_s` is {steps:.6} steps, not a whole number of them");
        let help = format!("choose a duration of {:e} s, or another step", whole.max(1.0) * step_s);
        refusals.push(Refusal::new(file.duration_s.span(), "not a whole number of steps", what, help));
        return None;
    }
    Some(Grid { step_s, steps: whole as usize })
}

/// The platform's stroke, narrowed by the scenario's; none where nothing is limited.
fn stroke(platform: &Platform, limits: Option<&Limits>, refusals: &mut Vec<Refusal>) -> Option<Stroke> {
    let narrowed = limits.and_then(|limits| narrowed_stroke(limits, refusals));
    let [shortest, longest] = narrowed.unwrap_or([f64::NEG_INFINITY, f64::INFINITY]);
    let of_platform = &platform.limits;
    let stroke = Stroke {
        shortest_m: of_platform.minimum_length.map(|limit| limit.map_or(shortest, |m| m.max(shortest))),
        longest_m: of_platform.maximum_length.map(|limit| limit.map_or(longest, |m| m.min(longest))),
    };
    let ends = stroke.shortest_m.iter().chain(&stroke.longest_m);
    ends.copied().any(f64::is_finite).then_some(stroke)
}

fn narrowed_stroke(limits: &Limits, refusals: &mut Vec<Refusal>) -> Option<[f64; 2]> {
    let [shortest_m, longest_m] = *limits.actuator_length_m.get_ref();
    if shortest_m < longest_m && shortest_m.abs() < LARGEST && longest_m < LARGEST {
        return Some([shortest_m, longest_m]);
    }
    let what = format!("`actuator_length_m` must be [shortest, longest], but is [{shortest_m}, {longest_m}]");
    let help = "for example `actuator_length_m = [0.15, 0.25]`";
    refusals.push(Refusal::new(limits.actuator_length_m.span(), "not a range", what, help));
    None
}

fn spectrum(
    spectrum: Option<&Spectrum>,
    grid: Grid,
    steering: &Steering,
    refusals: &mut Vec<Refusal>,
) -> SpectrumRequest {
    let Some(spectrum) = spectrum else {
        let frequencies_hz = match steering {
            Steering::Target(motion) => motion.frequencies_hz(),
            Steering::Free(..) => Vec::new(),
        };
        return SpectrumRequest { frequencies_hz, first_step: 0, window: Window::Auto, paper_percent: None };
    };
    let highest = 0.5 / grid.step_s;
    let mut frequencies_hz = Vec::new();
    for frequency in spectrum.frequencies_hz.get_ref() {
        let f = positive("frequencies_hz", "frequencies_hz = [40.0, 100.0]", frequency, refusals);
        if f >= highest {
            let what = format!("{f} Hz is not below {highest} Hz, half the sampling rate");
            refusals.push(Refusal::new(
                frequency.span(),
                "too high",
                what,
                "shorten `step_s`, or leave it out",
            ));
        }
        frequencies_hz.push(f);
    }
    let mut first_step = 0;
    if let Some(start) = &spectrum.start_s {
        let steps = start.get_ref() / grid.step_s;
        // NaN lies in no range.
        if (0.0..grid.steps as f64 - 1.0).contains(&steps) {
            first_step = steps.round() as usize;
        } else {
            let end = grid.time(grid.steps);
            let what = format!("`start_s` is {} s, outside the duration of {end} s", start.get_ref());
            refusals.push(Refusal::new(start.span(), "outside", what, "for example `start_s = 0.1`"));
        }
    }
    let paper_percent = spectrum.paper_error_percent.as_ref().map(|rows| {
        if rows.get_ref().len() != frequencies_hz.len() {
            let (rows_found, wanted) = (rows.get_ref().len(), frequencies_hz.len());
            let what = format!("`paper_error_percent` has {rows_found} rows for {wanted} frequencies");
            let help = "give one row of six numbers per entry of `frequencies_hz`";
            refusals.push(Refusal::new(rows.span(), "one row per frequency", what, help));
        }
        rows.get_ref().clone()
    });
    let window = spectrum.window.unwrap_or(Window::Auto);
    SpectrumRequest { frequencies_hz, first_step, window, paper_percent }
}

/// A number that is one.
pub(super) fn finite(key: &str, number: &Spanned<f64>, refusals: &mut Vec<Refusal>) -> f64 {
    let value = *number.get_ref();
    if value.abs() <= LARGEST {
        return value;
    }
    let what = format!("`{key}` needs finite numbers, none beyond {LARGEST:e}");
    refusals.push(Refusal::new(
        number.span(),
        "not such a number",
        what,
        "scenarios/README.md tells what is meant",
    ));
    0.0
}

/// A number above zero; 1 in its place if it is not.
pub(super) fn positive(key: &str, example: &str, number: &Spanned<f64>, refusals: &mut Vec<Refusal>) -> f64 {
    let value = *number.get_ref();
    if value > 0.0 && value <= LARGEST {
        return value;
    }
    let what = format!("`{key}` must be positive and finite, but is {value}");
    refusals.push(Refusal::new(number.span(), "must be positive", what, format!("for example `{example}`")));
    1.0
}
