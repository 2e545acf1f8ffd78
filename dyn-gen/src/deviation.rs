//! How far arrays of numbers are apart, and how far they may be. A broken value never passes for a small deviation.

/// What an array's deviation is relative to, at least.
#[derive(Clone, Copy, Debug)]
pub struct Scale(f64);

impl Scale {
    /// The largest entry of the expected array itself.
    pub fn own() -> Scale {
        Scale(0.0)
    }

    /// For scalars, the largest value over a run of states: a single energy may be zero by the choice of its datum.
    /// Arrays are measured by their own entries.
    pub fn of<'a>(expected: impl IntoIterator<Item = &'a [f64]>) -> Scale {
        let scalars = expected.into_iter().filter(|values| values.len() == 1);
        Scale(scalars.fold(0.0, |most, values| larger(most, values[0].abs())))
    }
}

/// Part of an array's largest entry over a run that its entries at a single state are measured by at least.
const RESIDUE: f64 = 1e-3;

impl Scale {
    /// As [`Scale::of`], and for arrays a thousandth of the largest entry over the run: what a state leaves of terms that
    /// cancel, as springs relaxed at home do, has no digits of its own.
    pub fn over<'a>(expected: impl IntoIterator<Item = &'a [f64]>) -> Scale {
        let parts = expected.into_iter().map(|values| {
            let largest = values.iter().fold(0.0, |most, x| larger(most, x.abs()));
            if values.len() == 1 { largest } else { RESIDUE * largest }
        });
        Scale(parts.fold(0.0, larger))
    }
}

/// Largest deviation over the largest expected entry (or the scale, where that is larger); infinite where lengths differ or
/// everything expected is zero, NaN where a value is not a number.
pub fn relative_error(found: &[f64], expected: &[f64], scale: Scale) -> f64 {
    if found.len() != expected.len() {
        return f64::INFINITY;
    }
    let largest = expected.iter().fold(scale.0, |most, x| larger(most, x.abs()));
    let deviation = found.iter().zip(expected).fold(0.0, |most, (x, y)| larger(most, (x - y).abs()));
    if deviation == 0.0 { 0.0 } else { deviation / largest }
}

/// The larger number; NaN wins, so that a broken value cannot hide.
pub fn larger(a: f64, b: f64) -> f64 {
    if a >= b || a.is_nan() { a } else { b }
}

/// Allowed deviation of an output.
#[derive(Clone, Copy, Debug)]
pub struct Tolerance {
    /// Outputs it is for.
    pub outputs: &'static [&'static str],
    /// Largest relative error in the maximum norm.
    pub relative: f64,
    /// Why not tighter.
    pub reason: &'static str,
}

/// Tolerances that differ from [`DEFAULT`].
pub const TOLERANCES: &[Tolerance] = &[Tolerance {
    outputs: &["inverse_dynamics", "passive_inverse_dynamics"],
    relative: 1e-11,
    reason: "rounding errors are multiplied by the condition number of J_dp, up to 1000 near the edge",
}];

/// Matrices, Jacobians, bias, accelerations, kinematics, energies.
pub const DEFAULT: Tolerance = Tolerance {
    outputs: &[],
    relative: 1e-12,
    reason: "sums of some hundred rounded terms, partly cancelling: some thousand times the unit roundoff",
};

/// The largest relative error that an output may have.
pub fn tolerance(output: &str) -> f64 {
    TOLERANCES.iter().find(|row| row.outputs.contains(&output)).unwrap_or(&DEFAULT).relative
}

/// Whether a relative error of an output is acceptable; NaN is not.
pub fn within(error: f64, output: &str) -> bool {
    error <= tolerance(output)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn own(found: &[f64], expected: &[f64]) -> f64 {
        relative_error(found, expected, Scale::own())
    }

    #[test]
    fn errors_are_relative_to_the_largest_entry_and_broken_values_show() {
        assert_eq!(own(&[1.0, 4.0], &[1.5, 4.0]), 0.125);
        assert_eq!(own(&[0.0], &[0.0]), 0.0);
        assert_eq!(own(&[1.0], &[0.0]), f64::INFINITY);
        assert_eq!(own(&[1.0], &[1.0, 2.0]), f64::INFINITY);
        assert!(own(&[1.0, f64::NAN], &[1.0, 1.0]).is_nan());
        assert!(own(&[f64::NAN, 2.0], &[1.0, 1.0]).is_nan());
        assert!(!within(f64::NAN, "bias"));
    }

    #[test]
    fn what_cancels_at_one_state_is_measured_by_the_run() {
        let run: [&[f64]; 2] = [&[1e-16, 2e-16], &[100.0, 50.0]];
        assert!((relative_error(&[2e-16, 2e-16], run[0], Scale::over(run)) / 1e-15 - 1.0).abs() < 1e-12);
        assert_eq!(relative_error(&[100.0, 51.0], run[1], Scale::over(run)), 0.01);
        let scalars: [&[f64]; 2] = [&[0.0], &[-8.0]];
        assert_eq!(relative_error(&[1.0], &[0.0], Scale::over(scalars)), 0.125);
    }

    #[test]
    fn only_scalars_take_the_scale_of_a_run() {
        let scalars: [&[f64]; 2] = [&[0.0], &[-8.0]];
        assert_eq!(relative_error(&[1.0], &[0.0], Scale::of(scalars)), 0.125);
        let arrays: [&[f64]; 1] = [&[8.0, 8.0]];
        assert_eq!(relative_error(&[1.0, 2.0], &[1.0, 1.0], Scale::of(arrays)), 1.0);
    }
}
