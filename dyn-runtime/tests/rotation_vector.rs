//! Rotations by rotation vectors against nalgebra's and against finite differences; steps that keep them rotations.

use dyn_runtime::nalgebra::{Matrix3, Rotation3, Vector3};
use dyn_runtime::rotation_vector;

#[test]
fn rotation_is_the_rotation_about_the_vector() {
    for angle in [1e-9, 1e-3, 0.0099, 0.0101, 0.5, 0.999, 1.001, 2.5] {
        let phi = Vector3::new(0.6, -0.48, 0.64) * angle;
        let error = (rotation_vector::rotation(&phi).matrix() - Rotation3::new(phi).matrix()).amax();
        assert!(error < 4e-16, "{angle}: {error:e}");
    }
}

/// Angular velocity and acceleration against finite differences of R and w.
#[test]
fn angular_motion_is_that_of_the_rotation() {
    let phi = |t: f64| Vector3::new((1.3 * t).sin(), 0.7 * (0.9 * t).cos(), 0.4 * t * t - 0.2) * 0.9;
    let d = 1e-4;
    let central = |f: &dyn Fn(f64) -> Matrix3<f64>, t: f64| {
        (f(t - 2.0 * d) - f(t - d) * 8.0 + f(t + d) * 8.0 - f(t + 2.0 * d)) / (12.0 * d)
    };
    let rate = |t: f64| Vector3::new(1.3 * (1.3 * t).cos(), -0.63 * (0.9 * t).sin(), 0.8 * t) * 0.9;
    let second = |t: f64| Vector3::new(-1.69 * (1.3 * t).sin(), -0.567 * (0.9 * t).cos(), 0.8) * 0.9;
    for t in [0.0, 0.3, 1.0, 1.7] {
        let (w, acceleration) = rotation_vector::angular_motion(&phi(t), &rate(t), &second(t));
        let r_rate = central(&|t| *rotation_vector::rotation(&phi(t)).matrix(), t);
        let error = (r_rate - w.cross_matrix() * rotation_vector::rotation(&phi(t)).matrix()).amax();
        assert!(error < 1e-11, "{t}: {error:e}");
        let w_rate =
            central(&|t| rotation_vector::angular_motion(&phi(t), &rate(t), &second(t)).0.cross_matrix(), t);
        let error = (w_rate - acceleration.cross_matrix()).amax();
        assert!(error < 1e-11, "{t}: {error:e}");
    }
}

#[test]
fn rotation_vector_rate_inverts_the_angular_velocity() {
    let (phi, rate) = (Vector3::new(0.02, -0.01, 0.03), Vector3::new(1.0, -2.0, 0.5));
    let (w, _) = rotation_vector::angular_motion(&phi, &rate, &Vector3::zeros());
    let error = (rotation_vector::rate_within_step(&phi, &w) - rate).norm();
    assert!(error < 1e-8, "{error:e}");
}

#[test]
fn single_precision_is_as_good() {
    for angle in [1e-3, 0.009, 0.5, 1.5_f32] {
        let phi = Vector3::new(0.6, -0.48, 0.64) * angle;
        let error = (rotation_vector::rotation(&phi).matrix() - Rotation3::new(phi).matrix()).amax();
        assert!(error < 3e-7, "{angle}: {error:e}");
    }
}

#[test]
fn orthonormalising_squares_the_errors_of_rounding() {
    let rotation = rotation_vector::rotation(&Vector3::new(0.3, -0.7, 0.2));
    let disturbed =
        rotation.matrix() * (Matrix3::identity() + Matrix3::from_fn(|i, k| 1e-6 * (i + 2 * k) as f64));
    let nearest = rotation_vector::orthonormalised(&Rotation3::from_matrix_unchecked(disturbed));
    let deviation = |matrix: &Matrix3<f64>| (matrix.transpose() * matrix - Matrix3::identity()).amax();
    assert!(deviation(&disturbed) > 1e-6);
    assert!(deviation(nearest.matrix()) < 1e-9);
}
