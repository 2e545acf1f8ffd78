//! How a call ended: a status for every reason, and where to look.

use core::ffi::{CStr, c_char};
use core::mem::size_of;

use dyn_runtime::parameter::{ParameterError, ParameterProblem};
use dyn_runtime::{Error, Input};

use crate::limits::Quantity;
use crate::real::Real;

/// How a call ended. With any status but DYN_STATUS_OK no output has been written.
#[repr(i32)]
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Status {
    /// The outputs are written. They are finite, but for margins and limits, where INFINITY is no limit.
    Ok = 0,
    /// A pointer that must not be is null.
    NullPointer = 1,
    /// The `struct_size` of a struct is not its size: not filled in, or header and library differ.
    WrongStructSize = 2,
    /// The model's `kind` is none that this library was built with.
    UnknownModel = 3,
    /// An element of an input is NaN or infinite: `info.input` and `info.element` say which, `info.leg` for what legs have.
    NonFinite = 4,
    /// A rotation matrix is not a rotation: `info.value` is the largest element of |R^T R - 1|. Where it is within
    /// `info.limit` the matrix is a reflection.
    NotARotation = 5,
    /// The parameters are not those of a mechanism: the geometry of leg `info.leg` is not finite or a rod has no length.
    InvalidModel = 6,
    /// Leg `info.leg` cannot reach the platform.
    OutOfReach = 7,
    /// The rod of leg `info.leg` is perpendicular to its actuator, which cannot drive it.
    RodPerpendicular = 8,
    /// The six legs together cannot hold every wrench: `info.value` is the reciprocal condition number of J_dp, below
    /// `info.limit`.
    SingularJacobian = 9,
    /// Every input is finite, yet the result is not: numbers too large, or parameters that are not physical.
    NonFiniteResult = 10,
    /// The angles have no rates: `info.value` is cos c2, of a magnitude below `info.limit`.
    GimbalLock = 11,
    /// A parameter is not physical: `info.input`, `info.element` and `info.leg` say which, `info.value` is what it is, 0 where
    /// that is not finite.
    InvalidParameter = 12,
    /// No pose found with the given actuator lengths: a length still differs by `info.value`, m.
    NoConvergence = 13,
    /// A quantity is beyond its limit: `info.quantity`, `info.leg`, and `info.value`, the margin (negative).
    BeyondLimit = 14,
    /// A reason that this version of the interface has no status for.
    Other = 15,
    /// The model does not carry what was asked for: the platform file does not give it, or parameters come at run time.
    NotInModel = 16,
    /// A limit is NaN, or an angle is limited whose direction at home is not given: `info.quantity` and `info.leg` say which.
    InvalidLimit = 17,
    /// The voice coil of leg `info.leg` has a force constant of 0 or not finite, or a limit that is negative or NaN.
    InvalidCoil = 18,
}

/// An input of a call or a parameter of a model, as `info.input` names it.
#[repr(i32)]
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum InputName {
    /// None in particular.
    None = -1,
    /// `base_position`
    BasePosition = 0,
    /// `base_rotation`
    BaseRotation = 1,
    /// `base_velocity`
    BaseVelocity = 2,
    /// `base_acceleration`
    BaseAcceleration = 3,
    /// `platform_position`
    PlatformPosition = 4,
    /// `platform_rotation`
    PlatformRotation = 5,
    /// `platform_velocity`
    PlatformVelocity = 6,
    /// `platform_acceleration`
    PlatformAcceleration = 7,
    /// `actuator_force`
    ActuatorForce = 8,
    /// `external_wrench`
    ExternalWrench = 9,
    /// The angles of a conversion.
    Angles = 10,
    /// The quaternion of a conversion.
    Quaternion = 11,
    /// `reference_velocity`
    ReferenceVelocity = 12,
    /// The lengths of forward kinematics.
    ActuatorLength = 13,
    /// The rates of dyn_platform_velocity.
    ActuatorVelocity = 14,
    /// The rates of angles of a conversion.
    AngleRates = 15,
    /// The angular velocity of a conversion.
    AngularVelocity = 16,
    /// `base_point`
    BasePoint = 100,
    /// `actuator_axis`
    ActuatorAxis = 101,
    /// `platform_point`
    PlatformPoint = 102,
    /// `rod_length`
    RodLength = 103,
    /// `rod_mass`
    RodMass = 104,
    /// `rod_inertia`
    RodInertia = 105,
    /// `rod_com_fraction`
    RodComFraction = 106,
    /// `mover_mass`
    MoverMass = 107,
    /// `mover_offset`
    MoverOffset = 108,
    /// `rest_length`
    RestLength = 109,
    /// `axial_stiffness`
    AxialStiffness = 110,
    /// `axial_damping`
    AxialDamping = 111,
    /// `payload_mass`
    PayloadMass = 112,
    /// `payload_com`
    PayloadCom = 113,
    /// `payload_inertia`
    PayloadInertia = 114,
    /// `gravity`
    Gravity = 115,
    /// `lower_mass`
    LowerMass = 116,
    /// `lower_com_distance`
    LowerComDistance = 117,
    /// `lower_inertia`
    LowerInertia = 118,
    /// `upper_mass`
    UpperMass = 119,
    /// `upper_com_distance`
    UpperComDistance = 120,
    /// `upper_inertia`
    UpperInertia = 121,
}

/// Details of a status. Wherever a call takes a pointer to one, it may be null.
///
/// Written by every call that gets one of the right size, whatever the status.
#[repr(C)]
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Info {
    /// Set to sizeof(dyn_info) before the call.
    pub struct_size: usize,
    /// The input to blame, or DYN_INPUT_NONE.
    pub input: InputName,
    /// The first leg to blame, 0 to 5 (platform files count from 1), or -1.
    pub leg: i32,
    /// The quantity whose limit it is about, a `DYN_QUANTITY_...`, or -1.
    pub quantity: i32,
    /// A number that says how far off, see the status; else 0.
    pub value: Real,
    /// The threshold that `value` failed; else 0.
    pub limit: Real,
    /// Index of the first element of `input` to blame, row-major, or -1.
    pub element: i32,
}

/// A status with its details.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Refusal {
    pub status: Status,
    pub input: InputName,
    pub element: i32,
    pub leg: i32,
    pub quantity: i32,
    pub value: Real,
    pub limit: Real,
}

impl Refusal {
    /// Without details.
    pub fn of(status: Status) -> Self {
        Self { status, input: InputName::None, element: -1, leg: -1, quantity: -1, value: 0.0, limit: 0.0 }
    }

    /// Because of an input.
    pub fn of_input(status: Status, input: InputName) -> Self {
        Self { input, ..Self::of(status) }
    }

    fn of_leg(status: Status, leg: usize) -> Self {
        // Legs are 0 to 5.
        Self { leg: leg as i32, ..Self::of(status) }
    }

    fn of_quantity(status: Status, quantity: dyn_runtime::Quantity, leg: Option<usize>) -> Self {
        let refusal = leg.map_or(Self::of(status), |leg| Self::of_leg(status, leg));
        Self { quantity: Quantity::from(quantity) as i32, ..refusal }
    }

    pub fn info(&self) -> Info {
        Info {
            struct_size: size_of::<Info>(),
            input: self.input,
            element: self.element,
            leg: self.leg,
            quantity: self.quantity,
            value: self.value,
            limit: self.limit,
        }
    }
}

impl From<ParameterError> for Refusal {
    fn from(error: ParameterError) -> Self {
        let value = match error.problem {
            ParameterProblem::NotPositive(value)
            | ParameterProblem::Negative(value)
            | ParameterProblem::NotAFraction(value)
            | ParameterProblem::NotAUnitVector(value) => value as Real,
            _ => 0.0,
        };
        let row = INPUTS.iter().find(|(_, name)| name.to_bytes() == error.parameter.as_bytes());
        let input = row.map_or(InputName::None, |(input, _)| *input);
        // Of a quantity that legs have, the leg is the first dimension.
        let leg = match input {
            InputName::BasePoint | InputName::ActuatorAxis | InputName::PlatformPoint => {
                error.element as i32 / 3
            }
            InputName::None
            | InputName::PayloadMass
            | InputName::PayloadCom
            | InputName::PayloadInertia
            | InputName::Gravity => -1,
            _ => error.element as i32,
        };
        let element = error.element as i32;
        Self { element, leg, value, ..Self::of_input(Status::InvalidParameter, input) }
    }
}

impl From<Error> for Refusal {
    fn from(error: Error) -> Self {
        match error {
            Error::NonFinite { input, element } => {
                let element = element as i32;
                let leg = match input {
                    Input::ActuatorForce | Input::ActuatorLength | Input::ActuatorVelocity => element,
                    _ => -1,
                };
                Self { element, leg, ..Self::of_input(Status::NonFinite, input.into()) }
            }
            Error::NotARotation { input, defect } => Self {
                value: defect.deviation as Real,
                limit: <Real as dyn_runtime::Real>::MAX_ROTATION_DEVIATION,
                ..Self::of_input(Status::NotARotation, input.into())
            },
            Error::InvalidModel { leg } => Self::of_leg(Status::InvalidModel, leg),
            Error::OutOfReach { leg } => Self::of_leg(Status::OutOfReach, leg),
            Error::RodPerpendicular { leg } => Self::of_leg(Status::RodPerpendicular, leg),
            Error::SingularJacobian { reciprocal_condition } => Self {
                value: reciprocal_condition as Real,
                limit: <Real as dyn_runtime::Real>::MIN_RECIPROCAL_CONDITION,
                ..Self::of(Status::SingularJacobian)
            },
            Error::NoConvergence { residual_m, .. } => {
                Self { value: residual_m as Real, ..Self::of(Status::NoConvergence) }
            }
            Error::BeyondLimit { quantity, leg, margin } => {
                Self { value: margin as Real, ..Self::of_quantity(Status::BeyondLimit, quantity, leg) }
            }
            Error::InvalidLimit { quantity, leg } => Self::of_quantity(Status::InvalidLimit, quantity, leg),
            Error::InvalidCoil { leg } => Self::of_leg(Status::InvalidCoil, leg),
            Error::NonFiniteResult => Self::of(Status::NonFiniteResult),
            _ => Self::of(Status::Other),
        }
    }
}

impl From<Input> for InputName {
    fn from(input: Input) -> Self {
        match input {
            Input::BasePosition => Self::BasePosition,
            Input::BaseRotation => Self::BaseRotation,
            Input::BaseVelocity => Self::BaseVelocity,
            Input::BaseAcceleration => Self::BaseAcceleration,
            Input::PlatformPosition => Self::PlatformPosition,
            Input::PlatformRotation => Self::PlatformRotation,
            Input::PlatformVelocity => Self::PlatformVelocity,
            Input::PlatformAcceleration => Self::PlatformAcceleration,
            Input::ActuatorForce => Self::ActuatorForce,
            Input::ExternalWrench => Self::ExternalWrench,
            Input::ReferenceVelocity => Self::ReferenceVelocity,
            Input::ActuatorLength => Self::ActuatorLength,
            Input::ActuatorVelocity => Self::ActuatorVelocity,
            _ => Self::None,
        }
    }
}

const STATUSES: &[(Status, &CStr)] = &[
    (Status::Ok, c"ok"),
    (Status::NullPointer, c"a pointer is null: pass the address of a variable"),
    (
        Status::WrongStructSize,
        c"a struct_size is not the size of its struct: set it with sizeof, and compile against this library's header",
    ),
    (Status::UnknownModel, c"this library has no such model: look at kind, and at the features it was built with"),
    (Status::NonFinite, c"an input is NaN or infinite: keep the previous value or stop the controller"),
    (
        Status::NotARotation,
        c"not a rotation: orthonormalise the matrix and check that its columns are the body's axes, or divide the quaternion \
          by its norm",
    ),
    (
        Status::InvalidModel,
        c"the model's parameters are not those of a mechanism: fill in every one; no rod length is 0",
    ),
    (
        Status::OutOfReach,
        c"a leg is out of reach: bring the platform nearer to its home, and check that positions are in metres",
    ),
    (
        Status::RodPerpendicular,
        c"a rod is perpendicular to its actuator, which cannot drive it: bring the platform nearer to its home",
    ),
    (
        Status::SingularJacobian,
        c"the Jacobian J_dp is singular, no forces hold every wrench: bring the platform nearer to its home",
    ),
    (
        Status::NonFiniteResult,
        c"the result is not finite although every input is: check units and the model's parameters",
    ),
    (Status::GimbalLock, c"the angles have no rates so near gimbal lock: go on with the angular velocity"),
    (
        Status::InvalidParameter,
        c"a parameter is not physical: masses, lengths and inertias are positive, axes are unit vectors, numbers finite",
    ),
    (
        Status::NoConvergence,
        c"no pose found with these actuator lengths: start nearer to it, and check that every length is d, in metres, in the \
          order of the platform file",
    ),
    (
        Status::BeyondLimit,
        c"a quantity is beyond its limit: bring the platform nearer to its home, move it more slowly, ask for less force",
    ),
    (
        Status::InvalidLimit,
        c"a limit is NaN, or an angle is limited without its direction at home: start from dyn_model_limits, INFINITY is none",
    ),
    (
        Status::InvalidCoil,
        c"a voice coil has a force constant of 0 or not finite, or a negative limit: fill in all six, in N/A and A",
    ),
    (
        Status::NotInModel,
        c"the model does not carry this: give it in the platform file and bake that, or fill the struct in by hand",
    ),
    (Status::Other, c"refused for a reason that this version of the interface has no status for"),
];

/// A status in words, with the remedy: a static string, never null, also for numbers that are no status.
#[unsafe(no_mangle)]
pub extern "C" fn dyn_status_text(status: i32) -> *const c_char {
    text(STATUSES, |known| known as i32 == status, c"not a status of this library")
}

/// The text of the row whose number is meant, or `unknown`.
pub(crate) fn text<T: Copy>(
    rows: &[(T, &'static CStr)],
    is_meant: impl Fn(T) -> bool,
    unknown: &'static CStr,
) -> *const c_char {
    rows.iter().find(|(known, _)| is_meant(*known)).map_or(unknown, |(_, text)| text).as_ptr()
}

const INPUTS: &[(InputName, &CStr)] = &[
    (InputName::None, c"none"),
    (InputName::BasePosition, c"base_position"),
    (InputName::BaseRotation, c"base_rotation"),
    (InputName::BaseVelocity, c"base_velocity"),
    (InputName::BaseAcceleration, c"base_acceleration"),
    (InputName::PlatformPosition, c"platform_position"),
    (InputName::PlatformRotation, c"platform_rotation"),
    (InputName::PlatformVelocity, c"platform_velocity"),
    (InputName::PlatformAcceleration, c"platform_acceleration"),
    (InputName::ActuatorForce, c"actuator_force"),
    (InputName::ExternalWrench, c"external_wrench"),
    (InputName::Angles, c"angles"),
    (InputName::Quaternion, c"quaternion"),
    (InputName::ReferenceVelocity, c"reference_velocity"),
    (InputName::ActuatorLength, c"actuator_length"),
    (InputName::ActuatorVelocity, c"actuator_velocity"),
    (InputName::AngleRates, c"angle_rates"),
    (InputName::AngularVelocity, c"angular_velocity"),
    (InputName::BasePoint, c"base_point"),
    (InputName::ActuatorAxis, c"actuator_axis"),
    (InputName::PlatformPoint, c"platform_point"),
    (InputName::RodLength, c"rod_length"),
    (InputName::RodMass, c"rod_mass"),
    (InputName::RodInertia, c"rod_inertia"),
    (InputName::RodComFraction, c"rod_com_fraction"),
    (InputName::MoverMass, c"mover_mass"),
    (InputName::MoverOffset, c"mover_offset"),
    (InputName::RestLength, c"rest_length"),
    (InputName::AxialStiffness, c"axial_stiffness"),
    (InputName::AxialDamping, c"axial_damping"),
    (InputName::PayloadMass, c"payload_mass"),
    (InputName::PayloadCom, c"payload_com"),
    (InputName::PayloadInertia, c"payload_inertia"),
    (InputName::Gravity, c"gravity"),
    (InputName::LowerMass, c"lower_mass"),
    (InputName::LowerComDistance, c"lower_com_distance"),
    (InputName::LowerInertia, c"lower_inertia"),
    (InputName::UpperMass, c"upper_mass"),
    (InputName::UpperComDistance, c"upper_com_distance"),
    (InputName::UpperInertia, c"upper_inertia"),
];

/// The name of an input: a static string, never null, also for numbers that are no input.
#[unsafe(no_mangle)]
pub extern "C" fn dyn_input_text(input: i32) -> *const c_char {
    text(INPUTS, |known| known as i32 == input, c"not an input of this library")
}
