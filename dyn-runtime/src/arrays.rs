//! The boundary between generated functions (plain row-major arrays) and nalgebra (column-major matrices).

use nalgebra::{Rotation3, SMatrix, SVector, Vector3};

use crate::float::Scalar;
use crate::real::Real;

/// What a checked call returns for an output of a generated function: the same numbers with their meaning.
pub(crate) trait FromRows<Rows> {
    fn from_rows(rows: &Rows) -> Self;
}

impl<T: Real> FromRows<T> for T {
    #[inline]
    fn from_rows(number: &T) -> Self {
        *number
    }
}

impl<T: Real, const N: usize> FromRows<[T; N]> for SVector<T, N> {
    #[inline]
    fn from_rows(elements: &[T; N]) -> Self {
        Self::from(*elements)
    }
}

/// Row-major rows to a matrix.
impl<T: Real, const R: usize, const C: usize> FromRows<[[T; C]; R]> for SMatrix<T, R, C> {
    #[inline]
    fn from_rows(rows: &[[T; C]; R]) -> Self {
        SMatrix::<T, C, R>::from(*rows).transpose()
    }
}

/// One for each leg.
impl<Leg: FromRows<Rows>, Rows> FromRows<[Rows; 6]> for [Leg; 6] {
    #[inline]
    fn from_rows(legs: &[Rows; 6]) -> Self {
        legs.each_ref().map(Leg::from_rows)
    }
}

/// Row-major elements of a rotation.
#[inline]
pub(crate) fn rotation_rows<T: Real>(rotation: &Rotation3<T>) -> [[T; 3]; 3] {
    let r = rotation.matrix();
    [[r.m11, r.m12, r.m13], [r.m21, r.m22, r.m23], [r.m31, r.m32, r.m33]]
}

/// The six numbers of a twist, an acceleration or a wrench.
#[inline]
pub(crate) fn stacked<T: Real>(upper: &Vector3<T>, lower: &Vector3<T>) -> [T; 6] {
    [upper.x, upper.y, upper.z, lower.x, lower.y, lower.z]
}

/// The two halves of six such numbers.
#[inline]
pub(crate) fn halves<T: Real>(stacked: &[T; 6]) -> (Vector3<T>, Vector3<T>) {
    let [a, b, c, d, e, f] = *stacked;
    (Vector3::new(a, b, c), Vector3::new(d, e, f))
}

/// Whether no element is NaN or infinite, for numbers and arrays of any depth.
pub(crate) trait AllFinite {
    type Number: Real;
    /// Numbers in it.
    const COUNT: usize;

    /// Zero, or NaN where an element is not finite: two operations for each element and no comparison.
    fn vanishing(&self) -> Self::Number;

    #[inline]
    fn all_finite(&self) -> bool {
        self.vanishing() == <Self::Number as Scalar>::constant(0.0)
    }

    /// Index of the first number, row-major, that is NaN or infinite.
    fn first_not_finite(&self) -> Option<usize>;
}

impl<T: Real> AllFinite for T {
    type Number = T;
    const COUNT: usize = 1;

    #[inline]
    fn vanishing(&self) -> T {
        *self * T::zero()
    }

    fn first_not_finite(&self) -> Option<usize> {
        (!self.is_finite()).then_some(0)
    }
}

impl<Element: AllFinite, const N: usize> AllFinite for [Element; N] {
    type Number = Element::Number;
    const COUNT: usize = N * Element::COUNT;

    #[inline]
    fn vanishing(&self) -> Element::Number {
        self.iter().fold(<Element::Number as Scalar>::constant(0.0), |sum, element| sum + element.vanishing())
    }

    fn first_not_finite(&self) -> Option<usize> {
        let place = |(k, element): (usize, &Element)| Some(k * Element::COUNT + element.first_not_finite()?);
        self.iter().enumerate().find_map(place)
    }
}
