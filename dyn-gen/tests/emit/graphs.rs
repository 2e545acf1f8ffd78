//! Graphs made by hand and at random, and the files around them.

use dyn_gen::emit::{CountRow, Header, Model, RuntimePath, Scalar, Signature, Source, function, model_file};
use dyn_gen::graph::{Builder, Graph, Node, NodeId, Op, Output, Symbol};
use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::{Rng, SeedableRng};

pub fn symbol(name: &str, shape: &[usize], parameter: bool) -> Symbol {
    Symbol {
        name: name.into(),
        shape: shape.into(),
        unit: "m".into(),
        frame: "O".into(),
        meaning: format!("test {name}"),
        equation: String::new(),
        parameter,
    }
}

/// A graph with these inputs; `outputs` are named arrays of nodes.
pub fn graph(
    name: &str,
    inputs: Vec<Symbol>,
    builder: Builder,
    outputs: Vec<(Symbol, Vec<NodeId>)>,
) -> Graph {
    Graph {
        name: name.into(),
        meaning: "Made for a test".into(),
        equation: "(1)".into(),
        inputs,
        outputs: outputs.into_iter().map(|(symbol, nodes)| Output { symbol, nodes }).collect(),
        ..builder.into_graph()
    }
}

/// The file of a model with these functions.
pub fn model(graphs: &[Graph], parameters: &[Symbol]) -> String {
    let header = Header {
        title: "Functions made for a test.".into(),
        command: "cargo test".into(),
        graphs: vec![Source { name: "test.json".into(), sha256: "00".into() }],
        platform: None,
        casadi: "0.0.0".into(),
        operations: graphs
            .iter()
            .map(|graph| CountRow {
                function: graph.name.clone(),
                before: 7,
                after: graph.operation_count().total(),
            })
            .collect(),
        eliminations: Vec::new(),
        evidence: Vec::new(),
    };
    let functions: Vec<String> = graphs
        .iter()
        .map(|graph| function(graph, !parameters.is_empty()).expect("a printable graph"))
        .collect();
    let signatures: Vec<Signature> = graphs.iter().map(Signature::of).collect();
    let model = Model {
        name: "test_model",
        runtime: &RuntimePath::inside(),
        parameters,
        scalars: &[Scalar::F64, Scalar::F32],
        defaults: None,
        limits: None,
        signatures: &signatures,
        functions: &functions,
        in_lanes: &[],
        prepared: &[],
    };
    model_file(&header, &model).expect("a printable model")
}

/// Numbers at the edges of the format and ordinary ones.
pub const CONSTANTS: [f64; 22] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    0.5,
    -2.75,
    0.1,
    -1.0 / 3.0,
    1e16,
    -1e16,
    123456789012345680.0,
    1e-5,
    1e-7,
    5e-324,
    -5e-324,
    2.225073858507201e-308,
    f64::MIN_POSITIVE,
    f64::MAX,
    -f64::MAX,
    f64::EPSILON,
    0.30000000000000004,
    std::f64::consts::FRAC_1_SQRT_2,
];

/// Random numbers, the same everywhere.
pub struct Draw(Pcg64Mcg);

impl Draw {
    pub fn new(seed: u64) -> Draw {
        Draw(Pcg64Mcg::seed_from_u64(seed))
    }

    /// Uniform in 0..end.
    pub fn below(&mut self, end: usize) -> usize {
        (self.0.next_u64() % end as u64) as usize
    }

    /// Uniform in (-3, 3).
    pub fn number(&mut self) -> f64 {
        6.0 * (self.0.next_u64() >> 11) as f64 / (1_u64 << 53) as f64 - 3.0
    }
}

/// A random expression graph: every operation, many sections, edge constants, values used never, once, often.
pub fn random(name: &str, seed: u64, operations: usize) -> Graph {
    let mut draw = Draw::new(seed);
    let inputs = vec![symbol("base_rotation", &[3, 3], false), symbol("torque", &[], false)];
    let mut builder = Builder::new();
    let mut values: Vec<NodeId> = (0..9).map(|element| builder.input(0, element)).collect();
    values.push(builder.input(1, 0));
    values.extend(CONSTANTS.iter().map(|&value| builder.constant(value)));
    let sections = ["", "leg 1: rod direction", "leg 2: rod direction", "payload"];
    for step in 0..operations {
        if step % 7 == 0 {
            builder.enter_section(sections[draw.below(sections.len())]);
        }
        // Recent values more often, so that expressions nest.
        let mut pick = || {
            let reach = if draw.below(10) < 7 { values.len().min(6) } else { values.len() };
            values[values.len() - 1 - draw.below(reach)]
        };
        let (a, b, c) = (pick(), pick(), pick());
        let node = match draw.below(9) {
            0 => Node::Unary(Op::Neg, a),
            1 => Node::Unary(Op::Sqrt, a),
            2 | 3 => Node::Binary(Op::Add, a, b),
            4 | 5 => Node::Binary(Op::Sub, a, b),
            6 => Node::Binary(Op::Mul, a, b),
            7 => Node::Binary(Op::Div, a, b),
            _ => Node::Ternary([Op::MulAdd, Op::MulSub, Op::NegMulAdd][step % 3], a, b, c),
        };
        values.push(builder.insert(node));
    }
    let mut outputs = vec![(symbol("total", &[], false), vec![values[values.len() - 1]])];
    let picked: Vec<NodeId> = (0..6).map(|_| values[draw.below(values.len())]).collect();
    outputs.push((symbol("picked", &[2, 3], false), picked));
    graph(name, inputs, builder, outputs)
}
