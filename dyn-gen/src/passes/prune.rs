//! Removes what no output needs.

use crate::graph::{Graph, Node};

use super::rewrite::rewrite;

/// Keeps only live nodes and solves, the sections they belong to, and of the parameters among the inputs those that are read.
///
/// States stay in the signature even if nothing reads them: a function has one signature for every platform.
pub fn prune(graph: &Graph) -> Graph {
    let graph = rewrite(graph, |builder, _, node| builder.insert(node));
    let mut read = graph.inputs.iter().map(|symbol| !symbol.parameter).collect::<Vec<_>>();
    for node in &graph.nodes {
        if let Node::Input { input, .. } = node {
            read[*input as usize] = true;
        }
    }
    let new_input = renumber(&read);
    let mut section_used = vec![false; graph.sections.len()];
    section_used[0] = true;
    graph.section_of.iter().for_each(|section| section_used[*section as usize] = true);
    let new_section = renumber(&section_used);

    let mut pruned = graph.clone();
    pruned.inputs = keep(graph.inputs, &read);
    pruned.sections = keep(graph.sections, &section_used);
    pruned.section_of.iter_mut().for_each(|section| *section = new_section[*section as usize]);
    for node in &mut pruned.nodes {
        if let Node::Input { input, .. } = node {
            *input = new_input[*input as usize];
        }
    }
    pruned
}

/// The index of each kept item among those kept.
fn renumber(kept: &[bool]) -> Vec<u32> {
    let mut next = 0;
    let number = |kept: &bool| {
        let index = next;
        next += u32::from(*kept);
        index
    };
    kept.iter().map(number).collect()
}

fn keep<T>(items: Vec<T>, kept: &[bool]) -> Vec<T> {
    items.into_iter().zip(kept).filter(|(_, kept)| **kept).map(|(item, _)| item).collect()
}
