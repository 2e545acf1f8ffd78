//! The paper's angles `c = [c1, c2, c3]` (alpha, beta, gamma of the base; psi, theta, phi of the platform),
//! in radians, with `R = Rz(c3) Ry(c2) Rx(c1)` (2), and their rates.
//!
//! The dynamics know rotations and angular velocities only. Whoever measures or commands these angles
//! converts at the border, with the functions below: **the rates of the angles are not the angular
//! velocity.**

use nalgebra::{Matrix3, Rotation3, Vector3};

use crate::error::GimbalLock;
use crate::float::{atan2, sin_cos, sqrt};
use crate::real::Real;

/// [`Real::MIN_COS_C2`] of `f64`.
pub const MIN_COS_C2: f64 = <f64 as Real>::MIN_COS_C2;

/// `R = Rz(c3) Ry(c2) Rx(c1)` (2): body coordinates to coordinates in the frame that the angles refer to, O
/// for base and platform.
pub fn rotation<T: Real>(angles: [T; 3]) -> Rotation3<T> {
    let [(s1, c1), (s2, c2), (s3, c3)] = T::sine_cosines(angles);
    #[rustfmt::skip]
    let matrix = Matrix3::new(
        c3 * c2, c3 * s2 * s1 - s3 * c1, c3 * s2 * c1 + s3 * s1,
        s3 * c2, s3 * s2 * s1 + c3 * c1, s3 * s2 * c1 - c3 * s1,
        -s2,     c2 * s1,                c2 * c1,
    );
    Rotation3::from_matrix_unchecked(matrix)
}

/// Angles, rad, of a rotation from body coordinates to O: the inverse of [`rotation`]. `c1` and `c3` lie in
/// `[-pi, pi]`, `c2` in `[-pi/2, pi/2]`.
///
/// At gimbal lock, `c2 = +-pi/2`, the rotation depends on `c1 -+ c3` only; there, `|cos c2|` at most [`Real::LOCKED_COS_C2`],
/// `c3` is 0. Near it `c1` and `c3` are uncertain by the matrix's errors over `|cos c2|`, each for itself, but
/// they belong together: everywhere [`rotation`] gives the same matrix back, to about 1e-15. The angles of a
/// motion through the lock jump.
///
/// Elements that are not finite make angles that are not.
///
/// ```
/// use dyn_runtime::angles;
///
/// let [c1, c2, c3] = angles::from_rotation(&angles::rotation([0.1_f64, -0.2, 0.3]));
/// assert!((c1 - 0.1).abs() < 1e-15 && (c2 + 0.2).abs() < 1e-15 && (c3 - 0.3).abs() < 1e-15);
/// ```
pub fn from_rotation<T: Real>(rotation: &Rotation3<T>) -> [T; 3] {
    let r = rotation.matrix();
    // An arc tangent keeps its digits near +-pi/2, where an arc sine loses half of them.
    let cos_c2 = sqrt(r[(0, 0)] * r[(0, 0)] + r[(1, 0)] * r[(1, 0)]);
    let c2 = atan2(-r[(2, 0)], cos_c2);
    let c3 = if cos_c2 <= T::LOCKED_COS_C2 { T::zero() } else { atan2(r[(1, 0)], r[(0, 0)]) };
    // Rz(c3)^T R = Ry(c2) Rx(c1), whose second row is [0, cos c1, -sin c1]: the c1 that goes with this c3.
    let (sin_c3, cos_c3) = sin_cos(c3);
    let sin_c1 = sin_c3 * r[(0, 2)] - cos_c3 * r[(1, 2)];
    let cos_c1 = cos_c3 * r[(1, 1)] - sin_c3 * r[(0, 1)];
    [atan2(sin_c1, cos_c1), c2, c3]
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
pub fn angular_velocity<T: Real>(angles: [T; 3], rates: [T; 3]) -> Vector3<T> {
    rate_matrix(angles) * Vector3::from(rates)
}

/// Angular acceleration `w'`, rad/s^2, O axes, from angles (rad), rates (rad/s) and second derivatives
/// (rad/s^2): the time derivative of [`angular_velocity`].
pub fn angular_acceleration<T: Real>(
    angles: [T; 3],
    rates: [T; 3],
    second_derivatives: [T; 3],
) -> Vector3<T> {
    let zero = T::zero();
    let [_, (s2, c2), (s3, c3)] = T::sine_cosines(angles);
    let [_, r2, r3] = rates;
    #[rustfmt::skip]
    let rate_matrix_derivative = Matrix3::new(
        -s3 * c2 * r3 - c3 * s2 * r2, -c3 * r3, zero,
         c3 * c2 * r3 - s3 * s2 * r2, -s3 * r3, zero,
        -c2 * r2,                      zero,     zero,
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
/// # Errors
/// [`GimbalLock`] if `|cos c2|` is below [`Real::MIN_COS_C2`], or `c2` not finite: most motions have no finite
/// rates there. Other elements that are not finite make rates that are not.
pub fn angle_rates<T: Real>(
    angles: [T; 3],
    angular_velocity_rad_s: Vector3<T>,
) -> Result<[T; 3], GimbalLock> {
    let [_, (s2, c2), (s3, c3)] = T::sine_cosines(angles);
    if !c2.is_finite() || c2.abs() < T::MIN_COS_C2 {
        return Err(GimbalLock { cos_c2: c2.to_f64() });
    }
    let w = angular_velocity_rad_s;
    let rate_1 = (c3 * w.x + s3 * w.y) / c2;
    Ok([rate_1, c3 * w.y - s3 * w.x, w.z + s2 * rate_1])
}

/// The matrix of [`angular_velocity`].
fn rate_matrix<T: Real>(angles: [T; 3]) -> Matrix3<T> {
    let [_, (s2, c2), (s3, c3)] = T::sine_cosines(angles);
    let (zero, one) = (T::zero(), T::one());
    #[rustfmt::skip]
    let matrix = Matrix3::new(
        c3 * c2,  -s3, zero,
        s3 * c2,   c3, zero,
        -s2,     zero,  one,
    );
    matrix
}
