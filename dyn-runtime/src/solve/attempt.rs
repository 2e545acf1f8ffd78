//! Systems of six equations whose solution is known already, most probably.
//!
//! Generated code solves in 3 x 3 blocks, which needs two divisions where elimination needs six and no comparison. That keeps
//! the digits where the first block is far from singular; nobody can promise so of numbers that come at run time. So it is
//! examined: the attempt counts where its residual shows that it solves a system whose rows differ from the given ones by
//! rounding errors (backward stability), and elimination with pivots does the work elsewhere.

use crate::float::Scalar;
use crate::triple::Triple;

/// Largest residual of a row over the root of the sum of its squared terms, in units of the type's epsilon.
pub(crate) const MOST_RESIDUAL: f64 = 32.0;

/// Solution of `matrix * x = right_hand_side`: `attempt` where it is one, else [`solve_general`](super::solve_general)'s.
///
/// It is one if in each row `|a . x - b| < 32 eps sqrt(sum (a_j x_j)^2)`: the row with each coefficient changed by some dozen
/// roundings has exactly this solution. What is not finite is none, nor is what is so large that its squares are not.
///
/// ```
/// use dyn_runtime::solve::solve_after_attempt;
///
/// let (matrix, right) = ([[0.0, 2.0], [4.0, 0.0]], [6.0, 4.0]);
/// assert_eq!(solve_after_attempt(&[1.0, 3.0], &matrix, &right), [1.0, 3.0]);
/// assert_eq!(solve_after_attempt(&[f64::NAN, 0.0], &matrix, &right), [1.0, 3.0]);
/// ```
#[inline(always)]
pub fn solve_after_attempt<T: Scalar, const N: usize>(
    attempt: &[T; N],
    matrix: &[[T; N]; N],
    right_hand_side: &[T; N],
) -> [T; N] {
    let (mut residuals, mut squares) = (*attempt, *attempt);
    for row in 0..N {
        (residuals[row], squares[row]) = (-right_hand_side[row], T::constant(0.0));
        for column in 0..N {
            let term = matrix[row][column] * attempt[column];
            residuals[row] = residuals[row] + term;
            squares[row] = squares[row] + term * term;
        }
    }
    T::unless_wrong(attempt, &residuals, &squares, matrix, right_hand_side)
}

/// The same of a single state in lanes: unknown `order[k]` stands in lane `k` of the first three or in lane `k - 3` of the
/// others, and so do the columns of the matrix.
#[inline(always)]
pub fn solve_after_attempt_in_lanes<P: Triple>(
    attempt: &[P; 2],
    matrix: &[[P; 2]; 6],
    right_hand_side: &[P::Lane; 6],
    order: &[usize; 6],
) -> [P::Lane; 6] {
    let (mut residuals, mut squares) = (*right_hand_side, *right_hand_side);
    for row in 0..6 {
        let (first, second) = (matrix[row][0] * attempt[0], matrix[row][1] * attempt[1]);
        residuals[row] = sum(first + second) - right_hand_side[row];
        squares[row] = sum(first.multiply_add(first, second * second));
    }
    let mut rows = [*right_hand_side; 6];
    for row in 0..6 {
        rows[row] = each(order, matrix[row], right_hand_side[0]);
    }
    let solution = each(order, *attempt, right_hand_side[0]);
    P::Lane::unless_wrong(&solution, &residuals, &squares, &rows, right_hand_side)
}

/// The six numbers, each in its place.
#[inline(always)]
fn each<P: Triple>(order: &[usize; 6], [first, second]: [P; 2], any: P::Lane) -> [P::Lane; 6] {
    let mut numbers = [any; 6];
    for lane in 0..3 {
        numbers[order[lane]] = first.lane(lane);
        numbers[order[3 + lane]] = second.lane(lane);
    }
    numbers
}

/// The sum of the three lanes.
#[inline(always)]
fn sum<P: Triple>(three: P) -> P::Lane {
    three.lane(0) + three.lane(1) + three.lane(2)
}
