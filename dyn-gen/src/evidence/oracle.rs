//! The hand-written dynamics, asked by name.

use dyn_platform::Platform;
use dyn_reference::Mechanism;
use dyn_reference::inputs::InputError;

use super::Case;
use crate::graph::Environment;

/// Why the hand-written dynamics have no answer.
#[derive(Clone, PartialEq, Debug, thiserror::Error, miette::Diagnostic)]
pub enum OracleError {
    /// They do not have a leg type.
    #[error("the hand-written dynamics have no legs of type `{leg_type}`")]
    #[diagnostic(help("add a module to dyn-reference/src/legs"))]
    NoLegType {
        /// Its name.
        leg_type: String,
    },
    /// They lack an input.
    #[error("the hand-written dynamics: {0}")]
    Input(InputError),
    /// They do not have an output.
    #[error("the hand-written dynamics have no `{output}`")]
    #[diagnostic(help(
        "add it to the table OUTPUTS of dyn-reference/src/outputs.rs, or to that of the leg type"
    ))]
    NoOutput {
        /// The output.
        output: String,
    },
}

/// The outputs called `names` of a platform with legs of this type, at every case.
pub fn expected(leg_type: &str, cases: &[Case], names: &[String]) -> Result<Vec<Environment>, OracleError> {
    cases
        .iter()
        .map(|case| {
            let environment = &case.environment;
            let lookup = |name: &str| environment.get(name).cloned();
            let mechanism = mechanism(leg_type, lookup)?;
            let state = dyn_reference::State::from_arrays(lookup).map_err(OracleError::Input)?;
            let value = |name: &String| {
                let mut values = Vec::new();
                if !mechanism.output(&state, name, &mut values) {
                    return Err(OracleError::NoOutput { output: name.clone() });
                }
                Ok((name.clone(), values))
            };
            names.iter().map(value).collect()
        })
        .collect()
}

fn mechanism(leg_type: &str, lookup: impl FnMut(&str) -> Option<Vec<f64>>) -> Result<Mechanism, OracleError> {
    match Mechanism::from_arrays(leg_type, lookup) {
        Some(mechanism) => mechanism.map_err(OracleError::Input),
        None => Err(OracleError::NoLegType { leg_type: leg_type.into() }),
    }
}

/// The reference's parameters of a platform.
///
/// # Errors
/// If the reference lacks the leg type, or the platform a parameter.
pub fn reference_parameters(platform: &Platform) -> Result<Mechanism, OracleError> {
    mechanism(platform.leg_type.name(), |name| platform.parameter(name))
}

/// The reference's form of a state.
///
/// # Errors
/// If a part is missing.
pub fn reference_state(state: &Environment) -> Result<dyn_reference::State, InputError> {
    dyn_reference::State::from_arrays(|name| state.get(name).cloned())
}
