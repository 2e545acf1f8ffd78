//! Why a checked call gives no answer.

use core::error;
use core::fmt;

use crate::monitor::Quantity;

/// An argument of a checked call.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub enum Input {
    /// Position of the base's origin.
    BasePosition,
    /// Rotation of the base.
    BaseRotation,
    /// Twist of the base.
    BaseVelocity,
    /// Acceleration of the base.
    BaseAcceleration,
    /// Position of the platform's origin.
    PlatformPosition,
    /// Rotation of the platform.
    PlatformRotation,
    /// Twist of the platform.
    PlatformVelocity,
    /// Acceleration of the platform.
    PlatformAcceleration,
    /// Forces of the six actuators.
    ActuatorForce,
    /// External wrench on the payload.
    ExternalWrench,
    /// Reference velocity of the platform.
    ReferenceVelocity,
    /// Lengths of the six actuators.
    ActuatorLength,
    /// Rates of the six actuators.
    ActuatorVelocity,
}

/// Why a checked call gives no answer. Legs are indices 0 to 5; the messages number them 1 to 6 as well.
#[derive(Clone, Copy, PartialEq, Debug)]
#[non_exhaustive]
pub enum Error {
    /// An element of an input is NaN or infinite.
    NonFinite {
        /// The input.
        input: Input,
        /// Index of the first such element, row-major: of what legs have it is the leg, 0 to 5.
        element: usize,
    },
    /// A rotation matrix is not a rotation.
    NotARotation {
        /// [`Input::BaseRotation`] or [`Input::PlatformRotation`].
        input: Input,
        /// What is wrong with it.
        defect: NotARotation,
    },
    /// The model's parameters are not those of a mechanism: `(u.a)^2` of this leg is NaN or infinite although
    /// base and platform are near each other. A rod length is 0, or a number of the geometry is not finite.
    InvalidModel {
        /// Index of the first such leg, 0 to 5.
        leg: usize,
    },
    /// The platform joint of this leg is farther from the actuator's axis than the rod is long.
    OutOfReach {
        /// Index of the first such leg, 0 to 5.
        leg: usize,
    },
    /// The rod of this leg is perpendicular to its actuator, or so nearly that the leg cannot be driven:
    /// `(u.a)^2` is below [`Real::MIN_ROD_ALIGNMENT`](crate::Real::MIN_ROD_ALIGNMENT).
    RodPerpendicular {
        /// Index of the first such leg, 0 to 5.
        leg: usize,
    },
    /// The six legs together cannot hold every wrench: J_dp is singular, or so nearly that no digit of the
    /// forces would mean anything.
    SingularJacobian {
        /// As [`jacobian_reciprocal_condition`](crate::jacobian_reciprocal_condition) gives it, below
        /// [`Real::MIN_RECIPROCAL_CONDITION`](crate::Real::MIN_RECIPROCAL_CONDITION).
        reciprocal_condition: f64,
    },
    /// An invalid limit: NaN, or an angle that is limited without the direction at home that it is counted from.
    InvalidLimit {
        /// What it limits.
        quantity: Quantity,
        /// Index of the first such leg, 0 to 5; none for conditioning.
        leg: Option<usize>,
    },
    /// An invalid voice coil: its force constant is 0 or not finite, or its limit negative or NaN.
    InvalidCoil {
        /// Index of the first such leg, 0 to 5.
        leg: usize,
    },
    /// Forward kinematics found no pose with the given actuator lengths from where it started.
    NoConvergence {
        /// Steps that were made.
        iterations: u32,
        /// Largest difference of a length that is left, m.
        residual_m: f64,
    },
    /// A quantity is beyond its limit, see [`Monitor`](crate::Monitor).
    BeyondLimit {
        /// The quantity.
        quantity: Quantity,
        /// Index, 0 to 5, of the leg that is farthest beyond; none for conditioning.
        leg: Option<usize>,
        /// Distance to the limit in the quantity's unit, negative because beyond.
        margin: f64,
    },
    /// Every input is finite, yet the result is not: numbers too large to compute with, or a model whose
    /// parameters are not physical.
    NonFiniteResult,
}

/// How far a matrix is from being a rotation.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct NotARotation {
    /// Largest element of `|R^T R - 1|`, 0 for a rotation; NaN if an element of R is not finite.
    pub deviation: f64,
    /// Determinant of R, +1 for a rotation, -1 for a reflection.
    pub determinant: f64,
}

/// A quaternion whose norm is not 1.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct NotAUnitQuaternion {
    /// `|q|^2`, 1 for a rotation; NaN if a component is not finite.
    pub norm_squared: f64,
}

/// Angles too near `c2 = +-pi/2`, where the paper's angles have no rates.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct GimbalLock {
    /// `cos c2`, of a magnitude below [`Real::MIN_COS_C2`](crate::Real::MIN_COS_C2); NaN if `c2` is not finite.
    pub cos_c2: f64,
}

impl Input {
    /// The input in words.
    pub fn name(self) -> &'static str {
        match self {
            Self::BasePosition => "position of the base",
            Self::BaseRotation => "rotation of the base",
            Self::BaseVelocity => "velocity of the base",
            Self::BaseAcceleration => "acceleration of the base",
            Self::PlatformPosition => "position of the platform",
            Self::PlatformRotation => "rotation of the platform",
            Self::PlatformVelocity => "velocity of the platform",
            Self::PlatformAcceleration => "acceleration of the platform",
            Self::ActuatorForce => "actuator forces",
            Self::ExternalWrench => "external wrench",
            Self::ReferenceVelocity => "reference velocity",
            Self::ActuatorLength => "actuator lengths",
            Self::ActuatorVelocity => "actuator velocities",
        }
    }
}

impl fmt::Display for Input {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::NonFinite { input, element } => write!(
                f,
                "{input}: element {element} (counted from 0, row by row) is NaN or infinite; keep the previous value or \
                 stop the controller"
            ),
            Self::NotARotation { input, defect } => write!(f, "{input}: {defect}"),
            Self::InvalidModel { leg } => write!(
                f,
                "the model's parameters are not those of a mechanism: leg {} (index {leg}) has no finite alignment of \
                 rod and actuator; check that every parameter is filled in and that no rod length is 0",
                leg + 1
            ),
            Self::OutOfReach { leg } => write!(
                f,
                "leg {} (index {leg}) is out of reach: its platform joint is farther from the actuator's axis than \
                 the rod is long; bring the platform nearer to its home, and check that positions are in metres",
                leg + 1
            ),
            Self::RodPerpendicular { leg } => write!(
                f,
                "leg {} (index {leg}): the rod is perpendicular to the actuator, which then cannot drive it; bring \
                 the platform nearer to its home",
                leg + 1
            ),
            Self::SingularJacobian { reciprocal_condition } => write!(
                f,
                "the Jacobian J_dp is singular (reciprocal condition number {reciprocal_condition:.1e}): no actuator \
                 forces hold every wrench in this pose; bring the platform nearer to its home"
            ),
            Self::InvalidLimit { quantity, leg } => {
                let (name, _) = quantity.name_and_unit();
                of_leg(f, leg)?;
                write!(
                    f,
                    "the limit of {name} is NaN, or an angle is limited and its direction at home is not given; start from \
                     `limits()` of the model or `Limits::none()`, where infinity is no limit"
                )
            }
            Self::InvalidCoil { leg } => {
                of_leg(f, Some(leg))?;
                f.write_str(
                    "the voice coil has a force constant of 0 or not finite, or a negative limit; fill in all six, in N/A and A",
                )
            }
            Self::NoConvergence { iterations, residual_m } => write!(
                f,
                "no pose found with these actuator lengths: after {iterations} steps a length still differs by \
                 {residual_m:.1e} m; start nearer to the pose, and check that every length is d, in metres, in the order of the platform file"
            ),
            Self::BeyondLimit { quantity, leg, margin } => {
                let (name, unit) = quantity.name_and_unit();
                let remedy = match quantity {
                    Quantity::ActuatorForce => "ask for less acceleration",
                    Quantity::ActuatorVelocity => "move the platform more slowly",
                    _ => "bring the platform nearer to its home",
                };
                of_leg(f, leg)?;
                write!(f, "{name} is beyond its limit by {:.3e}{unit}; {remedy}", -margin)
            }
            Self::NonFiniteResult => f.write_str(
                "the result is not finite although every input is: check units and the model's parameters",
            ),
        }
    }
}

/// The subject of a message.
fn of_leg(f: &mut fmt::Formatter<'_>, leg: Option<usize>) -> fmt::Result {
    match leg {
        Some(leg) => write!(f, "leg {} (index {leg}): ", leg + 1),
        None => f.write_str("all legs together: "),
    }
}

impl fmt::Display for NotARotation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "not a rotation matrix: R^T R differs from 1 by {:.1e} and det R is {:.3}; orthonormalise it (for example \
             through a unit quaternion) and check that its columns are the body's axes",
            self.deviation, self.determinant
        )
    }
}

impl fmt::Display for NotAUnitQuaternion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "not a unit quaternion: its norm squared is {}; divide it by its norm, and check that it has arrived whole",
            self.norm_squared
        )
    }
}

impl fmt::Display for GimbalLock {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "the angles have no rates: cos c2 is {:.1e}, too near gimbal lock (or c2 is not finite); go on with the \
             angular velocity instead",
            self.cos_c2
        )
    }
}

impl error::Error for NotARotation {}

impl error::Error for NotAUnitQuaternion {}

impl error::Error for GimbalLock {}

impl error::Error for Error {}
