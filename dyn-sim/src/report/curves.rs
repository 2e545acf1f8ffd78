//! The curves as CSV: every sample, names with units, numbers that read back exactly.

use std::io::{self, Write};

use super::analysis::{Analysis, Difference, Spectrum};
use crate::outcome::{AmplitudeTable, Outcome, Series};

/// The paper's names of the six components.
pub(super) const COMPONENTS: [&str; 6] = ["Ax", "Ay", "Az", "Arx", "Ary", "Arz"];
const AXES: [&str; 3] = ["x", "y", "z"];

/// One CSV file.
pub(super) struct CurveFile<'a> {
    /// Path inside the report.
    pub(super) path: String,
    /// What it holds.
    pub(super) about: String,
    rows: usize,
    columns: Vec<Column<'a>>,
}

struct Column<'a> {
    name: String,
    value: Box<dyn Fn(usize) -> f64 + 'a>,
}

impl<'a> CurveFile<'a> {
    fn new(name: &str, about: String, rows: usize) -> Self {
        Self { path: format!("csv/{name}.csv"), about, rows, columns: Vec::new() }
    }

    fn column(&mut self, name: impl Into<String>, value: impl Fn(usize) -> f64 + 'a) {
        self.columns.push(Column { name: name.into(), value: Box::new(value) });
    }

    /// Three linear and three angular columns.
    fn six(&mut self, linear: [&str; 2], angular: [&str; 2], values: &'a [[f64; 6]]) {
        for i in 0..6 {
            let [quantity, unit] = if i < 3 { linear } else { angular };
            self.column(format!("{quantity}_{}_{unit}", AXES[i % 3]), move |row| values[row][i]);
        }
    }

    fn accelerations(&mut self, values: &'a [[f64; 6]]) {
        self.six(["acceleration", "m_per_s2"], ["angular_acceleration", "rad_per_s2"], values);
    }

    /// Header line, then one line per sample. Numbers are the shortest that read back to the same bits.
    pub(super) fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        for (i, column) in self.columns.iter().enumerate() {
            write!(out, "{}{}", if i == 0 { "" } else { "," }, column.name)?;
        }
        writeln!(out)?;
        for row in 0..self.rows {
            for (i, column) in self.columns.iter().enumerate() {
                write!(out, "{}{:?}", if i == 0 { "" } else { "," }, (column.value)(row))?;
            }
            writeln!(out)?;
        }
        Ok(())
    }
}

/// Every curve of the report.
pub(super) fn curve_files<'a>(outcome: &'a Outcome, analysis: &'a Analysis) -> Vec<CurveFile<'a>> {
    let mut files = vec![motion("base", "motion of the base", &outcome.base)];
    if !outcome.target.time_s.is_empty() {
        files.push(motion("target", "wanted motion of the platform", &outcome.target));
    }
    files.push(actuators(outcome));
    for (simulation, number) in outcome.simulations.iter().zip(1..) {
        let name = format!("simulation_{number}_{}", file_name(&simulation.label));
        files.push(motion(&name, &format!("motion of the platform by {}", simulation.label), simulation));
    }
    files.extend(analysis.differences.iter().zip(1..).map(difference));
    files.extend(analysis.spectra.iter().zip(1..).map(spectrum));
    files.extend(outcome.amplitude_tables.iter().zip(1..).map(amplitudes));
    files
}

/// A label in lower-case letters, digits and underscores.
pub(super) fn file_name(label: &str) -> String {
    let replaced: String = label
        .chars()
        .map(|letter| if letter.is_ascii_alphanumeric() { letter.to_ascii_lowercase() } else { '_' })
        .collect();
    replaced.split('_').filter(|word| !word.is_empty()).collect::<Vec<_>>().join("_")
}

fn motion<'a>(name: &str, about: &str, series: &'a Series) -> CurveFile<'a> {
    let about = format!("{about}: position, rotation, velocity, acceleration, in inertial axes");
    let mut file = CurveFile::new(name, about, series.time_s.len());
    file.column("time_s", |row| series.time_s[row]);
    for (i, axis) in AXES.iter().enumerate() {
        file.column(format!("position_{axis}_m"), move |row| series.position_m[row][i]);
    }
    for (i, j) in (0..9).map(|entry| (entry / 3, entry % 3)) {
        file.column(format!("rotation_{}{}", AXES[i], AXES[j]), move |row| series.rotation[row][i][j]);
    }
    file.six(["velocity", "m_per_s"], ["angular_velocity", "rad_per_s"], &series.velocity);
    file.accelerations(&series.acceleration);
    file
}

fn actuators(outcome: &Outcome) -> CurveFile<'_> {
    let Outcome { base, actuator_force_n: forces, actuator_length_m: lengths, .. } = outcome;
    // A free platform may come without forces; what there is, is written.
    let present = [forces.len(), lengths.len()].into_iter().filter(|count| *count > 0).min().unwrap_or(0);
    let about = "actuator forces on the movers along the actuators' axes, and actuator lengths".to_owned();
    let mut file = CurveFile::new("actuators", about, present.min(base.time_s.len()));
    file.column("time_s", |row| base.time_s[row]);
    for leg in 0..6 {
        if !forces.is_empty() {
            file.column(format!("force_{}_n", leg + 1), move |row| forces[row][leg]);
        }
    }
    for leg in 0..6 {
        if !lengths.is_empty() {
            file.column(format!("length_{}_m", leg + 1), move |row| lengths[row][leg]);
        }
    }
    file
}

fn difference((difference, number): (&Difference, usize)) -> CurveFile<'_> {
    let name = format!("difference_{number}_{}", file_name(&difference.label));
    let about = format!("acceleration by {} minus target", difference.label);
    let mut file = CurveFile::new(&name, about, difference.time_s.len());
    file.column("time_s", |row| difference.time_s[row]);
    file.accelerations(&difference.acceleration);
    file
}

fn spectrum((spectrum, number): (&Spectrum, usize)) -> CurveFile<'_> {
    let name = format!("spectrum_{number}_{}", file_name(&spectrum.label));
    let about = format!("amplitude spectrum of the platform's acceleration: {}", spectrum.label);
    let mut file = CurveFile::new(&name, about, spectrum.frequency_hz.len());
    file.column("frequency_hz", |row| spectrum.frequency_hz[row]);
    file.accelerations(&spectrum.amplitude);
    file
}

fn amplitudes((table, number): (&AmplitudeTable, usize)) -> CurveFile<'_> {
    let name = format!("amplitudes_{number}_{}", file_name(&table.label));
    let about = format!("errors and amplitudes at the excited frequencies, {}", table.label);
    let mut file = CurveFile::new(&name, about, table.frequencies_hz.len());
    file.column("frequency_hz", |row| table.frequencies_hz[row]);
    for (i, component) in COMPONENTS.iter().enumerate() {
        let unit = if i < 3 { "m_per_s2" } else { "rad_per_s2" };
        let component = component.to_lowercase();
        let columns = [
            (format!("{component}_error_percent"), Some(&table.error_percent)),
            (format!("{component}_amplitude_{unit}"), Some(&table.amplitude)),
            (format!("{component}_target_amplitude_{unit}"), Some(&table.target_amplitude)),
            (format!("{component}_paper_percent"), table.paper_percent.as_ref()),
        ];
        for (name, values) in columns {
            if let Some(values) = values {
                // A simulation that stopped early has no amplitudes.
                file.column(name, move |row| values.get(row).map_or(f64::NAN, |row| row[i]));
            }
        }
    }
    file
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_read_back_to_the_same_bits() {
        let awkward = [0.1 + 0.2, -0.0, 5e-324, f64::MAX, 1e-7, std::f64::consts::PI];
        let mut random = awkward.to_vec();
        let mut state = 1u64;
        for _ in 0..3000 {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            random.push(f64::from_bits(state));
        }
        random.retain(|value| !value.is_nan());
        let mut file = CurveFile::new("numbers", String::new(), random.len());
        file.column("value_m", |row| random[row]);
        file.column("negative_m", |row| -random[row]);
        let mut text = Vec::new();
        file.write(&mut text).expect("memory");
        let text = String::from_utf8(text).expect("text");
        let mut lines = text.lines();
        assert_eq!(lines.next(), Some("value_m,negative_m"));
        for (line, value) in lines.zip(&random) {
            let read: Vec<u64> =
                line.split(',').map(|field| field.parse::<f64>().expect(field).to_bits()).collect();
            assert_eq!(read, [value.to_bits(), (-value).to_bits()], "{line}");
        }
        assert_eq!(text.lines().count(), random.len() + 1);
    }

    #[test]
    fn every_header_carries_units_and_every_line_all_columns() {
        let outcome = super::super::example::outcome();
        let analysis = Analysis::new(&outcome);
        let files = curve_files(&outcome, &analysis);
        for file in &files {
            let mut text = Vec::new();
            file.write(&mut text).expect("memory");
            let text = String::from_utf8(text).expect("text");
            let header = text.lines().next().expect("header");
            let has_unit = |name: &str| {
                ["_s", "_m", "_hz", "_n", "_s2", "_percent"].iter().any(|unit| name.ends_with(unit))
                    || name.starts_with("rotation_")
            };
            assert!(header.split(',').all(has_unit), "{}: {header}", file.path);
            let columns = header.split(',').count();
            assert!(text.lines().all(|line| line.split(',').count() == columns), "{}", file.path);
        }
        let mut paths: Vec<&str> = files.iter().map(|file| file.path.as_str()).collect();
        let count = paths.len();
        paths.sort_unstable();
        paths.dedup();
        assert_eq!(paths.len(), count);
        assert!(paths.contains(&"csv/simulation_2_exudyn_1_13_8.csv"), "{paths:?}");
    }
}
