//! The hand-written dynamics, asked by name.

use dyn_platform::Platform;
use dyn_reference::inputs::InputError;
use dyn_reference::outputs;

use super::Case;
use crate::graph::Environment;

/// Why the hand-written dynamics have no answer.
#[derive(Clone, PartialEq, Debug, thiserror::Error, miette::Diagnostic)]
pub enum OracleError {
    /// They lack an input.
    #[error("the hand-written dynamics: {0}")]
    Input(InputError),
    /// They do not have an output.
    #[error("the hand-written dynamics have no `{output}`")]
    #[diagnostic(help("add it to the table OUTPUTS of dyn-reference/src/outputs.rs"))]
    NoOutput {
        /// The output.
        output: String,
    },
}

/// The outputs called `names` at every case.
pub fn expected(cases: &[Case], names: &[String]) -> Result<Vec<Environment>, OracleError> {
    cases
        .iter()
        .map(|case| {
            let environment = &case.environment;
            let lookup = |name: &str| environment.get(name).cloned();
            let parameters = dyn_reference::Parameters::from_arrays(lookup).map_err(OracleError::Input)?;
            let state = dyn_reference::State::from_arrays(lookup).map_err(OracleError::Input)?;
            let value = |name: &String| {
                let mut values = Vec::new();
                if !outputs::output(&parameters, &state, name, &mut values) {
                    return Err(OracleError::NoOutput { output: name.clone() });
                }
                Ok((name.clone(), values))
            };
            names.iter().map(value).collect()
        })
        .collect()
}

/// The reference's parameters of a platform.
///
/// # Errors
/// If the platform lacks one.
pub fn reference_parameters(platform: &Platform) -> Result<dyn_reference::Parameters, InputError> {
    dyn_reference::Parameters::from_arrays(|name| platform.parameter(name))
}

/// The reference's form of a state.
///
/// # Errors
/// If a part is missing.
pub fn reference_state(state: &Environment) -> Result<dyn_reference::State, InputError> {
    dyn_reference::State::from_arrays(|name| state.get(name).cloned())
}
