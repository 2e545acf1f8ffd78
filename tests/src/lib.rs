//! What the tests share: platforms, states, compiled models by name, the hand-written reference by name.

pub mod comparison;
pub mod compiled;
pub mod platforms;
pub mod reference;
pub mod vectors;

/// The README's example, compiled and run.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
pub struct Readme;

/// The examples of the chapter about control loops, compiled and run; those in C are `dyn-capi`'s business.
#[cfg(doctest)]
#[doc = include_str!("../../docs/control-loop.md")]
pub struct ControlLoop;
