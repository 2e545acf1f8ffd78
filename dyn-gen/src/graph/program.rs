//! What a graph file holds: small graphs, and functions that call them once or over all legs.

use super::interpreter::{Environment, EvaluationError, Evaluator, lookup, solve_general, solve_symmetric};
use super::{Graph, SolveKind, Symbol};
use crate::deviation::{Scale, relative_error};

/// What a symbol is to the functions.
#[derive(Clone, Copy, PartialEq, Eq, Debug, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Role {
    /// A state or load, an argument of generated functions.
    Input,
    /// A physical parameter: baked or held in a struct.
    Parameter,
    /// Passed from step to step.
    Intermediate,
    /// May leave a function (and be passed on).
    Output,
}

/// A symbol of the program.
#[derive(Clone, PartialEq, Debug)]
pub struct Declaration {
    /// The whole array: if `per_leg`, the leg is the first dimension.
    pub symbol: Symbol,
    /// What it is to the functions.
    pub role: Role,
    /// Whether a call over legs takes one leg's slice of it.
    pub per_leg: bool,
}

/// One step of a function.
#[derive(Clone, PartialEq, Debug)]
pub enum Step {
    /// Evaluates a graph.
    Call {
        /// Index into [`Program::graphs`].
        graph: usize,
        /// Once for every leg, in contrast to once.
        over_legs: bool,
    },
    /// Solves a linear system.
    Solve {
        /// Name of the symbol defined.
        solution: String,
        /// Name of the matrix, n x n.
        matrix: String,
        /// Name of the right-hand side, n.
        right_hand_side: String,
        /// What is known of the matrix.
        kind: SolveKind,
    },
}

/// A row of the derivation's table of functions.
#[derive(Clone, PartialEq, Debug)]
pub struct Function {
    /// Its noun.
    pub name: String,
    /// What it computes, one line.
    pub meaning: String,
    /// Equation number(s) in the source.
    pub equation: String,
    /// Symbols of role input, in signature order.
    pub inputs: Vec<String>,
    /// Symbols of role output, in signature order.
    pub outputs: Vec<String>,
    /// Whether its outputs belong to this leg type; the signature of every other function is the same for all.
    pub leg_specific: bool,
    /// In order of evaluation.
    pub steps: Vec<Step>,
    /// What the derivation computed for [`Program::sample`].
    pub sample_outputs: Environment,
}

/// Where a graph file comes from.
#[derive(Clone, PartialEq, Eq, Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Provenance {
    /// Version of CasADi that derived it.
    pub casadi: String,
    /// SHA-256 of the sources of the derivation, hexadecimal.
    pub derivation_sha256: String,
}

/// A graph file, checked by [`Program::from_json`].
#[derive(Clone, PartialEq, Debug)]
pub struct Program {
    /// Leg type it derives, e.g. `uhp`.
    pub name: String,
    /// Number of legs of the mechanism.
    pub leg_count: usize,
    /// Where it comes from.
    pub provenance: Provenance,
    /// All symbols.
    pub symbols: Vec<Declaration>,
    /// All graphs. In one that is called over legs the inputs and outputs that are per leg have one leg's shape.
    pub graphs: Vec<Graph>,
    /// All functions.
    pub functions: Vec<Function>,
    /// A value for every input and parameter.
    pub sample: Environment,
}

impl Program {
    /// The function called `name`.
    pub fn function(&self, name: &str) -> Option<&Function> {
        self.functions.iter().find(|function| function.name == name)
    }

    /// The symbol called `name`.
    pub fn declaration(&self, name: &str) -> Option<&Declaration> {
        self.symbols.iter().find(|declaration| declaration.symbol.name == name)
    }

    /// Every physical parameter, in the order of the file.
    pub fn parameters(&self) -> impl Iterator<Item = &Symbol> {
        self.symbols
            .iter()
            .filter(|declaration| declaration.role == Role::Parameter)
            .map(|found| &found.symbol)
    }

    /// The parameters that the steps of `function` read, in the order of the file.
    pub fn parameters_of<'a>(&'a self, function: &'a Function) -> impl Iterator<Item = &'a Symbol> {
        self.parameters().filter(|parameter| {
            function.steps.iter().any(|step| match step {
                Step::Call { graph, .. } => {
                    self.graphs[*graph].inputs.iter().any(|input| input.name == parameter.name)
                }
                Step::Solve { matrix, right_hand_side, .. } => {
                    *matrix == parameter.name || *right_hand_side == parameter.name
                }
            })
        })
    }

    pub(super) fn declared(&self, name: &str) -> &Declaration {
        self.declaration(name).unwrap_or_else(|| panic!("a checked program declares `{name}`"))
    }

    /// Evaluates `function` step by step, reading its inputs and parameters from `environment`, and returns every symbol that
    /// its steps define (outputs and intermediates).
    ///
    /// This is the oracle of [`flatten`](Self::flatten): no expression is shared between steps or legs.
    pub fn evaluate(
        &self,
        function: &Function,
        environment: &Environment,
    ) -> Result<Environment, EvaluationError> {
        let mut known = Environment::new();
        for name in &function.inputs {
            let symbol = &self.declared(name).symbol;
            known.insert(name.clone(), lookup(&function.name, symbol, environment)?.to_vec());
        }
        for symbol in self.parameters_of(function) {
            known.insert(symbol.name.clone(), lookup(&function.name, symbol, environment)?.to_vec());
        }
        let given = known.keys().cloned().collect::<Vec<_>>();
        let mut evaluator = Evaluator::new();
        for step in &function.steps {
            match step {
                Step::Call { graph, over_legs } => {
                    self.call(&self.graphs[*graph], *over_legs, &mut known, &mut evaluator);
                }
                Step::Solve { solution, matrix, right_hand_side, kind } => {
                    let mut matrix = known[matrix].clone();
                    let mut x = known[right_hand_side].clone();
                    match kind {
                        SolveKind::General => solve_general(&mut matrix, &mut x, &mut Vec::new()),
                        SolveKind::SymmetricPositiveDefinite => solve_symmetric(&mut matrix, &mut x),
                    }
                    known.insert(solution.clone(), x);
                }
            }
        }
        given.iter().for_each(|name| drop(known.remove(name)));
        Ok(known)
    }

    fn call(&self, graph: &Graph, over_legs: bool, known: &mut Environment, evaluator: &mut Evaluator) {
        let calls = if over_legs { self.leg_count } else { 1 };
        let mut results = vec![Vec::new(); graph.outputs.len()];
        for leg in 0..calls {
            let inputs = graph.inputs.iter().map(|symbol| {
                let values = &known[&symbol.name];
                let slice = over_legs && self.declared(&symbol.name).per_leg;
                if slice { &values[leg * symbol.len()..(leg + 1) * symbol.len()] } else { &values[..] }
            });
            let values = evaluator.run(graph, &inputs.collect::<Vec<_>>());
            for (output, result) in graph.outputs.iter().zip(&mut results) {
                result.extend(output.nodes.iter().map(|id| values[id.index()]));
            }
        }
        for (output, result) in graph.outputs.iter().zip(results) {
            known.insert(output.symbol.name.clone(), result);
        }
    }

    /// Evaluates every function at the sample and returns the largest deviation from the derivation's own outputs, relative
    /// to the largest entry of each array, with the function and output where it occurs.
    pub fn check_samples(&self) -> Result<(f64, String), EvaluationError> {
        let mut worst = (0.0, String::new());
        for function in &self.functions {
            let values = self.evaluate(function, &self.sample)?;
            for (name, expected) in &function.sample_outputs {
                let relative = relative_error(&values[name], expected, Scale::own());
                if relative > worst.0 || relative.is_nan() {
                    worst = (relative, format!("{}, {name}", function.name));
                }
            }
        }
        Ok(worst)
    }
}
