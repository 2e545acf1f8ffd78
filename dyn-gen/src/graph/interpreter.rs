//! Evaluation of graphs in double precision: the meaning that every pass has to keep.

use std::collections::BTreeMap;

use super::{Graph, Node, Rounding, SolveKind, Symbol};

/// Named arrays, flat and row-major.
pub type Environment = BTreeMap<String, Vec<f64>>;

/// An array that a graph needs is missing or has the wrong size.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error, miette::Diagnostic)]
#[error("{function}: input `{input}` needs {expected} numbers, got {got}")]
#[diagnostic(help("give every input of the function as a flat row-major array"))]
pub struct EvaluationError {
    /// The function or graph evaluated.
    pub function: String,
    /// The input.
    pub input: String,
    /// Its number of elements.
    pub expected: usize,
    /// The number of elements given (0: missing).
    pub got: usize,
}

/// The array called like `symbol` in `environment`, of the right size.
pub(super) fn lookup<'a>(
    function: &str,
    symbol: &Symbol,
    environment: &'a Environment,
) -> Result<&'a [f64], EvaluationError> {
    let values = environment.get(&symbol.name).map_or(&[][..], Vec::as_slice);
    if values.len() == symbol.len() {
        return Ok(values);
    }
    Err(EvaluationError {
        function: function.to_owned(),
        input: symbol.name.clone(),
        expected: symbol.len(),
        got: values.len(),
    })
}

/// Evaluates graphs one after another without allocating once its buffers have grown.
#[derive(Default)]
pub struct Evaluator {
    rounding: Rounding,
    values: Vec<f64>,
    /// Solutions of all solves, one after the other; each is filled when its first element is met.
    solutions: Vec<f64>,
    /// Where each solve's solution starts, `usize::MAX` while it is unsolved.
    solved_at: Vec<usize>,
    matrix: Vec<f64>,
    pivots: Vec<usize>,
}

impl Evaluator {
    /// An evaluator with empty buffers that rounds products before it adds.
    pub fn new() -> Evaluator {
        Evaluator::default()
    }

    /// An evaluator with empty buffers that rounds as told.
    pub fn with_rounding(rounding: Rounding) -> Evaluator {
        Evaluator { rounding, ..Evaluator::default() }
    }

    /// Gives every node of `graph` its value and returns them all; `inputs[k]` are the elements of `graph.inputs[k]`.
    ///
    /// # Panics
    /// If an input has too few elements, the graph breaks its invariants, or it has lanes ([`unpack`](crate::pack::unpack) it).
    pub fn run(&mut self, graph: &Graph, inputs: &[&[f64]]) -> &[f64] {
        self.values.clear();
        self.values.reserve(graph.nodes.len());
        self.solutions.clear();
        self.solved_at.clear();
        self.solved_at.resize(graph.solves.len(), usize::MAX);
        for node in &graph.nodes {
            let value = match *node {
                Node::Constant(value) => value,
                Node::Input { input, element } => inputs[input as usize][element as usize],
                Node::Unary(op, a) => op.apply(self.rounding, self.values[a.index()], 0.0, 0.0),
                Node::Binary(op, a, b) => {
                    op.apply(self.rounding, self.values[a.index()], self.values[b.index()], 0.0)
                }
                Node::Ternary(op, a, b, c) => {
                    let [a, b, c] = [a, b, c].map(|operand| self.values[operand.index()]);
                    op.apply(self.rounding, a, b, c)
                }
                Node::Lanes(_) | Node::Lane(..) => {
                    panic!("graphs in lanes are unpacked before they are evaluated")
                }
                Node::Solution { solve, element } => {
                    if self.solved_at[solve as usize] == usize::MAX {
                        self.solve(graph, solve as usize);
                    }
                    self.solutions[self.solved_at[solve as usize] + element as usize]
                }
            };
            self.values.push(value);
        }
        &self.values
    }

    fn solve(&mut self, graph: &Graph, index: usize) {
        let solve = &graph.solves[index];
        let start = self.solutions.len();
        self.solved_at[index] = start;
        self.matrix.clear();
        self.matrix.extend(solve.matrix.iter().map(|id| self.values[id.index()]));
        self.solutions.extend(solve.right_hand_side.iter().map(|id| self.values[id.index()]));
        let x = &mut self.solutions[start..];
        let attempt: Vec<f64> = solve.attempt.iter().map(|id| self.values[id.index()]).collect();
        match solve.kind {
            _ if is_solved_by(&attempt, &self.matrix, x) => x.copy_from_slice(&attempt),
            SolveKind::General => solve_general(&mut self.matrix, x, &mut self.pivots),
            SolveKind::SymmetricPositiveDefinite => solve_symmetric(&mut self.matrix, x),
        }
    }
}

impl Graph {
    /// The outputs for named inputs, products rounded before they are added.
    pub fn evaluate(&self, environment: &Environment) -> Result<Environment, EvaluationError> {
        self.evaluate_with(Rounding::Separate, environment)
    }

    /// The outputs for named inputs.
    pub fn evaluate_with(
        &self,
        rounding: Rounding,
        environment: &Environment,
    ) -> Result<Environment, EvaluationError> {
        let inputs = self
            .inputs
            .iter()
            .map(|symbol| lookup(&self.name, symbol, environment))
            .collect::<Result<Vec<_>, _>>()?;
        let mut evaluator = Evaluator::with_rounding(rounding);
        let values = evaluator.run(self, &inputs);
        let outputs = self.outputs.iter().map(|output| {
            (output.symbol.name.clone(), output.nodes.iter().map(|id| values[id.index()]).collect())
        });
        Ok(outputs.collect())
    }
}

/// Largest residual of an attempt, over the root of the sum of its squared terms: as `dyn_runtime::solve` has it.
const MOST_RESIDUAL: f64 = 32.0 * f64::EPSILON;

/// Whether `attempt` is the solution of `matrix * x = b` (n x n, row-major) but for an error that a change of each row of the
/// matrix by a few units in the last place explains. Not if it is empty.
pub fn is_solved_by(attempt: &[f64], matrix: &[f64], b: &[f64]) -> bool {
    let is_satisfied = |(row, b): (&[f64], &f64)| {
        let terms = row.iter().zip(attempt).map(|(a, x)| a * x);
        let (sum, squares) =
            terms.fold((0.0, 0.0), |(sum, squares), term| (sum + term, squares + term * term));
        squares.is_finite() && (sum - b) * (sum - b) < MOST_RESIDUAL * MOST_RESIDUAL * squares
    };
    !attempt.is_empty() && matrix.chunks(attempt.len()).zip(b).all(is_satisfied)
}

/// Solves `matrix * x = b` by Gaussian elimination with complete pivoting; `b` enters in `x` and `matrix` (n x n, row-major)
/// is overwritten. A singular matrix gives infinities or NaN.
pub fn solve_general(matrix: &mut [f64], x: &mut [f64], columns: &mut Vec<usize>) {
    let n = x.len();
    columns.clear();
    columns.extend(0..n);
    for k in 0..n {
        let (mut row, mut column) = (k, k);
        for i in k..n {
            for j in k..n {
                if matrix[i * n + j].abs() > matrix[row * n + column].abs() {
                    (row, column) = (i, j);
                }
            }
        }
        for j in 0..n {
            matrix.swap(k * n + j, row * n + j);
        }
        x.swap(k, row);
        for i in 0..n {
            matrix.swap(i * n + k, i * n + column);
        }
        columns.swap(k, column);
        for i in k + 1..n {
            let factor = matrix[i * n + k] / matrix[k * n + k];
            for j in k + 1..n {
                matrix[i * n + j] -= factor * matrix[k * n + j];
            }
            x[i] -= factor * x[k];
        }
    }
    for k in (0..n).rev() {
        for j in k + 1..n {
            x[k] -= matrix[k * n + j] * x[j];
        }
        x[k] /= matrix[k * n + k];
    }
    // Undo the column exchanges: x[k] belongs at columns[k].
    for k in 0..n {
        while columns[k] != k {
            let target = columns[k];
            x.swap(k, target);
            columns.swap(k, target);
        }
    }
}

/// Solves `matrix * x = b` for a symmetric positive definite matrix by L D L^T; `b` enters in `x`, and `matrix` (n x n,
/// row-major, lower triangle read) is overwritten.
pub fn solve_symmetric(matrix: &mut [f64], x: &mut [f64]) {
    let n = x.len();
    for j in 0..n {
        for k in 0..j {
            // The part above the diagonal keeps L D, so that each product is formed once.
            matrix[j * n + j] -= matrix[j * n + k] * matrix[k * n + j];
        }
        for i in j + 1..n {
            for k in 0..j {
                matrix[i * n + j] -= matrix[i * n + k] * matrix[k * n + j];
            }
            matrix[j * n + i] = matrix[i * n + j];
        }
        for i in j + 1..n {
            matrix[i * n + j] /= matrix[j * n + j];
        }
    }
    for i in 0..n {
        for k in 0..i {
            x[i] -= matrix[i * n + k] * x[k];
        }
    }
    for i in (0..n).rev() {
        x[i] /= matrix[i * n + i];
        for k in i + 1..n {
            x[i] -= matrix[k * n + i] * x[k];
        }
    }
}
