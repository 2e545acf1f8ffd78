//! Which function a call or a jump through a register leads to: where the register comes from, on every way.

use std::collections::BTreeSet;

use super::function::{Instruction, Line, named};

/// Where a call or a jump leads that does not name it.
#[derive(Clone, PartialEq, Eq)]
pub enum Callee {
    /// The function whose address the linker puts into a table of addresses.
    Named(String),
    /// Somewhere in the function itself, through a table of distances.
    Table,
    /// Anywhere.
    Unknown,
}

/// Who writes registers.
pub struct Registers<'a> {
    lines: &'a [Line<'a>],
    /// Instructions that lead to each.
    before: Vec<Vec<usize>>,
}

/// Registers that have names of their own, with the names of their parts.
const PARTS: [[&str; 5]; 8] = [
    ["rax", "eax", "ax", "al", "ah"],
    ["rbx", "ebx", "bx", "bl", "bh"],
    ["rcx", "ecx", "cx", "cl", "ch"],
    ["rdx", "edx", "dx", "dl", "dh"],
    ["rsi", "esi", "si", "sil", ""],
    ["rdi", "edi", "di", "dil", ""],
    ["rbp", "ebp", "bp", "bpl", ""],
    ["rsp", "esp", "sp", "spl", ""],
];

/// Registers that a call keeps.
const KEPT: [&str; 6] = ["rbx", "rbp", "r12", "r13", "r14", "r15"];

/// Operations whose last operand is only read.
const READING: [&str; 8] = ["cmp", "test", "ucomi", "comi", "vucomi", "vcomi", "push", "j"];

/// Operations that write registers which they do not name.
const IMPLICIT: [&str; 8] = ["mul", "imul", "div", "idiv", "cqto", "cltd", "rep", "cpuid"];

impl<'a> Registers<'a> {
    pub fn new(lines: &'a [Line<'a>], instructions: &[Instruction]) -> Self {
        let mut before = vec![Vec::new(); lines.len()];
        for (index, instruction) in instructions.iter().enumerate() {
            for &next in &instruction.next {
                before[next].push(index);
            }
        }
        Self { lines, before }
    }

    /// Where the call or jump at `index` leads.
    pub fn callee(&self, index: usize) -> Callee {
        let line = &self.lines[index];
        let operand = line.parts().1.trim_start_matches('*').split_whitespace().next().unwrap_or_default();
        match (line.relocation, operand.strip_prefix('%').map(whole)) {
            (Some(target), _) if line.is_indirect => Callee::Named(named(target)),
            (Some(_), _) if operand.contains("(,") => Callee::Table,
            (None, Some(register)) => self.value(index, register),
            _ => Callee::Unknown,
        }
    }

    /// What `register` holds at `index`, if it is the same on every way there.
    fn value(&self, index: usize, register: &str) -> Callee {
        let (mut seen, mut waiting) = (BTreeSet::new(), vec![index]);
        let mut found: Option<Callee> = None;
        while let Some(at) = waiting.pop() {
            // The caller's.
            if self.before[at].is_empty() {
                return Callee::Unknown;
            }
            for &before in &self.before[at] {
                if !seen.insert(before) {
                    continue;
                }
                match self.written(before, register) {
                    None => waiting.push(before),
                    Some(value) if found.as_ref().is_none_or(|found| *found == value) => found = Some(value),
                    Some(_) => return Callee::Unknown,
                }
            }
        }
        found.unwrap_or(Callee::Unknown)
    }

    /// What the instruction at `index` leaves in `register`; none if it leaves it alone.
    fn written(&self, index: usize, register: &str) -> Option<Callee> {
        let line = &self.lines[index];
        let (operation, operands) = line.parts();
        if operation == "call" {
            return (!KEPT.contains(&register)).then_some(Callee::Unknown);
        }
        if IMPLICIT.contains(&operation) && ["rax", "rcx", "rdx", "rsi", "rdi"].contains(&register) {
            return Some(Callee::Unknown);
        }
        let is_named = |operand: &str| operand.strip_prefix('%').map(whole) == Some(register);
        if operation.starts_with("xchg") {
            return operands.split(',').any(is_named).then_some(Callee::Unknown);
        }
        let last =
            operands.split('#').next().unwrap_or_default().trim().rsplit(',').next().unwrap_or_default();
        if READING.iter().any(|reading| operation.starts_with(reading)) || !is_named(last) {
            return None;
        }
        Some(match (operation, line.relocation) {
            ("mov", Some(target)) if line.is_indirect => Callee::Named(named(target)),
            // The table's address and a distance from it.
            ("add", None) if operands.starts_with('%') => Callee::Table,
            _ => Callee::Unknown,
        })
    }
}

/// The register that a name is a part of.
fn whole(name: &str) -> &str {
    match PARTS.iter().find(|parts| parts.contains(&name)) {
        Some(parts) => parts[0],
        None => name.trim_end_matches(['d', 'w', 'b']),
    }
}
