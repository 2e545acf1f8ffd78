//! Linear systems against nalgebra, in bad orders, near singular and not finite; condition numbers of known
//! matrices.

use dyn_runtime::jacobian_reciprocal_condition;
use dyn_runtime::nalgebra::{Matrix6, Rotation3, Vector3, Vector6};
use dyn_runtime::solve::{
    reciprocal_condition, solve_after_attempt, solve_after_attempt_in_lanes, solve_general,
};
use dyn_runtime::triple::{self, Portable, Triple};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

fn random_matrix(random: &mut Pcg64) -> [[f64; 6]; 6] {
    std::array::from_fn(|_| std::array::from_fn(|_| random.random_range(-1.0..1.0)))
}

fn to_nalgebra(rows: &[[f64; 6]; 6]) -> Matrix6<f64> {
    Matrix6::from_fn(|r, c| rows[r][c])
}

/// Largest residual relative to what rounding alone explains, `|A| |x| eps`.
fn residual_in_roundings(rows: &[[f64; 6]; 6], x: &[f64; 6], right_hand_side: &[f64; 6]) -> f64 {
    let (matrix, x) = (to_nalgebra(rows), Vector6::from(*x));
    let residual = matrix * x - Vector6::from(*right_hand_side);
    residual.component_div(&(matrix.abs() * x.abs())).amax() / f64::EPSILON
}

#[test]
fn agrees_with_nalgebra_on_random_matrices() {
    let mut random = Pcg64::seed_from_u64(3);
    for _ in 0..2_000 {
        let matrix = random_matrix(&mut random);
        let right_hand_side: [f64; 6] = std::array::from_fn(|_| random.random_range(-1.0..1.0));
        let x = solve_general(&matrix, &right_hand_side);
        assert!(residual_in_roundings(&matrix, &x, &right_hand_side) < 50.0);
        let peer = to_nalgebra(&matrix).lu().solve(&Vector6::from(right_hand_side)).expect("regular");
        let allowed = 1e-14 / reciprocal_condition(&matrix) * peer.amax();
        assert!((Vector6::from(x) - peer).amax() <= allowed);
    }
}

/// Zeros or tiny numbers on the diagonal, rows of very different size: elimination in the given order would
/// fail or lose all digits.
#[test]
fn any_order_of_rows_and_units_will_do() {
    let mut random = Pcg64::seed_from_u64(4);
    for case in 0..2_000 {
        let mut matrix = random_matrix(&mut random);
        for (i, row) in matrix.iter_mut().enumerate() {
            row[i] = if case % 2 == 0 { 0.0 } else { 1e-17 };
            let unit = 10_f64.powi(random.random_range(-12..12));
            row.iter_mut().for_each(|element| *element *= unit);
        }
        let exact: [f64; 6] = std::array::from_fn(|_| random.random_range(-1.0..1.0));
        let right_hand_side: [f64; 6] = (to_nalgebra(&matrix) * Vector6::from(exact)).into();
        let x = solve_general(&matrix, &right_hand_side);
        assert!(residual_in_roundings(&matrix, &x, &right_hand_side) < 50.0, "case {case}");
    }
}

/// An attempt in lanes, columns 2, 4, 6 first.
struct Attempt<'a>([f64; 6], &'a [[f64; 6]; 6], [f64; 6], &'a mut [f64; 6]);

impl triple::Call<f64> for Attempt<'_> {
    #[inline(always)]
    fn in_lanes<P: Triple<Lane = f64>>(self) {
        let sides =
            |row: &[f64; 6]| [P::triple([row[1], row[3], row[5]]), P::triple([row[0], row[2], row[4]])];
        let rows = self.1.map(|row| sides(&row));
        *self.3 = solve_after_attempt_in_lanes::<P>(&sides(&self.0), &rows, &self.2, &[1, 3, 5, 0, 2, 4]);
    }

    fn flat(self) {
        self.in_lanes::<Portable<f64>>();
    }
}

/// Whatever the attempt, the solution is as good as elimination's.
#[test]
fn attempts_count_where_they_solve_the_system() {
    let mut random = Pcg64::seed_from_u64(5);
    let (mut taken, mut refused) = (0, 0);
    for case in 0..4_000 {
        let mut matrix = random_matrix(&mut random);
        for row in &mut matrix {
            let unit = 10_f64.powi(random.random_range(-12..12));
            row.iter_mut().for_each(|element| *element *= unit);
        }
        let exact: [f64; 6] = std::array::from_fn(|_| random.random_range(-1.0..1.0));
        let right_hand_side: [f64; 6] = (to_nalgebra(&matrix) * Vector6::from(exact)).into();
        let error = 10_f64.powi(-10 - case % 8);
        let attempt = exact.map(|x| x * (1.0 + random.random_range(-error..error)));
        let by_elimination = solve_general(&matrix, &right_hand_side);
        let mut in_lanes = [0.0; 6];
        triple::run(Attempt(attempt, &matrix, right_hand_side, &mut in_lanes));
        for x in [solve_after_attempt(&attempt, &matrix, &right_hand_side), in_lanes] {
            assert!(residual_in_roundings(&matrix, &x, &right_hand_side) < 50.0, "case {case}");
            match x {
                x if x == attempt => taken += 1,
                x => {
                    assert_eq!(x, by_elimination, "case {case}");
                    refused += 1;
                }
            }
        }
    }
    assert!(taken > 1_000 && refused > 4_000, "{taken} taken, {refused} refused");
}

#[test]
fn attempts_without_numbers_or_with_too_large_ones_are_refused() {
    let matrix: [[f64; 6]; 6] = Matrix6::identity().into();
    let right_hand_side = [1e200, 1.0, 2.0, 3.0, 4.0, 5.0];
    for wrong in [f64::NAN, f64::INFINITY, 0.0, 1e300, -1e200] {
        let attempt = [wrong, 1.0, 2.0, 3.0, 4.0, 5.0];
        assert_eq!(solve_after_attempt(&attempt, &matrix, &right_hand_side), right_hand_side);
    }
    // Squares of the terms overflow, that of the residual does not.
    let large = [1e155, 1.0, 2.0, 3.0, 4.0, 5.0];
    assert_eq!(solve_after_attempt(&[0.95e155, 1.0, 2.0, 3.0, 4.0, 5.0], &matrix, &large), large);
    assert_eq!(solve_after_attempt(&[0.0; 6], &matrix, &[0.0; 6]), [0.0; 6]);
    let singular = [[1.0; 6]; 6];
    assert!(solve_after_attempt(&[f64::NAN; 6], &singular, &right_hand_side).iter().any(|x| !x.is_finite()));
}

#[test]
fn solves_permutations_exactly() {
    let right_hand_side = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0];
    let mut matrix = [[0.0; 6]; 6];
    for (i, column) in [3, 5, 0, 2, 1, 4].into_iter().enumerate() {
        matrix[i][column] = 2.0;
    }
    assert_eq!(solve_general(&matrix, &right_hand_side), [1.5, 2.5, 2.0, 0.5, 3.0, 1.0]);
}

#[test]
fn singular_and_non_finite_systems_end_without_numbers() {
    let without_solution = [
        [[0.0; 3]; 3],
        [[1.0, 2.0, 3.0], [2.0, 4.0, 6.0], [1.0, 0.0, 0.0]],
        [[1.0, 0.0, 2.0], [3.0, 0.0, 4.0], [5.0, 0.0, 1.0]],
        [[f64::NAN, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, f64::NAN, 1.0]],
    ];
    for matrix in without_solution {
        assert!(solve_general(&matrix, &[1.0; 3]).iter().any(|x| !x.is_finite()), "{matrix:?}");
        assert_eq!(reciprocal_condition(&matrix), 0.0, "{matrix:?}");
    }
    let infinite = [[f64::INFINITY, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, f64::NEG_INFINITY]];
    assert_eq!(reciprocal_condition(&infinite), 0.0);
}

#[test]
fn condition_numbers_of_known_matrices() {
    let identity: [[f64; 6]; 6] = Matrix6::identity().into();
    assert_eq!(reciprocal_condition(&identity), 1.0);
    // Hilbert matrix of order 6: column sum 49/20, and 11 865 420 of its integer inverse.
    let hilbert: [[f64; 6]; 6] = std::array::from_fn(|r| std::array::from_fn(|c| 1.0 / (r + c + 1) as f64));
    assert!((1.0 / reciprocal_condition(&hilbert) / 29_070_279.0 - 1.0).abs() < 1e-8);
    // [[1, 1], [1, 1 + e]]: (2 + e)^2 / e.
    let e: f64 = 1e-6;
    let nearly_singular = [[1.0, 1.0], [1.0, 1.0 + e]];
    assert!((reciprocal_condition(&nearly_singular) * (2.0 + e).powi(2) / e - 1.0).abs() < 1e-9);
    // A small pivot alone says nothing about the condition.
    assert!(reciprocal_condition(&[[1e-15, 1.0], [1.0, 0.0]]) > 0.99);
}

/// Three pairs of rods between two circles of `radius`, `twist` apart in angle; each row over its `u.a`.
fn jacobian(radius: f64, inclinations: [f64; 6], twist: f64) -> [[f64; 6]; 6] {
    std::array::from_fn(|leg| {
        let side = if leg % 2 == 0 { 1.0 } else { -1.0 };
        let centre = std::f64::consts::TAU / 3.0 * (leg / 2) as f64;
        let about_z = |angle: f64| Rotation3::from_axis_angle(&Vector3::z_axis(), angle);
        let joint = about_z(centre + side * 0.2) * Vector3::new(radius, 0.0, 0.0);
        let foot = about_z(centre + side * (0.2 + twist)) * Vector3::new(radius, 0.0, 0.0);
        let rod = (joint - foot + Vector3::new(0.0, 0.0, radius)).normalize() / inclinations[leg];
        let moment = joint.cross(&rod);
        [rod.x, rod.y, rod.z, moment.x, moment.y, moment.z]
    })
}

#[test]
fn condition_of_a_jacobian_depends_neither_on_size_nor_on_actuators() {
    let condition = jacobian_reciprocal_condition(&jacobian(0.1, [1.0; 6], 0.6));
    assert!(condition > 0.02, "{condition}");
    let close = |other: f64| (other / condition - 1.0).abs() < 1e-12;
    // Neither the size of the platform nor the unit of length matters ...
    assert!(close(jacobian_reciprocal_condition(&jacobian(100.0, [1.0; 6], 0.6))));
    // ... nor how inclined the actuators are to the rods ...
    assert!(close(jacobian_reciprocal_condition(&jacobian(0.1, [1.0, 0.5, 0.1, 0.02, -1.0, 0.7], 0.6))));
    // ... but rods that all stand upright cannot hold a horizontal force,
    assert_eq!(jacobian_reciprocal_condition(&jacobian(0.1, [1.0; 6], 0.0)), 0.0);
    // and nearly upright ones hardly.
    let nearly = jacobian_reciprocal_condition(&jacobian(0.1, [1.0; 6], 1e-9));
    assert!((1e-12..1e-8).contains(&nearly), "{nearly}");
}

/// Frames do count, as far as it is documented.
#[test]
fn condition_of_a_jacobian_belongs_to_its_reference_frames() {
    let rods = jacobian(0.1, [1.0; 6], 0.6);
    let condition = jacobian_reciprocal_condition(&rods);
    // P's origin moved by n radii of the joint circle.
    let from_afar = |n: f64| jacobian_reciprocal_condition(&about(&rods, Vector3::new(0.1 * n, 0.0, 0.0)));
    assert!((0.5..1.5).contains(&(from_afar(0.3) / condition)), "{}", from_afar(0.3) / condition);
    for n in [10.0, 1000.0] {
        let ratio = from_afar(n) * n / condition;
        assert!((0.5..2.0).contains(&ratio), "{ratio}");
    }
    // Everything turned in O.
    for leaning in [0.6, 0.3, -0.9] {
        let rods = jacobian(0.1, [1.0; 6], leaning);
        let condition = jacobian_reciprocal_condition(&rods);
        for k in 0..200 {
            let axis = Vector3::new((f64::from(k) * 0.7).sin(), (f64::from(k) * 1.3).cos(), 0.4).normalize();
            let turn = Rotation3::new(axis * (0.05 * f64::from(k)));
            let turned = rods.map(|row| {
                let [u, moment] = halves(row).map(|half| turn * half);
                [u.x, u.y, u.z, moment.x, moment.y, moment.z]
            });
            let ratio = jacobian_reciprocal_condition(&turned) / condition;
            assert!((0.5..2.0).contains(&ratio), "{ratio}");
        }
    }
}

/// Six rods towards one point cannot hold a moment about it, wherever it is.
#[test]
fn rods_that_meet_are_seen() {
    let centre = Vector3::new(0.02, -0.03, 0.07);
    let meeting = jacobian(0.1, [1.0; 6], 0.6).map(|row| {
        let [u, _] = halves(row);
        let moment = centre.cross(&u);
        [u.x, u.y, u.z, moment.x, moment.y, moment.z]
    });
    assert!(jacobian_reciprocal_condition(&meeting) < 1e-15);
}

fn halves([a, b, c, d, e, f]: [f64; 6]) -> [Vector3<f64>; 2] {
    [Vector3::new(a, b, c), Vector3::new(d, e, f)]
}

/// Moments about another point.
fn about(rods: &[[f64; 6]; 6], origin: Vector3<f64>) -> [[f64; 6]; 6] {
    rods.map(|row| {
        let [u, moment] = halves(row);
        let moment = moment - origin.cross(&u);
        [u.x, u.y, u.z, moment.x, moment.y, moment.z]
    })
}

#[test]
fn a_jacobian_without_rods_or_arms_is_singular() {
    assert_eq!(jacobian_reciprocal_condition(&[[0.0; 6]; 6]), 0.0);
    assert_eq!(jacobian_reciprocal_condition(&[[1.0, 0.0, 0.0, 0.0, 0.0, 0.0]; 6]), 0.0);
    assert_eq!(jacobian_reciprocal_condition(&[[f64::NAN; 6]; 6]), 0.0);
}
