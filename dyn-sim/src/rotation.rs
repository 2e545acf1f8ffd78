//! Rotations by rotation vectors: `R = exp([phi]x)`, their angular velocity and acceleration.
//!
//! The angular velocity is that of `R' = [w]x R`, in the axes to which R turns (O for a body's rotation):
//!
//! ```text
//! w  = phi' + a phi x phi' + b phi x (phi x phi'),   a = (1 - cos s)/s^2,   b = (s - sin s)/s^3,   s = |phi|
//! ```

use dyn_runtime::nalgebra::{Matrix3, Rotation3, Vector3};

/// Below this angle squared, quotients like `(1 - cos s)/s^2` come from their series.
const SERIES_LIMIT: f64 = 1.0;

/// Terms of the series up to [`SERIES_LIMIT`]; the first one left out is below `1/(2 * 10)!`.
const TERMS: usize = 10;

/// Below this angle squared, [`FEW`] terms give full precision: the turns within an integration step.
const SMALL: f64 = 1e-4;

/// Terms of the series up to [`SMALL`]; the first one left out is below `1e-16/9!`.
const FEW: usize = 4;

/// `sin s/s` as a series in `s^2`.
const SINC: [f64; TERMS] = alternating_reciprocal_factorials(1);
/// a as a series in `s^2`.
const A: [f64; TERMS] = alternating_reciprocal_factorials(2);
/// b as a series in `s^2`.
const B: [f64; TERMS] = alternating_reciprocal_factorials(3);

/// `(-1)^k / (2 k + first)!`
const fn alternating_reciprocal_factorials(first: usize) -> [f64; TERMS] {
    let mut values = [0.0; TERMS];
    let mut k = 0;
    while k < TERMS {
        let mut factorial = 1.0;
        let mut n = 2;
        while n <= 2 * k + first {
            factorial *= n as f64;
            n += 1;
        }
        values[k] = if k % 2 == 0 { 1.0 / factorial } else { -1.0 / factorial };
        k += 1;
    }
    values
}

/// A polynomial and its derivative.
#[inline]
fn polynomial<const N: usize>(coefficients: &[f64; N], x: f64) -> (f64, f64) {
    let (mut value, mut derivative) = (0.0, 0.0);
    for coefficient in coefficients.iter().rev() {
        derivative = derivative * x + value;
        value = value * x + coefficient;
    }
    (value, derivative)
}

/// `sin s/s` and a, for `square = s^2`.
#[inline]
fn sinc_and_a(square: f64) -> (f64, f64) {
    if square < SMALL {
        let few = |series: &[f64; TERMS]| {
            let mut first = [0.0; FEW];
            first.copy_from_slice(&series[..FEW]);
            polynomial(&first, square).0
        };
        return (few(&SINC), few(&A));
    }
    if square <= SERIES_LIMIT {
        return (polynomial(&SINC, square).0, polynomial(&A, square).0);
    }
    let s = square.sqrt();
    let (sin, cos) = s.sin_cos();
    (sin / s, (1.0 - cos) / square)
}

/// a and b with their derivatives by `s^2`, for `square = s^2`.
fn a_and_b(square: f64) -> [(f64, f64); 2] {
    if square <= SERIES_LIMIT {
        return [polynomial(&A, square), polynomial(&B, square)];
    }
    let s = square.sqrt();
    let (sin, cos) = s.sin_cos();
    let (fourth, fifth) = (square * square, square * square * s);
    [
        ((1.0 - cos) / square, (s * sin - 2.0 * (1.0 - cos)) / (2.0 * fourth)),
        ((s - sin) / (square * s), (3.0 * sin - s * (2.0 + cos)) / (2.0 * fifth)),
    ]
}

/// `[v]x`, so that `[v]x y = v x y`.
pub fn cross_matrix(v: &Vector3<f64>) -> Matrix3<f64> {
    Matrix3::new(0.0, -v.z, v.y, v.z, 0.0, -v.x, -v.y, v.x, 0.0)
}

/// `exp([phi]x)`: the rotation about `phi` by `|phi|` rad.
#[inline]
pub fn exponential(phi: &Vector3<f64>) -> Rotation3<f64> {
    let (sinc, a) = sinc_and_a(phi.norm_squared());
    let (x, y, z) = (phi.x, phi.y, phi.z);
    let (sx, sy, sz) = (sinc * x, sinc * y, sinc * z);
    let (axy, axz, ayz) = (a * x * y, a * x * z, a * y * z);
    let (axx, ayy, azz) = (a * x * x, a * y * y, a * z * z);
    Rotation3::from_matrix_unchecked(Matrix3::new(
        1.0 - (ayy + azz),
        axy - sz,
        axz + sy,
        axy + sz,
        1.0 - (axx + azz),
        ayz - sx,
        axz - sy,
        ayz + sx,
        1.0 - (axx + ayy),
    ))
}

/// Angular velocity (rad/s) and acceleration (rad/s^2) of `exp([phi]x)` from the rotation vector (rad) and its two
/// time derivatives, exact at any angle.
pub fn angular_motion(
    phi: &Vector3<f64>,
    rate: &Vector3<f64>,
    second: &Vector3<f64>,
) -> (Vector3<f64>, Vector3<f64>) {
    let [(a, a_by_square), (b, b_by_square)] = a_and_b(phi.norm_squared());
    let square_rate = 2.0 * phi.dot(rate);
    let turn = phi.cross(rate);
    let turn_rate = phi.cross(second);
    let twice = phi.cross(&turn);
    let velocity = rate + turn * a + twice * b;
    let acceleration = second
        + turn * (a_by_square * square_rate)
        + turn_rate * a
        + twice * (b_by_square * square_rate)
        + (rate.cross(&turn) + phi.cross(&turn_rate)) * b;
    (velocity, acceleration)
}

/// The rate of the rotation vector `phi` under angular velocity `w`, up to the second commutator:
/// `phi' = w - phi x w/2 + phi x (phi x w)/12`; what is left out is of fourth order in `phi`.
#[inline]
pub fn rotation_vector_rate(phi: &Vector3<f64>, w: &Vector3<f64>) -> Vector3<f64> {
    let once = phi.cross(w);
    w - once * 0.5 + phi.cross(&once) / 12.0
}

/// The rotation nearest to a product of rotations, for errors of rounding: one step of Newton's iteration squares them.
#[inline]
pub fn orthonormalised(rotation: &Rotation3<f64>) -> Rotation3<f64> {
    let matrix = rotation.matrix();
    Rotation3::from_matrix_unchecked((matrix * 3.0 - matrix * (matrix.transpose() * matrix)) * 0.5)
}

/// Row by row, as generated functions and files have it.
pub fn rows(rotation: &Rotation3<f64>) -> [[f64; 3]; 3] {
    rotation.matrix().transpose().into()
}

/// From rows; the caller knows that they are those of a rotation.
pub fn from_rows(rows: &[[f64; 3]; 3]) -> Rotation3<f64> {
    Rotation3::from_matrix_unchecked(Matrix3::from(*rows).transpose())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exponential_is_the_rotation_about_the_vector() {
        for angle in [1e-9, 1e-3, 0.0099, 0.0101, 0.5, 0.999, 1.001, 2.5] {
            let phi = Vector3::new(0.6, -0.48, 0.64) * angle;
            let error = (exponential(&phi).matrix() - Rotation3::new(phi).matrix()).amax();
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
            let (w, acceleration) = angular_motion(&phi(t), &rate(t), &second(t));
            let r_rate = central(&|t| *exponential(&phi(t)).matrix(), t);
            let error = (r_rate - cross_matrix(&w) * exponential(&phi(t)).matrix()).amax();
            assert!(error < 1e-11, "{t}: {error:e}");
            let w_rate = central(&|t| cross_matrix(&angular_motion(&phi(t), &rate(t), &second(t)).0), t);
            let error = (w_rate - cross_matrix(&acceleration)).amax();
            assert!(error < 1e-11, "{t}: {error:e}");
        }
    }

    #[test]
    fn rotation_vector_rate_inverts_the_angular_velocity() {
        let (phi, rate) = (Vector3::new(0.02, -0.01, 0.03), Vector3::new(1.0, -2.0, 0.5));
        let (w, _) = angular_motion(&phi, &rate, &Vector3::zeros());
        let error = (rotation_vector_rate(&phi, &w) - rate).norm();
        assert!(error < 1e-8, "{error:e}");
    }
}
