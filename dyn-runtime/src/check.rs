//! What a checked call refuses, and the thresholds.

use nalgebra::Matrix3;

use crate::arrays::AllFinite;
use crate::error::{Error, Input, NotARotation};
use crate::float::sqrt;
use crate::solve::reciprocal_condition;

/// Largest element of `|R^T R - 1|` that passes as a rotation.
///
/// Ten times the rounding of single precision, so that a matrix measured or stored in f32 passes; results are
/// wrong by about as much as the matrix is. More is a matrix integrated without care, or not a rotation at
/// all.
pub const MAX_ROTATION_DEVIATION: f64 = 1e-6;

/// Least `(u.a)^2` of a leg: the rod within 0.57 degrees of perpendicular to its actuator.
///
/// There the rod carries a hundred times the actuator's force, the actuator moves a hundred times as fast as
/// the platform joint, and relative errors of the geometry grow ten thousand times, rounding errors to about
/// 1e-12. Mechanisms stop long before; so this refuses nothing but numerical nonsense.
pub const MIN_ROD_ALIGNMENT: f64 = 1e-4;

/// Least [`jacobian_reciprocal_condition`] for which forces are computed.
///
/// Below, an error of the pose of a millionth of the platform's size changes the forces by as much as they
/// are, and of sixteen digits ten are left. The paper's platform at home stands ten thousand times above.
pub const MIN_RECIPROCAL_CONDITION: f64 = 1e-6;

/// Platform and base farther apart than this along an axis of O are out of any leg's reach; far above it, the
/// squares of distances are infinite.
const OVERFLOWING_DISTANCE_M: f64 = 1e100;

/// How well the six legs hold any wrench, from J_dp: 1 at best, 0 where there is one that they cannot hold.
///
/// J_dp mixes metres and pure numbers, and the length of its rows only says how inclined each rod is to its
/// actuator. So each row is divided by the length of its translational part (which leaves the rod's direction
/// u and its moment about P), and moments by their root mean square. The result is the reciprocal condition
/// number of that matrix in the 1-norm, 0 if J_dp is not finite. It depends neither on units nor on the
/// platform's size, nor on the actuators' directions.
///
/// It does depend on the reference frames. Moments are taken about P's origin, which therefore belongs amid
/// the platform joints: from an origin n times the platform's size away, all arms look alike and the number
/// falls to about 1/n of its value. And the 1-norm sums along O's axes: turning base and platform together
/// changes the number, for usual poses by less than a factor of 2.
///
/// `jacobian` is row-major: a row per leg, three translational columns, then three rotational.
pub fn jacobian_reciprocal_condition(jacobian: &[[f64; 6]; 6]) -> f64 {
    // Loops, not `map` with a closure: that keeps a bounds check in the compiled code, hence a panic.
    //
    // Why moments are not taken about a point that the six rods define, such as the one nearest to their
    // lines: J_dp alone has no other length than its moments, and rods that meet in one point, which cannot
    // hold a moment, would pass unseen.
    let mut scaled = *jacobian;
    let mut arms_squared = 0.0;
    for row in &mut scaled {
        let [x, y, z, ..] = *row;
        let length = sqrt(x * x + y * y + z * z);
        for element in row.iter_mut() {
            *element /= length;
        }
        let [.., x, y, z] = *row;
        arms_squared += x * x + y * y + z * z;
    }
    let characteristic_length = sqrt(arms_squared / 6.0);
    for [.., x, y, z] in &mut scaled {
        for moment in [x, y, z] {
            *moment /= characteristic_length;
        }
    }
    reciprocal_condition(&scaled)
}

/// `None` for a rotation.
pub(crate) fn rotation_defect(matrix: &Matrix3<f64>) -> Option<NotARotation> {
    let columns: [[f64; 3]; 3] = (*matrix).into();
    let deviation = if columns.all_finite() {
        (matrix.transpose() * matrix - Matrix3::identity()).amax()
    } else {
        f64::NAN
    };
    let determinant = matrix.determinant();
    let is_rotation = deviation <= MAX_ROTATION_DEVIATION && determinant > 0.0;
    if is_rotation { None } else { Some(NotARotation { deviation, determinant }) }
}

/// Passes an input on if all its elements are finite.
pub(crate) fn finite<T: AllFinite>(input: Input, array: T) -> Result<T, Error> {
    if array.all_finite() { Ok(array) } else { Err(Error::NonFinite { input }) }
}

/// Passes the rest of a call if its outputs are finite.
pub(crate) fn finite_result(outputs: &[&dyn AllFinite]) -> Result<(), Error> {
    if outputs.iter().all(|output| output.all_finite()) { Ok(()) } else { Err(Error::NonFiniteResult) }
}

/// The model has an alignment `(u_i.a_i)^2` for every leg, unless the poses are to blame.
///
/// With finite poses it is `1 - n.n/s^2`, and this is finite unless a parameter is not, a rod has no length,
/// or a square overflows.
pub(crate) fn mechanism(
    rod_alignment: &[f64; 6],
    base_position: &[f64; 3],
    platform_position: &[f64; 3],
) -> Result<(), Error> {
    let squares_overflow =
        base_position.iter().zip(platform_position).any(|(b, p)| (b - p).abs() > OVERFLOWING_DISTANCE_M);
    match rod_alignment.iter().position(|alignment| !alignment.is_finite()) {
        Some(leg) if !squares_overflow => Err(Error::InvalidModel { leg }),
        _ => Ok(()),
    }
}

/// Every leg reaches the platform and stands well enough to drive it; `rod_alignment[i] = (u_i.a_i)^2`.
pub(crate) fn reach(rod_alignment: &[f64; 6]) -> Result<(), Error> {
    for (leg, alignment) in rod_alignment.iter().copied().enumerate() {
        // Poses so far apart that the distance overflows give NaN.
        if alignment < 0.0 || alignment.is_nan() {
            return Err(Error::OutOfReach { leg });
        }
        if alignment < MIN_ROD_ALIGNMENT {
            return Err(Error::RodPerpendicular { leg });
        }
    }
    Ok(())
}

/// J_dp can be inverted.
pub(crate) fn invertible(jacobian_dp: &[[f64; 6]; 6]) -> Result<(), Error> {
    let reciprocal_condition = jacobian_reciprocal_condition(jacobian_dp);
    if reciprocal_condition >= MIN_RECIPROCAL_CONDITION {
        Ok(())
    } else {
        Err(Error::SingularJacobian { reciprocal_condition })
    }
}
