//! The six equations `J_dp twist = rates` in blocks of three: the quick way, for the usual case.
//!
//! Legs 1, 3, 5 and legs 2, 4, 6 each make a block of three rows. With three directions in A, three moments in B, and C, D
//! of the other three legs,
//!
//! ```text
//! [A B] [v]   [r]         S = D - C A^-1 B      w = S^-1 (q - C A^-1 r)
//! [C D] [w] = [q]                               v = A^-1 r - A^-1 B w
//! ```
//!
//! takes two divisions where elimination takes six, and no comparison. Neither has to wait for the other: inverses stand as
//! adjugate matrix and determinant, and det A goes with S. That is sound where the
//! directions of A are far from lying in one plane, and where the condition is known to be good; [`Blocks::of`] gives nothing
//! otherwise, and elimination with pivots does the work.

use crate::real::Real;
use crate::triple::Triple;

type Vector<T> = [T; 3];
type Matrix<T> = [[T; 3]; 3];

/// Least square of the volume that the directions of legs 1, 3, 5 span, each of length 1: growth of rounding errors stays
/// below about a hundred.
const MIN_SQUARED_VOLUME: f64 = 1e-4;

/// J_dp, ready to be solved with.
#[derive(Clone, Copy)]
pub(crate) struct Blocks<T> {
    /// The adjugate of A: det A times its inverse.
    adjugate: Matrix<T>,
    /// det A.
    volume: T,
    /// 1 / det A.
    inverse_volume: T,
    /// (det A) A^-1 B.
    coupling: Matrix<T>,
    /// C.
    lower: Matrix<T>,
    /// The adjugate of (det A) S.
    complement_adjugate: Matrix<T>,
    /// 1 / det((det A) S).
    inverse_complement: T,
}

impl<T: Real> Blocks<T> {
    /// `None` unless the reciprocal condition of J_dp is certainly at least [`Real::MIN_RECIPROCAL_CONDITION`].
    ///
    /// Of `P` the arithmetic counts: how a product in a sum is rounded.
    #[inline(always)]
    pub fn of<P: Triple<Lane = T>>(jacobian_dp: &[[T; 6]; 6]) -> Option<Self> {
        // Neither `map` nor a loop: both are calls and copies here, which cost as much as the arithmetic.
        let [first, second, third, fourth, fifth, sixth] = jacobian_dp;
        let upper = [direction(first), direction(third), direction(fifth)];
        let right = [moment(first), moment(third), moment(fifth)];
        let lower = [direction(second), direction(fourth), direction(sixth)];
        let lower_right = [moment(second), moment(fourth), moment(sixth)];
        let (adjugate, volume) = adjugated::<P>(&upper);
        let coupling = product::<P>(&adjugate, &right);
        let below = product::<P>(&lower, &coupling);
        let complement = |k: usize| scaled_difference::<P>(&lower_right[k], volume, &below[k]);
        let (complement_adjugate, complement_volume) =
            adjugated::<P>(&[complement(0), complement(1), complement(2)]);
        let (inverse_volume, inverse_complement) = (T::one() / volume, T::one() / complement_volume);

        // As `check::jacobian_condition_bound`, squared, with the largest that the 1-norm of the scaled matrix can be,
        // sqrt(6) |A|_F = sqrt(72): (0.04575 / sqrt(72))^2 det^2 >= MIN^2, det being that of the scaled matrix.
        let square = |vector: &Vector<T>| dot::<P>(vector, vector);
        let (s1, s3, s5) = (square(&upper[0]), square(&upper[1]), square(&upper[2]));
        let (s2, s4, s6) = (square(&lower[0]), square(&lower[1]), square(&lower[2]));
        let (upper_squares, lower_squares) = (s1 * s3 * s5, s2 * s4 * s6);
        // Of arms without their directions' lengths: one division instead of six, and no less for it.
        let shortest = less(less(less(s1, s2), less(s3, s4)), less(s5, s6));
        let arms = (square(&right[0]) + square(&right[1]) + square(&right[2]))
            + (square(&lower_right[0]) + square(&lower_right[1]) + square(&lower_right[2]));
        let arm_squared = arms * T::constant(1.0 / 6.0) / shortest;
        // det J_dp = det A det S, and det((det A) S) = (det A)^3 det S.
        let determinant = complement_volume * inverse_volume * inverse_volume;
        let least = T::MIN_RECIPROCAL_CONDITION * T::constant(185.5);
        let is_regular = determinant * determinant
            > least * least * (upper_squares * lower_squares) * (arm_squared * arm_squared * arm_squared);
        let is_voluminous = volume * volume > T::constant(MIN_SQUARED_VOLUME) * upper_squares;
        // Not short of one another: what is not finite passes neither.
        let blocks = Self {
            adjugate,
            volume,
            inverse_volume,
            coupling,
            lower,
            complement_adjugate,
            inverse_complement,
        };
        (is_regular & is_voluminous).then_some(blocks)
    }

    /// The twist with `J_dp twist = rates`.
    #[inline(always)]
    pub fn solve<P: Triple<Lane = T>>(&self, rates: &[T; 6]) -> [T; 6] {
        let [r1, q1, r2, q2, r3, q3] = *rates;
        let alone = applied::<P>(&self.adjugate, &[r1, r2, r3]);
        let rest = scaled_difference::<P>(&[q1, q2, q3], self.volume, &applied::<P>(&self.lower, &alone));
        let [wx, wy, wz] = scaled(&applied::<P>(&self.complement_adjugate, &rest), self.inverse_complement);
        let held = |k: usize| {
            let [x, y, z] = self.coupling[k];
            P::neg_mul_add(z, wz, P::neg_mul_add(y, wy, P::neg_mul_add(x, wx, alone[k])))
        };
        let [x, y, z] = scaled(&[held(0), held(1), held(2)], self.inverse_volume);
        [x, y, z, wx, wy, wz]
    }
}

#[inline(always)]
fn direction<T: Real>(row: &[T; 6]) -> Vector<T> {
    [row[0], row[1], row[2]]
}

#[inline(always)]
fn moment<T: Real>(row: &[T; 6]) -> Vector<T> {
    [row[3], row[4], row[5]]
}

#[inline(always)]
fn less<T: Real>(a: T, b: T) -> T {
    if a < b { a } else { b }
}

/// `a . b`
#[inline(always)]
pub(crate) fn dot<P: Triple>(a: &Vector<P::Lane>, b: &Vector<P::Lane>) -> P::Lane {
    P::mul_add(a[2], b[2], P::mul_add(a[1], b[1], a[0] * b[0]))
}

#[inline(always)]
fn cross<P: Triple>(a: &Vector<P::Lane>, b: &Vector<P::Lane>) -> Vector<P::Lane> {
    let minor = |i: usize, k: usize| P::mul_sub(a[i], b[k], a[k] * b[i]);
    [minor(1, 2), minor(2, 0), minor(0, 1)]
}

/// `a - b`
#[inline(always)]
pub(crate) fn difference<T: Real>(a: &Vector<T>, b: &Vector<T>) -> Vector<T> {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[inline(always)]
fn applied<P: Triple>(matrix: &Matrix<P::Lane>, vector: &Vector<P::Lane>) -> Vector<P::Lane> {
    [dot::<P>(&matrix[0], vector), dot::<P>(&matrix[1], vector), dot::<P>(&matrix[2], vector)]
}

/// `left right`
#[inline(always)]
pub(crate) fn product<P: Triple>(left: &Matrix<P::Lane>, right: &Matrix<P::Lane>) -> Matrix<P::Lane> {
    let element = |[x, y, z]: &Vector<P::Lane>, k: usize| {
        P::mul_add(*z, right[2][k], P::mul_add(*y, right[1][k], *x * right[0][k]))
    };
    let row = |of: &Vector<P::Lane>| [element(of, 0), element(of, 1), element(of, 2)];
    [row(&left[0]), row(&left[1]), row(&left[2])]
}

#[inline(always)]
fn scaled<T: Real>(vector: &Vector<T>, factor: T) -> Vector<T> {
    [vector[0] * factor, vector[1] * factor, vector[2] * factor]
}

/// `factor a - b`
#[inline(always)]
fn scaled_difference<P: Triple>(
    a: &Vector<P::Lane>,
    factor: P::Lane,
    b: &Vector<P::Lane>,
) -> Vector<P::Lane> {
    [P::mul_sub(a[0], factor, b[0]), P::mul_sub(a[1], factor, b[1]), P::mul_sub(a[2], factor, b[2])]
}

/// The determinant times the inverse, by cross products of the rows, and the determinant.
#[inline(always)]
fn adjugated<P: Triple>(rows: &Matrix<P::Lane>) -> (Matrix<P::Lane>, P::Lane) {
    let [a, b, c] = rows;
    let (bc, ca, ab) = (cross::<P>(b, c), cross::<P>(c, a), cross::<P>(a, b));
    let row = |k: usize| [bc[k], ca[k], ab[k]];
    ([row(0), row(1), row(2)], dot::<P>(a, &bc))
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;
    use rand::{RngExt, SeedableRng};
    use rand_pcg::Pcg64;

    use super::Blocks;
    use crate::check::{MIN_RECIPROCAL_CONDITION, jacobian_reciprocal_condition, twist_of_rates};
    use crate::models::Uhp2016;
    use crate::solve::solve_general;
    use crate::triple::Portable;
    use crate::{BaseMotion, Hexapod, PlatformState, Pose};

    fn matrix(random: &mut Pcg64) -> [[f64; 6]; 6] {
        [[0.0; 6]; 6].map(|row: [f64; 6]| row.map(|_| random.random_range(-1.0..1.0)))
    }

    fn near(found: &[f64; 6], expected: &[f64; 6], tolerance: f64) {
        let largest = expected.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        for (found, expected) in found.iter().zip(expected) {
            assert!((found - expected).abs() <= tolerance * largest, "{found} is not {expected}");
        }
    }

    #[test]
    fn what_passes_is_well_conditioned_and_solved() {
        let mut random = Pcg64::seed_from_u64(1);
        let mut passed = 0;
        for k in 0..20_000 {
            let mut rows = matrix(&mut random);
            // The sixth leg as the fifth but for ever less.
            let share = 10.0_f64.powi(-(k % 9));
            let fifth = rows[4];
            for (sixth, fifth) in rows[5].iter_mut().zip(fifth) {
                *sixth = fifth + share * *sixth;
            }
            let Some(blocks) = Blocks::of::<Portable<f64>>(&rows) else { continue };
            let condition = jacobian_reciprocal_condition(&rows);
            assert!(condition >= MIN_RECIPROCAL_CONDITION, "{condition:e} passed");
            let right = [1.0, -2.0, 3.0, 0.5, -1.5, 2.5];
            near(&blocks.solve::<Portable<f64>>(&right), &solve_general(&rows, &right), 1e-12 / condition);
            passed += 1;
        }
        assert!(passed > 5_000, "only {passed} passed");
    }

    #[test]
    fn legs_in_one_plane_are_left_to_elimination() {
        let mut random = Pcg64::seed_from_u64(2);
        for _ in 0..200 {
            let mut rows = matrix(&mut random);
            let [first, _, third, ..] = rows;
            for (fifth, (first, third)) in rows[4].iter_mut().zip(first.iter().zip(third)).take(3) {
                *fifth = first - third;
            }
            assert!(Blocks::of::<Portable<f64>>(&rows).is_none());
            let condition = jacobian_reciprocal_condition(&rows);
            let right = [1.0, -2.0, 3.0, 0.5, -1.5, 2.5];
            if condition > 1e-3 {
                near(&twist_of_rates(&rows, &right).unwrap(), &solve_general(&rows, &right), 1e-10);
            }
        }
        assert!(Blocks::of::<Portable<f64>>(&[[f64::NAN; 6]; 6]).is_none());
        assert!(Blocks::of::<Portable<f64>>(&[[0.0; 6]; 6]).is_none());
    }

    #[test]
    fn poses_of_the_paper_take_the_quick_way() {
        let (hexapod, mut random) = (Hexapod::new(Uhp2016), Pcg64::seed_from_u64(3));
        for _ in 0..500 {
            let mut any = |size: f64| Vector3::from_fn(|_, _| random.random_range(-size..size));
            let base = Pose::from_paper_angles(any(1.0), any(1.0).into());
            let mut relative = Pose::from_paper_angles(any(0.02), any(0.1).into());
            relative.position_m.z += 0.382;
            let platform = PlatformState::at_rest(base.compose(&relative));
            let Ok(jacobian) = hexapod.jacobian_dp(&BaseMotion::at_rest(base), &platform) else { continue };
            assert!(Blocks::of::<Portable<f64>>(&jacobian.transpose().into()).is_some());
        }
    }
}
