//! Axes: ranges, ticks at round numbers, labels, unit prefixes.

/// `[low, high]` of the finite values, or `None` if there are none.
pub(super) fn extent(values: impl Iterator<Item = f64>) -> Option<[f64; 2]> {
    values.filter(|value| value.is_finite()).fold(None, |range, value| match range {
        None => Some([value, value]),
        Some([low, high]) => Some([f64::min(low, value), f64::max(high, value)]),
    })
}

/// The extent with room above and below; a constant gets room as well.
pub(super) fn padded([low, high]: [f64; 2]) -> [f64; 2] {
    let size = low.abs().max(high.abs());
    let span = high - low;
    // Below 1e-12 of its size a span is rounding, not a curve.
    let room = if span > 1e-12 * size {
        0.08 * span
    } else if size > 0.0 {
        0.5 * size
    } else {
        1.0
    };
    [low - room, high + room]
}

/// Ticks at multiples of 1, 2 or 5 times a power of ten, `count` of them or up to 2.5 times as many, and the decimals
/// their labels need.
pub(super) fn linear_ticks([low, high]: [f64; 2], count: usize) -> (Vec<f64>, usize) {
    let widest = (high - low) / count as f64;
    let decade = 10f64.powf(widest.log10().floor());
    let step = [5.0, 2.0, 1.0]
        .map(|multiple| multiple * decade)
        .into_iter()
        .find(|step| *step <= 1.001 * widest)
        .unwrap_or(decade);
    let decimals = (-(step * 1.0001).log10().floor()).max(0.0) as usize;
    let first = (low / step).ceil() as i64;
    let last = (high / step).floor() as i64;
    ((first..=last).map(|multiple| multiple as f64 * step).collect(), decimals)
}

/// Powers of ten in the range, thinned to at most `count`.
pub(super) fn log_ticks([low, high]: [f64; 2], count: usize) -> Vec<f64> {
    let first = low.log10().ceil() as i32;
    let last = high.log10().floor() as i32;
    let stride = ((last - first) as usize / count.max(1) + 1).max(1);
    (first..=last).rev().step_by(stride).map(|exponent| 10f64.powi(exponent)).collect()
}

/// A label with a true minus sign.
pub(super) fn fixed(value: f64, decimals: usize) -> String {
    let text = format!("{:.decimals$}", value + 0.0);
    match text.strip_prefix('-') {
        Some(digits) if digits.bytes().all(|byte| matches!(byte, b'0' | b'.')) => digits.to_owned(),
        Some(digits) => format!("\u{2212}{digits}"),
        None => text,
    }
}

/// `10⁻⁶` and the like.
pub(super) fn power_of_ten(exponent: i32) -> String {
    const SUPERSCRIPTS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let mut text = "10".to_owned();
    for character in exponent.to_string().chars() {
        text.push(character.to_digit(10).map_or('⁻', |digit| SUPERSCRIPTS[digit as usize]));
    }
    text
}

/// Name and factor of the SI prefix that brings `largest` to between 1 and 1000; no prefix above one.
pub(super) fn prefix(largest: f64) -> (&'static str, f64) {
    const PREFIXES: [(&str, f64); 6] =
        [("", 1.0), ("m", 1e-3), ("µ", 1e-6), ("n", 1e-9), ("p", 1e-12), ("f", 1e-15)];
    if largest == 0.0 {
        return PREFIXES[0];
    }
    // 0.999: a largest value of one unit less a rounding keeps the unit.
    *PREFIXES.iter().find(|(_, factor)| largest >= 0.999 * factor).unwrap_or(&PREFIXES[5])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_inside() {
        assert_eq!(linear_ticks([-0.5, 10.5], 4), (vec![0.0, 2.0, 4.0, 6.0, 8.0, 10.0], 0));
        let (ticks, decimals) = linear_ticks([0.9, 1.0], 5);
        let labels: Vec<String> = ticks.into_iter().map(|tick| fixed(tick, decimals)).collect();
        assert_eq!(labels, ["0.90", "0.92", "0.94", "0.96", "0.98", "1.00"]);
        assert_eq!(log_ticks([3e-4, 2.0], 9), [1.0, 0.1, 0.01, 0.001]);
        assert_eq!(log_ticks([1e-8, 1.0], 5), [1.0, 1e-2, 1e-4, 1e-6, 1e-8]);
    }

    #[test]
    fn labels_are_typeset() {
        assert_eq!(fixed(-2.5, 1), "\u{2212}2.5");
        assert_eq!(fixed(-0.0, 0), "0");
        assert_eq!(fixed(-0.04, 1), "0.0");
        assert_eq!(power_of_ten(-16), "10⁻¹⁶");
        assert_eq!(power_of_ten(4), "10⁴");
        assert_eq!(prefix(0.004), ("m", 1e-3));
        assert_eq!(prefix(3.0), ("", 1.0));
        assert_eq!(prefix(1e-6), ("µ", 1e-6));
        assert_eq!(prefix(0.0), ("", 1.0));
    }

    #[test]
    fn ranges_are_never_empty() {
        assert_eq!(extent([f64::NAN, 2.0, -1.0, f64::INFINITY].into_iter()), Some([-1.0, 2.0]));
        assert_eq!(extent([f64::NAN].into_iter()), None);
        for constant in [0.0, 5.0, -5.0] {
            let [low, high] = padded([constant, constant]);
            assert!(low < constant && constant < high);
        }
    }
}
