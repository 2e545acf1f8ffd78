//! The boundary between generated functions (plain row-major arrays) and nalgebra (column-major matrices).

use nalgebra::{Rotation3, SMatrix, SVector, Vector3};

/// Row-major rows to a matrix.
pub(crate) fn matrix<const R: usize, const C: usize>(rows: &[[f64; C]; R]) -> SMatrix<f64, R, C> {
    SMatrix::<f64, C, R>::from(*rows).transpose()
}

/// Row-major rows to a matrix, for each leg.
pub(crate) fn matrices<const R: usize, const C: usize>(legs: &[[[f64; C]; R]; 6]) -> [SMatrix<f64, R, C>; 6] {
    legs.map(|rows| matrix(&rows))
}

/// A vector for each leg.
pub(crate) fn vectors<const N: usize>(legs: &[[f64; N]; 6]) -> [SVector<f64, N>; 6] {
    legs.map(SVector::from)
}

/// Row-major elements of a rotation.
pub(crate) fn rotation_rows(rotation: &Rotation3<f64>) -> [[f64; 3]; 3] {
    rotation.matrix().transpose().into()
}

/// The six numbers of a twist, an acceleration or a wrench.
pub(crate) fn stacked(upper: &Vector3<f64>, lower: &Vector3<f64>) -> [f64; 6] {
    [upper.x, upper.y, upper.z, lower.x, lower.y, lower.z]
}

/// The two halves of six such numbers.
pub(crate) fn halves(stacked: &[f64; 6]) -> (Vector3<f64>, Vector3<f64>) {
    let [a, b, c, d, e, f] = *stacked;
    (Vector3::new(a, b, c), Vector3::new(d, e, f))
}

/// Whether no element is NaN or infinite, for numbers and arrays of any depth.
pub(crate) trait AllFinite {
    fn all_finite(&self) -> bool;
}

impl AllFinite for f64 {
    fn all_finite(&self) -> bool {
        self.is_finite()
    }
}

impl<T: AllFinite, const N: usize> AllFinite for [T; N] {
    fn all_finite(&self) -> bool {
        self.iter().all(T::all_finite)
    }
}
