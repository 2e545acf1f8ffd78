//! Small graphs as text, for fixtures: `y = a * (b + c) - sqrt(2)`, one line per output.

use std::fmt::Write;

use dyn_gen::graph::{Builder, Graph, Node, NodeId, Op, Output, Symbol};

pub fn scalar(name: &str, parameter: bool) -> Symbol {
    Symbol {
        name: name.to_owned(),
        shape: Vec::new(),
        unit: "-".to_owned(),
        frame: "-".to_owned(),
        meaning: name.to_owned(),
        equation: String::new(),
        parameter,
    }
}

/// Inputs are the letters in order of appearance; names that start with `p` are parameters.
pub fn parse(text: &str) -> Graph {
    let mut parser = Parser { rest: "", builder: Builder::new(), inputs: Vec::new() };
    let mut outputs = Vec::new();
    for line in text.lines().filter(|line| !line.trim().is_empty()) {
        let (name, expression) = line.split_once('=').expect("output = expression");
        parser.rest = Box::leak(expression.replace(' ', "").into_boxed_str());
        let node = parser.sum();
        assert_eq!(parser.rest, "", "in {line}");
        outputs.push(Output { symbol: scalar(name.trim(), false), nodes: vec![node] });
    }
    let inputs = parser.inputs;
    Graph { name: "fixture".to_owned(), inputs, outputs, ..parser.builder.into_graph() }
}

struct Parser {
    rest: &'static str,
    builder: Builder,
    inputs: Vec<Symbol>,
}

impl Parser {
    fn eat(&mut self, token: char) -> bool {
        let found = self.rest.starts_with(token);
        if found {
            self.rest = &self.rest[1..];
        }
        found
    }

    fn sum(&mut self) -> NodeId {
        let mut sum = self.product();
        loop {
            let op = if self.eat('+') {
                Op::Add
            } else if self.eat('-') {
                Op::Sub
            } else {
                return sum;
            };
            let term = self.product();
            sum = self.builder.binary(op, sum, term);
        }
    }

    fn product(&mut self) -> NodeId {
        let mut product = self.factor();
        loop {
            let op = if self.eat('*') {
                Op::Mul
            } else if self.eat('/') {
                Op::Div
            } else {
                return product;
            };
            let factor = self.factor();
            product = self.builder.binary(op, product, factor);
        }
    }

    fn factor(&mut self) -> NodeId {
        if self.eat('-') {
            let value = self.factor();
            return self.builder.unary(Op::Neg, value);
        }
        if self.eat('(') {
            let value = self.sum();
            assert!(self.eat(')'));
            return value;
        }
        let end = self.rest.find(|c: char| !c.is_alphanumeric() && c != '.').unwrap_or(self.rest.len());
        let (word, rest) = self.rest.split_at(end);
        self.rest = rest;
        if word == "sqrt" {
            let value = self.factor();
            return self.builder.unary(Op::Sqrt, value);
        }
        if let Ok(value) = word.parse() {
            return self.builder.constant(value);
        }
        let known = self.inputs.iter().position(|input| input.name == word);
        let input = known.unwrap_or_else(|| {
            self.inputs.push(scalar(word, word.starts_with('p')));
            self.inputs.len() - 1
        });
        self.builder.input(input as u32, 0)
    }
}

/// Every output as an expression; nodes with several users get a line of their own before.
pub fn print(graph: &Graph) -> String {
    let uses = graph.use_counts();
    let live = graph.live();
    let mut text = String::new();
    let mut expressions: Vec<String> = Vec::new();
    for (index, node) in graph.nodes.iter().enumerate() {
        let operand = |id: NodeId| expressions[id.index()].clone();
        let compound = |id: NodeId| match graph.nodes[id.index()] {
            Node::Binary(..) if uses[id.index()] == 1 => format!("({})", operand(id)),
            _ => operand(id),
        };
        let expression = match *node {
            Node::Constant(value) => format!("{value}"),
            Node::Input { input, .. } => graph.inputs[input as usize].name.clone(),
            Node::Unary(Op::Neg, a) => format!("-{}", compound(a)),
            Node::Unary(_, a) => format!("sqrt({})", operand(a)),
            Node::Binary(op, a, b) => {
                let sign = ["", "", "+", "-", "*", "/"][op as usize];
                format!("{} {sign} {}", compound(a), compound(b))
            }
            Node::Ternary(op, a, b, c) => {
                format!("{}({}, {}, {})", op.info().name, operand(a), operand(b), operand(c))
            }
            Node::Lanes(lanes) => {
                format!("[{}, {}, {}]", operand(lanes[0]), operand(lanes[1]), operand(lanes[2]))
            }
            Node::Lane(a, lane) => format!("{}.{lane}", operand(a)),
            Node::Solution { solve, element } => format!("{}[{element}]", graph.solves[solve as usize].name),
        };
        let operation = matches!(node, Node::Unary(..) | Node::Binary(..) | Node::Ternary(..));
        let shared = live[index] && uses[index] > 1 && operation;
        expressions.push(if shared {
            writeln!(text, "t{index} = {expression}").unwrap();
            format!("t{index}")
        } else {
            expression
        });
    }
    for output in &graph.outputs {
        let nodes = output.nodes.iter().map(|id| expressions[id.index()].as_str()).collect::<Vec<_>>();
        writeln!(text, "{} = {}", output.symbol.name, nodes.join(", ")).unwrap();
    }
    text
}
