//! Simulated against wanted motion: complex amplitudes as in the paper's Table 4, and errors in the time domain.

use realfft::num_complex::Complex;

use crate::outcome::{AmplitudeTable, Series, TimeErrors};
use crate::spectrum::Plan;

/// A target component this much smaller than the largest of its kind (linear, angular) has no relative error.
const NEGLIGIBLE: f64 = 1e-9;

/// Errors of the complex amplitudes of `simulated` against those of `target`.
pub fn amplitude_table(
    plan: &Plan,
    frequencies_hz: &[f64],
    target: &Series,
    simulated: &Series,
    paper_percent: Option<&[[f64; 6]]>,
) -> AmplitudeTable {
    let wanted = plan.amplitudes(&target.acceleration, frequencies_hz);
    let found = plan.amplitudes(&simulated.acceleration, frequencies_hz);
    let largest = |kind: usize| {
        wanted.iter().flat_map(|row| &row[3 * kind..3 * kind + 3]).map(|a| a.norm()).fold(0.0, f64::max)
    };
    let least = [largest(0) * NEGLIGIBLE, largest(1) * NEGLIGIBLE];
    let error = |(wanted, found): (&[Complex<f64>; 6], &[Complex<f64>; 6])| {
        std::array::from_fn(|i| {
            let size = wanted[i].norm();
            if size > least[i / 3] { 100.0 * finite((found[i] - wanted[i]).norm()) / size } else { f64::NAN }
        })
    };
    AmplitudeTable {
        label: simulated.label.clone(),
        frequencies_hz: frequencies_hz.to_vec(),
        error_percent: wanted.iter().zip(&found).map(error).collect(),
        amplitude: found.iter().map(|row| row.map(|a| a.norm())).collect(),
        target_amplitude: wanted.iter().map(|row| row.map(|a| a.norm())).collect(),
        paper_percent: paper_percent.map(<[_]>::to_vec),
    }
}

/// Errors in the time domain over the samples that both have.
pub fn time_errors(reference: &Series, simulated: &Series) -> TimeErrors {
    let part = |a: &[f64; 6], kind: usize| [a[3 * kind], a[3 * kind + 1], a[3 * kind + 2]];
    let difference = |a: [f64; 3], b: [f64; 3]| finite(norm(std::array::from_fn(|i| a[i] - b[i])));
    // Largest error and largest value of the linear or the angular acceleration.
    let error_and_size = |kind: usize| {
        let mut error = 0.0_f64;
        let mut size = 0.0_f64;
        for (wanted, found) in reference.acceleration.iter().zip(&simulated.acceleration) {
            error = error.max(difference(part(wanted, kind), part(found, kind)));
            size = size.max(norm(part(wanted, kind)));
        }
        (error, size)
    };
    let parts = [error_and_size(0), error_and_size(1)];
    let relative = parts.into_iter().filter(|(_, size)| *size > 0.0).map(|(error, size)| error / size);
    let positions = reference.position_m.iter().zip(&simulated.position_m);
    TimeErrors {
        label: simulated.label.clone(),
        reference: reference.label.clone(),
        acceleration_relative: relative.reduce(f64::max).unwrap_or(f64::NAN),
        linear_m_s2: parts[0].0,
        angular_rad_s2: parts[1].0,
        position_m: positions.map(|(wanted, found)| difference(*wanted, *found)).fold(0.0, f64::max),
    }
}

/// A broken value is infinitely wrong: as a NaN it would lose every comparison and count as no error.
fn finite(deviation: f64) -> f64 {
    if deviation.is_nan() { f64::INFINITY } else { deviation }
}

fn norm(v: [f64; 3]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// The largest entry of a table's errors, percent; cells without a target do not count.
pub fn worst_percent(table: &AmplitudeTable) -> f64 {
    table.error_percent.iter().flatten().copied().filter(|e| !e.is_nan()).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_simulation_that_broke_is_infinitely_wrong() {
        let target = Series {
            label: "target".into(),
            time_s: vec![0.0],
            position_m: vec![[0.0; 3]],
            rotation: vec![[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]],
            velocity: vec![[0.0; 6]],
            acceleration: vec![[1.0; 6]],
        };
        let mut broken = target.clone();
        broken.acceleration[0][4] = f64::NAN;
        broken.position_m[0][2] = f64::NAN;
        let errors = time_errors(&target, &broken);
        assert_eq!((errors.acceleration_relative, errors.position_m), (f64::INFINITY, f64::INFINITY));
    }

    /// Nothing is relative to a body at rest: an error there must not pass for none.
    #[test]
    fn a_target_at_rest() {
        let still = Series { acceleration: vec![[0.0; 6]], position_m: vec![[0.0; 3]], ..Series::default() };
        let mut moved = still.clone();
        moved.acceleration[0] = [0.0, 3.0, 4.0, 0.0, 0.0, 2.0];
        let errors = time_errors(&still, &moved);
        assert!(errors.acceleration_relative.is_nan());
        assert_eq!((errors.linear_m_s2, errors.angular_rad_s2, errors.position_m), (5.0, 2.0, 0.0));
    }
}
