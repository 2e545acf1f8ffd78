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
