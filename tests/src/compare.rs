//! Deviations between arrays, relative in the maximum norm.

/// What an array's deviation is relative to.
#[derive(Clone, Copy, Debug)]
pub struct Scale(f64);

impl Scale {
    /// The largest entry of the expected array itself.
    pub fn own() -> Scale {
        Scale(0.0)
    }

    /// For scalars, the largest value over a run of states: a single energy may be zero by the choice of its datum.
    /// Arrays are measured by their own entries.
    pub fn of<'a>(expected: impl Iterator<Item = &'a [f64]>) -> Scale {
        let scalars = expected.filter(|values| values.len() == 1);
        Scale(scalars.fold(0.0, |most, values| most.max(values[0].abs())))
    }
}

/// Largest absolute difference over the largest entry of `expected` (or the scale, where that is larger); 0 where nothing
/// differs, NaN where a NaN is.
pub fn deviation(actual: &[f64], expected: &[f64], scale: Scale) -> f64 {
    assert_eq!(actual.len(), expected.len(), "arrays of different length");
    let largest = expected.iter().fold(scale.0, |most, x| most.max(x.abs()));
    let difference = actual.iter().zip(expected).fold(0.0_f64, |most, (a, b)| {
        let d = (a - b).abs();
        if d.is_nan() || most.is_nan() { f64::NAN } else { most.max(d) }
    });
    if difference == 0.0 { 0.0 } else { difference / largest }
}

/// Whether a deviation is acceptable; NaN is not.
pub fn within(deviation: f64, tolerance: f64) -> bool {
    deviation <= tolerance
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_nan_is_never_within() {
        assert!(!within(deviation(&[f64::NAN, 1.0], &[1.0, 1.0], Scale::own()), 1.0));
        assert!(!within(deviation(&[1.0, 1.0], &[1.0, f64::NAN], Scale::own()), 1.0));
    }

    #[test]
    fn deviation_is_relative_to_the_largest_entry() {
        assert_eq!(deviation(&[10.0, 1.5], &[10.0, 1.0], Scale::own()), 0.05);
        assert_eq!(deviation(&[0.0, 0.0], &[0.0, 0.0], Scale::own()), 0.0);
        assert_eq!(deviation(&[1e-300], &[0.0], Scale::own()), f64::INFINITY);
    }

    #[test]
    fn only_scalars_take_the_scale_of_a_run() {
        let scalars: [&[f64]; 2] = [&[0.0], &[-8.0]];
        assert_eq!(deviation(&[1.0], &[0.0], Scale::of(scalars.into_iter())), 0.125);
        let arrays: [&[f64]; 1] = [&[8.0, 8.0]];
        assert_eq!(deviation(&[1.0, 2.0], &[1.0, 1.0], Scale::of(arrays.into_iter())), 1.0);
    }
}
