//! Functions in lanes: what they compute, and how much of it three at a time.

mod common;

use common::STATES;
use dyn_gen::graph::{Builder, Environment, Evaluator, Graph, Node, Op, Rounding};
use dyn_gen::pack::unpack;
use dyn_gen::{GeneratedFunction, GraphFile, IN_LANES, Numbers, optimise, sampled_states};
use dyn_platform::{LegType, Platform};

/// Committed and test platforms of every leg type.
fn platforms() -> Vec<Platform> {
    let ups = ["ups_regular", "ups_everything"].map(|name| {
        Platform::from_file(common::root().join(format!("tests/platforms/{name}.toml"))).unwrap()
    });
    common::platforms().into_iter().chain(ups).collect()
}

/// Whether the function has a general linear system, of a platform with so much room that no three legs are far from parallel to a
/// plane everywhere.
fn is_left_to_pivots(platform: &Platform, function: &GeneratedFunction) -> bool {
    platform.leg_type == LegType::Ups
        && ["inverse_dynamics", "control"].contains(&function.graph.name.as_str())
}

#[test]
fn functions_in_lanes_are_the_functions_as_derived() {
    for platform in platforms() {
        let program = GraphFile::of(platform.leg_type).unwrap().program;
        let parameters = common::parameters(&program, &platform);
        let names = IN_LANES.map(str::to_owned);
        let functions = optimise(&program, &Numbers::baked(&platform), Some(&names)).unwrap();
        for function in &functions {
            let derived = program.flatten(program.function(&function.graph.name).unwrap());
            let Some(packed) = &function.in_lanes else {
                assert!(is_left_to_pivots(&platform, function), "{}: {}", platform.name, function.graph.name);
                continue;
            };
            assert!(packed.graph.has_lanes());
            let flat = unpack(&packed.graph);
            assert!(!flat.has_lanes());
            for state in sampled_states(&program, &platform, &STATES, 9).unwrap().iter().step_by(16) {
                let mut environment = state.clone();
                environment.extend(parameters.clone());
                let expected = derived.evaluate(&environment).unwrap();
                for rounding in [Rounding::Separate, Rounding::Fused] {
                    let found = flat.evaluate_with(rounding, &environment).unwrap();
                    for (name, values) in &expected {
                        let scale = values.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
                        for (x, y) in values.iter().zip(&found[name]) {
                            let error = (x - y).abs();
                            let place = format!("{}: {}, {name}", platform.name, function.graph.name);
                            assert!(error <= 1e-11 * scale, "{place}: {error:e}");
                        }
                    }
                }
            }
        }
    }
}

/// Instructions of arithmetic that a function needs, an operation in lanes being one.
fn instructions(graph: &Graph) -> usize {
    let live = graph.live();
    let operations = graph.nodes.iter().zip(live).filter(|(node, live)| {
        *live && matches!(node, Node::Binary(..) | Node::Ternary(..) | Node::Unary(Op::Sqrt, _))
    });
    operations.count()
}

#[test]
fn most_operations_are_three_at_a_time_for_any_platform() {
    // Tilted axes cost more, as they do without lanes: fewer constants are zero.
    let limits = [
        ("uhp_2016", [350, 450, 1280, 545, 85]),
        ("tilted_axes", [455, 610, 1770, 680, 110]),
        ("ups_regular", [0, 550, 1150, 0, 97]),
    ];
    for (name, limits) in limits {
        let platform = platforms().into_iter().find(|platform| platform.name == name).unwrap();
        let program = GraphFile::of(platform.leg_type).unwrap().program;
        let names = IN_LANES.map(str::to_owned);
        let functions = optimise(&program, &Numbers::baked(&platform), Some(&names)).unwrap();
        for (function, limit) in functions.iter().zip(limits) {
            let Some(packed) = &function.in_lanes else { continue };
            let found = instructions(&packed.graph);
            println!("{name}: {} {found}, {:?}", function.graph.name, packed.partition);
            assert!(
                found <= limit,
                "{name}: {} takes {found} instructions, limit {limit}",
                function.graph.name
            );
        }
    }
}

#[test]
fn the_legs_side_by_side_keep_the_digits() {
    for platform in common::platforms() {
        let program = GraphFile::of(platform.leg_type).unwrap().program;
        let names = ["inverse_dynamics".to_owned()];
        let functions = optimise(&program, &Numbers::baked(&platform), Some(&names)).unwrap();
        let partition = &functions[0].in_lanes.as_ref().unwrap().partition;
        let mut legs = partition.legs.clone();
        legs.sort_unstable();
        assert_eq!(legs, [0, 1, 2, 3, 4, 5], "{}", platform.name);
        assert!(partition.states > 50 && partition.growth < 100.0, "{}: {partition:?}", platform.name);
    }
}

#[test]
fn unpacking_repeats_operations_lane_by_lane() {
    let mut builder = Builder::new();
    let x: [_; 3] = std::array::from_fn(|element| builder.input(0, element as u32));
    let wide = builder.insert(Node::Lanes(x));
    let two = builder.constant(2.0);
    // An operand without lanes is the same in all of them.
    let doubled = builder.binary(Op::Mul, wide, two);
    let sum = builder.insert(Node::Ternary(Op::MulAdd, doubled, wide, x[1]));
    let lanes: Vec<_> = (0..3).map(|lane| builder.insert(Node::Lane(sum, lane))).collect();
    let like = common::text::parse("y = x");
    let mut graph =
        Graph { outputs: like.outputs.clone(), inputs: like.inputs.clone(), ..builder.into_graph() };
    (graph.inputs[0].shape, graph.outputs[0].symbol.shape) = (vec![3], vec![3]);
    graph.outputs[0].nodes = lanes;
    assert_eq!(graph.in_lanes().iter().filter(|wide| **wide).count(), 3);
    let flat = unpack(&graph);
    let environment = Environment::from([("x".to_owned(), vec![1.0, 3.0, -5.0])]);
    assert_eq!(flat.evaluate(&environment).unwrap()["y"], [2.0 + 3.0, 18.0 + 3.0, 50.0 + 3.0]);
    assert_eq!(flat.operation_count().total(), 6);
    assert!(std::panic::catch_unwind(|| Evaluator::new().run(&graph, &[&[1.0, 2.0, 3.0]]).to_vec()).is_err());
}
