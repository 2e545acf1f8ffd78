//! Rotation vectors as plain arrays, for one number or any number of lanes, without a branch. Loops, not closures: those are
//! not always inlined, and then not compiled for the lanes.

use crate::float::{Scalar, mul_add};

/// Coefficients of the series up to an angle of [`MAX_TURN_RAD`]; the first one left out is below `1/19!`.
const TERMS: usize = 9;

/// Largest turn for which the series are exact, up to rounding.
pub(crate) const MAX_TURN_RAD: f64 = 1.0;

/// `sin s/s` as a series in `s^2`.
pub(super) const SINC: [f64; TERMS] = alternating_reciprocal_factorials(1);
/// `(1 - cos s)/s^2` as a series in `s^2`.
pub(super) const A: [f64; TERMS] = alternating_reciprocal_factorials(2);
/// `(s - sin s)/s^3` as a series in `s^2`.
pub(super) const B: [f64; TERMS] = alternating_reciprocal_factorials(3);

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

/// The polynomial with these coefficients, that of the constant first.
#[inline(always)]
pub(super) fn polynomial<T: Scalar>(coefficients: &[f64], x: T) -> T {
    let Some((last, before)) = coefficients.split_last() else { return T::constant(0.0) };
    let mut value = T::constant(*last);
    for coefficient in before.iter().rev() {
        value = mul_add(value, x, T::constant(*coefficient));
    }
    value
}

/// The derivative of [`polynomial`].
#[inline(always)]
pub(super) fn derivative<T: Scalar>(coefficients: &[f64], x: T) -> T {
    let mut value = T::constant(0.0);
    for (power, coefficient) in coefficients.iter().enumerate().skip(1).rev() {
        value = mul_add(value, x, T::constant(*coefficient * power as f64));
    }
    value
}

/// `a . b`
#[inline(always)]
pub(crate) fn dot<T: Scalar>(a: [T; 3], b: [T; 3]) -> T {
    mul_add(a[2], b[2], mul_add(a[1], b[1], a[0] * b[0]))
}

#[inline(always)]
fn cross<T: Scalar>([ax, ay, az]: [T; 3], [bx, by, bz]: [T; 3]) -> [T; 3] {
    [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx]
}

/// `v a`
#[inline(always)]
fn scaled<T: Scalar>([x, y, z]: [T; 3], a: T) -> [T; 3] {
    [x * a, y * a, z * a]
}

#[inline(always)]
fn transposed<T: Scalar>(a: &[[T; 3]; 3]) -> [[T; 3]; 3] {
    [[a[0][0], a[1][0], a[2][0]], [a[0][1], a[1][1], a[2][1]], [a[0][2], a[1][2], a[2][2]]]
}

/// Product of two matrices.
#[inline(always)]
fn product<T: Scalar>(a: &[[T; 3]; 3], b: &[[T; 3]; 3]) -> [[T; 3]; 3] {
    let [x, y, z] = transposed(b);
    [
        [dot(a[0], x), dot(a[0], y), dot(a[0], z)],
        [dot(a[1], x), dot(a[1], y), dot(a[1], z)],
        [dot(a[2], x), dot(a[2], y), dot(a[2], z)],
    ]
}

/// `exp([phi]x) R` for `|phi|` up to [`MAX_TURN_RAD`].
#[inline(always)]
pub(crate) fn turned<T: Scalar>(phi: [T; 3], rotation: &[[T; 3]; 3]) -> [[T; 3]; 3] {
    let square = dot(phi, phi);
    product(&turn(phi, polynomial(&SINC, square), polynomial(&A, square)), rotation)
}

/// `exp([phi]x)` from `sin s/s` and `(1 - cos s)/s^2`, where `s = |phi|`.
#[inline(always)]
pub(super) fn turn<T: Scalar>(phi: [T; 3], sinc: T, a: T) -> [[T; 3]; 3] {
    let one = T::constant(1.0);
    let [x, y, z] = phi;
    let [sx, sy, sz] = scaled(phi, sinc);
    let [ax, ay, az] = scaled(phi, a);
    let (axy, axz, ayz) = (ax * y, ax * z, ay * z);
    let (axx, ayy, azz) = (ax * x, ay * y, az * z);
    [
        [one - (ayy + azz), axy - sz, axz + sy],
        [axy + sz, one - (axx + azz), ayz - sx],
        [axz - sy, ayz + sx, one - (axx + ayy)],
    ]
}

/// See [`rate_within_step`](super::rate_within_step).
#[inline(always)]
pub(crate) fn rate_within_step<T: Scalar>(phi: [T; 3], w: [T; 3]) -> [T; 3] {
    let once = cross(phi, w);
    let twice = cross(phi, once);
    let (half, twelfth) = (T::constant(-0.5), T::constant(1.0 / 12.0));
    let mut rate = w;
    for k in 0..3 {
        rate[k] = mul_add(twice[k], twelfth, mul_add(once[k], half, rate[k]));
    }
    rate
}

/// See [`orthonormalised`](super::orthonormalised).
#[inline(always)]
pub(crate) fn orthonormalised<T: Scalar>(rotation: &[[T; 3]; 3]) -> [[T; 3]; 3] {
    let (three_halves, half) = (T::constant(1.5), T::constant(0.5));
    let correction = product(rotation, &product(&transposed(rotation), rotation));
    let mut nearest = *rotation;
    for i in 0..3 {
        for k in 0..3 {
            nearest[i][k] = nearest[i][k] * three_halves - correction[i][k] * half;
        }
    }
    nearest
}
