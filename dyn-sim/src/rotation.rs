//! Rotations as generated functions and files have them.

use dyn_runtime::nalgebra::{Matrix3, Rotation3};

/// Row by row, as generated functions and files have it.
pub fn rows(rotation: &Rotation3<f64>) -> [[f64; 3]; 3] {
    rotation.matrix().transpose().into()
}

/// From rows; the caller knows that they are those of a rotation.
pub fn from_rows(rows: &[[f64; 3]; 3]) -> Rotation3<f64> {
    Rotation3::from_matrix_unchecked(Matrix3::from(*rows).transpose())
}
