//! What will be printed, examined before it is: the optimised graphs are evaluated at sampled states and compared, output by
//! output, with the graphs as they were derived and with [`dyn_reference`], which somebody wrote by hand and which shares
//! nothing with them; and they have to obey the laws of mechanics.

mod comparison;
mod laws;
mod oracle;
mod table;

use dyn_platform::Platform;
use serde::Serialize;

pub use comparison::{Agreement, Worst};
pub(crate) use laws::moving;
pub use laws::{LAWS, Law, LawRow};
pub use oracle::{OracleError, reference_parameters, reference_state};

use crate::error::GenerateError;
use crate::generate::GeneratedFunction;
use crate::graph::{Environment, EvaluationError, Program};
use crate::numbers::Numbers;
use crate::pack::unpack;
use crate::parallel;
use crate::sample::Kind;
use crate::workspace::{parameters, sampled_states};

/// How many states are looked at, and which.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
pub struct Sampling {
    /// Number of states: home, then in turn near home, anywhere, near the edge of the workspace.
    pub states: usize,
    /// Seed of the states.
    pub seed: u64,
}

impl Default for Sampling {
    /// 1000 states; another seed than that of the states by which pivots are chosen.
    fn default() -> Sampling {
        Sampling { states: 1000, seed: 2016 }
    }
}

/// A state, its parameters, and what kind it is.
#[derive(Clone, Debug)]
pub struct Case {
    /// Every input and every parameter by name, flat.
    pub environment: Environment,
    /// How far from rest it is.
    pub kind: Kind,
}

/// What was found.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Evidence {
    /// Name of the platform.
    pub platform: String,
    /// The states.
    #[serde(flatten)]
    pub sampling: Sampling,
    /// One row per output of every function.
    pub outputs: Vec<Agreement>,
    /// One row per law.
    pub laws: Vec<LawRow>,
}

/// Why nothing could be examined.
#[derive(Clone, PartialEq, Debug, thiserror::Error, miette::Diagnostic)]
pub enum EvidenceError {
    /// The interpreter lacks an input.
    #[error(transparent)]
    Evaluation(#[from] EvaluationError),
    /// The hand-written dynamics lack something.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Oracle(#[from] OracleError),
    /// Numbers of any platform are no platform's.
    #[error("there is no platform whose states could be sampled")]
    #[diagnostic(help("generate the model of a platform, or without evidence"))]
    NoPlatform,
}

/// `sampling.states` states of `platform` with its parameters: home, then in turn those of [`Kind::Random`],
/// [`Kind::Large`] and [`Kind::NearEdge`], the same for the same seed.
///
/// # Errors
/// As [`sampled_states`].
pub fn cases(program: &Program, platform: &Platform, sampling: Sampling) -> Result<Vec<Case>, GenerateError> {
    const KINDS: [Kind; 3] = [Kind::Random, Kind::Large, Kind::NearEdge];
    let moving = sampling.states.saturating_sub(1);
    let counts: Vec<(Kind, usize)> =
        (0..3).map(|k| (KINDS[k], moving / 3 + usize::from(k < moving % 3))).collect();
    let mut kinds = vec![(Kind::Home, sampling.states.min(1))];
    kinds.extend(&counts);
    let numbers = parameters(program, platform)?;
    let states = sampled_states(program, platform, &kinds, sampling.seed)?;
    let case = |(k, kind): (usize, Kind)| {
        let mut environment = states[k].clone();
        environment.extend(numbers.clone());
        Case { environment, kind }
    };
    // Sampled kind by kind, listed in turn.
    let starts = [1, 1 + counts[0].1, 1 + counts[0].1 + counts[1].1];
    let order = (0..moving).map(|k| (starts[k % 3] + k / 3, KINDS[k % 3]));
    Ok(std::iter::once((0, Kind::Home)).take(sampling.states).chain(order).map(case).collect())
}

/// Examines `functions`, generated from `numbers`, at sampled states.
///
/// Every other state has each run-time parameter changed a little, so that one that is not taken shows.
///
/// # Errors
/// If states cannot be sampled or an output has no counterpart; disagreement is no error but a figure.
pub fn gather(
    program: &Program,
    numbers: &Numbers<'_>,
    functions: &[GeneratedFunction],
    sampling: Sampling,
) -> Result<Evidence, GenerateError> {
    let platform = numbers.platform().ok_or(EvidenceError::NoPlatform)?;
    let run_time = numbers.run_time_parameters(program)?;
    let mut cases = cases(program, platform, sampling)?;
    if !run_time.is_empty() {
        for (k, case) in cases.iter_mut().enumerate().filter(|(k, _)| k % 2 == 1) {
            for symbol in &run_time {
                if let Some(values) = case.environment.get_mut(&symbol.name) {
                    vary(&symbol.name, values, k);
                }
            }
        }
    }
    let batches: Vec<&[Case]> = cases.chunks(crate::graph::LANES).collect();
    let names = comparison::output_names(functions);
    let expected = parallel::map(&batches, |batch| oracle::expected(&program.name, batch, &names));
    let expected: Vec<Environment> =
        expected.into_iter().collect::<Result<Vec<_>, _>>().map_err(EvidenceError::from)?.concat();
    let examined = with_lanes(functions);
    let comparison = comparison::Comparison::new(program, &examined, &names, &expected);
    let found = parallel::map(&(0..batches.len()).collect::<Vec<_>>(), |&k| {
        let first = k * crate::graph::LANES;
        comparison.examine(batches[k], first)
    });
    let found = found.into_iter().collect::<Result<Vec<_>, _>>()?;
    let (mut outputs, laws) = comparison.worst_of(found);
    let without_lanes: usize = functions.iter().map(|function| function.graph.outputs.len()).sum();
    outputs[without_lanes..].iter_mut().for_each(|row| row.function.push_str(" in lanes"));
    Ok(Evidence { platform: platform.name.clone(), sampling, outputs, laws })
}

/// The functions, and after them those in lanes as functions of their own.
fn with_lanes(functions: &[GeneratedFunction]) -> Vec<GeneratedFunction> {
    let in_lanes = functions.iter().filter_map(|function| {
        let graph = unpack(&function.in_lanes.as_ref()?.graph);
        Some(GeneratedFunction { graph, in_lanes: None, passes: Vec::new(), ..*function })
    });
    functions.iter().cloned().chain(in_lanes).collect()
}

/// Other numbers that are as valid as these, by up to a tenth, or a thousandth where reach depends on them.
fn vary(name: &str, values: &mut [f64], k: usize) {
    let wave = |period: usize| (k % period) as f64 / period as f64 - 0.5;
    match name {
        // A unit vector stays one, and within reach.
        "actuator_axis" => {
            for axis in values.chunks_mut(3) {
                axis[0] += 1e-3 * wave(7);
                axis[1] += 1e-3 * wave(11);
                let norm = axis.iter().map(|x| x * x).sum::<f64>().sqrt();
                axis.iter_mut().for_each(|x| *x /= norm);
            }
        }
        "base_point" | "platform_point" | "rod_length" => {
            let factor = 1.0 + 1e-3 * wave(13);
            values.iter_mut().for_each(|x| *x *= factor);
        }
        // Of one factor: a tensor stays that of a body.
        "payload_inertia" => {
            let factor = 1.0 + 0.2 * wave(17);
            values.iter_mut().for_each(|x| *x *= factor);
        }
        _ => {
            for (index, x) in values.iter_mut().enumerate() {
                *x *= 1.0 + 0.2 * wave(19 + index);
            }
        }
    }
}

impl Evidence {
    /// Whether everything is within its tolerance.
    pub fn holds(&self) -> bool {
        self.outputs.iter().all(Agreement::holds) && self.laws.iter().all(LawRow::holds)
    }

    /// The first of the [`failures`](Self::failures), line by line, and how many more there are.
    pub fn first_failures(&self) -> String {
        /// At most this many; the table has all.
        const MOST_SHOWN: usize = 4;
        let failures = self.failures();
        let more = failures.len().saturating_sub(MOST_SHOWN);
        let mut lines: Vec<String> = failures.into_iter().take(MOST_SHOWN).collect();
        if more > 0 {
            lines.push(format!("and {more} more"));
        }
        lines.join("\n")
    }

    /// Every figure that exceeds its tolerance, in words: what, by how much, at which state.
    pub fn failures(&self) -> Vec<String> {
        let place = |worst: &Worst| {
            format!("at state {} ({}) of seed {}", worst.state, worst.kind, self.sampling.seed)
        };
        let mut failures = Vec::new();
        for row in &self.outputs {
            for (worst, other) in [
                (&row.unoptimised, "the graph before optimisation"),
                (&row.reference, "the hand-written dynamics"),
            ] {
                if !worst.is_allowed() {
                    failures.push(format!(
                        "function `{}`, output `{}`: differs from {other} by {:.1e} (tolerance {:.0e}) {}",
                        row.function,
                        row.output,
                        worst.error,
                        worst.tolerance,
                        place(worst)
                    ));
                }
            }
        }
        for row in &self.laws {
            if let Some(worst) = row.worst.as_ref().filter(|_| !row.holds()) {
                failures.push(format!(
                    "functions `{}`: the law {} is missed by {:.1e} (tolerance {:.0e}) {}",
                    row.functions.join("`, `"),
                    row.law,
                    worst.error,
                    row.tolerance,
                    place(worst)
                ));
            }
        }
        failures
    }
}
