//! The hand-written dynamics, by name.

use dyn_gen::evidence;
use dyn_gen::graph::Environment;
use dyn_platform::Platform;
use dyn_reference::{Mechanism, State};

/// Parameters of the reference for a platform.
pub fn parameters(platform: &Platform) -> Mechanism {
    evidence::reference_parameters(platform).expect("platforms have every parameter")
}

/// A state of the reference.
pub fn state(state: &Environment) -> State {
    evidence::reference_state(state).expect("sampled states are complete")
}

/// An output by name, flat and row-major.
pub fn output(mechanism: &Mechanism, state: &State, name: &str) -> Vec<f64> {
    let mut values = Vec::new();
    assert!(mechanism.output(state, name, &mut values), "the reference has no output `{name}`");
    values
}

/// Every output by name.
pub fn outputs(mechanism: &Mechanism, state: &State) -> Environment {
    let names = mechanism.output_names().into_iter();
    names.map(|name| (name.to_owned(), output(mechanism, state, name))).collect()
}
