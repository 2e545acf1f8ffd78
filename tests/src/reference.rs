//! The hand-written dynamics, by name.

use dyn_gen::evidence;
use dyn_gen::graph::Environment;
use dyn_platform::Platform;
use dyn_reference::{Parameters, State};

/// Parameters of the reference for a platform.
pub fn parameters(platform: &Platform) -> Parameters {
    evidence::reference_parameters(platform).expect("platforms have every parameter")
}

/// A state of the reference.
pub fn state(state: &Environment) -> State {
    evidence::reference_state(state).expect("sampled states are complete")
}

/// An output by name, flat and row-major.
pub fn output(parameters: &Parameters, state: &State, name: &str) -> Vec<f64> {
    let mut values = Vec::new();
    assert!(
        dyn_reference::outputs::output(parameters, state, name, &mut values),
        "the reference has no output `{name}`"
    );
    values
}

/// Every output by name.
pub fn outputs(parameters: &Parameters, state: &State) -> Environment {
    let names = dyn_reference::outputs::OUTPUTS.iter().map(|row| row.name);
    names.map(|name| (name.to_owned(), output(parameters, state, name))).collect()
}
