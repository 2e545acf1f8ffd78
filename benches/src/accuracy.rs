//! Rounding errors of every implementation, against results of the same graph in fifty digits (`benches/peers/exact.py`).

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use dyn_gen::graph::Environment;
use dyn_platform::Platform;
use dyn_runtime::kernels::{ForwardDynamics, InverseDynamics, Matrices};
use nalgebra::SMatrix;
use serde::Deserialize;

use crate::call::Call;
use crate::cases::{Case, Visitor, visit};
use crate::model::Baked;
use crate::output::Output;
use crate::states::{COUNT, Inputs, States};
use crate::table;

/// Largest relative error of a 6 x 6 matrix in double precision, in the maximum norm.
pub const MATRIX_TOLERANCE: f64 = 2e-14;
/// The same of what a linear system gives, for a Jacobian J_dp of condition 1.
pub const SOLUTION_TOLERANCE: f64 = 1e-13;
/// Tolerances in single precision: this many times its epsilon where double precision has the two above, in their proportion.
const SINGLE_EPSILONS: f64 = 100.0;

/// Least u.a of all legs at which matrices in single precision are judged. Where a product and its sum are rounded apart, only from 0.15
/// on: nearer to the edge, at 0.13, 1/(u.a)^2 = 60 stands before every rounding error of a leg's position, three times that in C_p.
const LEAST_ALIGNMENT_IN_SINGLE: f64 = if cfg!(target_feature = "fma") { 0.1 } else { 0.15 };

/// Functions with exact results.
const FUNCTIONS: [&str; 3] = ["inverse_dynamics", "forward_dynamics", "matrices"];
/// Numbers of a 6 x 6 matrix.
const MATRIX: usize = 36;
/// Where J_dp begins among the results of `matrices`.
const JACOBIAN: usize = 2 * MATRIX;

/// States with exact results.
#[derive(Deserialize)]
pub struct Exact {
    platform: String,
    cases: Vec<ExactCase>,
}

#[derive(Deserialize)]
struct ExactCase {
    /// Whether its inputs are numbers of single precision, rotations included.
    single: bool,
    state: Environment,
    results: BTreeMap<String, Vec<f64>>,
}

/// The largest error of an implementation over the states.
#[derive(Clone, Debug, PartialEq)]
pub struct Accuracy {
    /// What was looked at.
    pub case: Case,
    /// Relative error in the maximum norm, at the state where it is the largest part of its tolerance.
    pub error: f64,
    /// What is granted there.
    pub tolerance: f64,
}

impl Accuracy {
    /// Whether the error is within the tolerance.
    pub fn holds(&self) -> bool {
        self.error <= self.tolerance
    }
}

impl Exact {
    /// The committed results, for the paper's platform.
    pub fn committed() -> PathBuf {
        Path::new(env!("CARGO_MANIFEST_DIR")).join("exact.json")
    }

    /// From a file that `exact.py` wrote.
    ///
    /// # Errors
    /// If it cannot be read or is of another platform, in words.
    pub fn read(path: &Path, platform: &Platform) -> Result<Self, String> {
        let refused = |reason: &dyn std::fmt::Display| format!("{}: {reason}", path.display());
        let text = fs::read_to_string(path).map_err(|error| refused(&error))?;
        let exact: Self = serde_json::from_str(&text).map_err(|error| refused(&error))?;
        if exact.platform == platform.name && !exact.cases.is_empty() {
            Ok(exact)
        } else {
            Err(refused(&format!("not of platform `{}`", platform.name)))
        }
    }

    /// Errors of everything that can be measured, and of the baked and the run-time model in single precision.
    pub fn judge(&self, platform: &Platform) -> Vec<Accuracy> {
        let states: Vec<Environment> =
            self.cases.iter().cycle().take(COUNT).map(|case| case.state.clone()).collect();
        let states = States::new(&states);
        let mut judge = Judge { exact: self, found: Vec::new() };
        for function in FUNCTIONS {
            visit(function, platform, &states, &mut judge);
        }
        judge.single(&Baked, "generated", &states);
        judge.single(&narrowed(platform), "generated_runtime", &states);
        judge.found
    }
}

/// The run-time model in single precision.
fn narrowed(platform: &Platform) -> dyn_runtime::models::Uhp<f32> {
    dyn_runtime::models::Uhp {
        parameters: dyn_runtime::models::Parameters::from_fn(|name, values: &mut [f32]| {
            let numbers = platform.parameter(name).expect("platforms have every parameter");
            values.iter_mut().zip(numbers).for_each(|(value, number)| *value = number as f32);
        }),
    }
}

/// A table of accuracies.
pub fn text(accuracies: &[Accuracy]) -> String {
    let rows: Vec<Vec<String>> = accuracies
        .iter()
        .map(|Accuracy { case, error, tolerance }| {
            let verdict = if error <= tolerance { "holds" } else { "EXCEEDS" };
            vec![
                case.function.into(),
                case.implementation.into(),
                case.variant.into(),
                format!("{error:.1e}"),
                format!("{tolerance:.1e}"),
                verdict.into(),
            ]
        })
        .collect();
    table::text(&["function", "implementation", "variant", "relative error", "tolerance", ""], &rows, 3)
}

struct Judge<'a> {
    exact: &'a Exact,
    found: Vec<Accuracy>,
}

impl Judge<'_> {
    /// Adds the worst of `results`, one list of numbers per state of single or of either precision.
    fn add(&mut self, case: Case, epsilon: f64, states: impl Iterator<Item = (usize, Vec<f64>)>) {
        let scale = epsilon / f64::EPSILON;
        let mut worst = Accuracy { case, error: 0.0, tolerance: f64::INFINITY };
        for (index, found) in states {
            let exact = &self.exact.cases[index];
            let expected = &exact.results[case.function];
            let condition = condition(&exact.results["matrices"][JACOBIAN..JACOBIAN + MATRIX]);
            let single = scale > 1.0;
            let (size, tolerance) = match (case.function, single) {
                ("matrices", false) => (MATRIX, MATRIX_TOLERANCE),
                ("matrices", true) => (MATRIX, SINGLE_EPSILONS * epsilon),
                (_, false) => (expected.len(), SOLUTION_TOLERANCE * condition),
                (_, true) => (expected.len(), SINGLE_EPSILONS * epsilon * condition),
            };
            for (found, expected) in found.chunks(size).zip(expected.chunks(size)) {
                let error = relative_error(found, expected);
                if error / tolerance > worst.error / worst.tolerance {
                    worst = Accuracy { case, error, tolerance };
                }
            }
        }
        self.found.push(worst);
    }

    /// Adds a model in single precision.
    fn single<M>(&mut self, model: &M, implementation: &'static str, states: &States)
    where
        M: InverseDynamics<f32> + ForwardDynamics<f32> + Matrices<f32>,
    {
        let narrow: Vec<(usize, Inputs<f32>)> = (0..self.exact.cases.len())
            .filter(|&index| self.exact.cases[index].single)
            .map(|index| (index, states.inputs[index].narrowed()))
            .collect();
        for function in FUNCTIONS {
            let case = Case { function, implementation, variant: "f32" };
            let is_judged = |index: usize| {
                let jacobian = &self.exact.cases[index].results["matrices"][JACOBIAN..JACOBIAN + MATRIX];
                function != "matrices" || least_alignment(jacobian) >= LEAST_ALIGNMENT_IN_SINGLE
            };
            let results = narrow.iter().filter(|(index, _)| is_judged(*index)).map(|(index, state)| {
                let mut values = Vec::new();
                match function {
                    "inverse_dynamics" => {
                        let mut output = [0.0; 6];
                        crate::cases::inverse_dynamics(model, state, &mut output);
                        values.extend(output.map(f64::from));
                    }
                    "forward_dynamics" => {
                        let mut output = [0.0; 6];
                        crate::cases::forward_dynamics(model, state, &mut output);
                        values.extend(output.map(f64::from));
                    }
                    _ => {
                        let mut output = [[[0.0; 6]; 6]; 6];
                        crate::cases::matrices(model, state, &mut output);
                        values.extend(output.as_flattened().as_flattened().iter().map(|&x| f64::from(x)));
                    }
                }
                (*index, values)
            });
            let results: Vec<_> = results.collect();
            self.add(case, f64::from(f32::EPSILON), results.into_iter());
        }
    }
}

impl Visitor for Judge<'_> {
    fn visit<C: Call>(&mut self, case: Case, states: &[C::State; COUNT], mut call: C) {
        // Code with other formulas than the graph's answers differently to a rotation that is one to eight digits only.
        let of_the_graph =
            case.implementation.starts_with("generated") || case.implementation == "casadi_c_same";
        let count = self.exact.cases.len();
        let results: Vec<_> = (0..count)
            .filter(|&index| of_the_graph || !self.exact.cases[index].single)
            .map(|index| {
                let mut values = Vec::new();
                call.call(&states[index], |output| output.read(&mut values));
                (index, values)
            })
            .collect();
        self.add(case, f64::EPSILON, results.into_iter());
    }
}

/// Largest difference over the largest expected number; infinite where a number is missing or none.
fn relative_error(found: &[f64], expected: &[f64]) -> f64 {
    let largest = expected.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let difference = |(x, y): (&f64, &f64)| if (x - y).is_nan() { f64::INFINITY } else { (x - y).abs() };
    let most = found.iter().zip(expected).map(difference).fold(0.0, f64::max);
    match (found.len() == expected.len(), most == 0.0) {
        (false, _) => f64::INFINITY,
        // At rest the Coriolis matrices are zero, exactly.
        (true, true) => 0.0,
        (true, false) => most / largest,
    }
}

/// Condition of a row-major 6 x 6 matrix in the spectral norm.
fn condition(numbers: &[f64]) -> f64 {
    let values = SMatrix::<f64, 6, 6>::from_row_slice(numbers).singular_values();
    values.max() / values.min()
}

/// The least u.a of all legs, from J_dp whose rows begin with u/(u.a), equation (32).
fn least_alignment(jacobian_dp: &[f64]) -> f64 {
    let stretch = |row: &[f64]| row[..3].iter().map(|x| x * x).sum::<f64>().sqrt();
    1.0 / jacobian_dp.chunks(6).map(stretch).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::states::platform;

    #[test]
    fn generated_code_rounds_no_more_than_promised() {
        let platform = platform();
        let found = Exact::read(&Exact::committed(), &platform).unwrap().judge(&platform);
        assert!(found.iter().any(|row| row.case.variant == "f32"));
        let beyond: Vec<Accuracy> = found
            .into_iter()
            .filter(|row| row.case.implementation.starts_with("generated"))
            .filter(|row| !row.holds())
            .collect();
        assert!(beyond.is_empty(), "{}", text(&beyond));
    }

    #[test]
    fn exact_states_reach_to_the_edge_of_what_is_promised() {
        let exact = Exact::read(&Exact::committed(), &platform()).unwrap();
        let alignments: Vec<(bool, f64)> = exact
            .cases
            .iter()
            .map(|case| {
                (case.single, least_alignment(&case.results["matrices"][JACOBIAN..JACOBIAN + MATRIX]))
            })
            .collect();
        assert!(alignments.iter().all(|(_, alignment)| *alignment > 0.1), "{alignments:?}");
        for single in [false, true] {
            let near = |(of, alignment): &&(bool, f64)| *of == single && *alignment < 0.2;
            assert!(alignments.iter().filter(near).count() >= 2, "{alignments:?}");
        }
    }

    #[test]
    fn results_of_another_platform_are_refused() {
        let other = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/platforms/tilted_axes.toml");
        let other = Platform::from_file(&other).unwrap();
        assert!(Exact::read(&Exact::committed(), &other).is_err_and(|reason| reason.contains("not of")));
    }

    #[test]
    fn what_is_not_a_number_is_no_small_error() {
        assert_eq!(relative_error(&[f64::NAN, 1.0], &[1.0, 1.0]), f64::INFINITY);
        assert_eq!(relative_error(&[1.0], &[1.0, 1.0]), f64::INFINITY);
        assert_eq!(relative_error(&[1.5, 2.0], &[1.0, 2.0]), 0.25);
        assert_eq!(relative_error(&[0.0], &[0.0]), 0.0);
    }
}
