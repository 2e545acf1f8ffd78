//! The printer: what it prints compiles, means what the interpreter computes to the last bit, and reads well.

mod bits;
mod compiled;
mod graphs;
mod length;
mod limits;
mod run_time;
mod text;
