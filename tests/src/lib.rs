//! What the tests share: platforms, states, compiled models by name, the hand-written reference by name, tolerances.

pub mod compare;
pub mod comparison;
pub mod compiled;
pub mod platforms;
pub mod reference;
pub mod tolerance;
pub mod vectors;

/// The README's example, compiled and run.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
pub struct Readme;
