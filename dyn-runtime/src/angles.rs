//! The paper's angles `c = [c1, c2, c3]` (alpha, beta, gamma of the base; psi, theta, phi of the platform),
//! in radians, with `R = Rz(c3) Ry(c2) Rx(c1)` (2), and their rates.
//!
//! The dynamics know rotations and angular velocities only. Whoever measures or commands these angles
//! converts at the border, with the functions below: **the rates of the angles are not the angular
//! velocity.**

use nalgebra::{Matrix3, Rotation3, Vector3};

use crate::float::sin_cos;

/// `R = Rz(c3) Ry(c2) Rx(c1)` (2): body coordinates to coordinates in the frame that the angles refer to, O
/// for base and platform.
pub fn rotation(angles: [f64; 3]) -> Rotation3<f64> {
    let [(s1, c1), (s2, c2), (s3, c3)] = angles.map(sin_cos);
    #[rustfmt::skip]
    let matrix = Matrix3::new(
        c3 * c2, c3 * s2 * s1 - s3 * c1, c3 * s2 * c1 + s3 * s1,
        s3 * c2, s3 * s2 * s1 + c3 * c1, s3 * s2 * c1 - c3 * s1,
        -s2,     c2 * s1,                c2 * c1,
    );
    Rotation3::from_matrix_unchecked(matrix)
}

/// Angular velocity `w`, rad/s, O axes, from angles (rad) and their rates (rad/s):
///
/// ```text
///     | cos c3 cos c2   -sin c3   0 |
/// w = | sin c3 cos c2    cos c3   0 | c'
///     |    -sin c2          0     1 |
/// ```
///
/// Its inverse is [`angle_rates`].
pub fn angular_velocity(angles: [f64; 3], rates: [f64; 3]) -> Vector3<f64> {
    rate_matrix(angles) * Vector3::from(rates)
}

/// Angular acceleration `w'`, rad/s^2, O axes, from angles (rad), rates (rad/s) and second derivatives
/// (rad/s^2): the time derivative of [`angular_velocity`].
pub fn angular_acceleration(angles: [f64; 3], rates: [f64; 3], second_derivatives: [f64; 3]) -> Vector3<f64> {
    let [_, (s2, c2), (s3, c3)] = angles.map(sin_cos);
    let [_, r2, r3] = rates;
    #[rustfmt::skip]
    let rate_matrix_derivative = Matrix3::new(
        -s3 * c2 * r3 - c3 * s2 * r2, -c3 * r3, 0.0,
         c3 * c2 * r3 - s3 * s2 * r2, -s3 * r3, 0.0,
        -c2 * r2,                      0.0,     0.0,
    );
    rate_matrix(angles) * Vector3::from(second_derivatives) + rate_matrix_derivative * Vector3::from(rates)
}

/// Rates of the angles, rad/s, from angles (rad) and angular velocity (rad/s, O axes); the inverse of
/// [`angular_velocity`]:
///
/// ```text
/// c1' = (cos c3 wx + sin c3 wy) / cos c2
/// c2' = cos c3 wy - sin c3 wx
/// c3' = wz + sin c2 c1'
/// ```
///
/// At `c2 = +-pi/2` the angles are singular (a motion may have no finite rates); near it the rates are huge.
pub fn angle_rates(angles: [f64; 3], angular_velocity_rad_s: Vector3<f64>) -> [f64; 3] {
    let [_, (s2, c2), (s3, c3)] = angles.map(sin_cos);
    let w = angular_velocity_rad_s;
    let rate_1 = (c3 * w.x + s3 * w.y) / c2;
    [rate_1, c3 * w.y - s3 * w.x, w.z + s2 * rate_1]
}

/// The matrix of [`angular_velocity`].
fn rate_matrix(angles: [f64; 3]) -> Matrix3<f64> {
    let [_, (s2, c2), (s3, c3)] = angles.map(sin_cos);
    #[rustfmt::skip]
    let matrix = Matrix3::new(
        c3 * c2, -s3, 0.0,
        s3 * c2,  c3, 0.0,
        -s2,     0.0, 1.0,
    );
    matrix
}
