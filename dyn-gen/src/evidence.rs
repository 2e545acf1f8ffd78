//! What will be printed, compared with dynamics that someone wrote by hand: the optimised graphs are evaluated by the
//! interpreter at sampled states and compared, output by output, with [`dyn_reference`], which shares nothing with them.

use dyn_platform::Platform;
use dyn_reference::inputs::InputError;
use dyn_reference::outputs;

use crate::generate::{GenerateError, GeneratedFunction};
use crate::graph::{Environment, EvaluationError, Program};
use crate::sample::Kind;
use crate::workspace::sampled_states;

/// Kinds of states, with the name each has in tables.
pub const KINDS: [(Kind, &str); 3] =
    [(Kind::Random, "random"), (Kind::Large, "large"), (Kind::NearEdge, "near edge")];

/// How well one output agrees.
#[derive(Clone, PartialEq, Debug, serde::Serialize)]
pub struct Agreement {
    /// The function.
    pub function: String,
    /// The output.
    pub output: String,
    /// For each of [`KINDS`], the largest deviation at any state, relative to the largest entry of the array at that
    /// state. NaN where a deviation is not a number.
    pub worst: [f64; KINDS.len()],
}

impl Agreement {
    /// The largest of all.
    pub fn overall(&self) -> f64 {
        self.worst.iter().fold(0.0, |most, &error| larger(most, error))
    }
}

/// Why nothing could be compared.
#[derive(Clone, PartialEq, Debug, thiserror::Error, miette::Diagnostic)]
pub enum EvidenceError {
    /// No states, or no platform to sample.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Generate(#[from] GenerateError),
    /// The interpreter lacks an input.
    #[error(transparent)]
    Evaluation(#[from] EvaluationError),
    /// The reference lacks an input.
    #[error("the reference: {0}")]
    Reference(InputError),
    /// The reference does not have an output.
    #[error("the reference has no `{output}`, an output of function `{function}`")]
    #[diagnostic(help("add it to the table OUTPUTS of dyn-reference/src/outputs.rs"))]
    NoReference {
        /// The function.
        function: String,
        /// The output.
        output: String,
    },
}

/// Compares every output of `functions`, generated for `platform`, at `count` states of each of [`KINDS`].
///
/// # Errors
/// If states cannot be sampled or an output has no counterpart; disagreement is no error but a figure.
pub fn compare(
    program: &Program,
    platform: &Platform,
    functions: &[GeneratedFunction],
    count: usize,
    seed: u64,
) -> Result<Vec<Agreement>, EvidenceError> {
    let parameters = reference_parameters(platform).map_err(EvidenceError::Reference)?;
    let mut table: Vec<Agreement> = Vec::new();
    for (column, (kind, _)) in KINDS.into_iter().enumerate() {
        for state in sampled_states(program, platform, &[(kind, count)], seed)? {
            let reference = reference_state(&state).map_err(EvidenceError::Reference)?;
            let mut row = 0;
            for function in functions {
                let mut results = function.graph.evaluate(&state)?;
                for output in &function.graph.outputs {
                    let (function, name) = (&function.graph.name, &output.symbol.name);
                    let mut expected = Vec::new();
                    if !outputs::output(&parameters, &reference, name, &mut expected) {
                        let (function, output) = (function.clone(), name.clone());
                        return Err(EvidenceError::NoReference { function, output });
                    }
                    if row == table.len() {
                        let (function, output) = (function.clone(), name.clone());
                        table.push(Agreement { function, output, worst: [0.0; KINDS.len()] });
                    }
                    let found = results.remove(name).unwrap_or_default();
                    let worst = &mut table[row].worst[column];
                    *worst = larger(*worst, relative_error(&found, &expected));
                    row += 1;
                }
            }
        }
    }
    Ok(table)
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

/// Largest deviation over the largest expected entry; infinite where only one of the arrays is zero.
fn relative_error(found: &[f64], expected: &[f64]) -> f64 {
    if found.len() != expected.len() {
        return f64::INFINITY;
    }
    let largest = expected.iter().fold(0.0, |most, x| larger(most, x.abs()));
    let deviation = found.iter().zip(expected).fold(0.0, |most, (x, y)| larger(most, (x - y).abs()));
    if deviation == 0.0 { 0.0 } else { deviation / largest }
}

/// The larger number; NaN wins, so that a broken value cannot hide.
fn larger(a: f64, b: f64) -> f64 {
    if a >= b || a.is_nan() { a } else { b }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_are_relative_to_the_largest_entry_and_broken_values_show() {
        assert_eq!(relative_error(&[1.0, 4.0], &[1.5, 4.0]), 0.125);
        assert_eq!(relative_error(&[0.0], &[0.0]), 0.0);
        assert_eq!(relative_error(&[1.0], &[0.0]), f64::INFINITY);
        assert_eq!(relative_error(&[1.0], &[1.0, 2.0]), f64::INFINITY);
        assert!(relative_error(&[1.0, f64::NAN], &[1.0, 1.0]).is_nan());
        assert!(relative_error(&[f64::NAN, 2.0], &[1.0, 1.0]).is_nan());
    }
}
