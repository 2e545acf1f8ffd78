//! Calls of the committed models. One program: each would compile the same large functions again.

mod control;
mod models;
mod no_allocation;
