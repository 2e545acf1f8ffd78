//! What the tests share: platforms, states, compiled models by name, the hand-written reference by name, tolerances.

pub mod compare;
pub mod compiled;
pub mod platforms;
pub mod reference;
pub mod tolerance;
pub mod vectors;
