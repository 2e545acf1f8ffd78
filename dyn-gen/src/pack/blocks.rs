//! Linear systems of six equations, written out in 3 x 3 blocks: what stands side by side in them.

use super::mapped;
use super::partition::Partition;
use crate::graph::{Builder, Graph, Group, Node, NodeId, Solve, SolveKind};
use crate::passes::{Images, attempted, in_blocks, symmetric_triples};

/// Writes every system of six equations out, general ones with the columns of the partition. The matrix of a symmetric one
/// stands in lanes as its blocks do, not row by row.
///
/// What comes out is an attempt where parameters at run time reach the matrix. General systems are left for pivoting at run
/// time if nothing was known to choose the partition by.
pub fn expand(graph: &Graph, groups: Vec<Group>, partition: &Partition) -> (Graph, Vec<Group>) {
    let groups = groups.into_iter().flat_map(|group| as_blocks(graph, group)).collect();
    let mut builder = Builder::with_sections_of(graph);
    let mut images = Images::new(graph);
    let mut solutions: Vec<Option<(Vec<NodeId>, Vec<Group>)>> = vec![None; graph.solves.len()];
    let mut order = Vec::new();
    for (index, live) in graph.live().into_iter().enumerate() {
        if !live {
            continue;
        }
        builder.enter_section_index(graph.section_of[index]);
        let node = graph.nodes[index];
        let image = match node {
            Node::Solution { solve, element } if expandable(&graph.solves[solve as usize], partition) => {
                let system = images.solve(&graph.solves[solve as usize]);
                let solution = solutions[solve as usize].get_or_insert_with(|| {
                    order.push(solve as usize);
                    match partition.examined && system.kind == SolveKind::General {
                        true => attempted(&mut builder, system, &partition.legs),
                        false => in_blocks(&mut builder, &system, &partition.legs),
                    }
                });
                solution.0[element as usize]
            }
            node => {
                let node = images.node(graph, &mut builder, node);
                builder.insert(node)
            }
        };
        images.set(index, image);
    }
    let outputs = images.outputs(graph);
    // A system's own groups come right before the first group that reads its solution: in the order of their nodes.
    let mut groups = mapped(groups, |node| images.get(node));
    for solve in order {
        let (solution, own) =
            solutions[solve].take().expect("it was put in the order when it was written out");
        let first = solution.iter().min().copied();
        let place = groups
            .iter()
            .position(|group| group.nodes().iter().max().copied() >= first)
            .unwrap_or(groups.len());
        groups.splice(place..place, own);
    }
    (builder.finish(graph, outputs), groups)
}

/// The group, or if it is the matrix of a symmetric system the triples that its blocks consist of.
fn as_blocks(graph: &Graph, group: Group) -> Vec<Group> {
    let is_matrix = |solve: &&Solve| {
        solve.kind == SolveKind::SymmetricPositiveDefinite
            && solve.right_hand_side.len() == 6
            && solve.matrix == group.nodes()
    };
    match graph.solves.iter().find(is_matrix) {
        None => vec![group],
        Some(solve) => symmetric_triples(solve)
            .map(|nodes| Group::Array { shape: vec![3], nodes: nodes.to_vec() })
            .into(),
    }
}

fn expandable(solve: &Solve, partition: &Partition) -> bool {
    solve.right_hand_side.len() == 6
        && (solve.kind == SolveKind::SymmetricPositiveDefinite || partition.examined || partition.states > 0)
}
