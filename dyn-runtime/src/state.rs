//! States of base and platform. Everything is in SI units and in the axes of the inertial frame O.
//!
//! Both bodies are described at the origin of their frame: B for the base, P (the centre of the circle of
//! platform joints, not the payload's centre of mass) for the platform.

use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3, Vector6};

use crate::angles;
use crate::arrays::{self, FromRows};
use crate::check::rotation_defect;
use crate::error::{NotARotation, NotAUnitQuaternion};
use crate::real::Real;

/// Position and orientation of a body frame, B or P, in O.
///
/// Let O's origin lie near the mechanism: what counts are differences of the positions of base and platform, and far from O
/// they lose the digits that the distance takes, in single precision soon. In a control loop O may move with the base's origin.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Pose<T: Real = f64> {
    /// Origin of the body frame, m, O.
    pub position_m: Vector3<T>,
    /// Coordinates in the body frame to coordinates in O, without unit: `in_o = rotation * in_body`. Its
    /// columns are the body's axes in O.
    pub rotation: Rotation3<T>,
}

/// Velocity of a body frame relative to O, in O axes: `[r'; w]`.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Twist<T = f64> {
    /// Velocity of the frame's origin, m/s, O.
    pub linear_m_s: Vector3<T>,
    /// Angular velocity, rad/s, O. A gyroscope reads it in body axes: turn that with [`Pose::rotation`]. Not
    /// the rates of Euler angles: [`angles::angular_velocity`] converts those.
    pub angular_rad_s: Vector3<T>,
}

/// Acceleration of a body frame relative to O, in O axes: `[r''; w']`, the time derivative of its [`Twist`].
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Acceleration<T = f64> {
    /// Acceleration of the frame's origin, m/s^2, O: an accelerometer's reading there, turned into O, plus
    /// the vector of gravity.
    pub linear_m_s2: Vector3<T>,
    /// Angular acceleration, rad/s^2, O. From Euler angles: [`angles::angular_acceleration`].
    pub angular_rad_s2: Vector3<T>,
}

/// External force and moment on the payload, at the payload's centre of mass, in O axes.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Wrench<T = f64> {
    /// Force F_D, N, O.
    pub force_n: Vector3<T>,
    /// Moment M_D about the payload's centre of mass, N m, O.
    pub moment_n_m: Vector3<T>,
}

/// How the base moves, in O; it drives the equations as a given motion.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct BaseMotion<T: Real = f64> {
    /// Pose of B: its origin in m, O; B to O.
    pub pose: Pose<T>,
    /// Velocity of B, v_b: m/s and rad/s, O.
    pub velocity: Twist<T>,
    /// Acceleration of B, v_b': m/s^2 and rad/s^2, O. Only functions with accelerations or forces depend on
    /// it.
    pub acceleration: Acceleration<T>,
}

/// Where the platform is and how fast it moves, in O (not relative to the base).
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct PlatformState<T: Real = f64> {
    /// Pose of P: its origin in m, O; P to O.
    pub pose: Pose<T>,
    /// Velocity of P, v_p: m/s and rad/s, O.
    pub velocity: Twist<T>,
}

impl<T: Real> Pose<T> {
    /// The frame O itself.
    pub fn identity() -> Self {
        Self { position_m: Vector3::zeros(), rotation: Rotation3::identity() }
    }

    /// From a position (m, O) and the paper's angles (rad), `R = Rz(c3) Ry(c2) Rx(c1)` (2): alpha, beta,
    /// gamma of the base or psi, theta, phi of the platform.
    ///
    /// ```
    /// use dyn_runtime::{Pose, nalgebra::Vector3};
    /// use std::f64::consts::FRAC_PI_2;
    ///
    /// let pose = Pose::from_paper_angles(Vector3::zeros(), [0.0, 0.0, FRAC_PI_2]);
    /// let x_axis_in_o = pose.rotation * Vector3::x();
    /// assert!((x_axis_in_o - Vector3::y()).norm() < 1e-15);
    /// ```
    pub fn from_paper_angles(position_m: Vector3<T>, angles_rad: [T; 3]) -> Self {
        Self { position_m, rotation: angles::rotation(angles_rad) }
    }

    /// From a position (m, O) and the four numbers of a unit quaternion, as an inertial measurement unit gives them: **`[w, x,
    /// y, z]`, the real part first**, turning coordinates in the body frame into coordinates in O. Where the device puts w
    /// last, or turns O into the body, reorder or negate x, y and z before. `q` and `-q` are the same rotation.
    ///
    /// What rounding left of the norm (single precision is good enough) is divided out.
    ///
    /// ```
    /// use dyn_runtime::{Pose, nalgebra::Vector3};
    ///
    /// // A quarter turn about z: the body's x axis points along O's y axis.
    /// let half = std::f64::consts::FRAC_PI_4;
    /// let pose = Pose::from_quaternion(Vector3::zeros(), [half.cos(), 0.0, 0.0, half.sin()])?;
    /// assert!((pose.rotation * Vector3::x() - Vector3::y()).norm() < 1e-15);
    /// # Ok::<(), dyn_runtime::NotAUnitQuaternion>(())
    /// ```
    ///
    /// # Errors
    /// If `|q|^2` differs from 1 by more than [`Real::MAX_ROTATION_DEVIATION`], or is not finite.
    pub fn from_quaternion(position_m: Vector3<T>, [w, x, y, z]: [T; 4]) -> Result<Self, NotAUnitQuaternion> {
        let (one, two) = (T::one(), T::constant(2.0));
        let norm_squared = (w * w + x * x) + (y * y + z * z);
        let deviation = (norm_squared - one).abs();
        if !deviation.is_finite() || deviation > T::MAX_ROTATION_DEVIATION {
            return Err(NotAUnitQuaternion { norm_squared: norm_squared.to_f64() });
        }
        let scale = two / norm_squared;
        let (sx, sy, sz) = (scale * x, scale * y, scale * z);
        #[rustfmt::skip]
        let matrix = Matrix3::new(
            one - (sy * y + sz * z), sx * y - sz * w,         sx * z + sy * w,
            sx * y + sz * w,         one - (sx * x + sz * z), sy * z - sx * w,
            sx * z - sy * w,         sy * z + sx * w,         one - (sx * x + sy * y),
        );
        Ok(Self { position_m, rotation: Rotation3::from_matrix_unchecked(matrix) })
    }

    /// From a position (m, O) and nalgebra's unit quaternion that rotates the body frame's coordinates into O; the caller
    /// knows its norm, see [`from_quaternion`](Self::from_quaternion).
    pub fn from_unit_quaternion(position_m: Vector3<T>, quaternion: &UnitQuaternion<T>) -> Self {
        Self { position_m, rotation: quaternion.to_rotation_matrix() }
    }

    /// From a position (m, O) and a rotation matrix whose columns are the body frame's axes in O.
    ///
    /// # Errors
    /// If the matrix is not finite, not orthonormal within
    /// [`Real::MAX_ROTATION_DEVIATION`], or a reflection; the error says how far off
    /// it is.
    pub fn from_rotation_matrix(position_m: Vector3<T>, matrix: &Matrix3<T>) -> Result<Self, NotARotation> {
        match rotation_defect(matrix) {
            None => Ok(Self { position_m, rotation: Rotation3::from_matrix_unchecked(*matrix) }),
            Some(defect) => Err(defect),
        }
    }

    /// The pose in O of a body whose pose relative to this one is `relative`: base and home give the
    /// platform.
    pub fn compose(&self, relative: &Self) -> Self {
        Self {
            position_m: self.position_m + self.rotation * relative.position_m,
            rotation: self.rotation * relative.rotation,
        }
    }
}

impl<T: Real> Twist<T> {
    /// At rest.
    pub fn zero() -> Self {
        Self { linear_m_s: Vector3::zeros(), angular_rad_s: Vector3::zeros() }
    }

    /// `[r'; w]`, as the 6x6 matrices of the equations take it.
    pub fn to_vector(&self) -> Vector6<T> {
        Vector6::from(self.to_array())
    }

    pub(crate) fn to_array(self) -> [T; 6] {
        arrays::stacked(&self.linear_m_s, &self.angular_rad_s)
    }
}

impl<T: Real> Acceleration<T> {
    /// No acceleration.
    pub fn zero() -> Self {
        Self { linear_m_s2: Vector3::zeros(), angular_rad_s2: Vector3::zeros() }
    }

    /// `[r''; w']`, as the 6x6 matrices of the equations take it.
    pub fn to_vector(&self) -> Vector6<T> {
        Vector6::from(self.to_array())
    }

    pub(crate) fn to_array(self) -> [T; 6] {
        arrays::stacked(&self.linear_m_s2, &self.angular_rad_s2)
    }
}

impl<T: Real> FromRows<[T; 6]> for Twist<T> {
    fn from_rows(stacked: &[T; 6]) -> Self {
        let (linear_m_s, angular_rad_s) = arrays::halves(stacked);
        Self { linear_m_s, angular_rad_s }
    }
}

impl<T: Real> FromRows<[T; 6]> for Acceleration<T> {
    fn from_rows(stacked: &[T; 6]) -> Self {
        let (linear_m_s2, angular_rad_s2) = arrays::halves(stacked);
        Self { linear_m_s2, angular_rad_s2 }
    }
}

impl<T: Real> Wrench<T> {
    /// No load.
    pub fn zero() -> Self {
        Self { force_n: Vector3::zeros(), moment_n_m: Vector3::zeros() }
    }

    /// `[F_D; M_D]`, still at the payload's centre of mass: not yet the W_ext of the equation of motion.
    pub fn to_vector(&self) -> Vector6<T> {
        Vector6::from(self.to_array())
    }

    pub(crate) fn to_array(self) -> [T; 6] {
        arrays::stacked(&self.force_n, &self.moment_n_m)
    }
}

impl<T: Real> BaseMotion<T> {
    /// A base that stands still.
    pub fn at_rest(pose: Pose<T>) -> Self {
        Self { pose, velocity: Twist::zero(), acceleration: Acceleration::zero() }
    }
}

impl<T: Real> PlatformState<T> {
    /// A platform that stands still.
    pub fn at_rest(pose: Pose<T>) -> Self {
        Self { pose, velocity: Twist::zero() }
    }
}
