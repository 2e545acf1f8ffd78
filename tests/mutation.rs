//! Would the agreement tests notice a wrong operation? Every operation of the committed graphs is changed in turn (result
//! with the other sign, an operand dropped, a constant 0.1 % larger), and the functions that use it are compared with the
//! reference again. At least 99 % of the changes must be caught; the rest is listed with the reason why it cannot be.

use dyn_gen::deviation::{Scale, relative_error, within};
use dyn_gen::graph::{Environment, Graph, Node, NodeId, Op, Program, Step};
use dyn_gen::sample::Kind;
use dyn_gen::sampled_states;
use dyn_platform::LegType;
use dyn_tests::{platforms, reference};

const CAUGHT: f64 = 0.99;

/// Changes that leave the outputs as they are, so that no comparison can see them: graph, change, how many nodes, reason.
type Equivalent = (&'static str, Change, usize, &'static str);

const EQUIVALENT: &[Equivalent] = &[
    ("leg_energy", Change::OtherSign, 4, "velocity components that enter the kinetic energy squared only"),
    ("total_energy", Change::OtherSign, 3, "velocity components that enter the kinetic energy squared only"),
];

const EQUIVALENT_OF_UPS: &[Equivalent] = &[
    (
        "leg_closure",
        Change::OtherSign,
        3,
        "components of the direction that enter the alignment squared only",
    ),
    ("leg_energy", Change::OtherSign, 1, "velocity components that enter the kinetic energy squared only"),
];

/// A change of one node.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Change {
    OtherSign,
    FirstOperandDropped,
    SecondOperandDropped,
    OperationDropped,
    ConstantLarger,
}

fn changes(node: Node) -> &'static [Change] {
    use Change::*;
    match node {
        // Exact zeros are structure, such as the base's angular acceleration in the bias; 0.1 % of zero is no change.
        Node::Constant(0.0) => &[],
        Node::Constant(_) => &[ConstantLarger],
        Node::Input { .. } | Node::Solution { .. } | Node::Lanes(_) | Node::Lane(..) => &[],
        Node::Unary(..) => &[OtherSign, OperationDropped],
        Node::Binary(..) | Node::Ternary(..) => &[OtherSign, FirstOperandDropped, SecondOperandDropped],
    }
}

/// The graph with node `id` changed.
fn mutate(graph: &Graph, id: usize, change: Change) -> Graph {
    let mut mutant = graph.clone();
    let node = &mut mutant.nodes[id];
    let users = match (change, *node) {
        (Change::ConstantLarger, Node::Constant(value)) => {
            *node = Node::Constant(value * 1.001);
            return mutant;
        }
        (Change::OtherSign, Node::Unary(Op::Neg, operand)) => operand,
        (Change::OtherSign, Node::Binary(Op::Sub, a, b)) => {
            *node = Node::Binary(Op::Sub, b, a);
            return mutant;
        }
        (Change::OtherSign, _) => return with_negation_after(mutant, id),
        (Change::OperationDropped, Node::Unary(_, operand)) => operand,
        (Change::FirstOperandDropped, Node::Binary(_, _, b)) => b,
        (Change::SecondOperandDropped, Node::Binary(_, a, _)) => a,
        (Change::FirstOperandDropped, Node::Ternary(_, _, _, sum)) => sum,
        (Change::SecondOperandDropped, Node::Ternary(_, a, b, _)) => {
            *node = Node::Binary(Op::Mul, a, b);
            return mutant;
        }
        (change, node) => panic!("{change:?} does not fit {node:?}"),
    };
    mutant.replace_uses(NodeId(id as u32), users);
    mutant
}

/// Everything that used node `id` uses its negation instead.
fn with_negation_after(mut graph: Graph, id: usize) -> Graph {
    let shift = |node: NodeId| if node.index() >= id { NodeId(node.0 + 1) } else { node };
    for node in &mut graph.nodes[id + 1..] {
        *node = match *node {
            Node::Unary(op, a) => Node::Unary(op, shift(a)),
            Node::Binary(op, a, b) => Node::Binary(op, shift(a), shift(b)),
            Node::Ternary(op, a, b, c) => Node::Ternary(op, shift(a), shift(b), shift(c)),
            other => other,
        };
    }
    graph.outputs.iter_mut().flat_map(|output| &mut output.nodes).for_each(|node| *node = shift(*node));
    graph.nodes.insert(id + 1, Node::Unary(Op::Neg, NodeId(id as u32)));
    graph.section_of.insert(id + 1, graph.section_of[id]);
    graph
}

/// A state with parameters, and the reference's outputs.
struct Case {
    environment: Environment,
    expected: Environment,
}

fn cases(leg_type: LegType, program: &Program) -> Vec<Case> {
    let mut cases = Vec::new();
    let names: &[&str] = match leg_type {
        LegType::Uhp => &["everything", "tilted_axes", "unequal_legs", "tilted_gravity_damped"],
        LegType::Ups => &["ups_everything", "ups_regular"],
    };
    for name in names {
        let mut platform = platforms::platform(name);
        if *name == "tilted_axes" {
            // Joints out of their planes, or products of a height with a tilt would be zero for some leg on every platform.
            for leg in 0..6 {
                platform.parameters.base_point[leg][2] += 0.01 - 0.003 * leg as f64;
                platform.parameters.platform_point[leg][2] -= 0.012 - 0.005 * leg as f64;
            }
        }
        let numbers = reference::parameters(&platform);
        for mut state in sampled_states(program, &platform, &[(Kind::Large, 2)], platforms::SEED).unwrap() {
            let expected = reference::outputs(&numbers, &reference::state(&state));
            state.extend(platforms::parameters(&platform));
            cases.push(Case { environment: state, expected });
        }
    }
    cases
}

/// Whether some output of some function that calls graph number `graph` deviates.
fn is_caught(program: &Program, graph: usize, cases: &[Case]) -> bool {
    let calls = |step: &Step| matches!(step, Step::Call { graph: called, .. } if *called == graph);
    program.functions.iter().filter(|function| function.steps.iter().any(calls)).any(|function| {
        cases.iter().any(|case| {
            let known = program.evaluate(function, &case.environment).expect("a complete environment");
            function.outputs.iter().any(|output| {
                let found = relative_error(&known[output], &case.expected[output], Scale::own());
                !within(found, output)
            })
        })
    })
}

/// Changes of a program's graphs: how many there were, and those that nobody noticed.
struct Outcome {
    total: usize,
    survivors: Vec<(String, Change, usize, Node)>,
}

/// Changes every operation of the graphs that `chosen` lets pass.
fn mutate_all(leg_type: LegType, chosen: impl Fn(&Graph) -> bool) -> Outcome {
    let program = platforms::graph_file(leg_type).program;
    let cases = cases(leg_type, &program);
    let unchanged = (0..program.graphs.len()).find(|&graph| is_caught(&program, graph, &cases));
    assert_eq!(unchanged, None, "the unchanged graphs must agree, or everything counts as caught");

    let mut outcome = Outcome { total: 0, survivors: Vec::new() };
    let mut mutant = program.clone();
    for (number, graph) in program.graphs.iter().enumerate().filter(|(_, graph)| chosen(graph)) {
        for (id, node) in graph.nodes.iter().enumerate() {
            for &change in changes(*node) {
                outcome.total += 1;
                mutant.graphs[number] = mutate(graph, id, change);
                if !is_caught(&mutant, number, &cases) {
                    outcome.survivors.push((graph.name.clone(), change, id, *node));
                }
            }
        }
        mutant.graphs[number] = graph.clone();
    }
    outcome
}

#[test]
fn changed_operations_of_the_paper_s_legs_are_caught() {
    mutate_all(LegType::Uhp, |_| true).judge(EQUIVALENT);
}

/// Of the graphs that both leg types have the other test changes every operation.
#[test]
fn changed_operations_of_telescopic_legs_are_caught() {
    let known = platforms::graph_file(LegType::Uhp).program.graphs;
    mutate_all(LegType::Ups, |graph| !known.contains(graph)).judge(EQUIVALENT_OF_UPS);
}

impl Outcome {
    /// Asserts that enough is caught, and that the survivors are those of the table.
    fn judge(&self, equivalent: &[Equivalent]) {
        let Outcome { total, survivors } = self;
        let total = *total;
        let caught = 1.0 - survivors.len() as f64 / total as f64;
        println!("{total} changes, {:.3} % caught, {} survive:", 100.0 * caught, survivors.len());
        let mut unexplained = Vec::new();
        for (graph, change, id, node) in survivors {
            let reason =
                equivalent.iter().find(|row| (row.0, row.1) == (graph.as_str(), *change)).map(|row| row.3);
            println!("  {graph}, node {id} {node:?}, {change:?}: {}", reason.unwrap_or("NO REASON KNOWN"));
            if reason.is_none() {
                unexplained.push(format!("{graph}, node {id} {node:?}, {change:?}"));
            }
        }
        assert!(caught >= CAUGHT, "only {:.3} % of the changes are caught", 100.0 * caught);
        assert!(unexplained.is_empty(), "survivors without a reason:\n{}", unexplained.join("\n"));
        for (graph, change, expected, reason) in equivalent {
            let found = survivors
                .iter()
                .filter(|survivor| (survivor.0.as_str(), survivor.1) == (*graph, *change))
                .count();
            assert_eq!(found, *expected, "{graph}, {change:?} ({reason})");
        }
    }
}
