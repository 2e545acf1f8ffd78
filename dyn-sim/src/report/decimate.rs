//! Thinning of long curves for drawing: first, lowest, highest and last sample of each pixel column.

/// Indices of the samples worth drawing when `x` from `range[0]` to `range[1]` takes `columns` pixels.
///
/// `x` ascends; samples outside the range are left out. Of the samples in one column the first, the lowest, the
/// highest and the last stay, so that the drawn line covers the same pixels and no extreme is lost. The first of
/// consecutive non-finite samples stays too: the line breaks there.
pub(super) fn decimate(x: &[f64], y: &[f64], range: [f64; 2], columns: usize) -> Vec<usize> {
    // Rounding of the window's ends must not cost the first or last sample.
    let slack = 1e-9 * (range[1] - range[0]);
    let start = x.partition_point(|&x| x < range[0] - slack);
    let end = x.partition_point(|&x| x <= range[1] + slack).min(y.len());
    let per_unit = columns as f64 / (range[1] - range[0]);
    let column = |i: usize| {
        let place = ((x[i] - range[0]) * per_unit) as usize;
        (place.min(columns.saturating_sub(1)), y[i].is_finite())
    };

    let mut kept = Vec::new();
    let mut first = start;
    while first < end {
        let mut next = first + 1;
        while next < end && column(next) == column(first) {
            next += 1;
        }
        if y[first].is_finite() {
            let bucket = || first..next;
            let lowest = bucket().min_by(|&i, &j| y[i].total_cmp(&y[j])).unwrap_or(first);
            let highest = bucket().max_by(|&i, &j| y[i].total_cmp(&y[j])).unwrap_or(first);
            let mut chosen = [first, lowest, highest, next - 1];
            chosen.sort_unstable();
            kept.extend_from_slice(&chosen);
            kept.dedup();
        } else {
            kept.push(first);
        }
        first = next;
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn extremes_of_every_column_stay() {
        let count = 20_000;
        let x: Vec<f64> = (0..count).map(|i| i as f64 / f64::from(count)).collect();
        let mut y: Vec<f64> = x.iter().map(|x| (1234.5 * x).sin() + (77.0 * x).cos()).collect();
        y[12_345] = 40.0;
        y[12_346] = -50.0;
        let columns = 300;
        let kept = decimate(&x, &y, [0.0, 1.0], columns);
        assert!(kept.len() <= 4 * columns, "{} samples stay", kept.len());
        assert!(kept.is_sorted_by(|i, j| i < j));
        assert!(kept.contains(&12_345) && kept.contains(&12_346));

        let extremes = |indices: &mut dyn Iterator<Item = usize>| {
            let mut found = vec![[f64::INFINITY, f64::NEG_INFINITY]; columns];
            for i in indices {
                let [low, high] = &mut found[(x[i] * columns as f64) as usize];
                (*low, *high) = (low.min(y[i]), high.max(y[i]));
            }
            found
        };
        assert_eq!(extremes(&mut (0..x.len())), extremes(&mut kept.into_iter()));
    }

    #[test]
    fn short_curves_stay_whole_and_windows_cut() {
        let x = [0.0, 0.1, 0.2, 0.30000000000000004, 0.4];
        let y = [1.0, f64::NAN, 2.0, 3.0, 4.0];
        assert_eq!(decimate(&x, &y, [0.0, 0.4], 100), [0, 1, 2, 3, 4]);
        assert_eq!(decimate(&x, &y, [0.1, 0.3], 100), [1, 2, 3]);
    }

    #[test]
    fn a_run_without_numbers_is_one_gap() {
        let x: Vec<f64> = (0..1000).map(f64::from).collect();
        let y = vec![f64::NAN; 1000];
        assert_eq!(decimate(&x, &y, [0.0, 999.0], 1), [0]);
    }
}
