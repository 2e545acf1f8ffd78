//! Linear systems in lanes: [`solve::solve_general`](crate::solve::solve_general) with pivots chosen per lane, and attempts.

use super::Lanes;

/// The same steps in the same order as [`solve::by_elimination`](crate::solve), so that each lane gets its bits.
#[inline(always)]
pub(super) fn by_elimination<T: Lanes, const N: usize>(
    matrix: &[[T; N]; N],
    right_hand_side: &[T; N],
) -> [T; N] {
    let (mut rows, mut right) = (*matrix, *right_hand_side);
    let mut scales = [T::constant(0.0); N];
    for (scale, row) in scales.iter_mut().zip(&rows) {
        for element in row {
            *scale = larger(*scale, element.absolute());
        }
    }
    let mut inverse_scales = scales.map(|scale| T::constant(1.0) / scale);
    let mut reciprocals = inverse_scales;
    for column in 0..N {
        exchange_for_largest(&mut rows, &mut right, &mut inverse_scales, column);
        let (pivot, known) = (rows[column], right[column]);
        reciprocals[column] = T::constant(1.0) / pivot[column];
        for below in column + 1..N {
            let factor = rows[below][column] * reciprocals[column];
            for k in column + 1..N {
                rows[below][k] = rows[below][k] - factor * pivot[k];
            }
            right[below] = right[below] - factor * known;
        }
    }
    for i in (0..N).rev() {
        let mut sum = right[i];
        for k in i + 1..N {
            sum = sum - rows[i][k] * right[k];
        }
        right[i] = sum * reciprocals[i];
    }
    right
}

/// [`Scalar::unless_wrong`](crate::float::Scalar::unless_wrong), `most` the square of the largest residual in relation to the
/// terms.
#[inline(always)]
pub(super) fn unless_wrong<T: Lanes, const N: usize>(
    attempt: &[T; N],
    residuals: &[T; N],
    squares: &[T; N],
    most: T,
    matrix: &[[T; N]; N],
    right_hand_side: &[T; N],
) -> [T; N] {
    let (zero, one) = (T::constant(0.0), T::constant(1.0));
    let mut right = one;
    for row in 0..N {
        // As of single numbers: squares that overflow make no number here.
        let overflow = squares[row] * zero;
        let small = (residuals[row] * residuals[row]).less_than(most * squares[row] + overflow);
        right = T::select(small, right, zero);
    }
    let right = zero.less_than(right);
    if T::bits(right).count_ones() as usize == T::COUNT {
        return *attempt;
    }
    let mut solution = by_elimination(matrix, right_hand_side);
    for row in 0..N {
        solution[row] = T::select(right, attempt[row], solution[row]);
    }
    solution
}

/// As [`f64::max`]: the other one where one is NaN.
#[inline(always)]
fn larger<T: Lanes>(largest: T, number: T) -> T {
    T::select(largest.less_than(number), number, largest)
}

/// Puts the row with the relatively largest coefficient in `column` into the pivot's place.
#[inline(always)]
fn exchange_for_largest<T: Lanes, const N: usize>(
    rows: &mut [[T; N]; N],
    right: &mut [T; N],
    inverse_scales: &mut [T; N],
    column: usize,
) {
    // The chosen row as a number per lane.
    let mut chosen = T::constant(column as f64);
    let mut largest = rows[column][column].absolute() * inverse_scales[column];
    for below in column + 1..N {
        let size = rows[below][column].absolute() * inverse_scales[below];
        let better = largest.less_than(size);
        largest = T::select(better, size, largest);
        chosen = T::select(better, T::constant(below as f64), chosen);
    }
    for below in column + 1..N {
        let here = (chosen - T::constant(below as f64)).absolute().less_than(T::constant(0.5));
        let (above, from_below) = rows.split_at_mut(below);
        let (pivot, row) = (&mut above[column], &mut from_below[0]);
        for k in column..N {
            exchange(here, &mut pivot[k], &mut row[k]);
        }
        let (above, from_below) = right.split_at_mut(below);
        exchange(here, &mut above[column], &mut from_below[0]);
        let (above, from_below) = inverse_scales.split_at_mut(below);
        exchange(here, &mut above[column], &mut from_below[0]);
    }
}

/// Exchanges two numbers where the mask is true.
#[inline(always)]
fn exchange<T: Lanes>(here: T::Mask, a: &mut T, b: &mut T) {
    (*a, *b) = (T::select(here, *b, *a), T::select(here, *a, *b));
}
