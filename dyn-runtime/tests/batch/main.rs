//! Batches against the same functions one state at a time.

mod arguments;
mod fused;
mod inputs;
mod lanes;
mod matrices;
mod platforms;
mod simulations;
