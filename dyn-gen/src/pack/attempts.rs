//! Attempts at linear systems, and the systems, as they stand in lanes.

use super::partition::Partition;
use crate::graph::{Builder, Graph, LANE_COUNT, Node, NodeId};
use crate::passes::{Images, simplified};

/// The same graph, in which an attempt and each row of its matrix consist of the lanes of two values, the columns side by side as
/// the partition says. Signs, that passes move to single numbers, return to the lanes.
pub fn side_by_side(graph: &Graph, partition: &Partition) -> Graph {
    if graph.solves.iter().all(|solve| solve.attempt.is_empty()) {
        return graph.clone();
    }
    let mut builder = Builder::with_sections_of(graph);
    let mut images = Images::new(graph);
    for (index, live) in graph.live().into_iter().enumerate() {
        if !live {
            continue;
        }
        builder.enter_section_index(graph.section_of[index]);
        let image = match graph.nodes[index] {
            Node::Solution { solve, element } if !graph.solves[solve as usize].attempt.is_empty() => {
                let mut system = images.solve(&graph.solves[solve as usize]);
                let n = system.attempt.len();
                for row in system.matrix.chunks_exact_mut(n).chain([&mut system.attempt[..]]) {
                    lanes_of(&mut builder, row, &partition.legs);
                }
                let solve = builder.solve(system);
                builder.solution(solve, element)
            }
            node => {
                let node = images.node(graph, &mut builder, node);
                builder.insert(node)
            }
        };
        images.set(index, image);
    }
    let outputs = images.outputs(graph);
    builder.finish(graph, outputs)
}

/// Puts the lanes of values that have them in the place of numbers.
fn lanes_of(builder: &mut Builder, numbers: &mut [NodeId], order: &[usize]) {
    for places in order.chunks_exact(LANE_COUNT) {
        let three = std::array::from_fn(|lane| numbers[places[lane]]);
        let wide = simplified(builder, Node::Lanes(three));
        if builder.has_lanes(wide) {
            for (lane, place) in places.iter().enumerate() {
                numbers[*place] = builder.insert(Node::Lane(wide, lane as u8));
            }
        }
    }
}
