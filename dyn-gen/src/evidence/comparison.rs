//! Optimised graphs beside the graphs as derived and the hand-written dynamics.

use serde::Serialize;

use super::laws::{LAWS, LawRow, Subject};
use super::{Case, EvidenceError};
use crate::deviation::{Scale, larger, relative_error, tolerance};
use crate::generate::GeneratedFunction;
use crate::graph::{Batch, Environment, EvaluationError, Graph, LaneEvaluator, Program, Symbol, Values};
use crate::sample::Kind;

/// How well one output agrees.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Agreement {
    /// The function.
    pub function: String,
    /// The output.
    pub output: String,
    /// Largest deviation from the graph as derived.
    pub unoptimised: Worst,
    /// Largest deviation from the hand-written dynamics.
    pub reference: Worst,
}

impl Agreement {
    /// Whether both are within the tolerance.
    pub fn holds(&self) -> bool {
        self.unoptimised.is_allowed() && self.reference.is_allowed()
    }
}

/// The error that comes nearest to what is allowed, and where it occurs.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub struct Worst {
    /// Relative to the largest entry of the array at that state, or a thousandth of that at all states (of a scalar: all of
    /// that); NaN where a deviation is not a number.
    pub error: f64,
    /// The largest error allowed there.
    pub tolerance: f64,
    /// Number of the state, from 0.
    pub state: usize,
    /// Its kind.
    pub kind: Kind,
}

impl Worst {
    /// No deviation anywhere yet.
    fn none(tolerance: f64) -> Worst {
        Worst { error: 0.0, tolerance, state: 0, kind: Kind::Home }
    }

    /// The worse of both, the earlier one of equals.
    pub(super) fn or(self, other: Worst) -> Worst {
        let same = larger(self.share(), other.share()).to_bits() == self.share().to_bits();
        if same { self } else { other }
    }

    /// The error over what is allowed.
    pub fn share(&self) -> f64 {
        self.error / self.tolerance
    }

    /// Whether the error is within the tolerance; NaN is not.
    pub fn is_allowed(&self) -> bool {
        self.error <= self.tolerance
    }
}

/// By how much the tolerance is larger at states of a kind.
fn allowance(kind: Kind) -> f64 {
    match kind {
        Kind::Home | Kind::Random | Kind::Large => 1.0,
        // A rod at u.a = 0.1 multiplies rounding errors by 1 / (u.a)^2 = 100; one at 0.4, as large states have, by 6.
        Kind::NearEdge => 10.0,
    }
}

/// Names of all outputs, each once.
pub(super) fn output_names(functions: &[GeneratedFunction]) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for output in functions.iter().flat_map(|function| &function.graph.outputs) {
        if !names.contains(&output.symbol.name) {
            names.push(output.symbol.name.clone());
        }
    }
    names
}

/// What is compared with what.
pub(super) struct Comparison<'a> {
    functions: &'a [GeneratedFunction],
    /// As derived, every parameter an input.
    derived: Vec<Graph>,
    /// The hand-written dynamics, state by state.
    expected: &'a [Environment],
    /// By output.
    scales: std::collections::BTreeMap<&'a str, Scale>,
    subject: Subject<'a>,
}

/// Worst deviations: two per output of every function (from the graph as derived, from the reference), one per law.
pub(super) struct Found {
    outputs: Vec<[Worst; 2]>,
    laws: Vec<Option<Worst>>,
}

impl<'a> Comparison<'a> {
    pub(super) fn new(
        program: &Program,
        functions: &'a [GeneratedFunction],
        names: &'a [String],
        expected: &'a [Environment],
    ) -> Comparison<'a> {
        let derived = functions.iter().filter_map(|function| chosen(program, &function.graph)).collect();
        let scale = |name: &'a String| {
            (name.as_str(), Scale::over(expected.iter().map(|values| values[name].as_slice())))
        };
        Comparison {
            functions,
            derived,
            expected,
            scales: names.iter().map(scale).collect(),
            subject: Subject::new(functions.iter().map(|function| &function.graph)),
        }
    }

    /// The cases of one batch, of which the first is state number `first`.
    pub(super) fn examine(&self, batch: &[Case], first: usize) -> Result<Found, EvidenceError> {
        let environments: Vec<&Environment> = batch.iter().map(|case| &case.environment).collect();
        let lanes = Batch::new(&environments);
        let mut evaluator = LaneEvaluator::default();
        let mut outputs = Vec::new();
        let mut results = Vec::new();
        let (mut found_here, mut before_here) = (Vec::new(), Vec::new());
        for (function, derived) in self.functions.iter().zip(&self.derived) {
            let found = evaluate(&function.graph, &lanes, &mut evaluator)?;
            let before = evaluate(derived, &lanes, &mut evaluator)?;
            for ((output, found), before) in function.graph.outputs.iter().zip(&found).zip(&before) {
                let name = output.symbol.name.as_str();
                let scale = self.scales[name];
                let mut worst = [Worst::none(tolerance(name)); 2];
                for (lane, case) in batch.iter().enumerate() {
                    for (here, values) in [(&mut found_here, found), (&mut before_here, before)] {
                        here.clear();
                        here.extend(values.iter().map(|value| value[lane]));
                    }
                    let state = first + lane;
                    for (worst, expected) in worst.iter_mut().zip([&before_here, &self.expected[state][name]])
                    {
                        let error = relative_error(&found_here, expected, scale);
                        let tolerance = tolerance(name) * allowance(case.kind);
                        *worst = worst.or(Worst { error, tolerance, state, kind: case.kind });
                    }
                }
                outputs.push(worst);
            }
            results.push(found);
        }
        let laws = self.subject.examine(batch, first, &lanes, &results)?;
        Ok(Found { outputs, laws })
    }

    /// The worst of all batches, in their order.
    pub(super) fn worst_of(&self, found: Vec<Found>) -> (Vec<Agreement>, Vec<LawRow>) {
        let rows = self.functions.iter().flat_map(|function| {
            function.graph.outputs.iter().map(|output| (&function.graph.name, &output.symbol.name))
        });
        let outputs = rows.enumerate().map(|(row, (function, output))| {
            let worst = |k: usize| {
                found
                    .iter()
                    .map(|found| found.outputs[row][k])
                    .fold(Worst::none(tolerance(output)), Worst::or)
            };
            Agreement {
                function: function.clone(),
                output: output.clone(),
                unoptimised: worst(0),
                reference: worst(1),
            }
        });
        let outputs = outputs.collect();
        let laws = LAWS.iter().enumerate().map(|(row, law)| {
            let worst = found.iter().filter_map(|found| found.laws[row]).reduce(Worst::or);
            LawRow {
                law: law.name,
                functions: self.subject.functions_of(law),
                tolerance: law.tolerance,
                worst,
            }
        });
        (outputs, laws.collect())
    }
}

/// The function as derived, with the outputs that are generated and no more.
fn chosen(program: &Program, generated: &Graph) -> Option<Graph> {
    let mut function = program.function(&generated.name)?.clone();
    let is_generated = |name: &String| generated.outputs.iter().any(|output| output.symbol.name == *name);
    function.outputs.retain(is_generated);
    Some(program.flatten(&function))
}

/// The outputs of a graph at the states of a batch.
pub(super) fn evaluate(
    graph: &Graph,
    batch: &Batch,
    evaluator: &mut LaneEvaluator<Values>,
) -> Result<Vec<Vec<Values>>, EvaluationError> {
    let inputs = graph.inputs.iter().map(|symbol| input(graph, symbol, batch));
    Ok(evaluator.run(graph, &inputs.collect::<Result<Vec<_>, _>>()?))
}

/// The elements of an input of a graph.
pub(super) fn input<'a>(
    graph: &Graph,
    symbol: &Symbol,
    batch: &'a Batch,
) -> Result<&'a [Values], EvaluationError> {
    let values = batch.get(&symbol.name).unwrap_or_default();
    if values.len() == symbol.len() {
        return Ok(values);
    }
    Err(EvaluationError {
        function: graph.name.clone(),
        input: symbol.name.clone(),
        expected: symbol.len(),
        got: values.len(),
    })
}
