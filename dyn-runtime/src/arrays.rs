//! The boundary between generated functions (plain row-major arrays) and nalgebra (column-major matrices).

use nalgebra::{Rotation3, SMatrix, SVector, Vector3};

/// What a checked call returns for an output of a generated function: the same numbers with their meaning.
pub(crate) trait FromRows<Rows> {
    fn from_rows(rows: &Rows) -> Self;
}

impl FromRows<f64> for f64 {
    fn from_rows(number: &f64) -> Self {
        *number
    }
}

impl<const N: usize> FromRows<[f64; N]> for SVector<f64, N> {
    fn from_rows(elements: &[f64; N]) -> Self {
        Self::from(*elements)
    }
}

/// Row-major rows to a matrix.
impl<const R: usize, const C: usize> FromRows<[[f64; C]; R]> for SMatrix<f64, R, C> {
    fn from_rows(rows: &[[f64; C]; R]) -> Self {
        SMatrix::<f64, C, R>::from(*rows).transpose()
    }
}

/// One for each leg.
impl<T: FromRows<Rows>, Rows> FromRows<[Rows; 6]> for [T; 6] {
    fn from_rows(legs: &[Rows; 6]) -> Self {
        legs.each_ref().map(T::from_rows)
    }
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
