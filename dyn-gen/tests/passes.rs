//! Each pass against the interpreter: on small fixtures, on random graphs, and on the committed functions.

mod common;

use common::random::{self, Source, error_bounds};
use common::text::{parse, print};
use dyn_gen::graph::{Environment, Evaluator, Graph, Node};
use dyn_gen::passes::{Context, Exactness, PASSES, Pass, run_passes};
use expect_test::{Expect, expect};

fn pass(name: &str) -> &'static Pass {
    PASSES.iter().find(|pass| pass.name == name).expect("a pass of the table")
}

fn run(pass: &Pass, graph: &Graph, context: &Context) -> Graph {
    (pass.run)(graph, context, &mut Vec::new())
}

fn check(name: &str, before: &str, after: Expect) {
    let parameters = Environment::from([("p".to_owned(), vec![3.0])]);
    let graph = run(pass(name), &parse(before), &Context { parameters, states: Vec::new() });
    after.assert_eq(&print(&graph));
}

#[test]
fn bake_replaces_parameters_and_folds() {
    check(
        "bake",
        "y = p * 2 + x\nz = pq * p",
        expect![[r#"
        y = 6 + x
        z = 3 * pq
    "#]],
    );
    check(
        "bake",
        "y = 1 / (p - 3)",
        expect![[r#"
        y = 1 / 0
    "#]],
    );
}

#[test]
fn simplify_removes_trivial_operands() {
    let before = "a = x * 1 + 0\nb = x * 0\nc = x - x\nd = 0 - x\ne = x / 1\nf = --x\ng = x + x\nh = x / 4\ni = x / -1\nj = 0 / x\n\
                  k = x / 3\nl = (x - 0) * (3 - 2)\nm = x / 0";
    check(
        "simplify",
        before,
        expect![[r#"
        t3 = -x
        a = x
        b = 0
        c = 0
        d = t3
        e = x
        f = x
        g = x * 2
        h = x * 0.25
        i = t3
        j = 0
        k = x / 3
        l = x
        m = x / 0
    "#]],
    );
}

#[test]
fn simplify_moves_signs_outwards() {
    check(
        "simplify",
        "a = x + (-y)\nb = (-x) * y + z\nc = x - (-2) * y\nd = (-x) - y\ne = (-x) / (-y)\nf = sqrt(-(x * -y))",
        expect![[r#"
        t5 = x * y
        a = x - y
        b = z - t5
        c = x + (y * 2)
        d = -(x + y)
        e = x / y
        f = sqrt(t5)
    "#]],
    );
}

#[test]
fn share_gives_differences_one_order() {
    check(
        "share",
        "a = (x - y) * z\nb = z + (y - x)\nc = (y - x) * (x - y)",
        expect![[r#"
        t3 = x - y
        a = t3 * z
        b = -(t3 - z)
        c = -(t3 * t3)
    "#]],
    );
}

#[test]
fn invert_divides_once_by_each_divisor() {
    check(
        "invert",
        "a = x / z\nb = y / z\nc = x / y\nd = x / 5",
        expect![[r#"
        t3 = 1 / z
        a = x * t3
        b = t3 * y
        c = x / y
        d = x * 0.2
    "#]],
    );
}

#[test]
fn merge_forms_common_sums_once() {
    check(
        "merge",
        "a = 3 * x + 3 * y",
        expect![[r#"
        a = 3 * (x + y)
    "#]],
    );
    check(
        "merge",
        "a = x + y + z\nb = w - x - y",
        expect![[r#"
        t5 = x + y
        a = z + t5
        b = -(t5 - w)
    "#]],
    );
    check(
        "merge",
        "a = (2 * x) * 3 + 0.5 * y\nb = z - 6 * x - 0.5 * y",
        expect![[r#"
        t9 = (x * 6) + (0.5 * y)
        a = t9
        b = -(t9 - z)
    "#]],
    );
    check(
        "merge",
        "a = x + y - (x - 2 * y)",
        expect![[r#"
        a = y * 3
    "#]],
    );
}

#[test]
fn settle_lets_differences_and_constants_take_signs() {
    check(
        "settle",
        "a = -(x - y)\nb = -(2 * z)\nc = -((x - w) * (z + 1))\nd = -(x * y)\ne = -((3 + w) / z)",
        expect![[r#"
        a = y - x
        b = z * -2
        c = (z + 1) * (w - x)
        d = -(x * y)
        e = (-3 - w) / z
    "#]],
    );
    // A difference with another use stays as it is.
    check(
        "settle",
        "a = -(x - y)\nb = (x - y) * z",
        expect![[r#"
        t2 = x - y
        a = -t2
        b = t2 * z
    "#]],
    );
}

#[test]
fn prune_drops_what_no_output_needs() {
    let mut graph = parse("a = x + p\nb = y * pz");
    graph.outputs.remove(0);
    let pruned = run(pass("prune"), &graph, &Context::default());
    assert_eq!(print(&pruned), "b = y * pz\n");
    let inputs = pruned.inputs.iter().map(|symbol| symbol.name.as_str()).collect::<Vec<_>>();
    // The unused state `x` stays in the signature, the unused parameter `p` goes.
    assert_eq!(inputs, ["x", "y", "pz"]);
    assert_eq!(pruned.nodes.len(), 3);
}

#[test]
fn expand_writes_a_symmetric_system_out() {
    let mut graph = parse("a = x\nb = y\nc = z\nd = v\ne = w");
    let nodes = graph.outputs.iter().map(|output| output.nodes[0]).collect::<Vec<_>>();
    graph.solves.push(dyn_gen::graph::Solve {
        name: "s".to_owned(),
        kind: dyn_gen::graph::SolveKind::SymmetricPositiveDefinite,
        matrix: vec![nodes[0], nodes[1], nodes[1], nodes[2]],
        right_hand_side: vec![nodes[3], nodes[4]],
    });
    graph.nodes.extend([0, 1].map(|element| Node::Solution { solve: 0, element }));
    graph.section_of.extend([0, 0]);
    graph.outputs.truncate(1);
    graph.outputs[0].nodes = vec![dyn_gen::graph::NodeId(5), dyn_gen::graph::NodeId(6)];
    let expanded = run(pass("expand"), &graph, &Context::default());
    expect![[r#"
        t6 = 1 / x
        t7 = y * t6
        t15 = (w - (v * t7)) * (1 / (z - (y * t7)))
        a = (v * t6) - (t7 * t15), t15
    "#]]
    .assert_eq(&print(&expanded));
}

/// Values of all outputs, signs of zeros removed; none if an intermediate value is not finite.
fn outputs(graph: &Graph, values: &[f64]) -> Option<Vec<u64>> {
    let finite =
        graph.nodes.iter().zip(graph.live()).zip(values).all(|((_, live), value)| !live || value.is_finite());
    let bits =
        graph.outputs.iter().flat_map(|output| &output.nodes).map(|id| (values[id.index()] + 0.0).to_bits());
    finite.then(|| bits.collect())
}

/// Evaluates a random graph with its parameters in place.
fn random_case(seed: u64) -> (Graph, Vec<Vec<f64>>, Environment) {
    let mut source = Source::new(seed);
    let size = 10 + source.below(80);
    let graph = random::graph(&mut source, size);
    let inputs =
        graph.inputs.iter().map(|_| (0..3).map(|_| source.number()).collect::<Vec<_>>()).collect::<Vec<_>>();
    let parameters = [("p".to_owned(), inputs[2].clone()), ("q".to_owned(), inputs[3].clone())];
    (graph, inputs, parameters.into())
}

/// The inputs a pass left, by name.
fn remaining<'a>(graph: &Graph, original: &Graph, inputs: &'a [Vec<f64>]) -> Vec<&'a [f64]> {
    let position = |name: &str| original.inputs.iter().position(|symbol| symbol.name == name).unwrap();
    graph.inputs.iter().map(|symbol| inputs[position(&symbol.name)].as_slice()).collect()
}

#[test]
fn exact_passes_keep_every_bit_of_random_graphs() {
    let mut compared = 0;
    for seed in 0..3000 {
        let (original, inputs, parameters) = random_case(seed);
        let context = Context { parameters, states: Vec::new() };
        let mut graph = original.clone();
        for pass in PASSES.iter().filter(|pass| pass.exactness == Exactness::Exact) {
            let after = run(pass, &graph, &context);
            let (mut evaluator, mut other) = (Evaluator::new(), Evaluator::new());
            let before = outputs(&graph, evaluator.run(&graph, &remaining(&graph, &original, &inputs)));
            if before.is_some() {
                let values = other.run(&after, &remaining(&after, &original, &inputs));
                assert_eq!(
                    before,
                    outputs(&after, values),
                    "{} changed random graph {seed}:\n{}",
                    pass.name,
                    print(&graph)
                );
                compared += 1;
            }
            graph = after;
        }
    }
    assert!(compared > 5000, "only {compared} comparisons");
}

#[test]
fn rounding_passes_stay_within_the_error_bounds_of_random_graphs() {
    let mut compared = 0;
    for seed in 0..3000 {
        let (original, inputs, parameters) = random_case(seed);
        let context = Context { parameters, states: Vec::new() };
        let mut graph = run(pass("share"), &run(pass("bake"), &original, &context), &context);
        for pass in PASSES.iter().filter(|pass| pass.exactness == Exactness::Rounding) {
            let after = run(pass, &graph, &context);
            let bounded = |graph: &Graph| {
                let mut evaluator = Evaluator::new();
                let values = evaluator.run(graph, &remaining(graph, &original, &inputs));
                let errors = error_bounds(graph, values);
                let nodes = graph.outputs.iter().flat_map(|output| &output.nodes);
                nodes.map(|id| (values[id.index()], errors[id.index()])).collect::<Vec<_>>()
            };
            for ((before, error), (after, other_error)) in bounded(&graph).into_iter().zip(bounded(&after)) {
                let tolerance = error + other_error;
                if tolerance.is_finite() && before.is_finite() && tolerance < 1e-6 * (1.0 + before.abs()) {
                    assert!(
                        (before - after).abs() <= tolerance,
                        "{}, seed {seed}: {before} != {after}",
                        pass.name
                    );
                    compared += 1;
                }
            }
            graph = after;
        }
    }
    assert!(compared > 10_000, "only {compared} comparisons");
}

#[test]
fn running_a_pass_twice_changes_nothing_more() {
    for seed in 0..500 {
        let (mut graph, _, parameters) = random_case(seed);
        let context = Context { parameters, states: Vec::new() };
        for pass in &PASSES {
            let once = run(pass, &graph, &context);
            let twice = run(pass, &once, &context);
            let counts = (once.operation_count(), twice.operation_count());
            assert_eq!(counts.0, counts.1, "{} on random graph {seed}", pass.name);
            graph = once;
        }
    }
}

#[test]
fn no_pass_adds_operations_but_expand_and_invert() {
    for seed in 0..500 {
        let (graph, _, parameters) = random_case(seed);
        for report in run_passes(&graph, &Context { parameters, states: Vec::new() }).1 {
            let may_add = report.name == "expand" || report.name == "invert";
            assert!(
                may_add || report.after.total() <= report.before.total(),
                "{} on random graph {seed}",
                report.name
            );
        }
    }
}

#[test]
fn passes_keep_the_committed_functions() {
    let program = common::program();
    let platform = common::platform();
    let parameters = common::parameters(&program, &platform);
    let states = common::sampled_states(&platform, &parameters, 7);
    // Other states than those from which the pivot order is chosen.
    let compared_at = common::sampled_states(&platform, &parameters, 8);
    let contexts = [
        Context { parameters: parameters.clone(), states: states.clone() },
        Context { parameters: Environment::new(), states: states.clone() },
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
    let states = common::sampled_states(&platform, &parameters, 1);
    let flat = program.flatten(program.function("inverse_dynamics").unwrap());
    let (graph, reports) =
        run_passes(&flat, &Context { parameters: parameters.clone(), states: states.clone() });
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
    let parameters = common::parameters(&program, &platform);
    let states = common::sampled_states(&platform, &parameters, 1);
    let graph = program.flatten(program.function("inverse_dynamics").unwrap());
    let (graph, _) = run_passes(&graph, &Context { parameters: Environment::new(), states });
    assert_eq!(graph.operation_count().solves, 1);
}
