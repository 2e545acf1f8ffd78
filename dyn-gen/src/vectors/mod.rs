//! Test vectors: inputs and every output of a platform, so that a port of the equations can be checked. The format is
//! described in `docs/vectors.md`.

mod read;
mod write;

use dyn_platform::Platform;

pub use read::{StatesError, StatesFile, read_states};

use crate::GraphFile;
use crate::error::GenerateError;
use crate::evidence::EvidenceError;
use crate::generate::{GeneratedFunction, optimise};
use crate::graph::Environment;
use crate::numbers::Numbers;

/// Version of the format.
pub const VERSION: u32 = 1;

/// Why there are no vectors.
#[derive(Clone, PartialEq, Debug, thiserror::Error, miette::Diagnostic)]
pub enum VectorsError {
    /// Nothing can be computed.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Generate(#[from] GenerateError),
    /// A leg does not reach.
    #[error(
        "cases[{case}]: leg {leg} is out of reach: its platform joint is farther from its actuator's axis than its rod is long"
    )]
    #[diagnostic(help(
        "bring the platform of this case nearer to its home, and check that positions are in metres"
    ))]
    Reach {
        /// Number of the case, from 0.
        case: usize,
        /// Number of the leg, from 1.
        leg: usize,
    },
    /// A result is not a number.
    #[error("cases[{case}]: output `{output}` of function `{function}` is not finite")]
    #[diagnostic(help(
        "the pose is singular or the numbers are too large to compute with: bring the platform of this case nearer to its home"
    ))]
    NotFinite {
        /// Number of the case, from 0.
        case: usize,
        /// The function.
        function: String,
        /// The output.
        output: String,
    },
}

/// The text of a file of vectors: every output of every function at each of `states`, evaluated as `generate` prints it.
///
/// # Errors
/// See [`VectorsError`].
pub fn vectors(
    file: &GraphFile,
    platform: &Platform,
    states: &[Environment],
) -> Result<String, VectorsError> {
    let functions = optimise(&file.program, &Numbers::baked(platform), None)?;
    let mut cases = Vec::with_capacity(states.len());
    for (case, state) in states.iter().enumerate() {
        cases.push(write::case(state, &outputs(&functions, case, state)?));
    }
    write::file(platform, &cases).map_err(|error| GenerateError::Json { message: error.to_string() }.into())
}

/// Every output at one state with its shape, each once, in the order of the functions.
fn outputs(
    functions: &[GeneratedFunction],
    case: usize,
    state: &Environment,
) -> Result<Vec<(String, serde_json::Value)>, VectorsError> {
    let mut outputs: Vec<(String, serde_json::Value)> = Vec::new();
    for function in functions {
        let graph = &function.graph;
        let values =
            graph.evaluate(state).map_err(|error| GenerateError::from(EvidenceError::from(error)))?;
        for output in &graph.outputs {
            let name = &output.symbol.name;
            let Some(values) = values.get(name) else { continue };
            if name == "rod_alignment"
                && let Some(leg) = values.iter().position(|alignment| *alignment < 0.0)
            {
                return Err(VectorsError::Reach { case, leg: leg + 1 });
            }
            if !values.iter().all(|value| value.is_finite()) {
                let (function, output) = (graph.name.clone(), name.clone());
                return Err(VectorsError::NotFinite { case, function, output });
            }
            if !outputs.iter().any(|(known, _)| known == name) {
                outputs.push((name.clone(), write::nested(values, &output.symbol.shape)));
            }
        }
    }
    Ok(outputs)
}
