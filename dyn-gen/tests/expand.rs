//! Linear systems written out by the pass `expand`: what they give satisfies the system within the bound for elimination in a
//! fixed order.

mod common;

use common::random::Source;
use common::text::scalar;
use common::{pass, run};
use dyn_gen::graph::{Builder, Environment, Graph, Output, Solve, SolveKind, Symbol};
use dyn_gen::passes::{Context, PivotOrder, run_passes};

/// A system of `n` equations whose matrix and right-hand side are the states `matrix` and `b`, but for entries that `fixed`
/// gives.
fn system(n: usize, kind: SolveKind, fixed: &[Option<f64>]) -> Graph {
    let symbol = |name: &str, shape: &[usize]| Symbol { shape: shape.into(), ..scalar(name, false) };
    let mut builder = Builder::new();
    let matrix = (0..n * n).map(|k| match fixed[k] {
        Some(value) => builder.constant(value),
        None => builder.input(0, k as u32),
    });
    let matrix = matrix.collect();
    let right_hand_side = (0..n).map(|k| builder.input(1, k as u32)).collect();
    let solve = builder.solve(Solve { name: "x".to_owned(), kind, matrix, right_hand_side, attempt: vec![] });
    let nodes = (0..n).map(|k| builder.solution(solve, k as u32)).collect();
    Graph {
        name: "system".to_owned(),
        inputs: vec![symbol("matrix", &[n, n]), symbol("b", &[n])],
        outputs: vec![Output { symbol: symbol("x", &[n]), nodes }],
        ..builder.into_graph()
    }
}

fn state(matrix: Vec<f64>, b: Vec<f64>) -> Environment {
    Environment::from([("matrix".to_owned(), matrix), ("b".to_owned(), b)])
}

fn numbers(source: &mut Source, count: usize) -> Vec<f64> {
    (0..count).map(|_| source.number()).collect()
}

/// 0..n in random order.
fn permutation(source: &mut Source, n: usize) -> Vec<usize> {
    let mut order: Vec<usize> = (0..n).collect();
    (1..n).rev().for_each(|k| order.swap(k, source.below(k + 1)));
    order
}

/// Asserts |A x - b| <= (4 n + 8) eps sizes |x|, row by row, where `sizes` (n x n) bounds |L| |U|: the backward error of
/// elimination is 3 n eps |L| |U| to first order; a reciprocal per pivot and the residual's own rounding add to it.
fn assert_solves(graph: &Graph, state: &Environment, sizes: &[f64], what: &str) {
    let n = state["b"].len();
    let x = graph.evaluate(state).unwrap().remove("x").unwrap();
    for i in 0..n {
        let row = &state["matrix"][i * n..(i + 1) * n];
        let residual = row.iter().zip(&x).map(|(a, x)| a * x).sum::<f64>() - state["b"][i];
        let size: f64 = sizes[i * n..(i + 1) * n].iter().zip(&x).map(|(size, x)| size * x.abs()).sum();
        let bound = (4 * n + 8) as f64 * f64::EPSILON * size;
        assert!(
            residual.abs() <= bound,
            "{what}, row {i}: residual {residual:e}, bound {bound:e}, x = {x:?}"
        );
    }
}

#[test]
fn general_systems_are_solved_in_the_order_that_states_show() {
    let mut source = Source::new(7);
    for n in (1..=6).flat_map(|n| [n; 40]) {
        // Large entries at a random transversal, some of the others constant: zeros, ones, numbers.
        let columns = permutation(&mut source, n);
        let fixed = (0..n * n).map(|k| match (columns[k / n] == k % n, source.below(6)) {
            (false, 0 | 1) => Some(0.0),
            (false, 2) => Some(1.0),
            (false, 3) => Some(-0.4),
            _ => None,
        });
        let fixed: Vec<Option<f64>> = fixed.collect();
        let mut draw = || {
            let entry = |(k, value): (usize, f64)| {
                let large = columns[k / n] == k % n;
                fixed[k].unwrap_or(if large { 4.0 + value } else { 0.5 * value })
            };
            let matrix = numbers(&mut source, n * n).into_iter().enumerate().map(entry).collect();
            state(matrix, numbers(&mut source, n))
        };
        let states: Vec<Environment> = (0..8).map(|_| draw()).collect();
        let graph = system(n, SolveKind::General, &fixed);
        let context =
            Context { parameters: Environment::new(), states: states.clone(), ..Context::default() };
        let mut orders: Vec<PivotOrder> = Vec::new();
        let expanded = (pass("expand").run)(&graph, &context, &mut orders);
        assert!(expanded.solves.is_empty());
        let [order] = &orders[..] else { panic!("one system, got {orders:?}") };
        // Not above what a diagonally dominant matrix can have, as for the order along the transversal.
        assert!(order.growth < 16.0, "{order:?}");
        let (passed, _) = run_passes(&graph, &context);
        for state in &states {
            // |L| |U| <= growth r_i c_j with the scaling of rows and columns by which growth is measured.
            let a = &state["matrix"];
            let largest = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, f64::max);
            let r: Vec<f64> = (0..n).map(|i| largest(&mut (0..n).map(|j| a[i * n + j].abs()))).collect();
            let c: Vec<f64> =
                (0..n).map(|j| largest(&mut (0..n).map(|i| a[i * n + j].abs() / r[i]))).collect();
            let sizes: Vec<f64> = (0..n * n).map(|k| order.growth * r[k / n] * c[k % n]).collect();
            assert_solves(&expanded, state, &sizes, "general, expanded");
            assert_solves(&passed, state, &sizes, "general, all passes");
        }
    }
}

#[test]
fn symmetric_systems_are_solved_from_the_lower_triangle() {
    let mut source = Source::new(8);
    for n in (1..=6).flat_map(|n| [n; 40]) {
        let graph = system(n, SolveKind::SymmetricPositiveDefinite, &vec![None; n * n]);
        let expanded = run(pass("expand"), &graph, &Context::default());
        let (passed, _) = run_passes(&graph, &Context::default());
        assert!(expanded.solves.is_empty() && passed.solves.is_empty());
        // B B^T + 1/2, rows and columns scaled over six powers of ten.
        let b = numbers(&mut source, n * n);
        let scale: Vec<f64> = (0..n).map(|_| 10.0_f64.powi(source.below(7) as i32 - 3)).collect();
        let entry = |k: usize| {
            let (i, j) = (k / n, k % n);
            let product: f64 = (0..n).map(|l| b[i * n + l] * b[j * n + l]).sum();
            scale[i] * scale[j] * (product + if i == j { 0.5 } else { 0.0 })
        };
        let matrix: Vec<f64> = (0..n * n).map(entry).collect();
        // |L| D |L^T| <= sqrt(a_ii a_jj)
        let sizes: Vec<f64> =
            (0..n * n).map(|k| (matrix[k / n * (n + 1)] * matrix[k % n * (n + 1)]).sqrt()).collect();
        let right = numbers(&mut source, n);
        let whole = state(matrix.clone(), right.clone());
        for (graph, what) in [(&expanded, "symmetric, expanded"), (&passed, "symmetric, all passes")] {
            assert_solves(graph, &whole, &sizes, what);
            let lower = (0..n * n).map(|k| if k % n > k / n { f64::NAN } else { matrix[k] }).collect();
            let from_lower = graph.evaluate(&state(lower, right.clone())).unwrap();
            assert_eq!(from_lower, graph.evaluate(&whole).unwrap(), "{what} reads above the diagonal");
        }
    }
}

#[test]
fn singular_states_show_as_infinite_growth() {
    let graph = system(2, SolveKind::General, &[None; 4]);
    for singular in [[1.0, 2.0, 2.0, 4.0], [0.0, 0.0, 1.0, 2.0], [f64::NAN, 1.0, 1.0, 2.0]] {
        let sound = state(vec![1.0, 2.0, 3.0, 4.0], vec![1.0, 1.0]);
        let states = vec![sound, state(singular.into(), vec![1.0, 1.0])];
        let context = Context { parameters: Environment::new(), states, ..Context::default() };
        let mut orders = Vec::new();
        (pass("expand").run)(&graph, &context, &mut orders);
        assert_eq!((orders[0].growth, orders[0].states), (f64::INFINITY, 2), "{singular:?}");
    }
}
