//! What a checked call refuses. The thresholds stand with the types of number, in [`Real`].

use nalgebra::Matrix3;

use crate::arrays::AllFinite;
use crate::blocks::Blocks;
use crate::error::{Error, Input, NotARotation};
use crate::float::sqrt;
use crate::real::Real;
use crate::solve::{one_norm, reciprocal_condition, solve_even_rows};
use crate::triple::{Call, Portable, Triple};

/// [`Real::MAX_ROTATION_DEVIATION`] of `f64`.
pub const MAX_ROTATION_DEVIATION: f64 = <f64 as Real>::MAX_ROTATION_DEVIATION;

/// [`Real::MIN_ROD_ALIGNMENT`] of `f64`.
pub const MIN_ROD_ALIGNMENT: f64 = <f64 as Real>::MIN_ROD_ALIGNMENT;

/// [`Real::MIN_RECIPROCAL_CONDITION`] of `f64`.
pub const MIN_RECIPROCAL_CONDITION: f64 = <f64 as Real>::MIN_RECIPROCAL_CONDITION;

/// How well the six legs hold any wrench, from J_dp: 1 at best, 0 where there is one that they cannot hold.
///
/// J_dp mixes metres and pure numbers, and the length of its rows only says how inclined each rod is to its
/// actuator. So each row is divided by the length of its translational part (which leaves the rod's direction
/// u and its moment about P), and moments by their root mean square. The result is the reciprocal condition
/// number of that matrix in the 1-norm, 0 if J_dp is not finite. It depends neither on units nor on the
/// platform's size, nor on the actuators' directions.
///
/// It does depend on the reference frames. Moments are taken about P's origin, which therefore belongs amid
/// the platform joints: from an origin n times the platform's size away, all arms look alike and the number
/// falls to about 1/n of its value. And the 1-norm sums along O's axes: turning base and platform together
/// changes the number, for usual poses by less than a factor of 2.
///
/// `jacobian` is row-major: a row per leg, three translational columns, then three rotational.
pub fn jacobian_reciprocal_condition<T: Real>(jacobian: &[[T; 6]; 6]) -> T {
    reciprocal_condition(&Scaled::of(jacobian).rows)
}

/// A lower bound of [`jacobian_reciprocal_condition`] at a fifth of its cost, without the inverse.
///
/// With the singular values of the scaled matrix A, `|det A|` is their product, and the mean of the squares of the
/// five larger ones is at most `|A|_F^2 / 5`; so the least is at least `|det A| (5 / |A|_F^2)^(5/2)`, where
/// `|A|_F^2 = 12` by the scaling, and `|A^-1|_1 <= sqrt(6) / least`. In the paper's workspace the bound is
/// smaller by a factor of 3 to 4. Not finite or 0 where J_dp is singular or not finite.
pub fn jacobian_condition_bound<T: Real>(jacobian: &[[T; 6]; 6]) -> T {
    let scaled = Scaled::of(jacobian);
    scaled.bound(solve_even_rows(&scaled.rows, &[T::zero(); 6]).1)
}

/// J_dp with rows of directions and moments of mean square 1.
struct Scaled<T> {
    rows: [[T; 6]; 6],
    /// What each row was multiplied with.
    row_factors: [T; 6],
    /// What the moments were multiplied with besides.
    moment_factor: T,
}

impl<T: Real> Scaled<T> {
    fn of(jacobian: &[[T; 6]; 6]) -> Self {
        // Loops, not `map` with a closure: that keeps a bounds check in the compiled code, hence a panic.
        //
        // Why moments are not taken about a point that the six rods define, such as the one nearest to their
        // lines: J_dp alone has no other length than its moments, and rods that meet in one point, which cannot
        // hold a moment, would pass unseen.
        let mut rows = *jacobian;
        let mut row_factors = [T::zero(); 6];
        let mut arms_squared = T::zero();
        for (row, row_factor) in rows.iter_mut().zip(&mut row_factors) {
            let [x, y, z, ..] = *row;
            let factor = T::one() / sqrt(x * x + y * y + z * z);
            for element in row.iter_mut() {
                *element *= factor;
            }
            *row_factor = factor;
            let [.., x, y, z] = *row;
            arms_squared += x * x + y * y + z * z;
        }
        let moment_factor = T::one() / sqrt(arms_squared / T::constant(6.0));
        for [.., x, y, z] in &mut rows {
            for moment in [x, y, z] {
                *moment *= moment_factor;
            }
        }
        Self { rows, row_factors, moment_factor }
    }

    /// See [`jacobian_condition_bound`].
    fn bound(&self, absolute_determinant: T) -> T {
        // (5/12)^(5/2) / sqrt(6) = 0.0457505, rounded down.
        T::constant(0.045_75) * absolute_determinant / one_norm(&self.rows)
    }

    /// `Ok` unless the condition is too bad.
    fn judge(&self, absolute_determinant: T) -> Result<(), Error> {
        // The bound is almost always enough; only near a singular pose the number itself is worth its price.
        if self.bound(absolute_determinant) >= T::MIN_RECIPROCAL_CONDITION {
            return Ok(());
        }
        let reciprocal_condition = reciprocal_condition(&self.rows);
        if reciprocal_condition >= T::MIN_RECIPROCAL_CONDITION {
            Ok(())
        } else {
            Err(Error::SingularJacobian { reciprocal_condition: reciprocal_condition.to_f64() })
        }
    }
}

/// `None` for a rotation.
#[inline]
pub(crate) fn rotation_defect<T: Real>(matrix: &Matrix3<T>) -> Option<NotARotation> {
    if rotation_doubt(&(*matrix).into()) <= most_doubt() || is_rotation(matrix) {
        None
    } else {
        Some(described(matrix))
    }
}

/// How far a matrix with columns (or rows) x, y, z is from a right-handed rotation, as a sum of squares: of `x.x - 1`, `y.y - 1`, `x.y`
/// and `z - x x y`. Up to [`most_doubt`] it is one for certain: `R^T R - 1` has no element beyond five times the root then.
#[inline]
pub(crate) fn rotation_doubt<T: Real>(columns: &[[T; 3]; 3]) -> T {
    let [[a, b, c], [d, e, f], [g, h, i]] = *columns;
    let one = T::one();
    let (xx, yy, xy) = (a * a + b * b + c * c - one, d * d + e * e + f * f - one, a * d + b * e + c * f);
    let (p, q, r) = (b * f - c * e - g, c * d - a * f - h, a * e - b * d - i);
    xx * xx + yy * yy + xy * xy + p * p + q * q + r * r
}

/// Up to this [`rotation_doubt`] there is none.
#[inline]
pub(crate) fn most_doubt<T: Real>() -> T {
    let root = T::MAX_ROTATION_DEVIATION * T::constant(0.2);
    root * root
}

/// The exact answer, for matrices in doubt.
#[cold]
fn is_rotation<T: Real>(matrix: &Matrix3<T>) -> bool {
    let deviation = matrix.transpose() * matrix - Matrix3::identity();
    // No comparison holds for what is not a number.
    deviation.iter().all(|element| element.abs() <= T::MAX_ROTATION_DEVIATION)
        & (matrix.determinant() > T::zero())
}

/// What keeps a matrix from being a rotation.
#[cold]
fn described<T: Real>(matrix: &Matrix3<T>) -> NotARotation {
    let columns: [[T; 3]; 3] = (*matrix).into();
    let deviation = if columns.all_finite() {
        (matrix.transpose() * matrix - Matrix3::identity()).amax()
    } else {
        T::constant(f64::NAN)
    };
    NotARotation { deviation: deviation.to_f64(), determinant: matrix.determinant().to_f64() }
}

/// Passes an input on if all its elements are finite.
#[inline]
pub(crate) fn finite<Array: AllFinite>(input: Input, array: Array) -> Result<Array, Error> {
    if array.all_finite() { Ok(array) } else { Err(non_finite(input, &array)) }
}

#[cold]
fn non_finite<Array: AllFinite>(input: Input, array: &Array) -> Error {
    Error::NonFinite { input, element: array.first_not_finite().unwrap_or(0) }
}

/// Passes the rest of a call if its outputs are finite.
#[inline]
pub(crate) fn finite_result(outputs_are_finite: bool) -> Result<(), Error> {
    if outputs_are_finite { Ok(()) } else { Err(Error::NonFiniteResult) }
}

/// The model has an alignment `(u_i.a_i)^2` for every leg, unless the poses are to blame.
///
/// With finite poses it is `1 - n.n/s^2`, and this is finite unless a parameter is not, a rod has no length,
/// or a square overflows.
pub(crate) fn mechanism<T: Real>(
    rod_alignment: &[T; 6],
    base_position: &[T; 3],
    platform_position: &[T; 3],
) -> Result<(), Error> {
    let squares_overflow =
        base_position.iter().zip(platform_position).any(|(b, p)| (*b - *p).abs() > T::OVERFLOWING_DISTANCE_M);
    match rod_alignment.iter().position(|alignment| !alignment.is_finite()) {
        Some(leg) if !squares_overflow => Err(Error::InvalidModel { leg }),
        _ => Ok(()),
    }
}

/// [`mechanism`] and [`reach`].
#[inline]
pub(crate) fn in_reach<T: Real>(
    rod_alignment: &[T; 6],
    base_position: &[T; 3],
    platform_position: &[T; 3],
) -> Result<(), Error> {
    let [a, b, c, d, e, f] = *rod_alignment;
    let stand = rod_alignment.iter().fold(true, |all, alignment| all & (*alignment >= T::MIN_ROD_ALIGNMENT));
    // What is not a number is not greater either.
    if stand & ((a + b + c) + (d + e + f)).is_finite() {
        return Ok(());
    }
    mechanism(rod_alignment, base_position, platform_position)?;
    reach(rod_alignment)
}

/// Every leg reaches the platform and stands well enough to drive it; `rod_alignment[i] = (u_i.a_i)^2`.
#[cold]
fn reach<T: Real>(rod_alignment: &[T; 6]) -> Result<(), Error> {
    for (leg, alignment) in rod_alignment.iter().copied().enumerate() {
        // Poses so far apart that the distance overflows give NaN.
        if alignment < T::zero() || !alignment.is_finite() {
            return Err(Error::OutOfReach { leg });
        }
        if alignment < T::MIN_ROD_ALIGNMENT {
            return Err(Error::RodPerpendicular { leg });
        }
    }
    Ok(())
}

/// J_dp can be inverted.
#[inline]
pub(crate) fn invertible<T: Real>(jacobian_dp: &[[T; 6]; 6]) -> Result<(), Error> {
    let mut certain = false;
    T::run(Judge { jacobian_dp, certain: &mut certain });
    if certain { Ok(()) } else { judged_with_care(jacobian_dp, &[T::zero(); 6]).map(drop) }
}

/// Whether [`Blocks`] are certain that J_dp can be inverted.
struct Judge<'a, T> {
    jacobian_dp: &'a [[T; 6]; 6],
    certain: &'a mut bool,
}

impl<T: Real> Call<T> for Judge<'_, T> {
    #[inline(always)]
    fn in_lanes<P: Triple<Lane = T>>(self) {
        *self.certain = Blocks::<P>::of(self.jacobian_dp).is_some();
    }

    #[inline]
    fn flat(self) {
        self.in_lanes::<Portable<T>>();
    }
}

/// The twist with `J_dp twist = rates`, or why there is none.
pub(crate) fn twist_of_rates<T: Real>(jacobian_dp: &[[T; 6]; 6], rates: &[T; 6]) -> Result<[T; 6], Error> {
    match Blocks::<Portable<T>>::of(jacobian_dp) {
        Some(blocks) => Ok(blocks.twist(rates)),
        None => judged_with_care(jacobian_dp, rates),
    }
}

/// [`twist_of_rates`] by elimination with pivots, for layouts and poses that are none for [`Blocks`].
#[cold]
pub(crate) fn judged_with_care<T: Real>(jacobian_dp: &[[T; 6]; 6], rates: &[T; 6]) -> Result<[T; 6], Error> {
    let scaled = Scaled::of(jacobian_dp);
    let mut right = *rates;
    for (rate, factor) in right.iter_mut().zip(&scaled.row_factors) {
        *rate *= *factor;
    }
    let (mut twist, absolute_determinant) = solve_even_rows(&scaled.rows, &right);
    scaled.judge(absolute_determinant)?;
    let [.., x, y, z] = &mut twist;
    for speed in [x, y, z] {
        *speed *= scaled.moment_factor;
    }
    Ok(twist)
}
