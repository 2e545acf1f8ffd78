//! Compiled source against the interpreter, bit for bit.

use dyn_gen::graph::{Builder, Graph, Node, NodeId, OPS, Op, Solve, SolveKind};

use crate::compiled::{assert_same_bits, interpret, run};
use crate::graphs::{CONSTANTS, Draw, graph, model, random, symbol};

/// Random inputs for a graph; the first case is all ones.
fn cases(graph: &Graph, count: usize, seed: u64) -> Vec<Vec<Vec<f64>>> {
    let mut draw = Draw::new(seed);
    let mut value = |case: usize| if case == 0 { 1.0 } else { draw.number() };
    (0..count)
        .map(|case| {
            graph.inputs.iter().map(|symbol| (0..symbol.len()).map(|_| value(case)).collect()).collect()
        })
        .collect()
}

/// Every operation with every operation as left and as right operand, and with negative constants and inputs.
fn precedence() -> Graph {
    let inputs = vec![symbol("base_rotation", &[3, 3], false)];
    let mut builder = Builder::new();
    let apply = |builder: &mut Builder, op: Op, a: NodeId, b: NodeId| match op.info().arity {
        1 => builder.insert(Node::Unary(op, a)),
        2 => builder.insert(Node::Binary(op, a, b)),
        _ => builder.insert(Node::Ternary(op, a, b, a)),
    };
    let mut nodes = Vec::new();
    for outer in OPS {
        for inner in OPS {
            for (k, constant) in [None, Some(-1.7), Some(-0.0)].into_iter().enumerate() {
                let k = k as u32;
                let (a, b, c) = (builder.input(0, k), builder.input(0, k + 3), builder.input(0, k + 6));
                let a = constant.map_or(a, |value| builder.constant(value));
                let within = apply(&mut builder, inner.op, a, b);
                nodes.push(apply(&mut builder, outer.op, within, c));
                nodes.push(apply(&mut builder, outer.op, c, within));
                let other = apply(&mut builder, inner.op, c, a);
                nodes.push(apply(&mut builder, outer.op, within, other));
            }
        }
    }
    let shape = [nodes.len()];
    graph("precedence", inputs, builder, vec![(symbol("results", &shape, false), nodes)])
}

/// Edge constants as outputs by themselves and in an operation.
fn constants() -> Graph {
    let inputs = vec![symbol("torque", &[], false)];
    let mut builder = Builder::new();
    let mut nodes: Vec<NodeId> = CONSTANTS.iter().map(|&value| builder.constant(value)).collect();
    let torque = builder.input(0, 0);
    for &value in &CONSTANTS {
        let constant = builder.constant(value);
        nodes.push(builder.binary(Op::Mul, constant, torque));
        nodes.push(builder.binary(Op::Sub, torque, constant));
        nodes.push(builder.unary(Op::Neg, constant));
    }
    let shape = [nodes.len()];
    graph("constants", inputs, builder, vec![(symbol("results", &shape, false), nodes)])
}

/// An output that has the function's name, and elements that are inputs, repeated or constant.
fn copies() -> Graph {
    let inputs = vec![symbol("base_rotation", &[3, 3], false), symbol("unused", &[6], false)];
    let mut builder = Builder::new();
    let a = builder.input(0, 5);
    let square = builder.binary(Op::Mul, a, a);
    let two = builder.constant(2.0);
    let nodes = vec![a, square, two, square, a, two];
    graph("copies", inputs, builder, vec![(symbol("copies", &[6], false), nodes)])
}

#[test]
fn compiled_source_equals_the_interpreter() {
    let mut graphs = vec![precedence(), constants(), copies()];
    for seed in 0..40 {
        graphs.push(random(&format!("random_{seed}"), seed, 10 + 12 * seed as usize));
    }
    let cases: Vec<_> =
        graphs.iter().enumerate().map(|(k, graph)| cases(graph, 4, 1000 + k as u64)).collect();
    let compiled = run(&model(&graphs, &[]), &graphs, &cases, &["-O"]);
    assert_same_bits(&graphs, &compiled, &interpret(&graphs, &cases));
}

#[test]
fn parameters_and_a_linear_system_reach_the_function() {
    let parameters = [
        symbol("rod_length", &[6], true),
        symbol("payload_mass", &[], true),
        symbol("payload_inertia", &[3, 3], true),
        symbol("deep", &[2, 2, 2], true),
    ];
    let mut inputs = vec![symbol("torque", &[2], false)];
    inputs.extend(parameters.iter().cloned());
    let mut builder = Builder::new();
    let length = builder.input(1, 4);
    let mass = builder.input(2, 0);
    let inertia = builder.input(3, 7);
    let deep = builder.input(4, 6);
    let torque = [builder.input(0, 0), builder.input(0, 1)];
    let sum = builder.binary(Op::Add, length, mass);
    let index = builder.solve(Solve {
        name: "reaction".into(),
        kind: SolveKind::General,
        matrix: vec![sum, inertia, deep, mass],
        right_hand_side: torque.to_vec(),
        attempt: vec![],
    });
    let reaction = [builder.solution(index, 0), builder.solution(index, 1)];
    let difference = builder.binary(Op::Sub, reaction[0], reaction[1]);
    let outputs = vec![
        (symbol("reaction", &[2], false), reaction.to_vec()),
        (symbol("difference", &[], false), vec![difference]),
    ];
    let graphs = [graph("reactions", inputs, builder, outputs)];
    let mut case: Vec<Vec<f64>> = graphs[0].inputs.iter().map(|symbol| vec![0.0; symbol.len()]).collect();
    case[0] = vec![10.0, 4.0];
    case[1][4] = 3.0;
    case[2][0] = 1.0;
    case[3][7] = -2.0;
    case[4][6] = 2.0;
    // [4 -2; 2 1] x = [10; 4] has the solution [9/4, -1/2], exact in binary.
    let cases = [vec![case]];
    let compiled = run(&model(&graphs, &parameters), &graphs, &cases, &["-O"]);
    assert_eq!(compiled[0][0], [2.25, -0.5, 2.75]);
    assert_same_bits(&graphs, &compiled, &interpret(&graphs, &cases));
}
