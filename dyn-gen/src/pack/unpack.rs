//! A graph in lanes as one without.

use crate::graph::{Builder, Graph, LANE_COUNT, Node, NodeId};

/// The same function without lanes: each operation in lanes as often as its lanes are read. Evaluates to the same bits.
pub fn unpack(graph: &Graph) -> Graph {
    let in_lanes = graph.in_lanes();
    let mut builder = Builder::with_sections_of(graph);
    let mut images: Vec<[NodeId; LANE_COUNT]> = Vec::with_capacity(graph.nodes.len());
    for (index, node) in graph.nodes.iter().enumerate() {
        builder.enter_section_index(graph.section_of[index]);
        let image = match *node {
            Node::Lanes(lanes) => std::array::from_fn(|lane| images[lanes[lane].index()][0]),
            Node::Lane(a, lane) => [images[a.index()][lane as usize]; LANE_COUNT],
            Node::Solution { solve, element } => {
                let mut system = graph.solves[solve as usize].clone();
                for id in system.operands_mut() {
                    *id = images[id.index()][0];
                }
                let solve = builder.solve(system);
                [builder.solution(solve, element); LANE_COUNT]
            }
            node => {
                let in_lane = |builder: &mut Builder, lane: usize| {
                    let of = |id: NodeId| images[id.index()][lane];
                    builder.insert(match node {
                        Node::Unary(op, a) => Node::Unary(op, of(a)),
                        Node::Binary(op, a, b) => Node::Binary(op, of(a), of(b)),
                        Node::Ternary(op, a, b, c) => Node::Ternary(op, of(a), of(b), of(c)),
                        leaf => leaf,
                    })
                };
                match in_lanes[index] {
                    true => std::array::from_fn(|lane| in_lane(&mut builder, lane)),
                    false => [in_lane(&mut builder, 0); LANE_COUNT],
                }
            }
        };
        images.push(image);
    }
    let outputs = graph.outputs.iter().map(|output| {
        let nodes = output.nodes.iter().map(|id| images[id.index()][0]).collect();
        crate::graph::Output { symbol: output.symbol.clone(), nodes }
    });
    let outputs = outputs.collect();
    builder.finish(graph, outputs)
}
