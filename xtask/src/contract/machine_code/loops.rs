//! The longest way through a function.

use std::collections::{BTreeSet, HashMap};

use super::function::Instruction;

/// The most instructions on any way from `entry` through `nodes`; loops as often as `bounds` says for their depth, the last for all that
/// are deeper. None where it says nothing, and where a loop cannot be left.
pub fn longest(
    code: &[Instruction],
    costs: &[u64],
    nodes: &BTreeSet<usize>,
    entry: usize,
    bounds: &[u64],
) -> Option<u64> {
    let order = components(code, nodes, entry);
    // Components come last ones first, so what follows a component is known before it.
    let (mut after, mut component_of) = (HashMap::new(), HashMap::new());
    let mut result = 0;
    for (number, component) in order.iter().enumerate() {
        component_of.extend(component.iter().map(|&node| (node, number)));
        let inside: BTreeSet<usize> = component.iter().copied().collect();
        let mut leaving = component
            .iter()
            .flat_map(|&node| &code[node].next)
            .filter(|next| !inside.contains(next))
            .peekable();
        let can_be_left = leaving.peek().is_some();
        let later = leaving.filter_map(|next| after.get(component_of.get(next)?).copied()).max().unwrap_or(0);
        let is_loop = component.len() > 1 || component.iter().any(|node| code[*node].next.contains(node));
        let own = if is_loop {
            let (rounds, deeper) = bounds.split_first().filter(|_| can_be_left)?;
            let deeper = if deeper.is_empty() { bounds } else { deeper };
            rounds * round(code, costs, component, deeper)?
        } else {
            costs[component[0]]
        };
        after.insert(number, own + later);
        result = own + later;
    }
    Some(result)
}

/// The most instructions of one round of a loop, whose first instruction stands last in `component`.
fn round(code: &[Instruction], costs: &[u64], component: &[usize], deeper: &[u64]) -> Option<u64> {
    // Without the edges back to where the loop is entered, a round is a way through the rest.
    let (&first, rest) = component.split_last()?;
    let rest: BTreeSet<usize> = rest.iter().copied().collect();
    let mut most = 0;
    for &next in code[first].next.iter().filter(|next| rest.contains(next)) {
        most = most.max(longest(code, costs, &rest, next, deeper)?);
    }
    Some(costs[first] + most)
}

/// Strongly connected components of `nodes` that `entry` leads to, each before those that lead to it, the node that was met first last in
/// its component (Tarjan's algorithm).
fn components(code: &[Instruction], nodes: &BTreeSet<usize>, entry: usize) -> Vec<Vec<usize>> {
    let (mut found, mut stack, mut numbers, mut lowest) =
        (Vec::new(), Vec::new(), HashMap::new(), HashMap::new());
    let mut done = BTreeSet::new();
    let mut work = vec![(entry, 0)];
    while let Some((node, edge)) = work.pop() {
        if edge == 0 {
            let number = numbers.len();
            numbers.insert(node, number);
            lowest.insert(node, number);
            stack.push(node);
        }
        match code[node].next.get(edge) {
            Some(next) if nodes.contains(next) => {
                work.push((node, edge + 1));
                if !numbers.contains_key(next) {
                    work.push((*next, 0));
                }
            }
            Some(_) => work.push((node, edge + 1)),
            None => {
                let ahead =
                    code[node].next.iter().filter(|next| nodes.contains(next) && !done.contains(*next));
                let least = ahead.map(|next| lowest[next].min(numbers[next])).chain([lowest[&node]]).min();
                let least = least.unwrap_or(lowest[&node]);
                lowest.insert(node, least);
                if least == numbers[&node] {
                    let at = stack.iter().rposition(|&member| member == node).unwrap_or(0);
                    let mut component = stack.split_off(at);
                    component.reverse();
                    done.extend(component.iter().copied());
                    found.push(component);
                }
            }
        }
    }
    found
}
