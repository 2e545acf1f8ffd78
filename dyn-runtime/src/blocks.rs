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
//! takes two divisions one after the other where elimination takes six, and no comparison. That is sound where the
//! directions of A are far from lying in one plane, and where the condition is known to be good; [`Blocks::of`] gives nothing
//! otherwise, and elimination with pivots does the work.

use crate::real::Real;

type Vector<T> = [T; 3];
type Matrix<T> = [[T; 3]; 3];

/// Least square of the volume that the directions of legs 1, 3, 5 span, each of length 1: growth of rounding errors stays
/// below about a hundred.
const MIN_SQUARED_VOLUME: f64 = 1e-4;

/// J_dp, ready to be solved with.
#[derive(Clone, Copy)]
pub(crate) struct Blocks<T> {
    /// A^-1.
    inverse: Matrix<T>,
    /// A^-1 B.
    coupling: Matrix<T>,
    /// C.
    lower: Matrix<T>,
    /// S^-1.
    lower_inverse: Matrix<T>,
}

impl<T: Real> Blocks<T> {
    /// `None` unless the reciprocal condition of J_dp is certainly at least [`Real::MIN_RECIPROCAL_CONDITION`].
    #[inline]
    pub fn of(jacobian_dp: &[[T; 6]; 6]) -> Option<Self> {
        let [first, second, third, fourth, fifth, sixth] = jacobian_dp.each_ref().map(halves);
        let upper = [first.0, third.0, fifth.0];
        let lower = [second.0, fourth.0, sixth.0];
        let (inverse, volume) = inverted(&upper);
        let coupling = product(&inverse, &[first.1, third.1, fifth.1]);
        let below = product(&lower, &coupling);
        let complement = [
            difference(&second.1, &below[0]),
            difference(&fourth.1, &below[1]),
            difference(&sixth.1, &below[2]),
        ];
        let (lower_inverse, rest) = inverted(&complement);

        // As `check::jacobian_condition_bound`, squared, with the largest that the 1-norm of the scaled matrix can be,
        // sqrt(6) |A|_F = sqrt(72): (0.04575 / sqrt(72))^2 det^2 >= MIN^2, det being that of the scaled matrix.
        let square = |(direction, _): &(Vector<T>, Vector<T>)| dot(direction, direction);
        let arm = |(_, moment): &(Vector<T>, Vector<T>)| dot(moment, moment);
        let (s1, s3, s5) = (square(&first), square(&third), square(&fifth));
        let (s2, s4, s6) = (square(&second), square(&fourth), square(&sixth));
        let (upper_squares, lower_squares) = (s1 * s3 * s5, s2 * s4 * s6);
        // Of arms without their directions' lengths: one division instead of six, and no less for it.
        let shortest = less(less(less(s1, s2), less(s3, s4)), less(s5, s6));
        let arms = (arm(&first) + arm(&second)) + (arm(&third) + arm(&fourth)) + (arm(&fifth) + arm(&sixth));
        let arm_squared = arms * T::constant(1.0 / 6.0) / shortest;
        let determinant = volume * rest;
        let least = T::MIN_RECIPROCAL_CONDITION * T::constant(185.5);
        let is_regular = determinant * determinant
            > least * least * (upper_squares * lower_squares) * (arm_squared * arm_squared * arm_squared);
        let is_voluminous = volume * volume > T::constant(MIN_SQUARED_VOLUME) * upper_squares;
        // Not short of one another: what is not finite passes neither.
        (is_regular & is_voluminous).then_some(Self { inverse, coupling, lower, lower_inverse })
    }

    /// The twist with `J_dp twist = rates`.
    #[inline]
    pub fn solve(&self, rates: &[T; 6]) -> [T; 6] {
        let [r1, q1, r2, q2, r3, q3] = *rates;
        let alone = applied(&self.inverse, &[r1, r2, r3]);
        let angular = applied(&self.lower_inverse, &difference(&[q1, q2, q3], &applied(&self.lower, &alone)));
        let [x, y, z] = difference(&alone, &applied(&self.coupling, &angular));
        let [wx, wy, wz] = angular;
        [x, y, z, wx, wy, wz]
    }
}

#[inline(always)]
fn halves<T: Real>(row: &[T; 6]) -> (Vector<T>, Vector<T>) {
    let [a, b, c, d, e, f] = *row;
    ([a, b, c], [d, e, f])
}

#[inline(always)]
fn dot<T: Real>(a: &Vector<T>, b: &Vector<T>) -> T {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
fn less<T: Real>(a: T, b: T) -> T {
    if a < b { a } else { b }
}

#[inline(always)]
fn cross<T: Real>(a: &Vector<T>, b: &Vector<T>) -> Vector<T> {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// `a - b`
#[inline(always)]
pub(crate) fn difference<T: Real>(a: &Vector<T>, b: &Vector<T>) -> Vector<T> {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[inline(always)]
fn applied<T: Real>(matrix: &Matrix<T>, vector: &Vector<T>) -> Vector<T> {
    [dot(&matrix[0], vector), dot(&matrix[1], vector), dot(&matrix[2], vector)]
}

/// `left right`
#[inline(always)]
pub(crate) fn product<T: Real>(left: &Matrix<T>, right: &Matrix<T>) -> Matrix<T> {
    let row = |of: &Vector<T>| {
        let [x, y, z] = *of;
        let [a, b, c] = right;
        [x * a[0] + y * b[0] + z * c[0], x * a[1] + y * b[1] + z * c[1], x * a[2] + y * b[2] + z * c[2]]
    };
    [row(&left[0]), row(&left[1]), row(&left[2])]
}

/// The inverse by cross products of the rows, and the determinant.
#[inline(always)]
fn inverted<T: Real>(rows: &Matrix<T>) -> (Matrix<T>, T) {
    let [a, b, c] = rows;
    let (bc, ca, ab) = (cross(b, c), cross(c, a), cross(a, b));
    let determinant = dot(a, &bc);
    let r = T::one() / determinant;
    let row = |k: usize| [bc[k] * r, ca[k] * r, ab[k] * r];
    ([row(0), row(1), row(2)], determinant)
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
            let Some(blocks) = Blocks::of(&rows) else { continue };
            let condition = jacobian_reciprocal_condition(&rows);
            assert!(condition >= MIN_RECIPROCAL_CONDITION, "{condition:e} passed");
            let right = [1.0, -2.0, 3.0, 0.5, -1.5, 2.5];
            near(&blocks.solve(&right), &solve_general(&rows, &right), 1e-12 / condition);
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
            assert!(Blocks::of(&rows).is_none());
            let condition = jacobian_reciprocal_condition(&rows);
            let right = [1.0, -2.0, 3.0, 0.5, -1.5, 2.5];
            if condition > 1e-3 {
                near(&twist_of_rates(&rows, &right).unwrap(), &solve_general(&rows, &right), 1e-10);
            }
        }
        assert!(Blocks::of(&[[f64::NAN; 6]; 6]).is_none());
        assert!(Blocks::of(&[[0.0; 6]; 6]).is_none());
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
            assert!(Blocks::of(&jacobian.transpose().into()).is_some());
        }
    }
}
