//! What will be printed, compared with dynamics that someone wrote by hand: the optimised graphs are evaluated by the
//! interpreter at sampled states and compared, output by output, with [`dyn_reference`], which shares nothing with them.

use dyn_platform::Platform;
use dyn_reference::inputs::InputError;
use dyn_reference::outputs;

use crate::deviation::{Scale, larger, relative_error, within};
use crate::error::GenerateError;
use crate::generate::GeneratedFunction;
use crate::graph::{Environment, EvaluationError, Output, Program};
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
    /// state (of a scalar: at all of these states). NaN where a deviation is not a number.
    pub worst: [f64; KINDS.len()],
}

impl Agreement {
    /// The largest of all.
    pub fn overall(&self) -> f64 {
        self.worst.iter().fold(0.0, |most, &error| larger(most, error))
    }

    /// Whether every error is within the output's tolerance.
    pub fn holds(&self) -> bool {
        within(self.overall(), &self.output)
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
    let mut table: Vec<Agreement> = rows(functions)
        .map(|(function, output)| Agreement {
            function: function.graph.name.clone(),
            output: output.symbol.name.clone(),
            worst: [0.0; KINDS.len()],
        })
        .collect();
    for (column, (kind, _)) in KINDS.into_iter().enumerate() {
        let states = sampled_states(program, platform, &[(kind, count)], seed)?;
        let expected = states
            .iter()
            .map(|state| expected(&parameters, state, functions))
            .collect::<Result<Vec<Environment>, _>>()?;
        for (state, expected_here) in states.iter().zip(&expected) {
            let found = functions.iter().map(|function| function.graph.evaluate(state));
            let found = found.collect::<Result<Vec<Environment>, _>>()?;
            let found = functions.iter().zip(&found).flat_map(|(function, values)| {
                function.graph.outputs.iter().map(|output| &values[&output.symbol.name])
            });
            for (row, found) in table.iter_mut().zip(found) {
                let scale = Scale::of(expected.iter().map(|values| values[&row.output].as_slice()));
                let error = relative_error(found, &expected_here[&row.output], scale);
                row.worst[column] = larger(row.worst[column], error);
            }
        }
    }
    Ok(table)
}

fn rows(functions: &[GeneratedFunction]) -> impl Iterator<Item = (&GeneratedFunction, &Output)> {
    functions.iter().flat_map(|function| function.graph.outputs.iter().map(move |output| (function, output)))
}

/// The reference's value of every output.
fn expected(
    parameters: &dyn_reference::Parameters,
    state: &Environment,
    functions: &[GeneratedFunction],
) -> Result<Environment, EvidenceError> {
    let state = reference_state(state).map_err(EvidenceError::Reference)?;
    let mut expected = Environment::new();
    for (function, output) in rows(functions) {
        let name = &output.symbol.name;
        if expected.contains_key(name) {
            continue;
        }
        let mut values = Vec::new();
        if !outputs::output(parameters, &state, name, &mut values) {
            let (function, output) = (function.graph.name.clone(), name.clone());
            return Err(EvidenceError::NoReference { function, output });
        }
        expected.insert(name.clone(), values);
    }
    Ok(expected)
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
