//! What the numbers of a file may not be: bounds, unit vectors, rotations, inertia tensors, legs out of reach.

use nalgebra::{Matrix3 as Matrix, Vector3 as Vector};

use crate::keys::Key;
use crate::legs::named;
use crate::parameters::{Matrix3, Vector3};
use crate::platform::Pose;

/// Unit vectors and rotations may miss their norm by this much and are then normalised; inertia tensors may miss
/// symmetry and the triangle inequality by this much of their largest entry.
const TOLERANCE: f64 = 1e-9;

/// Where the norm misses no more than this, rounding to doubles explains it and the numbers stay as they were typed.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// A leg whose `u.a` (cosine between rod and actuator) at home is below this is refused: forces grow as its inverse.
const SMALLEST_ALIGNMENT: f64 = 0.01;

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

pub(crate) fn positive(value: f64, key: &Key) -> Checked<f64> {
    let what = || format!("`{}` must be positive, but is {value}", key.name);
    if value > 0.0 { Ok(value) } else { Err(Fault::new("must be positive", what(), key.remedy())) }
}

pub(crate) fn not_negative(value: f64, key: &Key) -> Checked<f64> {
    let what = || format!("`{}` must not be negative, but is {value}", key.name);
    if value >= 0.0 { Ok(value) } else { Err(Fault::new("must not be negative", what(), key.remedy())) }
}

pub(crate) fn fraction(value: f64, key: &Key) -> Checked<f64> {
    let what = || format!("`{}` must lie between 0 and 1, but is {value}", key.name);
    let inside = (0.0..=1.0).contains(&value);
    if inside { Ok(value) } else { Err(Fault::new("must lie between 0 and 1", what(), key.remedy())) }
}

/// An angle between two joints of a pair.
pub(crate) fn pair_angle(value: f64, key: &Key) -> Checked<f64> {
    if (0.0..std::f64::consts::TAU).contains(&value) {
        return Ok(value);
    }
    let what = format!("`{}` must lie between 0 and 2 pi rad, but is {value}", key.name);
    let help = format!("give radians: {value} degrees would be {} rad", value.to_radians());
    Err(Fault::new("must lie between 0 and 2 pi", what, help))
}

/// Accepts a unit vector and removes what rounding in the file left.
pub(crate) fn unit_vector(value: Vector3, key: &Key) -> Checked<Vector3> {
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

fn from_rows(rows: Matrix3) -> Matrix<f64> {
    Matrix::from_fn(|i, j| rows[i][j])
}

fn to_rows(matrix: Matrix<f64>) -> Matrix3 {
    std::array::from_fn(|i| std::array::from_fn(|j| matrix[(i, j)]))
}

/// A leg at home: how far its rod must reach, and whether it does.
pub(crate) struct LegAtHome {
    number: usize,
    rod_length: f64,
    /// From the actuator's axis to the platform joint, across the axis, m.
    across: f64,
}

impl LegAtHome {
    /// From `x = r_p + R p - b` with (18): the rod must span `n = x - (a.x) a`.
    pub fn new(
        number: usize,
        home: &Pose,
        base_point: Vector3,
        platform_point: Vector3,
        axis: Vector3,
        rod_length: f64,
    ) -> Self {
        let axis = Vector::from(axis);
        let joint = Vector::from(home.position) + from_rows(home.rotation) * Vector::from(platform_point);
        let x = joint - Vector::from(base_point);
        Self { number, rod_length, across: (x - axis * axis.dot(&x)).norm() }
    }

    /// `(u.a)^2 = 1 - n.n/s^2`, the squared cosine between rod and actuator; negative out of reach.
    fn alignment_squared(&self) -> f64 {
        1.0 - (self.across / self.rod_length).powi(2)
    }
}

/// Refuses legs whose rod is too short at home, or so short that it stands across its actuator.
pub(crate) fn reach(legs: &[LegAtHome]) -> Option<Fault> {
    let faulty: Vec<&LegAtHome> =
        legs.iter().filter(|leg| leg.alignment_squared() < SMALLEST_ALIGNMENT.powi(2)).collect();
    let farthest = faulty.iter().max_by(|one, other| one.across.total_cmp(&other.across))?;
    let numbers: Vec<usize> = faulty.iter().map(|leg| leg.number).collect();
    let (number, across, rod_length) = (farthest.number, farthest.across, farthest.rod_length);
    let (label, what) = if farthest.alignment_squared() < 0.0 {
        let what = format!(
            "the rod is too short to reach at home ({}): the platform joint of leg {number} is {across:.6} m \
             off its actuator's axis, the rod is {rod_length} m long",
            named(&numbers)
        );
        ("too short", what)
    } else {
        let what = format!(
            "the rod is perpendicular to its actuator at home ({}): the platform joint of leg {number} is \
             {across:.6} m off its actuator's axis, the rod is {rod_length} m long, so the actuator cannot push it",
            named(&numbers)
        );
        ("only just reaches", what)
    };
    let needed = across / (1.0 - SMALLEST_ALIGNMENT.powi(2)).sqrt();
    let help = format!(
        "make it longer than {:.6} m, or move the joints, the axis or the home pose",
        (needed * 1e6).ceil() / 1e6
    );
    Some(Fault::new(label, what, help))
}
