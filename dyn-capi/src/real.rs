//! The number type of the library, and the runtime's types made of it.

/// A physical number.
pub type Real = f64;

pub(crate) type Acceleration = dyn_runtime::Acceleration;
pub(crate) type BaseMotion = dyn_runtime::BaseMotion;
pub(crate) type PlatformState = dyn_runtime::PlatformState;
pub(crate) type Pose = dyn_runtime::Pose;
pub(crate) type Twist = dyn_runtime::Twist;
pub(crate) type Wrench = dyn_runtime::Wrench;
