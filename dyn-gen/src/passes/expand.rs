//! Writes linear systems out as arithmetic.

use super::Context;
use super::blocks::{EVERY_OTHER, attempted};
use super::pivot::{PivotOrder, choose_order};
use super::rewrite::Images;
use super::share::{Algebra, shared};
use crate::graph::{Builder, Environment, Evaluator, Graph, Node, NodeId, Solve, SolveKind};

/// Expands symmetric positive definite solves, stable in any order, and general ones whose matrix depends on no parameter, in
/// the pivot order of least growth over `context.states`. Any other general solve of six equations gets an attempt in blocks,
/// and is left with it for pivoting at run time.
pub fn expand(graph: &Graph, context: &Context, orders: &mut Vec<PivotOrder>) -> Graph {
    if graph.solves.is_empty() {
        return graph.clone();
    }
    let mut builder = Builder::with_sections_of(graph);
    let mut images = Images::new(graph);
    let mut solutions: Vec<Option<Vec<NodeId>>> = vec![None; graph.solves.len()];
    for (index, live) in graph.live().into_iter().enumerate() {
        if !live {
            continue;
        }
        builder.enter_section_index(graph.section_of[index]);
        let image = match graph.nodes[index] {
            Node::Solution { solve, element } => {
                let solution = &mut solutions[solve as usize];
                let solution = solution.get_or_insert_with(|| {
                    expanded(graph, &graph.solves[solve as usize], context, &images, &mut builder, orders)
                });
                solution[element as usize]
            }
            node => {
                let node = images.node(graph, &mut builder, node);
                shared(&mut builder, node)
            }
        };
        images.set(index, image);
    }
    let outputs = images.outputs(graph);
    builder.finish(graph, outputs)
}

/// The nodes of the solution, expanded if possible.
fn expanded(
    graph: &Graph,
    old: &Solve,
    context: &Context,
    images: &Images,
    builder: &mut Builder,
    orders: &mut Vec<PivotOrder>,
) -> Vec<NodeId> {
    let solve = images.solve(old);
    match solve.kind {
        SolveKind::SymmetricPositiveDefinite => symmetric(builder, solve),
        SolveKind::General => match order_for(graph, old, &solve, context, builder) {
            Some(order) => {
                let solution = general(builder, solve, &order);
                orders.push(order);
                solution
            }
            None if solve.right_hand_side.len() == EVERY_OTHER.len() => {
                attempted(builder, solve, &EVERY_OTHER).0
            }
            None => {
                let n = solve.right_hand_side.len() as u32;
                let index = builder.solve(solve);
                (0..n).map(|element| builder.solution(index, element)).collect()
            }
        },
    }
}

/// The pivot order for a general solve, if there is evidence for one that holds for the model.
fn order_for(
    graph: &Graph,
    old: &Solve,
    solve: &Solve,
    context: &Context,
    builder: &Builder,
) -> Option<PivotOrder> {
    if depends_on_parameters(graph, old, context) {
        return None;
    }
    let n = solve.right_hand_side.len();
    let constant = |row: usize, column: usize| builder.constant_value(solve.matrix[row * n + column]);
    choose_order(&old.name, n, &sampled_matrices(graph, old, context), &constant)
}

/// Whether a parameter that is not baked in reaches the matrix.
pub(crate) fn depends_on_parameters(graph: &Graph, solve: &Solve, context: &Context) -> bool {
    let mut needed = vec![false; graph.nodes.len()];
    solve.matrix.iter().for_each(|id| needed[id.index()] = true);
    graph.mark_needed(&mut needed);
    let at_run_time = |node: &Node| match *node {
        Node::Input { input, .. } => {
            let symbol = &graph.inputs[input as usize];
            symbol.parameter && !context.parameters.contains_key(&symbol.name)
        }
        _ => false,
    };
    graph.nodes.iter().zip(needed).any(|(node, needed)| needed && at_run_time(node))
}

/// The matrix at every sampled state, row-major. Parameters have the platform's values, if they are known.
pub(crate) fn sampled_matrices(graph: &Graph, solve: &Solve, context: &Context) -> Vec<Vec<f64>> {
    let mut evaluator = Evaluator::new();
    let zeros = graph.inputs.iter().map(|symbol| vec![0.0; symbol.len()]).collect::<Vec<_>>();
    let sample = |state: &Environment| {
        let inputs = graph.inputs.iter().zip(&zeros).map(|(symbol, zeros)| {
            let known = context.parameters.get(&symbol.name).or_else(|| state.get(&symbol.name));
            // What the matrix does not depend on may be missing.
            known.filter(|values| values.len() == symbol.len()).unwrap_or(zeros).as_slice()
        });
        let values = evaluator.run(graph, &inputs.collect::<Vec<_>>());
        solve.matrix.iter().map(|node| values[node.index()]).collect()
    };
    context.states.iter().map(sample).collect()
}

/// Gaussian elimination in a fixed order, one reciprocal per pivot.
fn general(builder: &mut Builder, solve: Solve, order: &PivotOrder) -> Vec<NodeId> {
    let Solve { mut matrix, right_hand_side: mut b, .. } = solve;
    let n = b.len();
    let (rows, columns) = (&order.rows, &order.columns);
    let mut reciprocals = Vec::with_capacity(n);
    for k in 0..n {
        let pivot_row = rows[k] * n;
        let reciprocal = builder.reciprocal(matrix[pivot_row + columns[k]]);
        reciprocals.push(reciprocal);
        for &row in &rows[k + 1..] {
            let factor = builder.mul(matrix[row * n + columns[k]], reciprocal);
            for &column in &columns[k + 1..] {
                let change = builder.mul(factor, matrix[pivot_row + column]);
                matrix[row * n + column] = builder.sub(matrix[row * n + column], change);
            }
            let change = builder.mul(factor, b[rows[k]]);
            b[row] = builder.sub(b[row], change);
        }
    }
    let mut x = b.clone();
    for k in (0..n).rev() {
        let mut remainder = b[rows[k]];
        for &column in &columns[k + 1..] {
            let known = builder.mul(matrix[rows[k] * n + column], x[column]);
            remainder = builder.sub(remainder, known);
        }
        x[columns[k]] = builder.mul(remainder, reciprocals[k]);
    }
    x
}

/// L D L^T of the lower triangle.
fn symmetric(builder: &mut Builder, solve: Solve) -> Vec<NodeId> {
    let Solve { mut matrix, right_hand_side: mut x, .. } = solve;
    let n = x.len();
    let mut reciprocals = Vec::with_capacity(n);
    for k in 0..n {
        let reciprocal = builder.reciprocal(matrix[k * n + k]);
        reciprocals.push(reciprocal);
        let column = (k + 1..n).map(|row| matrix[row * n + k]).collect::<Vec<_>>();
        for row in k + 1..n {
            let factor = builder.mul(column[row - k - 1], reciprocal);
            for inner in k + 1..=row {
                let change = builder.mul(factor, column[inner - k - 1]);
                matrix[row * n + inner] = builder.sub(matrix[row * n + inner], change);
            }
            let change = builder.mul(factor, x[k]);
            x[row] = builder.sub(x[row], change);
            matrix[row * n + k] = factor;
        }
    }
    for k in (0..n).rev() {
        let mut remainder = builder.mul(x[k], reciprocals[k]);
        for row in k + 1..n {
            let known = builder.mul(matrix[row * n + k], x[row]);
            remainder = builder.sub(remainder, known);
        }
        x[k] = remainder;
    }
    x
}
