//! Passes on the committed functions: what they keep, the order of pivots, the number of operations.

mod common;

use common::{STATES, run};
use dyn_gen::graph::{Environment, Evaluator};
use dyn_gen::passes::{Context, Exactness, PASSES, run_passes};
use dyn_gen::{Numbers, optimise, sampled_states};

#[test]
fn passes_keep_the_committed_functions() {
    let program = common::program();
    let platform = common::platform();
    let parameters = common::parameters(&program, &platform);
    let states = sampled_states(&program, &platform, &STATES, 7).unwrap();
    // Other states than those from which the pivot order is chosen.
    let compared_at = sampled_states(&program, &platform, &STATES, 8).unwrap();
    let contexts = [
        Context { parameters: parameters.clone(), states: states.clone(), ..Context::default() },
        Context { parameters: Environment::new(), states: states.clone(), ..Context::default() },
    ];
    for (function, context) in
        program.functions.iter().flat_map(|f| contexts.iter().map(move |context| (f, context)))
    {
        let flat = program.flatten(function);
        let mut graph = flat.clone();
        for pass in &PASSES {
            let after = run(pass, &graph, context);
            for state in compared_at.iter().step_by(8) {
                let mut environment = state.clone();
                environment.extend(parameters.clone());
                let (before, after) =
                    (graph.evaluate(&environment).unwrap(), after.evaluate(&environment).unwrap());
                let tolerance = if pass.exactness == Exactness::Exact { 0.0 } else { 1e-12 };
                for (name, values) in &before {
                    let scale = values.iter().fold(0.0_f64, |scale, value| scale.max(value.abs()));
                    for (x, y) in values.iter().zip(&after[name]) {
                        let deviation = (x - y).abs();
                        assert!(
                            deviation <= tolerance * scale,
                            "{} changed {name} of {} by {deviation:e} of {scale:e}",
                            pass.name,
                            function.name
                        );
                    }
                }
            }
            graph = after;
        }
    }
}

/// Largest entry of |L| |U| for a fixed order, by its definition, over the largest of the matrix scaled by rows and columns.
fn growth(mut a: Vec<f64>, n: usize, rows: &[usize], columns: &[usize]) -> f64 {
    for i in 0..n {
        let largest = (0..n).fold(0.0_f64, |largest, j| largest.max(a[i * n + j].abs()));
        (0..n).for_each(|j| a[i * n + j] /= largest);
    }
    for j in 0..n {
        let largest = (0..n).fold(0.0_f64, |largest, i| largest.max(a[i * n + j].abs()));
        (0..n).for_each(|i| a[i * n + j] /= largest);
    }
    let at = |i: usize, j: usize| rows[i] * n + columns[j];
    let (mut lower, mut upper) = (vec![0.0; n * n], vec![0.0; n * n]);
    for i in 0..n {
        for j in 0..n {
            let sum: f64 = (0..i.min(j)).map(|k| lower[i * n + k] * upper[k * n + j]).sum();
            let rest = a[at(i, j)] - sum;
            if i > j {
                lower[i * n + j] = rest / upper[j * n + j];
            } else {
                upper[i * n + j] = rest;
            }
        }
        lower[i * n + i] = 1.0;
    }
    let product =
        |i: usize, j: usize| (0..n).map(|k| (lower[i * n + k] * upper[k * n + j]).abs()).sum::<f64>();
    (0..n * n).map(|k| product(k / n, k % n)).fold(0.0, f64::max)
}

#[test]
fn the_pivot_order_of_the_default_platform_hardly_grows() {
    let program = common::program();
    let platform = common::platform();
    let parameters = common::parameters(&program, &platform);
    let states = sampled_states(&program, &platform, &STATES, 1).unwrap();
    let flat = program.flatten(program.function("inverse_dynamics").unwrap());
    let (graph, reports) = run_passes(
        &flat,
        &Context { parameters: parameters.clone(), states: states.clone(), ..Context::default() },
    );
    assert!(graph.solves.is_empty());
    let orders = reports.iter().flat_map(|report| &report.pivot_orders).collect::<Vec<_>>();
    let [order] = orders[..] else { panic!("one general solve, got {orders:?}") };
    assert_eq!(order.states, states.len());

    let worst = |rows: &[usize], columns: &[usize]| {
        let mut evaluator = Evaluator::new();
        let growths = states.iter().map(|state| {
            let inputs = flat
                .inputs
                .iter()
                .map(|symbol| state.get(&symbol.name).unwrap_or_else(|| &parameters[&symbol.name]));
            let values = evaluator.run(&flat, &inputs.map(Vec::as_slice).collect::<Vec<_>>());
            let matrix = flat.solves[0].matrix.iter().map(|id| values[id.index()]).collect();
            growth(matrix, 6, rows, columns)
        });
        growths.fold(0.0, f64::max)
    };
    let recomputed = worst(&order.rows, &order.columns);
    assert!((recomputed / order.growth - 1.0).abs() < 1e-9, "{order:?}, recomputed {recomputed}");
    assert!(order.growth < 20.0 && order.growth < 4.0 * order.growth_of_complete_pivoting, "{order:?}");
    // Not every order would do.
    let natural = [0, 1, 2, 3, 4, 5];
    let natural = worst(&natural, &natural);
    assert!(natural > 10.0 * order.growth, "natural order: {natural}");
}

#[test]
fn a_general_solve_that_depends_on_parameters_is_left_to_run_time() {
    let program = common::program();
    let platform = common::platform();
    let states = sampled_states(&program, &platform, &STATES, 1).unwrap();
    let graph = program.flatten(program.function("inverse_dynamics").unwrap());
    let (graph, _) =
        run_passes(&graph, &Context { parameters: Environment::new(), states, ..Context::default() });
    assert_eq!(graph.operation_count().solves, 1);
}

#[test]
fn eliminations_of_all_platforms_hardly_grow() {
    let program = common::program();
    for platform in common::platforms() {
        let names = program.functions.iter().map(|function| function.name.clone()).collect::<Vec<_>>();
        let functions = optimise(&program, &Numbers::baked(&platform), Some(&names)).unwrap();
        let orders: Vec<_> = functions.iter().flat_map(|function| function.pivot_orders()).collect();
        assert!(!orders.is_empty());
        for order in orders {
            assert!(order.growth < 100.0, "{}: {order:?}", platform.name);
        }
    }
}

#[test]
fn operation_counts_of_the_default_platform() {
    let program = common::program();
    let limits = [("inverse_dynamics", 920), ("forward_dynamics", 1100), ("matrices", 2200)];
    let names = limits.map(|(name, _)| name.to_owned());
    let functions = optimise(&program, &Numbers::baked(&common::platform()), Some(&names)).unwrap();
    for (function, (name, limit)) in functions.iter().zip(limits) {
        let count = function.graph.operation_count();
        assert_eq!(function.graph.name, name);
        assert!(count.solves == 0 && count.total() <= limit, "{name}: {count}, limit {limit}");
    }
}
