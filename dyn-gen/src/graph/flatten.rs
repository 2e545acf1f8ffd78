//! One graph of a whole function: its calls composed over all legs.

use std::collections::BTreeMap;

use super::{Builder, Function, Graph, Node, NodeId, Output, Program, Solve, Step};

/// Nodes of a flattened function that are computed alike.
#[derive(Clone, PartialEq, Debug)]
pub enum Group {
    /// The elements of an array, row-major.
    Array {
        /// Its shape.
        shape: Vec<usize>,
        /// Its elements.
        nodes: Vec<NodeId>,
    },
    /// The same element of every leg's array.
    Legs(Vec<NodeId>),
}

impl Group {
    /// Its nodes.
    pub fn nodes(&self) -> &[NodeId] {
        match self {
            Group::Array { nodes, .. } | Group::Legs(nodes) => nodes,
        }
    }
}

/// The nodes of each symbol known so far, flat.
type Known = BTreeMap<String, Vec<NodeId>>;

impl Program {
    /// `function` as one graph, whose inputs are the function's inputs and then the parameters its steps read.
    ///
    /// Statements come call by call, leg by leg, output by output; a node belongs to the section of the output that needed it
    /// first. Values equal those of [`evaluate`](Self::evaluate) bit for bit.
    pub fn flatten(&self, function: &Function) -> Graph {
        self.flatten_with_groups(function).0
    }

    /// [`flatten`](Self::flatten), and what its calls give, in order, as groups of nodes that are computed alike.
    pub fn flatten_with_groups(&self, function: &Function) -> (Graph, Vec<Group>) {
        let mut groups = Vec::new();
        let states = function.inputs.iter().map(|name| self.declared(name).symbol.clone());
        let inputs = states.chain(self.parameters_of(function).cloned()).collect::<Vec<_>>();

        let mut builder = Builder::new();
        let mut known = Known::new();
        for (input, symbol) in inputs.iter().enumerate() {
            let elements = (0..symbol.len()).map(|element| builder.input(input as u32, element as u32));
            known.insert(symbol.name.clone(), elements.collect());
        }
        for step in &function.steps {
            match step {
                Step::Call { graph, over_legs: false } => {
                    let graph = &self.graphs[*graph];
                    let results = inline(graph, &mut builder, "", |symbol| &known[symbol]);
                    groups.extend(graph.outputs.iter().zip(&results).map(|(output, nodes)| Group::Array {
                        shape: output.symbol.shape.clone(),
                        nodes: nodes.clone(),
                    }));
                    let named = graph.outputs.iter().zip(results);
                    known.extend(named.map(|(output, nodes)| (output.symbol.name.clone(), nodes)));
                }
                Step::Call { graph, over_legs: true } => {
                    self.inline_over_legs(&self.graphs[*graph], &mut builder, &mut known, &mut groups);
                }
                Step::Solve { solution, matrix, right_hand_side, kind } => {
                    let symbol = &self.declared(solution).symbol;
                    let solve = builder.solve(Solve {
                        name: solution.clone(),
                        kind: *kind,
                        matrix: known[matrix].clone(),
                        right_hand_side: known[right_hand_side].clone(),
                        attempt: Vec::new(),
                    });
                    builder.enter_section(&symbol.meaning);
                    let elements = (0..symbol.len()).map(|element| builder.solution(solve, element as u32));
                    known.insert(solution.clone(), elements.collect());
                }
            }
        }
        let outputs = function.outputs.iter().map(|name| {
            let symbol = self.declared(name).symbol.clone();
            Output { symbol, nodes: known[name].clone() }
        });
        let outputs = outputs.collect();
        let graph = Graph {
            name: function.name.clone(),
            meaning: function.meaning.clone(),
            equation: function.equation.clone(),
            inputs,
            outputs,
            ..builder.into_graph()
        };
        (graph, groups)
    }

    fn inline_over_legs(
        &self,
        graph: &Graph,
        builder: &mut Builder,
        known: &mut Known,
        groups: &mut Vec<Group>,
    ) {
        let mut collected = vec![Vec::new(); graph.outputs.len()];
        for leg in 0..self.leg_count {
            let results = inline(graph, builder, &format!("leg {}: ", leg + 1), |symbol| {
                let nodes = &known[symbol];
                let declaration = self.declared(symbol);
                if !declaration.per_leg {
                    return nodes;
                }
                let length = declaration.symbol.len() / self.leg_count;
                &nodes[leg * length..(leg + 1) * length]
            });
            for (collected, nodes) in collected.iter_mut().zip(results) {
                collected.extend(nodes);
            }
        }
        for nodes in &collected {
            let length = nodes.len() / self.leg_count;
            let of_legs = |element| nodes.iter().skip(element).step_by(length).copied().collect();
            groups.extend((0..length).map(|element| Group::Legs(of_legs(element))));
        }
        let named = graph.outputs.iter().zip(collected);
        known.extend(named.map(|(output, nodes)| (output.symbol.name.clone(), nodes)));
    }
}

/// Copies `graph` into `builder` with its inputs replaced by the nodes that `argument` gives for a symbol; returns its outputs.
fn inline<'a>(
    graph: &Graph,
    builder: &mut Builder,
    prefix: &str,
    argument: impl Fn(&str) -> &'a [NodeId],
) -> Vec<Vec<NodeId>> {
    let arguments = graph.inputs.iter().map(|symbol| argument(&symbol.name)).collect::<Vec<_>>();
    let mut copies: Vec<Option<NodeId>> = vec![None; graph.nodes.len()];
    let mut results = Vec::with_capacity(graph.outputs.len());
    for output in &graph.outputs {
        builder.enter_section(&format!("{prefix}{}", output.symbol.meaning));
        let mut needed = vec![false; graph.nodes.len()];
        output.nodes.iter().for_each(|node| needed[node.index()] = true);
        graph.mark_needed(&mut needed);
        for k in (0..graph.nodes.len()).filter(|k| needed[*k]) {
            if copies[k].is_none() {
                copies[k] = Some(copy(graph.nodes[k], &arguments, &copies, builder));
            }
        }
        results.push(output.nodes.iter().map(|node| copied(&copies, *node)).collect());
    }
    results
}

fn copy(node: Node, arguments: &[&[NodeId]], copies: &[Option<NodeId>], builder: &mut Builder) -> NodeId {
    match node {
        Node::Input { input, element } => arguments[input as usize][element as usize],
        Node::Constant(value) => builder.constant(value),
        Node::Unary(op, a) => builder.unary(op, copied(copies, a)),
        Node::Binary(op, a, b) => builder.binary(op, copied(copies, a), copied(copies, b)),
        Node::Ternary(op, a, b, c) => {
            let [a, b, c] = [a, b, c].map(|operand| copied(copies, operand));
            builder.insert(Node::Ternary(op, a, b, c))
        }
        Node::Lanes(_) | Node::Lane(..) | Node::Solution { .. } => {
            unreachable!(
                "lanes come later, and solves are steps of functions, never nodes of a program's graphs"
            )
        }
    }
}

fn copied(copies: &[Option<NodeId>], node: NodeId) -> NodeId {
    copies[node.index()].expect("operands are copied before their users")
}
