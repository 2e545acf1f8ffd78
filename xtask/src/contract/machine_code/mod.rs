//! What a function can do at most, read from its machine code (x86-64, as `objdump` prints it): instructions, bytes of stack, functions
//! that it calls.
//!
//! Every way through a function is looked at, whatever its conditions. A way back to an instruction is a loop; how often it is gone
//! round the code does not say, so every function that may have loops is named with their bounds, and no other may have any.
//!
//! | module | holds |
//! |-|-|
//! | `function` | a function's instructions, read from the listing |
//! | `registers` | which function a call through a register leads to |
//! | `loops` | the longest way through a function |

mod function;
mod loops;
mod registers;
#[cfg(test)]
mod tests;

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::fmt;

use function::Function;
use loops::longest;

/// Loops of a function that are known to end.
#[derive(Clone, Copy)]
pub struct Bounds {
    /// The function, as `rustc_demangle` writes it without hash.
    pub function: &'static str,
    /// Most rounds of loops, from the outermost inwards. Still deeper ones, of which the compiler makes some that the source does not
    /// have, as the last.
    pub rounds: &'static [u64],
    /// Why they end.
    pub reason: &'static str,
}

/// Why a call has no bound.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Unbounded {
    /// A function can call itself.
    Recursion(String),
    /// A function has a loop whose rounds are not bounded.
    Loop(String),
    /// A function calls what a register or memory says: the instruction.
    UnknownCallee(String, String),
}

/// Functions of one object by name.
pub struct MachineCode {
    functions: BTreeMap<String, Function>,
}

/// The most that a call of a function can take.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Worst {
    /// Bytes of the function's own code.
    pub code: u64,
    /// Bytes of stack along the deepest chain of calls, return addresses included.
    pub stack: u64,
    /// Instructions, those of all calls included; of functions outside of the object, such as memcpy, the call alone.
    pub instructions: u64,
}

impl MachineCode {
    /// Reads what `objdump --disassemble --reloc --no-show-raw-insn` prints.
    pub fn read(listing: &str) -> Self {
        let mut functions = BTreeMap::new();
        let mut lines = listing.lines().peekable();
        while let Some(line) = lines.next() {
            let Some((_, name)) = line.strip_suffix(">:").and_then(|line| line.split_once(" <")) else {
                continue;
            };
            let mut body = Vec::new();
            while let Some(line) = lines.next_if(|line| !line.is_empty() && !line.ends_with(">:")) {
                body.push(line);
            }
            functions.insert(name.to_owned(), Function::read(name, &body));
        }
        Self { functions }
    }

    /// Names of all functions.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.functions.keys().map(String::as_str)
    }

    /// Bytes of code of a function and of everything that it calls and `counted` says to count, and the bytes of stack along the
    /// deepest chain of these calls; `None` if the function is not there or can call itself.
    pub fn footprint(&self, function: &str, counted: impl Fn(&str) -> bool) -> Option<(u64, u64)> {
        let inside = |name: &String| self.functions.contains_key(name) && counted(name);
        let (mut code, mut waiting) = (0, vec![function.to_owned()]);
        let mut reached: BTreeSet<String> = BTreeSet::from([function.to_owned()]);
        while let Some(name) = waiting.pop() {
            let own = self.functions.get(&name)?;
            code += own.size;
            let callees = own.instructions.iter().filter_map(|instruction| instruction.callee.as_ref());
            for callee in callees.filter(|&name| inside(name)) {
                if reached.insert(callee.clone()) {
                    waiting.push(callee.clone());
                }
            }
        }
        Some((code, self.deepest(function, &inside, &mut Vec::new())?))
    }

    fn deepest(&self, name: &str, inside: &impl Fn(&String) -> bool, above: &mut Vec<String>) -> Option<u64> {
        if above.iter().any(|caller| caller == name) {
            return None;
        }
        let function = self.functions.get(name)?;
        above.push(name.to_owned());
        let callees = function.instructions.iter().filter_map(|instruction| instruction.callee.as_ref());
        let callees: BTreeSet<&String> = callees.filter(|&name| inside(name)).collect();
        let mut most = 0;
        for callee in callees {
            most = most.max(RETURN_ADDRESS + self.deepest(callee, inside, above)?);
        }
        above.pop();
        Some(function.frame + most)
    }

    /// Names that `function` and what it calls call, inside the object or not.
    pub fn reached(&self, function: &str) -> BTreeSet<String> {
        let (mut reached, mut waiting) = (BTreeSet::new(), vec![function.to_owned()]);
        while let Some(name) = waiting.pop() {
            let instructions = self.functions.get(&name).map_or(&[][..], |function| &function.instructions);
            for callee in instructions.iter().filter_map(|instruction| instruction.callee.as_ref()) {
                if reached.insert(callee.clone()) {
                    waiting.push(callee.clone());
                }
            }
        }
        reached
    }

    /// The most that a call of `function` takes, where loops of named functions are gone round as often as their bounds say.
    pub fn worst(&self, function: &str, bounds: &[Bounds]) -> Result<Worst, Unbounded> {
        self.within(function, bounds, &mut HashMap::new())
    }

    fn within(
        &self,
        name: &str,
        bounds: &[Bounds],
        known: &mut HashMap<String, Option<Worst>>,
    ) -> Result<Worst, Unbounded> {
        let Some(function) = self.functions.get(name) else { return Ok(Worst::default()) };
        if let Some(worst) = known.get(name) {
            return worst.ok_or_else(|| Unbounded::Recursion(demangled(name)));
        }
        // What calls itself meets this.
        known.insert(name.into(), None);
        if let Some(instruction) = &function.unknown_callee {
            return Err(Unbounded::UnknownCallee(demangled(name), instruction.clone()));
        }
        let mut stack = 0;
        let mut costs = Vec::new();
        for instruction in &function.instructions {
            let callee = match &instruction.callee {
                Some(callee) => self.within(callee, bounds, known)?,
                None => Worst::default(),
            };
            stack = stack.max(callee.stack + if instruction.callee.is_some() { RETURN_ADDRESS } else { 0 });
            costs.push(1 + callee.instructions);
        }
        let own = demangled(name);
        let rounds = bounds.iter().find(|bounds| bounds.function == own).map_or(&[][..], |own| own.rounds);
        let all: BTreeSet<usize> = (0..costs.len()).collect();
        let instructions =
            longest(&function.instructions, &costs, &all, 0, rounds).ok_or(Unbounded::Loop(own))?;
        let worst = Worst { code: function.size, stack: function.frame + stack, instructions };
        known.insert(name.into(), Some(worst));
        Ok(worst)
    }
}

const RETURN_ADDRESS: u64 = 8;

/// Without hash.
fn demangled(name: &str) -> String {
    format!("{:#}", rustc_demangle::demangle(name))
}

impl fmt::Display for Unbounded {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Recursion(function) => write!(f, "{function} can call itself"),
            Self::Loop(function) => write!(f, "{function} has a loop without a known bound"),
            Self::UnknownCallee(function, instruction) => {
                write!(f, "{function} calls what the code does not name: {instruction}")
            }
        }
    }
}
