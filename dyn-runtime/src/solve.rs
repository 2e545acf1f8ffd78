//! Small dense linear systems: bounded work, no allocation, no panic.
//!
//! Gaussian elimination with scaled partial pivoting. Scaling is implicit (it only chooses the pivot), so
//! rows in newtons beside rows in newton metres do not disturb the choice. Growth stays below 2^(N-1), 32 for
//! six unknowns.

mod attempt;

use core::mem;

pub(crate) use attempt::MOST_RESIDUAL;
pub use attempt::{solve_after_attempt, solve_after_attempt_in_lanes};

use crate::float::Scalar;
use crate::real::Real;

/// One row of the system `coefficients * x = right`, K right-hand sides at once.
#[derive(Clone, Copy)]
struct Row<T, const N: usize, const K: usize> {
    coefficients: [T; N],
    right: [T; K],
    /// One over the largest coefficient of the row as given; the pivot is the one largest relative to it.
    inverse_scale: T,
}

/// Solves `matrix * x = right_hand_side`; `matrix` is row-major.
///
/// A singular matrix gives huge or non-finite numbers, non-finite entries give non-finite numbers: whoever
/// cannot exclude them asks [`reciprocal_condition`].
///
/// ```
/// // The first pivot is zero: rows are exchanged.
/// let x = dyn_runtime::solve::solve_general(&[[0.0, 2.0], [4.0, 0.0]], &[6.0, 4.0]);
/// assert_eq!(x, [1.0, 3.0]);
/// ```
pub fn solve_general<T: Scalar, const N: usize>(matrix: &[[T; N]; N], right_hand_side: &[T; N]) -> [T; N] {
    T::solve_general(matrix, right_hand_side)
}

/// [`Scalar::solve_general`] of a single number.
pub(crate) fn by_elimination<T: Real, const N: usize>(
    matrix: &[[T; N]; N],
    right_hand_side: &[T; N],
) -> [T; N] {
    solve_columns(matrix, &right_hand_side.map(|element| [element])).map(|[element]| element)
}

/// Reciprocal condition number in the 1-norm, `1 / (|A| |A^-1|)`, from the explicit inverse: 1 for the
/// identity, towards 0 for matrices near a singular one, 0 where the inverse does not exist or an entry is
/// not finite.
///
/// ```
/// assert_eq!(dyn_runtime::solve::reciprocal_condition(&[[1.0, 0.0], [0.0, 0.25]]), 0.25);
/// ```
pub fn reciprocal_condition<T: Real, const N: usize>(matrix: &[[T; N]; N]) -> T {
    let mut identity = [[T::zero(); N]; N];
    for (i, row) in identity.iter_mut().enumerate() {
        row[i] = T::one();
    }
    let condition = one_norm(matrix) * one_norm(&solve_columns(matrix, &identity));
    // Rounding can leave the condition number of a perfect matrix just below 1.
    if condition.is_finite() && condition > T::zero() {
        (T::one() / condition).min(T::one())
    } else {
        T::zero()
    }
}

/// Solution of `matrix * x = right` and `|det matrix|`, for six rows of about equal size: Gaussian elimination with
/// partial pivoting. Not finite or 0 where [`solve_general`] is so.
pub(crate) fn solve_even_rows<T: Real>(matrix: &[[T; 6]; 6], right: &[T; 6]) -> ([T; 6], T) {
    let mut system = Six { rows: *matrix, right: *right };
    // One function per column, so that loops have constant lengths and the compiler unrolls them.
    let pivots = [
        system.eliminate::<0>(),
        system.eliminate::<1>(),
        system.eliminate::<2>(),
        system.eliminate::<3>(),
        system.eliminate::<4>(),
        system.eliminate::<5>(),
    ];
    system.substitute::<5>();
    system.substitute::<4>();
    system.substitute::<3>();
    system.substitute::<2>();
    system.substitute::<1>();
    system.substitute::<0>();
    (system.right, pivots.into_iter().fold(T::one(), |product, pivot| product * pivot).abs())
}

/// Six equations.
struct Six<T> {
    rows: [[T; 6]; 6],
    right: [T; 6],
}

impl<T: Real> Six<T> {
    /// Chooses the pivot of column K, clears the column below it, and gives the pivot.
    #[inline(always)]
    fn eliminate<const K: usize>(&mut self) -> T {
        let Self { rows, right } = self;
        for below in K + 1..6 {
            if rows[below][K].abs() > rows[K][K].abs() {
                rows.swap(K, below);
                right.swap(K, below);
            }
        }
        let (pivot, known) = (rows[K], right[K]);
        let reciprocal = T::one() / pivot[K];
        for below in K + 1..6 {
            let factor = rows[below][K] * reciprocal;
            for column in K + 1..6 {
                rows[below][column] -= factor * pivot[column];
            }
            right[below] -= factor * known;
        }
        pivot[K]
    }

    /// Puts the unknowns after K into equation K.
    #[inline(always)]
    fn substitute<const K: usize>(&mut self) {
        let Self { rows, right } = self;
        let mut sum = right[K];
        for column in K + 1..6 {
            sum -= rows[K][column] * right[column];
        }
        right[K] = sum / rows[K][K];
    }
}

/// Largest column sum of absolute values; NaN if an entry is NaN.
pub(crate) fn one_norm<T: Real, const N: usize>(matrix: &[[T; N]; N]) -> T {
    let mut sums = [T::zero(); N];
    for row in matrix {
        for (sum, element) in sums.iter_mut().zip(row) {
            *sum += element.abs();
        }
    }
    // `max` would drop a NaN.
    sums.into_iter().fold(T::zero(), |largest, sum| if sum <= largest { largest } else { sum })
}

/// Solves for the K columns of `right` at once.
fn solve_columns<T: Real, const N: usize, const K: usize>(
    matrix: &[[T; N]; N],
    right: &[[T; K]; N],
) -> [[T; K]; N] {
    let mut rows = [Row { coefficients: [T::zero(); N], right: [T::zero(); K], inverse_scale: T::zero() }; N];
    for (row, (coefficients, right)) in rows.iter_mut().zip(matrix.iter().zip(right)) {
        let scale = coefficients.iter().fold(T::zero(), |largest: T, element| largest.max(element.abs()));
        *row = Row { coefficients: *coefficients, right: *right, inverse_scale: T::one() / scale };
    }

    let mut remaining = rows.as_mut_slice();
    let mut reciprocals = [T::zero(); N];
    for (column, reciprocal) in reciprocals.iter_mut().enumerate() {
        let Some((pivot, below)) = mem::take(&mut remaining).split_first_mut() else { break };
        exchange_for_largest(pivot, below, column);
        *reciprocal = T::one() / pivot.coefficients[column];
        for row in below.iter_mut() {
            row.subtract(pivot, column, *reciprocal);
        }
        remaining = below;
    }

    let mut solution = [[T::zero(); K]; N];
    for (i, row) in rows.iter().enumerate().rev() {
        let mut sum = row.right;
        for (coefficient, known) in row.coefficients.iter().zip(&solution).skip(i + 1) {
            for (sum, known) in sum.iter_mut().zip(known) {
                *sum -= *coefficient * *known;
            }
        }
        solution[i] = sum.map(|sum| sum * reciprocals[i]);
    }
    solution
}

/// Puts the row with the relatively largest coefficient in `column` into the pivot's place.
fn exchange_for_largest<T: Real, const N: usize, const K: usize>(
    pivot: &mut Row<T, N, K>,
    below: &mut [Row<T, N, K>],
    column: usize,
) {
    let mut largest = pivot.relative_size(column);
    let mut chosen = None;
    for row in below {
        let size = row.relative_size(column);
        if size > largest {
            largest = size;
            chosen = Some(row);
        }
    }
    if let Some(row) = chosen {
        mem::swap(pivot, row);
    }
}

impl<T: Real, const N: usize, const K: usize> Row<T, N, K> {
    fn relative_size(&self, column: usize) -> T {
        self.coefficients[column].abs() * self.inverse_scale
    }

    /// Eliminates `column` from this row with the help of the pivot row and one over its coefficient there.
    fn subtract(&mut self, pivot: &Self, column: usize, reciprocal: T) {
        let factor = self.coefficients[column] * reciprocal;
        for (element, pivot) in self.coefficients.iter_mut().zip(&pivot.coefficients).skip(column + 1) {
            *element -= factor * *pivot;
        }
        for (element, pivot) in self.right.iter_mut().zip(&pivot.right) {
            *element -= factor * *pivot;
        }
    }
}
