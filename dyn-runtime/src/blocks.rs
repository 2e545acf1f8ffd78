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

use crate::float::{mul_add, mul_sub};
use crate::real::Real;
use crate::triple::Triple;

/// Least square of the volume that the directions of legs 1, 3, 5 span, each of length 1: growth of rounding errors stays
/// below about a hundred.
const MIN_SQUARED_VOLUME: f64 = 1e-4;

/// J_dp, ready to be solved with. A `P` is a vector in O, or a row of a matrix.
#[derive(Clone, Copy)]
pub(crate) struct Blocks<P: Triple> {
    /// Columns of the adjugate of A: det A times its inverse.
    adjugate: [P; 3],
    /// det A.
    volume: P::Lane,
    /// 1 / det A.
    inverse_volume: P::Lane,
    /// Rows of B.
    right: [P; 3],
    /// Rows of C.
    lower: [P; 3],
    /// Columns of the adjugate of (det A) S.
    complement_adjugate: [P; 3],
    /// 1 / det((det A) S).
    inverse_complement: P::Lane,
}

impl<T: Real, P: Triple<Lane = T>> Blocks<P> {
    /// `None` unless the reciprocal condition of J_dp is certainly at least [`Real::MIN_RECIPROCAL_CONDITION`].
    #[inline(always)]
    pub fn of(jacobian_dp: &[[T; 6]; 6]) -> Option<Self> {
        // Neither closures nor `map` nor loops: they are calls here, compiled for no registers, and cost more than the arithmetic.
        let [first, second, third, fourth, fifth, sixth] = jacobian_dp;
        let upper = [direction::<P>(first), direction(third), direction(fifth)];
        let right = [moment::<P>(first), moment(third), moment(fifth)];
        let lower = [direction::<P>(second), direction(fourth), direction(sixth)];
        let lower_right = [moment::<P>(second), moment(fourth), moment(sixth)];
        let (adjugate, volume) = adjugated(&upper);
        // (det A) A^-1 B
        let [one, two, three] = &adjugate;
        let coupling = [
            combined([one.lane(0), two.lane(0), three.lane(0)], &right),
            combined([one.lane(1), two.lane(1), three.lane(1)], &right),
            combined([one.lane(2), two.lane(2), three.lane(2)], &right),
        ];
        let determinant_a = P::splat(volume);
        let (complement_adjugate, complement_volume) = adjugated(&[
            mul_sub(lower_right[0], determinant_a, combined(components(lower[0]), &coupling)),
            mul_sub(lower_right[1], determinant_a, combined(components(lower[1]), &coupling)),
            mul_sub(lower_right[2], determinant_a, combined(components(lower[2]), &coupling)),
        ]);
        let (inverse_volume, inverse_complement) = (T::one() / volume, T::one() / complement_volume);

        // As `check::jacobian_condition_bound`, squared, with the largest that the 1-norm of the scaled matrix can be,
        // sqrt(6) |A|_F = sqrt(72): (0.04575 / sqrt(72))^2 det^2 >= MIN^2, det being that of the scaled matrix.
        let (s1, s3, s5) = (squared(first), squared(third), squared(fifth));
        let (s2, s4, s6) = (squared(second), squared(fourth), squared(sixth));
        let (upper_squares, lower_squares) = (s1 * s3 * s5, s2 * s4 * s6);
        // Of arms without their directions' lengths: one division instead of six, and no less for it.
        let shortest = less(less(less(s1, s2), less(s3, s4)), less(s5, s6));
        let arms = sum(mul_add(right[2], right[2], mul_add(right[1], right[1], right[0] * right[0])))
            + sum(mul_add(
                lower_right[2],
                lower_right[2],
                mul_add(lower_right[1], lower_right[1], lower_right[0] * lower_right[0]),
            ));
        let arm_squared = arms * T::constant(1.0 / 6.0) / shortest;
        // det J_dp = det A det S, and det((det A) S) = (det A)^3 det S.
        let determinant = complement_volume * inverse_volume * inverse_volume;
        let least = T::MIN_RECIPROCAL_CONDITION * T::constant(185.5);
        let is_regular = determinant * determinant
            > least * least * (upper_squares * lower_squares) * (arm_squared * arm_squared * arm_squared);
        let is_voluminous = volume * volume > T::constant(MIN_SQUARED_VOLUME) * upper_squares;
        // Not short of one another: what is not finite passes neither.
        let blocks =
            Self { adjugate, volume, inverse_volume, right, lower, complement_adjugate, inverse_complement };
        (is_regular & is_voluminous).then_some(blocks)
    }

    /// [`solve`](Self::solve), as six numbers.
    #[inline(always)]
    pub fn twist(&self, rates: &[T; 6]) -> [T; 6] {
        let (linear, angular) = self.solve(rates);
        let ([x, y, z], [wx, wy, wz]) = (components(linear), components(angular));
        [x, y, z, wx, wy, wz]
    }

    /// The twist with `J_dp twist = rates`, its linear and its angular half.
    #[inline(always)]
    pub fn solve(&self, rates: &[T; 6]) -> (P, P) {
        let [r1, q1, r2, q2, r3, q3] = *rates;
        // (det A) A^-1 r
        let alone = combined([r1, r2, r3], &self.adjugate);
        let rest = [
            less_product(self.volume * q1, self.lower[0], alone),
            less_product(self.volume * q2, self.lower[1], alone),
            less_product(self.volume * q3, self.lower[2], alone),
        ];
        let angular = combined(rest, &self.complement_adjugate) * P::splat(self.inverse_complement);
        let held = [
            less_product(r1, self.right[0], angular),
            less_product(r2, self.right[1], angular),
            less_product(r3, self.right[2], angular),
        ];
        let linear = combined(held, &self.adjugate) * P::splat(self.inverse_volume);
        (linear, angular)
    }
}

#[inline(always)]
fn direction<P: Triple>(row: &[P::Lane; 6]) -> P {
    P::triple([row[0], row[1], row[2]])
}

#[inline(always)]
fn moment<P: Triple>(row: &[P::Lane; 6]) -> P {
    P::triple([row[3], row[4], row[5]])
}

/// The square of a direction's length.
#[inline(always)]
fn squared<T: Real>(row: &[T; 6]) -> T {
    row[0] * row[0] + row[1] * row[1] + row[2] * row[2]
}

#[inline(always)]
fn less<T: Real>(a: T, b: T) -> T {
    if a < b { a } else { b }
}

#[inline(always)]
pub(crate) fn components<P: Triple>(vector: P) -> [P::Lane; 3] {
    [vector.lane(0), vector.lane(1), vector.lane(2)]
}

/// The sum of the three components.
#[inline(always)]
pub(crate) fn sum<P: Triple>(vector: P) -> P::Lane {
    vector.lane(0) + vector.lane(1) + vector.lane(2)
}

/// `number - a . b`
#[inline(always)]
fn less_product<P: Triple>(number: P::Lane, a: P, b: P) -> P::Lane {
    let ([a, b, c], [x, y, z]) = (components(a), components(b));
    P::neg_mul_add(c, z, P::neg_mul_add(b, y, P::neg_mul_add(a, x, number)))
}

/// Components 2, 3, 1.
#[inline(always)]
fn cycled<P: Triple>(vector: P) -> P {
    P::triple([vector.lane(1), vector.lane(2), vector.lane(0)])
}

#[inline(always)]
fn cross<P: Triple>(a: P, b: P) -> P {
    cycled(mul_sub(a, cycled(b), cycled(a) * b))
}

/// The sum of three vectors, each times its factor: a row times a matrix.
#[inline(always)]
pub(crate) fn combined<P: Triple>(factors: [P::Lane; 3], vectors: &[P; 3]) -> P {
    let [x, y, z] = factors;
    let [a, b, c] = *vectors;
    mul_add(c, P::splat(z), mul_add(b, P::splat(y), a * P::splat(x)))
}

/// The columns of the determinant times the inverse, by cross products of the rows, and the determinant.
#[inline(always)]
fn adjugated<P: Triple>(rows: &[P; 3]) -> ([P; 3], P::Lane) {
    let [a, b, c] = *rows;
    let first = cross(b, c);
    ([first, cross(c, a), cross(a, b)], sum(a * first))
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
            let Some(blocks) = Blocks::<Portable<f64>>::of(&rows) else { continue };
            let condition = jacobian_reciprocal_condition(&rows);
            assert!(condition >= MIN_RECIPROCAL_CONDITION, "{condition:e} passed");
            let right = [1.0, -2.0, 3.0, 0.5, -1.5, 2.5];
            near(&blocks.twist(&right), &solve_general(&rows, &right), 1e-12 / condition);
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
            assert!(Blocks::<Portable<f64>>::of(&rows).is_none());
            let condition = jacobian_reciprocal_condition(&rows);
            let right = [1.0, -2.0, 3.0, 0.5, -1.5, 2.5];
            if condition > 1e-3 {
                near(&twist_of_rates(&rows, &right).unwrap(), &solve_general(&rows, &right), 1e-10);
            }
        }
        assert!(Blocks::<Portable<f64>>::of(&[[f64::NAN; 6]; 6]).is_none());
        assert!(Blocks::<Portable<f64>>::of(&[[0.0; 6]; 6]).is_none());
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
            assert!(Blocks::<Portable<f64>>::of(&jacobian.transpose().into()).is_some());
        }
    }
}
