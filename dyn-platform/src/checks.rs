//! What the numbers of a file may not be: bounds, unit vectors, rotations, inertia tensors.

use std::f64::consts::{PI, TAU};

use nalgebra::{Matrix3 as Matrix, Vector3 as Vector};

use crate::keys::{Key, Range, Value};
use crate::parameters::{Matrix3, Vector3};

/// Unit vectors and rotations may miss their norm by this much and are then normalised; inertia tensors may miss
/// symmetry and the triangle inequality by this much of their largest entry.
const TOLERANCE: f64 = 1e-9;

/// Where the norm misses no more than this, rounding to doubles explains it and the numbers stay as they were typed.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// What is wrong with a value, still without its place in the file.
#[derive(Debug)]
pub(crate) struct Fault {
    pub label: String,
    pub what: String,
    pub help: String,
}

impl Fault {
    pub fn new(label: impl Into<String>, what: impl Into<String>, help: impl Into<String>) -> Self {
        Self { label: label.into(), what: what.into(), help: help.into() }
    }
}

type Checked<T> = Result<T, Fault>;

/// No check beyond the type.
pub(crate) fn any<T>(value: T, _: &Key) -> Checked<T> {
    Ok(value)
}

/// A number in the range of its key.
pub(crate) fn number(value: f64, key: &Key) -> Checked<f64> {
    let Value::Number(range) = key.value else { return Ok(value) };
    let (inside, must) = match range {
        Range::Any => (true, ""),
        Range::Positive => (value > 0.0, "be positive"),
        Range::NotNegative => (value >= 0.0, "not be negative"),
        Range::Fraction => ((0.0..=1.0).contains(&value), "lie between 0 and 1"),
        Range::PairAngle => ((0.0..TAU).contains(&value), "lie between 0 and 2 pi"),
        Range::JointAngle => (value > 0.0 && value < PI, "lie between 0 and pi"),
    };
    if inside {
        return Ok(value);
    }
    let is_angle = matches!(range, Range::PairAngle | Range::JointAngle);
    let unit = if is_angle { " rad" } else { "" };
    let what = format!("`{}` must {must}{unit}, but is {value}", key.name);
    let help = if is_angle && value > 0.0 {
        format!("give radians: {value} degrees would be {} rad", value.to_radians())
    } else {
        key.remedy()
    };
    Err(Fault::new(format!("must {must}"), what, help))
}

/// A vector, of length one if its key says so.
pub(crate) fn vector(value: Vector3, key: &Key) -> Checked<Vector3> {
    match key.value {
        Value::UnitVector => unit_vector(value, key),
        _ => Ok(value),
    }
}

/// Accepts a unit vector and removes what rounding in the file left.
fn unit_vector(value: Vector3, key: &Key) -> Checked<Vector3> {
    let vector = Vector::from(value);
    let norm = vector.norm();
    if (norm - 1.0).abs() <= ROUNDING {
        return Ok(value);
    }
    if (norm - 1.0).abs() <= TOLERANCE {
        return Ok((vector / norm).into());
    }
    let what = format!("`{}` must be a unit vector, but its length is {norm}", key.name);
    let help = if norm > 0.0 {
        let [x, y, z] = (vector / norm).into();
        format!("write the vector of length one in this direction: `{} = [{x:?}, {y:?}, {z:?}]`", key.name)
    } else {
        key.remedy()
    };
    Err(Fault::new("not of length one", what, help))
}

/// Accepts a proper rotation and removes what rounding in the file left.
pub(crate) fn rotation(value: Matrix3, key: &Key) -> Checked<Matrix3> {
    let matrix = from_rows(value);
    let error = matrix * matrix.transpose() - Matrix::identity();
    if error.amax() > TOLERANCE {
        let what = format!(
            "`{}` is not a rotation: its rows must be unit vectors perpendicular to each other, \
             but R R^T misses the identity by {:.1e}",
            key.name,
            error.amax()
        );
        return Err(Fault::new(
            "not orthonormal",
            what,
            "check the rows, and give rounded numbers at least ten digits",
        ));
    }
    if matrix.determinant() < 0.0 {
        let what = format!("`{}` is a reflection, not a rotation: its determinant is -1", key.name);
        let help = "make the axes right-handed: change the sign of one row";
        return Err(Fault::new("left-handed", what, help));
    }
    if error.amax() <= ROUNDING {
        return Ok(value);
    }
    // One step of Newton's iteration towards the nearest rotation: the error squares itself, 1e-9 -> 1e-18.
    Ok(to_rows(0.5 * (3.0 * matrix - matrix * matrix.transpose() * matrix)))
}

/// Accepts the inertia tensor of a real body and copies its upper triangle onto the lower one.
pub(crate) fn inertia(value: Matrix3, key: &Key) -> Checked<Matrix3> {
    let tensor = from_rows(value);
    let margin = TOLERANCE * tensor.amax();
    for (row, column) in [(0, 1), (0, 2), (1, 2)] {
        let (upper, lower) = (value[row][column], value[column][row]);
        if (upper - lower).abs() > margin {
            let what = format!(
                "`{}` is not symmetric: row {} column {} is {upper}, row {} column {} is {lower}",
                key.name,
                row + 1,
                column + 1,
                column + 1,
                row + 1
            );
            return Err(Fault::new(
                "not symmetric",
                what,
                "make the two equal: an inertia tensor is symmetric",
            ));
        }
    }
    let symmetric = Matrix::from_fn(|i, j| value[i.min(j)][i.max(j)]);
    // Of entries of ordinary size, lest the iteration meet an overflow.
    let scale = symmetric.amax().max(f64::MIN_POSITIVE);
    let mut moments: [f64; 3] = ((symmetric / scale).symmetric_eigenvalues() * scale).into();
    moments.sort_by(f64::total_cmp);
    let [smallest, middle, largest] = moments;
    let found = format!("its principal moments are {smallest:.4e}, {middle:.4e} and {largest:.4e} kg m^2");
    if smallest <= 0.0 {
        let what = format!("`{}` is not positive definite: {found}", key.name);
        let help = "check the signs and sizes off the diagonal; every principal moment must be positive";
        return Err(Fault::new("not positive definite", what, help));
    }
    if largest > smallest + middle + margin {
        let what = format!(
            "`{}` belongs to no body: {found}, and the largest exceeds the sum of the others",
            key.name
        );
        let help = "check the entries: in a body no principal moment exceeds the sum of the other two";
        return Err(Fault::new("violates the triangle inequality", what, help));
    }
    Ok(to_rows(symmetric))
}

pub(crate) fn from_rows(rows: Matrix3) -> Matrix<f64> {
    Matrix::from_fn(|i, j| rows[i][j])
}

pub(crate) fn to_rows(matrix: Matrix<f64>) -> Matrix3 {
    std::array::from_fn(|i| std::array::from_fn(|j| matrix[(i, j)]))
}
