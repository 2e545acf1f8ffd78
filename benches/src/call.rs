//! One call of one function by one implementation, and the two loops around it.
//!
//! Each implementation is called as a program would call it, and none pays for a conversion: generated functions
//! write into arrays that stay where they are, the reference returns by value into the caller's frame. Neither
//! result is copied, and both must be complete in memory when the call is over.

use std::hint::black_box;

use crate::output::Output;
use crate::states::{COUNT, Inputs};

/// A function of an implementation.
pub trait Call {
    /// What it takes.
    type State;
    /// What it gives.
    type Output: Output;

    /// Calls it and lets `read` look at the result where it lies.
    fn call<R>(&mut self, state: &Self::State, read: impl FnOnce(&Self::Output) -> R) -> R;
}

/// A generated function.
pub struct Generated<M, F, O> {
    /// The model.
    pub model: M,
    /// Calls one of the model's functions.
    pub function: F,
    /// Where the result goes.
    pub output: O,
}

impl<M, F: Fn(&M, &Inputs, &mut O), O: Output> Call for Generated<M, F, O> {
    type State = Inputs;
    type Output = O;

    #[inline(always)]
    fn call<R>(&mut self, state: &Self::State, read: impl FnOnce(&O) -> R) -> R {
        (self.function)(black_box(&self.model), state, &mut self.output);
        read(&self.output)
    }
}

/// A function of the reference.
pub struct Reference<F> {
    /// The platform.
    pub parameters: dyn_reference::Parameters,
    /// The function.
    pub function: F,
}

impl<F, O> Call for Reference<F>
where
    F: Fn(&dyn_reference::Parameters, &dyn_reference::State) -> O,
    O: Output,
{
    type State = dyn_reference::State;
    type Output = O;

    #[inline(always)]
    fn call<R>(&mut self, state: &Self::State, read: impl FnOnce(&O) -> R) -> R {
        let output = (self.function)(black_box(&self.parameters), state);
        read(&output)
    }
}

/// Each call of the returned function computes the next state. Calls do not depend on one another: the processor
/// may overlap the end of one with the beginning of the next.
pub fn throughput<C: Call>(call: &mut C, states: &[C::State; COUNT]) -> impl FnMut() {
    let mut next = 0;
    move || {
        call.call(black_box(&states[next]), |output| {
            black_box(output);
        });
        next = (next + 1) % COUNT;
    }
}

/// Each call of the returned function computes the next state, whose address is known only when every number of
/// the previous result is: calls follow one another strictly, as in a control loop.
///
/// The address is the sum of the index and `bits & nothing`, where `bits` holds the bits of all results and
/// `nothing` is zero, which neither compiler nor processor knows beforehand. So all inputs wait, they keep their
/// exact values, and the cost is one "or" per number of the result.
pub fn latency<C: Call>(call: &mut C, states: &[C::State; COUNT]) -> impl FnMut() {
    let nothing = black_box(0_u64);
    let mut next = 0;
    move || {
        let bits = call.call(black_box(&states[next]), |output| black_box(output).bits());
        next = (next + 1 + (bits & nothing) as usize) % COUNT;
    }
}
