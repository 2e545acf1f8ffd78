//! The boundary between generated functions (plain row-major arrays) and nalgebra (column-major matrices).

use nalgebra::{Rotation3, SMatrix, SVector, Vector3};

use crate::real::Real;

/// What a checked call returns for an output of a generated function: the same numbers with their meaning.
pub(crate) trait FromRows<Rows> {
    fn from_rows(rows: &Rows) -> Self;
}

impl<T: Real> FromRows<T> for T {
    fn from_rows(number: &T) -> Self {
        *number
    }
}

impl<T: Real, const N: usize> FromRows<[T; N]> for SVector<T, N> {
    fn from_rows(elements: &[T; N]) -> Self {
        Self::from(*elements)
    }
}

/// Row-major rows to a matrix.
impl<T: Real, const R: usize, const C: usize> FromRows<[[T; C]; R]> for SMatrix<T, R, C> {
    fn from_rows(rows: &[[T; C]; R]) -> Self {
        SMatrix::<T, C, R>::from(*rows).transpose()
    }
}

/// One for each leg.
impl<Leg: FromRows<Rows>, Rows> FromRows<[Rows; 6]> for [Leg; 6] {
    fn from_rows(legs: &[Rows; 6]) -> Self {
        legs.each_ref().map(Leg::from_rows)
    }
}

/// Row-major elements of a rotation.
pub(crate) fn rotation_rows<T: Real>(rotation: &Rotation3<T>) -> [[T; 3]; 3] {
    rotation.matrix().transpose().into()
}

/// The six numbers of a twist, an acceleration or a wrench.
pub(crate) fn stacked<T: Real>(upper: &Vector3<T>, lower: &Vector3<T>) -> [T; 6] {
    [upper.x, upper.y, upper.z, lower.x, lower.y, lower.z]
}

/// The two halves of six such numbers.
pub(crate) fn halves<T: Real>(stacked: &[T; 6]) -> (Vector3<T>, Vector3<T>) {
    let [a, b, c, d, e, f] = *stacked;
    (Vector3::new(a, b, c), Vector3::new(d, e, f))
}

/// Whether no element is NaN or infinite, for numbers and arrays of any depth.
pub(crate) trait AllFinite {
    fn all_finite(&self) -> bool;
}

impl<T: Real> AllFinite for T {
    fn all_finite(&self) -> bool {
        self.is_finite()
    }
}

impl<Element: AllFinite, const N: usize> AllFinite for [Element; N] {
    fn all_finite(&self) -> bool {
        // Without a way out in the middle: a few comparisons at once are faster than one after the other.
        self.iter().fold(true, |all, element| all & element.all_finite())
    }
}
