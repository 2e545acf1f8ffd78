//! Rotation vectors `phi`, rad: the rotation `R = exp([phi]x)` about `phi` by `|phi|`, its angular velocity and acceleration.
//!
//! They have no gimbal lock within a turn of `2 pi`, so a large rotation is best planned by its rotation vector, whose components may
//! be any smooth functions of time. Velocity and acceleration are those of `R' = [w]x R`, in the axes to which R turns (O for a
//! body's rotation):
//!
//! ```text
//! w  = phi' + a phi x phi' + b phi x (phi x phi'),   a = (1 - cos s)/s^2,   b = (s - sin s)/s^3,   s = |phi|
//! ```

pub(crate) mod arrays;

use nalgebra::{Matrix3, Rotation3, Vector3};

use crate::float::{sin_cos, sqrt};
use crate::real::Real;
use arrays::{A, B, MAX_TURN_RAD, SINC, derivative, polynomial};

/// Below this angle squared, [`FEW`] terms of the series give full precision: turns within an integration step.
const SMALL: f64 = 1e-4;

/// Terms of the series up to [`SMALL`]; the first one left out is below `1e-16/9!`.
const FEW: usize = 4;

/// `exp([phi]x)`: the rotation about `phi` by `|phi|` rad, at any angle.
///
/// ```
/// use dyn_runtime::{nalgebra::Vector3, rotation_vector};
///
/// let quarter = rotation_vector::rotation(&Vector3::new(0.0, 0.0, std::f64::consts::FRAC_PI_2));
/// assert!((quarter * Vector3::x() - Vector3::y()).norm() < 1e-15);
/// ```
#[inline]
pub fn rotation<T: Real>(phi: &Vector3<T>) -> Rotation3<T> {
    let square = phi.norm_squared();
    let (sinc, a) = if square < T::constant(SMALL) {
        (polynomial(&SINC[..FEW], square), polynomial(&A[..FEW], square))
    } else if square <= T::constant(MAX_TURN_RAD * MAX_TURN_RAD) {
        (polynomial(&SINC, square), polynomial(&A, square))
    } else {
        let s = sqrt(square);
        let (sin, cos) = sin_cos(s);
        (sin / s, (T::one() - cos) / square)
    };
    from_rows(arrays::turn((*phi).into(), sinc, a))
}

/// Angular velocity (rad/s) and acceleration (rad/s^2) of `exp([phi]x)` from the rotation vector (rad) and its two time
/// derivatives, exact at any angle.
pub fn angular_motion<T: Real>(
    phi: &Vector3<T>,
    rate: &Vector3<T>,
    second_derivative: &Vector3<T>,
) -> (Vector3<T>, Vector3<T>) {
    let [(a, a_by_square), (b, b_by_square)] = a_and_b(phi.norm_squared());
    let square_rate = phi.dot(rate) * T::constant(2.0);
    let turn = phi.cross(rate);
    let turn_rate = phi.cross(second_derivative);
    let twice = phi.cross(&turn);
    let velocity = rate + turn * a + twice * b;
    let acceleration = second_derivative
        + turn * (a_by_square * square_rate)
        + turn_rate * a
        + twice * (b_by_square * square_rate)
        + (rate.cross(&turn) + phi.cross(&turn_rate)) * b;
    (velocity, acceleration)
}

/// a and b with their derivatives by `s^2`, for `square = s^2`.
fn a_and_b<T: Real>(square: T) -> [(T, T); 2] {
    if square <= T::constant(MAX_TURN_RAD * MAX_TURN_RAD) {
        return [&A, &B].map(|series| (polynomial(series, square), derivative(series, square)));
    }
    let (one, two, three) = (T::one(), T::constant(2.0), T::constant(3.0));
    let s = sqrt(square);
    let (sin, cos) = sin_cos(s);
    let (fourth, fifth) = (square * square, square * square * s);
    [
        ((one - cos) / square, (s * sin - two * (one - cos)) / (two * fourth)),
        ((s - sin) / (square * s), (three * sin - s * (two + cos)) / (two * fifth)),
    ]
}

/// The rate of the rotation vector `phi` (rad) of a small turn under angular velocity `w` (rad/s), up to the second commutator:
/// `phi' = w - phi x w/2 + phi x (phi x w)/12`; what is left out is of fourth order in `phi`. A Runge-Kutta method of fourth
/// order on rotations needs no more (Munthe-Kaas' method).
#[inline]
pub fn rate_within_step<T: Real>(phi: &Vector3<T>, w: &Vector3<T>) -> Vector3<T> {
    arrays::rate_within_step((*phi).into(), (*w).into()).into()
}

/// The rotation nearest to a product of rotations, which has errors of rounding: `R (3 - R^T R)/2`, one step of Newton's
/// iteration, squares them.
#[inline]
pub fn orthonormalised<T: Real>(rotation: &Rotation3<T>) -> Rotation3<T> {
    from_rows(arrays::orthonormalised(&rotation.matrix().transpose().into()))
}

#[inline]
fn from_rows<T: Real>(rows: [[T; 3]; 3]) -> Rotation3<T> {
    Rotation3::from_matrix_unchecked(Matrix3::from(rows).transpose())
}
