//! Linear systems whose matrix comes at run time: how often the solution in blocks is taken, and that what is taken solves them.

mod common;

use common::STATES;
use dyn_gen::graph::{Evaluator, Graph, is_solved_by};
use dyn_gen::pack::unpack;
use dyn_gen::{GraphFile, Numbers, optimise, sampled_states};
use dyn_platform::Platform;

/// At how many of the states the attempt is taken, and the number of states.
fn taken(graph: &Graph, platform: &Platform) -> (usize, usize) {
    let program = GraphFile::of(platform.leg_type).unwrap().program;
    let parameters = common::parameters(&program, platform);
    let [system] = &graph.solves[..] else { panic!("one system in {}", graph.name) };
    assert_eq!(system.attempt.len(), 6);
    let states = sampled_states(&program, platform, &STATES, 9).unwrap();
    let mut evaluator = Evaluator::new();
    let is_taken = |state: &&dyn_gen::graph::Environment| {
        let inputs = graph
            .inputs
            .iter()
            .map(|symbol| state.get(&symbol.name).unwrap_or_else(|| &parameters[&symbol.name]).as_slice());
        let values = evaluator.run(graph, &inputs.collect::<Vec<_>>());
        let at = |ids: &[dyn_gen::graph::NodeId]| ids.iter().map(|id| values[id.index()]).collect::<Vec<_>>();
        is_solved_by(&at(&system.attempt), &at(&system.matrix), &at(&system.right_hand_side))
    };
    (states.iter().filter(is_taken).count(), states.len())
}

#[test]
fn attempts_are_taken_at_nearly_all_states() {
    let ups = ["ups_regular", "ups_everything"].map(|name| {
        Platform::from_file(common::root().join(format!("tests/platforms/{name}.toml"))).unwrap()
    });
    for platform in common::platforms().into_iter().chain(ups) {
        let program = GraphFile::of(platform.leg_type).unwrap().program;
        let numbers = Numbers::with_run_time(&platform, ["all"]);
        let functions = optimise(&program, &numbers, Some(&["inverse_dynamics".to_owned()])).unwrap();
        let [function] = &functions[..] else { panic!("one function") };
        let in_lanes = unpack(&function.in_lanes.as_ref().expect("in lanes").graph);
        for (graph, how) in [(&function.graph, "alone"), (&in_lanes, "in lanes")] {
            let (taken, states) = taken(graph, &platform);
            println!("{}, {how}: {taken} of {states}", platform.name);
            // Not where all is at rest and no force acts: nothing can be said of an error then.
            assert!(taken + 2 >= states, "{}, {how}: {taken} of {states}", platform.name);
        }
    }
}
