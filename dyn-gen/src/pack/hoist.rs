//! What follows from parameters at run time alone, taken out of a function in lanes: computed once, when they are set.
//!
//! Besides, every parameter of three legs in lanes is gathered from places in memory that are apart.

use std::collections::BTreeMap;

use super::unpack;
use crate::graph::{Builder, Graph, LANE_COUNT, Node, NodeId, Output, Symbol};
use crate::passes::Images;

/// The array that is handed over: a row for each value in lanes, its last lane twice, or for four numbers.
pub const PREPARED: &str = "prepared";
/// Numbers in a row: as many as a register holds.
const ROW: usize = 4;
/// Functions that less than this is taken out of stay as they are: values in lanes.
const LEAST: usize = 16;

/// A function in two parts.
#[derive(Clone, Debug)]
pub struct Hoisted {
    /// From the parameters to [`PREPARED`], without lanes.
    pub preparation: Graph,
    /// The function in lanes, with [`PREPARED`] as its last input.
    pub rest: Graph,
}

/// `graph`, in lanes, in two parts, if that is worth it.
pub fn hoist(graph: &Graph) -> Option<Hoisted> {
    let from_parameters = from_parameters(graph);
    let kept = Kept::of(graph, &from_parameters);
    (kept.wide.len() >= LEAST).then(|| {
        let symbol = kept.symbol();
        Hoisted { preparation: preparation(graph, &kept, &symbol), rest: rest(graph, &kept, &symbol) }
    })
}

/// For each node whether it follows from parameters, and from nothing else but numbers.
fn from_parameters(graph: &Graph) -> Vec<bool> {
    let mut known: Vec<bool> = Vec::with_capacity(graph.nodes.len());
    for node in &graph.nodes {
        let (mut all, mut any) = (true, false);
        graph.for_each_operand(*node, |operand| {
            all &= known[operand.index()] || matches!(graph.nodes[operand.index()], Node::Constant(_));
            any |= known[operand.index()];
        });
        known.push(match *node {
            Node::Input { input, .. } => graph.inputs[input as usize].parameter,
            Node::Solution { .. } => false,
            _ => all && any,
        });
    }
    known
}

/// Values that others than parameters need, with their rows.
struct Kept {
    wide: BTreeMap<NodeId, usize>,
    numbers: BTreeMap<NodeId, usize>,
}

impl Kept {
    fn of(graph: &Graph, from_parameters: &[bool]) -> Kept {
        let (in_lanes, live) = (graph.in_lanes(), graph.live());
        let (mut wide, mut numbers) = (BTreeMap::new(), BTreeMap::new());
        let mut keep = |id: NodeId| {
            let value = match graph.nodes[id.index()] {
                Node::Lane(of, _) => of,
                _ => id,
            };
            match graph.nodes[value.index()] {
                _ if !from_parameters[id.index()] => None,
                Node::Input { .. } => None,
                _ if in_lanes[value.index()] => wide.insert(value, 0),
                _ => numbers.insert(value, 0),
            };
        };
        for (index, node) in graph.nodes.iter().enumerate() {
            if live[index] && !from_parameters[index] {
                graph.for_each_operand(*node, &mut keep);
            }
        }
        graph.outputs.iter().flat_map(|output| &output.nodes).for_each(|id| keep(*id));
        wide.values_mut().enumerate().for_each(|(row, place)| *place = ROW * row);
        let first = ROW * wide.len();
        numbers.values_mut().enumerate().for_each(|(k, place)| *place = first + k);
        Kept { wide, numbers }
    }

    fn symbol(&self) -> Symbol {
        let rows = self.wide.len() + self.numbers.len().div_ceil(ROW);
        Symbol {
            name: PREPARED.into(),
            shape: vec![rows, ROW],
            unit: "SI".into(),
            frame: String::new(),
            meaning: "what follows from the parameters alone".into(),
            equation: String::new(),
            parameter: false,
        }
    }

    /// The node that reads what is kept in place of `id`.
    fn read(&self, graph: &Graph, builder: &mut Builder, input: u32, id: NodeId) -> Option<NodeId> {
        let mut element = |place: usize| builder.input(input, place as u32);
        if let Some(&place) = self.wide.get(&id) {
            let lanes = [0, 1, 2].map(|lane| element(place + lane));
            return Some(builder.insert(Node::Lanes(lanes)));
        }
        match graph.nodes[id.index()] {
            Node::Lane(of, lane) => self.wide.get(&of).map(|&place| element(place + lane as usize)),
            _ => self.numbers.get(&id).map(|&place| element(place)),
        }
    }
}

fn preparation(graph: &Graph, kept: &Kept, symbol: &Symbol) -> Graph {
    let mut whole = graph.clone();
    let mut nodes = Vec::new();
    for wide in kept.wide.keys() {
        for lane in [0, 1, 2, 2] {
            nodes.push(NodeId(whole.nodes.len() as u32));
            whole.nodes.push(Node::Lane(*wide, lane));
            whole.section_of.push(0);
        }
    }
    nodes.extend(kept.numbers.keys());
    // The last row is full.
    let last = nodes.last().copied();
    nodes.extend(last.into_iter().cycle().take(symbol.len() - nodes.len()));
    whole.name = format!("prepare_{}", graph.name);
    whole.meaning = format!("what follows from the parameters alone, for `{}`", graph.name);
    whole.equation = String::new();
    whole.outputs = vec![Output { symbol: symbol.clone(), nodes }];
    let flat = unpack(&whole);
    let mut parameters = Vec::new();
    let mut builder = Builder::with_sections_of(&flat);
    let mut images = Images::new(&flat);
    for (index, live) in flat.live().into_iter().enumerate() {
        if !live {
            continue;
        }
        builder.enter_section_index(flat.section_of[index]);
        let node = match images.node(&flat, &mut builder, flat.nodes[index]) {
            Node::Input { input, element } => {
                let place = parameters.iter().position(|known| *known == input).unwrap_or_else(|| {
                    parameters.push(input);
                    parameters.len() - 1
                });
                Node::Input { input: place as u32, element }
            }
            node => node,
        };
        let image = builder.insert(node);
        images.set(index, image);
    }
    let outputs = images.outputs(&flat);
    let inputs = parameters.into_iter().map(|input| flat.inputs[input as usize].clone()).collect();
    Graph { inputs, ..builder.finish(&flat, outputs) }
}

fn rest(graph: &Graph, kept: &Kept, symbol: &Symbol) -> Graph {
    let mut builder = Builder::with_sections_of(graph);
    let mut images = Images::new(graph);
    let input = graph.inputs.len() as u32;
    for (index, live) in graph.live().into_iter().enumerate() {
        if !live {
            continue;
        }
        builder.enter_section_index(graph.section_of[index]);
        let id = NodeId(index as u32);
        let image = kept.read(graph, &mut builder, input, id).unwrap_or_else(|| {
            let node = images.node(graph, &mut builder, graph.nodes[index]);
            builder.insert(node)
        });
        images.set(index, image);
    }
    let outputs = images.outputs(graph);
    let mut rest = builder.finish(graph, outputs);
    rest.name = format!("{}_{PREPARED}", graph.name);
    rest.inputs.push(symbol.clone());
    rest
}

/// The row of [`PREPARED`] that lanes read as a whole.
pub(crate) fn row(graph: &Graph, lanes: [NodeId; LANE_COUNT]) -> Option<usize> {
    let [first, second, third] = lanes.map(|id| match graph.nodes[id.index()] {
        Node::Input { input, element } if graph.inputs[input as usize].name == PREPARED => {
            Some(element as usize)
        }
        _ => None,
    });
    let first = first?;
    (first % ROW == 0 && second? == first + 1 && third? == first + 2).then_some(first / ROW)
}
