//! True motions of base and platform, and derivatives along them. Rotations are exponentials of rotation vectors, never
//! Euler angles.

use dyn_gen::graph::Environment;
use nalgebra::{Matrix3, Rotation3, SVector, Vector3, Vector6};

use crate::subject::{Values, parts};

/// Weights of f(h) - f(-h), f(2h) - f(-2h), ... in the central difference of eighth order.
const WEIGHTS: [f64; 4] = [4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0];

/// Derivative at 0, its error O(step^8).
pub fn derivative(f: impl Fn(f64) -> Vec<f64>, step: f64) -> Vec<f64> {
    let mut sum = vec![0.0; f(0.0).len()];
    for (k, weight) in (1..).zip(WEIGHTS) {
        let t = f64::from(k) * step;
        for (sum, (after, before)) in sum.iter_mut().zip(f(t).iter().zip(f(-t))) {
            *sum += weight * (after - before) / step;
        }
    }
    sum
}

/// Step in s of [`derivative`] along [`after`]. Truncation (as step^8) and rounding (as 1/step) meet near 1e-4 s, where joints
/// of large states move some tenths of a millimetre.
pub const TIME_STEP: f64 = 5e-5;

/// Step in m and rad of [`derivative`] along [`displaced`], by the same measure.
pub const DISPLACEMENT_STEP: f64 = 4e-4;

/// Relative deviation that finite differences of large states may have.
pub const TOLERANCE: f64 = 2e-10;

/// Why [`TOLERANCE`] is not tighter.
pub const REASON: &str =
    "finite differences: rounding, divided by a step that is a thousandth of what a leg can travel";

/// The state after a time: linear accelerations constant, rotation exp(w t + w' t^2/2) R, whose angular velocity and
/// acceleration at t = 0 are w and w'. Velocities are those of this motion at t; accelerations stay as they were, so they are
/// right at t = 0 only.
pub fn after(state: &Environment, t: f64) -> Environment {
    let mut moved = state.clone();
    for body in ["base", "platform"] {
        let names = ["position", "rotation", "velocity", "acceleration"].map(|part| format!("{body}_{part}"));
        let [position, rotation, velocity, acceleration] = names.each_ref().map(String::as_str);
        let (v, w) = parts(state.vector(velocity));
        let (v_rate, w_rate) = parts(state.vector(acceleration));
        let turn = w * t + w_rate * (0.5 * t * t);
        let angular = angular_velocity(turn, w + w_rate * t);
        let place: Vector3<f64> = state.vector::<3>(position) + v * t + v_rate * (0.5 * t * t);
        moved = moved
            .with(position, place.as_slice())
            .with(rotation, &turned(state.matrix(rotation), turn))
            .with(velocity, &[(v + v_rate * t).as_slice(), angular.as_slice()].concat());
    }
    moved
}

/// The state with a body (`base` or `platform`) displaced by a small twist.
pub fn displaced(state: &Environment, body: &str, twist: Vector6<f64>) -> Environment {
    let (position, rotation) = (format!("{body}_position"), format!("{body}_rotation"));
    let (shift, turn) = parts(twist);
    let place: SVector<f64, 3> = state.vector::<3>(&position) + shift;
    state.with(&position, place.as_slice()).with(&rotation, &turned(state.matrix(&rotation), turn))
}

/// Derivative by displacements of a body: one array per unit twist.
pub fn gradient(state: &Environment, body: &str, f: impl Fn(&Environment) -> Vec<f64>) -> [Vec<f64>; 6] {
    std::array::from_fn(|axis| {
        derivative(|size| f(&displaced(state, body, Vector6::ith(axis, size))), DISPLACEMENT_STEP)
    })
}

/// The rotation exp(turn) R, row-major.
fn turned(rotation: Matrix3<f64>, turn: Vector3<f64>) -> Vec<f64> {
    let turned = Rotation3::from_scaled_axis(turn).into_inner() * rotation;
    turned.transpose().as_slice().to_vec()
}

/// Angular velocity of exp(x(t)) from a small rotation vector and its rate:
/// x' + (1 - cos|x|)/|x|^2 x × x' + (|x| - sin|x|)/|x|^3 x × (x × x'), as power series.
fn angular_velocity(x: Vector3<f64>, rate: Vector3<f64>) -> Vector3<f64> {
    let s = x.norm_squared();
    assert!(s < 0.01, "the series are for small angles");
    let second = 1.0 / 2.0 - s / 24.0 + s * s / 720.0 - s * s * s / 40320.0;
    let third = 1.0 / 6.0 - s / 120.0 + s * s / 5040.0 - s * s * s / 362880.0;
    let cross = x.cross(&rate);
    rate + cross * second + x.cross(&cross) * third
}

/// The series, against the rotation itself: S(w) R = R'.
#[test]
fn angular_velocity_is_that_of_the_rotation() {
    let (w, w_rate, t) = (Vector3::new(3.0, -4.0, 2.0), Vector3::new(-20.0, 9.0, 30.0), 0.01);
    let turn = |t: f64| w * t + w_rate * (0.5 * t * t);
    let rotation = |t: f64| turned(Matrix3::identity(), turn(t));
    let rate = Matrix3::from_row_slice(&derivative(|dt| rotation(t + dt), 1e-3));
    let spin = rate * Matrix3::from_row_slice(&rotation(t)).transpose();
    let expected = angular_velocity(turn(t), w + w_rate * t);
    assert!((spin - expected.cross_matrix()).amax() < 1e-11 * expected.amax());
}
