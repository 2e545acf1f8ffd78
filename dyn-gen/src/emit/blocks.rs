//! Bodies cut into blocks: rustc 1.95 crashes on a function with some 3 000 nested scopes when debug info is on, and
//! every `let` opens a scope. A block `let (t1, t7) = { ... };` closes its scopes again and hands on what is still used.

use std::collections::{HashMap, HashSet};
use std::ops::Range;

use super::schedule::{Statement, Step, Value};

/// Most statements in one block.
const LIMIT: usize = 1000;

/// Consecutive statements and the values they hand on.
#[derive(Clone, PartialEq, Debug)]
pub struct Block {
    /// Which statements.
    pub statements: Range<usize>,
    /// Values defined here and read by a later block, in order of definition.
    pub live: Vec<Value>,
}

/// Cuts `statements` into blocks of at most [`LIMIT`], at the last change of section in a block's second half if there
/// is one. A body that needs no cut is a single block.
pub fn blocks(statements: &[Statement]) -> Vec<Block> {
    let mut blocks = Vec::new();
    let mut start = 0;
    while start < statements.len() {
        let end = if statements.len() - start <= LIMIT {
            statements.len()
        } else {
            (start + LIMIT / 2..=start + LIMIT)
                .rev()
                .find(|&cut| statements[cut - 1].section != statements[cut].section)
                .unwrap_or(start + LIMIT)
        };
        blocks.push(Block { statements: start..end, live: Vec::new() });
        start = end;
    }
    let mut defined_in = HashMap::new();
    let mut handed_on: HashSet<Value> = HashSet::new();
    for (number, block) in blocks.iter().enumerate() {
        for statement in &statements[block.statements.clone()] {
            if let Step::Define(value) = statement.step {
                defined_in.insert(value, number);
            }
            handed_on.extend(statement.reads.iter().filter(|value| defined_in[*value] != number));
        }
    }
    for block in &mut blocks {
        block.live = statements[block.statements.clone()]
            .iter()
            .filter_map(|statement| match statement.step {
                Step::Define(value) if handed_on.contains(&value) => Some(value),
                _ => None,
            })
            .collect();
    }
    blocks
}
