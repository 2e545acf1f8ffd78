//! Every checked call against a mock model: what goes in, what comes out, what is refused.

mod arguments;
mod calls;
mod inputs;
mod messages;
mod mock;
mod refusals;
