//! Poses from three representations, rotations that are refused, the paper's angles and their rates.

use std::f64::consts::{FRAC_PI_2, PI};

use dyn_runtime::nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};
use dyn_runtime::{MAX_ROTATION_DEVIATION, Pose, angles, angles::MIN_COS_C2};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

fn random_angles(random: &mut Pcg64) -> [f64; 3] {
    [random.random_range(-3.1..3.1), random.random_range(-1.5..1.5), random.random_range(-3.1..3.1)]
}

#[test]
fn three_representations_give_one_pose() {
    let mut random = Pcg64::seed_from_u64(5);
    let position = Vector3::new(0.1, -0.2, 0.3);
    for _ in 0..1_000 {
        let [c1, c2, c3] = random_angles(&mut random);
        let from_angles = Pose::from_paper_angles(position, [c1, c2, c3]);
        // Three turns about fixed axes, first x, last z: another library's trigonometry and order of
        // products.
        let quaternion = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), c3)
            * UnitQuaternion::from_axis_angle(&Vector3::y_axis(), c2)
            * UnitQuaternion::from_axis_angle(&Vector3::x_axis(), c1);
        let from_quaternion = Pose::from_unit_quaternion(position, &quaternion);
        let matrix = Rotation3::from_axis_angle(&Vector3::z_axis(), c3)
            * Rotation3::from_axis_angle(&Vector3::y_axis(), c2)
            * Rotation3::from_axis_angle(&Vector3::x_axis(), c1);
        let from_matrix = Pose::from_rotation_matrix(position, matrix.matrix()).expect("a rotation");
        for pose in [from_quaternion, from_matrix] {
            assert_eq!(pose.position_m, position);
            assert!((pose.rotation.matrix() - from_angles.rotation.matrix()).amax() < 2e-15);
        }
    }
}

#[test]
fn a_quaternion_has_its_real_part_first_and_needs_norm_one() {
    let mut random = Pcg64::seed_from_u64(11);
    let position = Vector3::new(0.1, -0.2, 0.3);
    for _ in 0..1_000 {
        let quaternion = UnitQuaternion::new(Vector3::from_fn(|_, _| random.random_range(-3.0..3.0)));
        let [x, y, z, w]: [f64; 4] = quaternion.coords.into();
        let expected = quaternion.to_rotation_matrix();
        for [w, x, y, z] in [[w, x, y, z], [-w, -x, -y, -z]] {
            let pose = Pose::from_quaternion(position, [w, x, y, z]).expect("norm 1");
            assert_eq!(pose.position_m, position);
            assert!((pose.rotation.matrix() - expected.matrix()).amax() < 1e-15);
            // Single precision passes, and a rotation is left.
            let single = [w, x, y, z].map(|number| f64::from(number as f32));
            let rotation =
                Pose::from_quaternion(position, single).expect("norm 1 in single precision").rotation;
            assert!((rotation.matrix() - expected.matrix()).amax() < 5e-7);
            assert!((rotation.matrix().transpose() * rotation.matrix() - Matrix3::identity()).amax() < 2e-15);
        }
    }
    let scaled = |norm_squared: f64| {
        Pose::from_quaternion(position, [0.5, -0.5, 0.5, 0.5].map(|number| number * norm_squared.sqrt()))
    };
    assert!(scaled(1.0 + 0.999 * MAX_ROTATION_DEVIATION).is_ok());
    assert!(scaled(1.0 - 0.999 * MAX_ROTATION_DEVIATION).is_ok());
    assert!(scaled(1.0 + 1.001 * MAX_ROTATION_DEVIATION).is_err());
    let refused = scaled(4.0).expect_err("norm 2");
    assert_eq!(refused.norm_squared, 4.0);
    assert!(refused.to_string().contains("its norm squared is 4"), "{refused}");
    assert!(scaled(f64::NAN).is_err() && scaled(f64::INFINITY).is_err() && scaled(0.0).is_err());
}

#[test]
fn composing_poses_transforms_points() {
    let base = Pose::from_paper_angles(Vector3::new(1.0, 2.0, 3.0), [0.3, -0.4, 0.5]);
    let home = Pose::from_paper_angles(Vector3::new(0.0, 0.1, 0.4), [-0.1, 0.2, 0.7]);
    let platform = base.compose(&home);
    let point = Vector3::new(0.2, -0.3, 0.1);
    let in_b = home.position_m + home.rotation * point;
    let in_o = base.position_m + base.rotation * in_b;
    assert!((platform.position_m + platform.rotation * point - in_o).amax() < 1e-15);
    assert_eq!(base.compose(&Pose::identity()), base);
}

#[test]
fn what_is_not_a_rotation_is_refused_with_its_distance() {
    let refused =
        |matrix: Matrix3<f64>| Pose::from_rotation_matrix(Vector3::zeros(), &matrix).expect_err("refused");
    let rotation = *angles::rotation([0.2, 0.3, 0.4]).matrix();

    let stretched = refused(rotation * 1.001);
    assert!((stretched.deviation - 0.002001).abs() < 1e-12);
    assert!((stretched.determinant - 1.003003001).abs() < 1e-12);

    let reflected = refused(-rotation);
    assert!(reflected.deviation < 1e-15);
    assert!((reflected.determinant + 1.0).abs() < 1e-15);

    let mut with_nan = rotation;
    with_nan[(1, 2)] = f64::NAN;
    assert!(refused(with_nan).deviation.is_nan());
    let mut with_infinity = rotation;
    with_infinity[(0, 0)] = f64::INFINITY;
    assert!(refused(with_infinity).deviation.is_nan());

    assert!(refused(Matrix3::zeros()).deviation == 1.0);
    assert!(stretched.to_string().contains("differs from 1 by 2.0e-3"), "{stretched}");
}

/// What single precision leaves of a rotation passes; the threshold is where it is documented.
#[test]
fn single_precision_passes() {
    let mut random = Pcg64::seed_from_u64(6);
    for _ in 0..1_000 {
        let rounded = angles::rotation(random_angles(&mut random)).matrix().map(|x| f64::from(x as f32));
        assert!(Pose::from_rotation_matrix(Vector3::zeros(), &rounded).is_ok());
    }
    let at = |deviation: f64| Matrix3::identity() * (1.0 + deviation).sqrt();
    assert!(Pose::from_rotation_matrix(Vector3::zeros(), &at(0.999 * MAX_ROTATION_DEVIATION)).is_ok());
    assert!(Pose::from_rotation_matrix(Vector3::zeros(), &at(1.001 * MAX_ROTATION_DEVIATION)).is_err());
}

/// Angles that change with constant second derivatives.
fn angles_at(t: f64, angles: [f64; 3], rates: [f64; 3], second: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| angles[k] + t * rates[k] + 0.5 * t * t * second[k])
}

#[test]
fn angular_velocity_is_the_derivative_of_the_rotation() {
    let mut random = Pcg64::seed_from_u64(7);
    for _ in 0..200 {
        let angles = random_angles(&mut random);
        let rates: [f64; 3] = std::array::from_fn(|_| random.random_range(-2.0..2.0));
        let rotation_at = |t| *angles::rotation(angles_at(t, angles, rates, [0.0; 3])).matrix();
        let h = 1e-5;
        let skew = (rotation_at(h) - rotation_at(-h)) / (2.0 * h) * rotation_at(0.0).transpose();
        let expected = Vector3::new(skew[(2, 1)], skew[(0, 2)], skew[(1, 0)]);
        assert!((angles::angular_velocity(angles, rates) - expected).amax() < 1e-8);
    }
}

#[test]
fn angular_acceleration_is_the_derivative_of_the_angular_velocity() {
    let mut random = Pcg64::seed_from_u64(8);
    for _ in 0..200 {
        let angles = random_angles(&mut random);
        let rates: [f64; 3] = std::array::from_fn(|_| random.random_range(-2.0..2.0));
        let second: [f64; 3] = std::array::from_fn(|_| random.random_range(-2.0..2.0));
        let velocity_at = |t: f64| {
            let rates_then = std::array::from_fn(|k| rates[k] + t * second[k]);
            angles::angular_velocity(angles_at(t, angles, rates, second), rates_then)
        };
        let h = 1e-5;
        let expected = (velocity_at(h) - velocity_at(-h)) / (2.0 * h);
        assert!((angles::angular_acceleration(angles, rates, second) - expected).amax() < 1e-7);
    }
}

#[test]
fn rates_of_the_angles_come_back() {
    let mut random = Pcg64::seed_from_u64(9);
    for _ in 0..1_000 {
        let angles = random_angles(&mut random);
        let rates: [f64; 3] = std::array::from_fn(|_| random.random_range(-2.0..2.0));
        let back =
            angles::angle_rates(angles, angles::angular_velocity(angles, rates)).expect("off the lock");
        // Near c2 = +-pi/2 rounding errors grow by 1/cos c2, at most 14 here.
        assert!(back.iter().zip(rates).all(|(back, rate)| (back - rate).abs() < 1e-13));
    }
    // Rates and angular velocity differ as soon as the body is turned.
    let w = angles::angular_velocity([0.0, 0.5, 0.0], [1.0, 0.0, 0.0]);
    assert!((w - Vector3::new(0.5_f64.cos(), 0.0, -0.5_f64.sin())).amax() < 1e-15);
}

#[test]
fn no_rates_at_gimbal_lock() {
    let w = Vector3::new(0.1, 0.2, 0.3);
    for lock in [FRAC_PI_2, -FRAC_PI_2, 3.0 * FRAC_PI_2] {
        let refused =
            |distance: f64| angles::angle_rates([0.4, lock + distance, 0.5], w).expect_err("locked");
        assert!(refused(0.0).cos_c2.abs() < 1e-15);
        for distance in [0.99 * MIN_COS_C2, -0.99 * MIN_COS_C2] {
            assert!((refused(distance).cos_c2.abs() / distance.abs() - 1.0).abs() < 1e-9);
        }
        let rates = angles::angle_rates([0.4, lock + 1.01 * MIN_COS_C2, 0.5], w).expect("off the lock");
        assert!(rates.iter().all(|rate| rate.abs() < 1.0 / MIN_COS_C2), "{rates:?}");
    }
    assert!(angles::angle_rates([0.0, f64::NAN, 0.0], w).expect_err("no angle").cos_c2.is_nan());
}

#[test]
fn angles_of_a_rotation_come_back() {
    let mut random = Pcg64::seed_from_u64(20);
    for _ in 0..10_000 {
        let angles = random_angles(&mut random);
        let back = angles::from_rotation(&angles::rotation(angles));
        // Errors of c1 and c3 grow by 1/cos c2, at most 14 here.
        assert!(
            back.iter().zip(angles).all(|(back, angle)| (back - angle).abs() < 2e-14),
            "{angles:?} {back:?}"
        );
    }
    // All eight corners of the ranges, and the axes between them.
    for c1 in [-PI, -FRAC_PI_2, 0.0, FRAC_PI_2, PI] {
        for c3 in [-PI, -FRAC_PI_2, 0.0, FRAC_PI_2, PI] {
            for c2 in [-1.5, 0.0, 1.5] {
                let rotation = angles::rotation([c1, c2, c3]);
                let again = angles::rotation(angles::from_rotation(&rotation));
                assert!((again.matrix() - rotation.matrix()).amax() < 1e-15, "{c1} {c2} {c3}");
            }
        }
    }
    let mut with_nan = *angles::rotation([0.1, 0.2, 0.3]).matrix();
    with_nan[(2, 0)] = f64::NAN;
    assert!(angles::from_rotation(&Rotation3::from_matrix_unchecked(with_nan))[1].is_nan());
}

/// At the lock only c1 -+ c3 shows; near it the matrix comes back all the same.
#[test]
fn angles_at_gimbal_lock() {
    for sign in [1.0, -1.0] {
        let [c1, c2, c3] = angles::from_rotation(&angles::rotation([0.7, sign * FRAC_PI_2, 0.2]));
        assert_eq!((c2, c3), (sign * FRAC_PI_2, 0.0));
        assert!((c1 - (0.7 - sign * 0.2)).abs() < 1e-15);
        // Exactly, without the rounding of cos(pi/2).
        #[rustfmt::skip]
        let exact = Matrix3::new(
            0.0,   0.0, sign,
            0.0,   1.0, 0.0,
            -sign, 0.0, 0.0,
        );
        let exact = angles::from_rotation(&Rotation3::from_matrix_unchecked(exact));
        assert_eq!(exact, [0.0, sign * FRAC_PI_2, 0.0]);

        let mut random = Pcg64::seed_from_u64(21);
        for exponent in 1..20 {
            for _ in 0..100 {
                let [c1, _, c3] = random_angles(&mut random);
                let distance = random.random_range(-1.0..1.0) * 10_f64.powi(-exponent);
                let rotation = angles::rotation([c1, sign * FRAC_PI_2 + distance, c3]);
                let angles = angles::from_rotation(&rotation);
                let again = angles::rotation(angles);
                assert!((again.matrix() - rotation.matrix()).amax() < 3e-15, "{distance:e} {angles:?}");
                assert!(angles[1].abs() <= FRAC_PI_2 && angles[0].abs() <= PI && angles[2].abs() <= PI);
            }
        }
    }
}
