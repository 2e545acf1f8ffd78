//! Evaluation of graphs at several states at a time, by values or by values with their rates.

use std::collections::BTreeMap;

use super::interpreter::{Environment, is_solved_by, solve_general, solve_symmetric};
use super::{Graph, Node, NodeId, Op, Output, Solve, SolveKind};

/// States evaluated at a time.
pub const LANES: usize = 8;

/// What a graph can be evaluated in.
pub trait Number: Copy {
    /// The same number in every lane, at rest.
    fn constant(value: f64) -> Self;
    /// The operation on these operands, as many as it has count; products are rounded before they are added.
    fn apply(op: Op, a: Self, b: Self, c: Self) -> Self;
    /// The solution of a linear system, row-major, lane by lane.
    fn solve(kind: SolveKind, matrix: &[Self], right_hand_side: &[Self], attempt: &[Self]) -> Vec<Self>;
}

/// A value in every lane: the bits of [`Op::apply`] with products rounded separately.
pub type Values = [f64; LANES];

impl Number for Values {
    fn constant(value: f64) -> Values {
        [value; LANES]
    }

    #[inline]
    fn apply(op: Op, a: Values, b: Values, c: Values) -> Values {
        // The operation is chosen once for all lanes.
        match op {
            Op::Neg => a.map(|x| -x),
            Op::Sqrt => a.map(f64::sqrt),
            Op::Add => std::array::from_fn(|lane| a[lane] + b[lane]),
            Op::Sub => std::array::from_fn(|lane| a[lane] - b[lane]),
            Op::Mul => std::array::from_fn(|lane| a[lane] * b[lane]),
            Op::Div => std::array::from_fn(|lane| a[lane] / b[lane]),
            Op::MulAdd => std::array::from_fn(|lane| a[lane] * b[lane] + c[lane]),
            Op::MulSub => std::array::from_fn(|lane| a[lane] * b[lane] - c[lane]),
            Op::NegMulAdd => std::array::from_fn(|lane| c[lane] - a[lane] * b[lane]),
        }
    }

    fn solve(
        kind: SolveKind,
        matrix: &[Values],
        right_hand_side: &[Values],
        attempt: &[Values],
    ) -> Vec<Values> {
        let mut solution = vec![[0.0; LANES]; right_hand_side.len()];
        let mut pivots = Vec::new();
        for lane in 0..LANES {
            let mut matrix: Vec<f64> = matrix.iter().map(|entry| entry[lane]).collect();
            let mut x: Vec<f64> = right_hand_side.iter().map(|entry| entry[lane]).collect();
            let attempt: Vec<f64> = attempt.iter().map(|entry| entry[lane]).collect();
            match kind {
                _ if is_solved_by(&attempt, &matrix, &x) => x = attempt,
                SolveKind::General => solve_general(&mut matrix, &mut x, &mut pivots),
                SolveKind::SymmetricPositiveDefinite => solve_symmetric(&mut matrix, &mut x),
            }
            solution.iter_mut().zip(x).for_each(|(entry, x)| entry[lane] = x);
        }
        solution
    }
}

/// Values with their rates of change, by the rules of differentiation.
#[derive(Clone, Copy, PartialEq, Default, Debug)]
pub struct Rates {
    /// The values.
    pub value: Values,
    /// Their rates.
    pub rate: Values,
}

impl Number for Rates {
    fn constant(value: f64) -> Rates {
        Rates { value: [value; LANES], rate: [0.0; LANES] }
    }

    #[inline]
    fn apply(op: Op, a: Rates, b: Rates, c: Rates) -> Rates {
        let value = Values::apply(op, a.value, b.value, c.value);
        let product =
            || std::array::from_fn(|lane| a.rate[lane] * b.value[lane] + a.value[lane] * b.rate[lane]);
        let rate = match op {
            Op::Neg | Op::Add | Op::Sub => Values::apply(op, a.rate, b.rate, c.rate),
            Op::Sqrt => std::array::from_fn(|lane| 0.5 * a.rate[lane] / value[lane]),
            Op::Mul => product(),
            Op::MulAdd => Values::apply(Op::Add, product(), c.rate, c.rate),
            Op::MulSub => Values::apply(Op::Sub, product(), c.rate, c.rate),
            Op::NegMulAdd => Values::apply(Op::Sub, c.rate, product(), c.rate),
            Op::Div => {
                std::array::from_fn(|lane| (a.rate[lane] - value[lane] * b.rate[lane]) / b.value[lane])
            }
        };
        Rates { value, rate }
    }

    fn solve(kind: SolveKind, matrix: &[Rates], right_hand_side: &[Rates], attempt: &[Rates]) -> Vec<Rates> {
        let n = right_hand_side.len();
        // Of a symmetric system only the lower triangle is read.
        let entry = |row: usize, column: usize| match kind {
            SolveKind::SymmetricPositiveDefinite if row < column => matrix[column * n + row],
            _ => matrix[row * n + column],
        };
        let values: Vec<Values> = matrix.iter().map(|entry| entry.value).collect();
        let right: Vec<Values> = right_hand_side.iter().map(|entry| entry.value).collect();
        let attempt: Vec<Values> = attempt.iter().map(|entry| entry.value).collect();
        let x = Values::solve(kind, &values, &right, &attempt);
        // A x' = b' - A' x
        let mut remainder: Vec<Values> = right_hand_side.iter().map(|entry| entry.rate).collect();
        for (row, remainder) in remainder.iter_mut().enumerate() {
            for (column, x) in x.iter().enumerate() {
                let rate = entry(row, column).rate;
                remainder.iter_mut().zip(rate.iter().zip(x)).for_each(|(sum, (rate, x))| *sum -= rate * x);
            }
        }
        let rates = Values::solve(kind, &values, &remainder, &[]);
        x.into_iter().zip(rates).map(|(value, rate)| Rates { value, rate }).collect()
    }
}

/// Named arrays of up to [`LANES`] states, lane by lane; lanes beyond repeat the last state.
#[derive(Clone, Debug, Default)]
pub struct Batch(BTreeMap<String, Vec<Values>>);

impl Batch {
    /// The arrays that all of these have in the same size.
    pub fn new(environments: &[&Environment]) -> Batch {
        let Some((first, _)) = environments.split_first() else { return Batch::default() };
        let across = |(name, array): (&String, &Vec<f64>)| {
            let arrays = environments.iter().map(|environment| environment.get(name));
            let arrays = arrays.collect::<Option<Vec<_>>>()?;
            if arrays.iter().any(|other| other.len() != array.len()) {
                return None;
            }
            let lane = |lane: usize| arrays[lane.min(arrays.len() - 1)];
            let values = (0..array.len()).map(|element| std::array::from_fn(|k| lane(k)[element]));
            Some((name.clone(), values.collect()))
        };
        Batch(first.iter().filter_map(across).collect())
    }

    /// The elements of an array.
    pub fn get(&self, name: &str) -> Option<&[Values]> {
        self.0.get(name).map(Vec::as_slice)
    }

    /// Sets an array.
    pub fn set(&mut self, name: &str, values: Vec<Values>) {
        self.0.insert(name.to_owned(), values);
    }
}

/// Evaluates graphs one after another in the same memory.
#[derive(Default)]
pub struct LaneEvaluator<N> {
    values: Vec<N>,
}

impl<N: Number> LaneEvaluator<N> {
    /// The outputs of `graph`, one after another, for `inputs[k]`, the elements of `graph.inputs[k]`.
    ///
    /// # Panics
    /// If an input has too few elements or the graph breaks its invariants.
    pub fn run(&mut self, graph: &Graph, inputs: &[&[N]]) -> Vec<Vec<N>> {
        let values = &mut self.values;
        values.clear();
        values.reserve(graph.nodes.len());
        let mut solved: Vec<Option<Vec<N>>> = vec![None; graph.solves.len()];
        let zero = N::constant(0.0);
        for node in &graph.nodes {
            let value = match *node {
                Node::Constant(value) => N::constant(value),
                Node::Input { input, element } => inputs[input as usize][element as usize],
                Node::Unary(op, a) => N::apply(op, values[a.index()], zero, zero),
                Node::Binary(op, a, b) => N::apply(op, values[a.index()], values[b.index()], zero),
                Node::Ternary(op, a, b, c) => {
                    N::apply(op, values[a.index()], values[b.index()], values[c.index()])
                }
                Node::Lanes(_) | Node::Lane(..) => {
                    panic!("graphs in lanes are unpacked before they are evaluated")
                }
                Node::Solution { solve, element } => {
                    let solution = solved[solve as usize]
                        .get_or_insert_with(|| solution(&graph.solves[solve as usize], values));
                    solution[element as usize]
                }
            };
            values.push(value);
        }
        let elements = |output: &Output| output.nodes.iter().map(|id| values[id.index()]).collect();
        graph.outputs.iter().map(elements).collect()
    }
}

fn solution<N: Number>(solve: &Solve, values: &[N]) -> Vec<N> {
    let at = |ids: &[NodeId]| ids.iter().map(|id| values[id.index()]).collect::<Vec<_>>();
    N::solve(solve.kind, &at(&solve.matrix), &at(&solve.right_hand_side), &at(&solve.attempt))
}
