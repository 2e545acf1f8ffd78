//! What follows from parameters alone, taken out of functions in lanes: both parts together are the function.

mod common;

use common::STATES;
use dyn_gen::graph::{Graph, Node, Rounding};
use dyn_gen::pack::{PREPARED, hoist, unpack};
use dyn_gen::{IN_LANES, Numbers, optimise, sampled_states};

#[test]
fn two_parts_are_the_function_bit_for_bit() {
    let program = common::program();
    let names = IN_LANES.map(str::to_owned);
    for platform in common::platforms().iter().take(3) {
        let parameters = common::parameters(&program, platform);
        let functions = optimise(&program, &Numbers::with_run_time(platform, ["all"]), Some(&names)).unwrap();
        for packed in functions.iter().map(|function| function.in_lanes.as_ref().expect("in lanes")) {
            let hoisted = hoist(&packed.graph).expect("all numbers at run time");
            assert!(hoisted.preparation.inputs.iter().all(|symbol| symbol.parameter));
            let (whole, rest) = (unpack(&packed.graph), unpack(&hoisted.rest));
            for state in sampled_states(&program, platform, &STATES, 9).unwrap().iter().step_by(16) {
                let mut environment = state.clone();
                environment.extend(parameters.clone());
                for rounding in [Rounding::Separate, Rounding::Fused] {
                    let expected = whole.evaluate_with(rounding, &environment).unwrap();
                    environment.extend(hoisted.preparation.evaluate_with(rounding, &environment).unwrap());
                    assert_eq!(
                        rest.evaluate_with(rounding, &environment).unwrap(),
                        expected,
                        "{}",
                        whole.name
                    );
                }
            }
        }
    }
}

/// Operations on parameters and numbers alone.
fn of_parameters_alone(graph: &Graph) -> usize {
    let mut alone: Vec<bool> = Vec::new();
    let mut found = 0;
    for (node, live) in graph.nodes.iter().zip(graph.live()) {
        let mut all = true;
        graph.for_each_operand(*node, |operand| all &= alone[operand.index()]);
        let is_operation =
            matches!(node, Node::Unary(..) | Node::Binary(..) | Node::Ternary(..) | Node::Lanes(_));
        let is_alone = match *node {
            Node::Input { input, .. } => graph.inputs[input as usize].parameter,
            Node::Constant(_) => true,
            Node::Solution { .. } => false,
            _ => all,
        };
        found += usize::from(live && is_alone && is_operation);
        alone.push(is_alone);
    }
    found
}

#[test]
fn nothing_of_parameters_alone_is_left_and_little_is_not_taken_out() {
    let (program, platform) = (common::program(), common::platform());
    let names = IN_LANES.map(str::to_owned);
    let optimised = |run_time: &[&str]| {
        let numbers = Numbers::with_run_time(&platform, run_time.iter().copied());
        optimise(&program, &numbers, Some(&names)).unwrap()
    };
    for function in optimised(&["all"]) {
        let graph = &function.in_lanes.as_ref().expect("in lanes").graph;
        let rest = hoist(graph).expect("worth it").rest;
        assert_eq!(rest.inputs.last().map(|symbol| symbol.name.as_str()), Some(PREPARED));
        println!("{}: {} of parameters alone", graph.name, of_parameters_alone(graph));
        assert!(of_parameters_alone(graph) > 20 && of_parameters_alone(&rest) == 0, "{}", graph.name);
    }
    for function in optimised(&["payload", "gravity", "legs.k_e"]) {
        assert!(hoist(&function.in_lanes.as_ref().expect("in lanes").graph).is_none());
    }
}
