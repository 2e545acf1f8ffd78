//! One function, as `objdump` prints it.

use std::collections::{BTreeSet, HashMap};

use super::registers::{Callee, Registers};

/// One function.
#[derive(Default)]
pub struct Function {
    pub instructions: Vec<Instruction>,
    /// Bytes of code.
    pub size: u64,
    /// Bytes that it puts on the stack itself.
    pub frame: u64,
    /// The first instruction that calls a function which the code does not name.
    pub unknown_callee: Option<String>,
}

/// Where an instruction leads.
pub struct Instruction {
    /// Instructions of the same function, by index.
    pub next: Vec<usize>,
    /// A function that is called, or jumped to at the end.
    pub callee: Option<String>,
}

/// An instruction as it is printed.
pub struct Line<'a> {
    address: u64,
    /// Operation and operands.
    pub text: &'a str,
    /// What the linker puts in, a name with an offset.
    pub relocation: Option<&'a str>,
    /// Whether that is the address of a place that holds the name's address.
    pub is_indirect: bool,
}

impl Function {
    pub fn read(name: &str, lines: &[&str]) -> Self {
        let mut function = Self::default();
        let lines = read_lines(lines);
        let indices: HashMap<u64, usize> =
            lines.iter().enumerate().map(|(index, line)| (line.address, index)).collect();
        let mut indirect = Vec::new();
        for (index, line) in lines.iter().enumerate() {
            let (operation, operands) = line.parts();
            function.frame += pushed(operation, operands);
            let inside = operands.split_once(" <").and_then(|(address, label)| {
                let address = u64::from_str_radix(address, 16).ok()?;
                let own = label.trim_end_matches('>').split('+').next() == Some(name);
                (own && line.relocation.is_none()).then(|| indices.get(&address).copied()).flatten()
            });
            let outside = || if inside.is_some() { None } else { callee(operands, line.relocation) };
            let following = (index + 1 < lines.len()).then_some(index + 1);
            let (next, callee) = match operation {
                "jmp" => (inside.into_iter().collect(), outside()),
                "call" => (following.into_iter().collect(), callee(operands, line.relocation)),
                "ret" | "ud2" | "hlt" => (vec![], None),
                jump if jump.starts_with('j') => (following.into_iter().chain(inside).collect(), outside()),
                _ => (following.into_iter().collect(), None),
            };
            if operands.starts_with('*') {
                indirect.push(index);
            }
            function.instructions.push(Instruction { next, callee });
        }
        function.size =
            lines.last().zip(lines.first()).map_or(0, |(last, first)| last.address - first.address + 1);
        function.resolve(&lines, &indirect);
        function
    }

    /// Finds out where calls and jumps through registers and memory lead.
    fn resolve(&mut self, lines: &[Line<'_>], indirect: &[usize]) {
        // A jump through a table leads to what nothing else leads to.
        let targets: BTreeSet<usize> =
            self.instructions.iter().flat_map(|instruction| instruction.next.iter().copied()).collect();
        let lost: Vec<usize> = (1..lines.len()).filter(|index| !targets.contains(index)).collect();
        let is_jump = |index: usize| lines[index].parts().0 == "jmp";
        let registers = Registers::new(lines, &self.instructions);
        let found: Vec<(usize, Callee)> =
            indirect.iter().map(|&index| (index, registers.callee(index))).collect();
        for (index, callee) in found {
            match callee {
                Callee::Named(name) => self.instructions[index].callee = Some(name),
                Callee::Table if is_jump(index) && !lost.is_empty() => {
                    self.instructions[index].next.clone_from(&lost);
                }
                Callee::Table | Callee::Unknown => {
                    self.unknown_callee.get_or_insert_with(|| lines[index].text.to_owned());
                }
            }
        }
    }
}

/// Instructions, each with its relocation, which is printed below it.
fn read_lines<'a>(lines: &[&'a str]) -> Vec<Line<'a>> {
    let mut read: Vec<Line<'_>> = Vec::new();
    for line in lines {
        let Some((address, text)) = line.trim_start().split_once(':') else { continue };
        let Ok(address) = u64::from_str_radix(address, 16) else { continue };
        match text.trim().strip_prefix("R_X86_64_") {
            Some(relocation) => {
                if let Some(line) = read.last_mut() {
                    line.relocation = relocation.split_whitespace().nth(1);
                    line.is_indirect = relocation.contains("GOTPCREL");
                }
            }
            None => read.push(Line { address, text: text.trim(), relocation: None, is_indirect: false }),
        }
    }
    read
}

impl<'a> Line<'a> {
    /// Operation and operands, without a hint to the processor about jumps.
    pub fn parts(&self) -> (&'a str, &'a str) {
        let text = self.text.strip_prefix("notrack ").unwrap_or(self.text);
        let (operation, operands) = text.split_once(char::is_whitespace).unwrap_or((text, ""));
        (operation, operands.trim())
    }
}

/// Bytes that an instruction puts on the stack.
fn pushed(operation: &str, operands: &str) -> u64 {
    match operation {
        "push" => 8,
        "sub" => operands
            .strip_prefix("$0x")
            .and_then(|rest| rest.strip_suffix(",%rsp"))
            .and_then(|digits| u64::from_str_radix(digits, 16).ok())
            .unwrap_or(0),
        _ => 0,
    }
}

/// The function that a call or a jump names.
fn callee(operands: &str, relocation: Option<&str>) -> Option<String> {
    if operands.starts_with('*') {
        return None;
    }
    let label = || operands.split_once('<')?.1.trim_end_matches('>').split('+').next();
    relocation.or_else(label).map(named)
}

/// The function of a relocation: `name-0x4`; of a function in a section of its own the section, `.text.name`.
pub fn named(target: &str) -> String {
    let label = target.rsplit_once("-0x").map_or(target, |(name, _)| name);
    label.trim_start_matches(".text.").trim_start_matches("unlikely.").to_owned()
}
