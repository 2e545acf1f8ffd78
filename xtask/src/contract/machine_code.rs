//! What a function can do at most, read from its machine code (x86-64, as `objdump` prints it): instructions, bytes of stack, functions
//! that it calls.
//!
//! Every way through a function is looked at, whatever its conditions. A way back to an instruction is a loop; the innermost loops of this
//! code go over legs, coordinates or columns.

use std::collections::{BTreeMap, BTreeSet, HashMap};

/// Most rounds of a loop over legs, coordinates or columns.
const SIX: u64 = 6;

/// Loops that are bounded by something else, from the outermost inwards: forward kinematics makes 30 steps, tries each 9 times.
const BOUNDS: [(&str, &[u64]); 1] = [("forward_kinematics", &[30, 9])];

/// Functions of one object by name.
pub struct MachineCode {
    functions: BTreeMap<String, Function>,
}

/// One function.
#[derive(Default)]
struct Function {
    instructions: Vec<Instruction>,
    /// Bytes of code.
    size: u64,
    /// Bytes that it puts on the stack itself.
    frame: u64,
}

/// Where an instruction leads.
struct Instruction {
    /// Instructions of the same function, by index.
    next: Vec<usize>,
    /// A function that is called, or jumped to at the end.
    callee: Option<String>,
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

    /// The most that a call of `function` takes; `None` if it can call itself.
    pub fn worst(&self, function: &str) -> Option<Worst> {
        self.within(function, &mut HashMap::new())
    }

    fn within(&self, name: &str, known: &mut HashMap<String, Option<Worst>>) -> Option<Worst> {
        let Some(function) = self.functions.get(name) else { return Some(Worst::default()) };
        if let Some(worst) = known.get(name) {
            return *worst;
        }
        // What calls itself meets this.
        known.insert(name.into(), None);
        let mut stack = 0;
        let mut costs = Vec::new();
        for instruction in &function.instructions {
            let callee = match &instruction.callee {
                Some(callee) => self.within(callee, known)?,
                None => Worst::default(),
            };
            stack = stack.max(callee.stack + if instruction.callee.is_some() { RETURN_ADDRESS } else { 0 });
            costs.push(1 + callee.instructions);
        }
        let bounds =
            BOUNDS.iter().find(|(part, _)| name.contains(part)).map_or(&[][..], |(_, bounds)| bounds);
        let all: BTreeSet<usize> = (0..costs.len()).collect();
        let instructions = longest(&function.instructions, &costs, &all, 0, bounds);
        let worst = Worst { code: function.size, stack: function.frame + stack, instructions };
        known.insert(name.into(), Some(worst));
        Some(worst)
    }
}

const RETURN_ADDRESS: u64 = 8;

impl Function {
    fn read(name: &str, lines: &[&str]) -> Self {
        let mut function = Self::default();
        let mut texts: Vec<(u64, &str, Option<&str>)> = Vec::new();
        for line in lines {
            let Some((address, text)) = line.trim_start().split_once(':') else { continue };
            let Ok(address) = u64::from_str_radix(address, 16) else { continue };
            match text.trim().strip_prefix("R_X86_64_") {
                // A relocation belongs to the instruction above it.
                Some(relocation) => {
                    if let Some((_, _, target)) = texts.last_mut() {
                        *target = relocation.split_whitespace().nth(1);
                    }
                }
                None => texts.push((address, text.trim(), None)),
            }
        }
        let indices: HashMap<u64, usize> =
            texts.iter().enumerate().map(|(index, text)| (text.0, index)).collect();
        let mut open = Vec::new();
        for (index, (_, text, relocation)) in texts.iter().enumerate() {
            let (operation, operands) = text.split_once(char::is_whitespace).unwrap_or((text, ""));
            let operands = operands.trim();
            function.frame += pushed(operation, operands);
            let inside = operands.split_once(" <").and_then(|(address, label)| {
                let address = u64::from_str_radix(address, 16).ok()?;
                let own = label.trim_end_matches('>').split('+').next() == Some(name);
                (own && relocation.is_none()).then(|| indices.get(&address).copied()).flatten()
            });
            let outside = || callee(operands, *relocation);
            let following = (index + 1 < texts.len()).then_some(index + 1);
            let (next, callee) = match operation {
                "jmp" | "notrack" if operands.contains('*') => {
                    open.push(index);
                    (vec![], None)
                }
                "jmp" => (inside.into_iter().collect(), if inside.is_some() { None } else { outside() }),
                "call" => (following.into_iter().collect(), outside()),
                "ret" | "ud2" | "hlt" => (vec![], None),
                jump if jump.starts_with('j') => (
                    following.into_iter().chain(inside).collect(),
                    if inside.is_some() { None } else { outside() },
                ),
                _ => (following.into_iter().collect(), None),
            };
            function.instructions.push(Instruction { next, callee });
        }
        function.size = texts.last().zip(texts.first()).map_or(0, |(last, first)| last.0 - first.0 + 1);
        // A jump through a table leads to what nothing else leads to.
        let targets: BTreeSet<usize> =
            function.instructions.iter().flat_map(|instruction| instruction.next.iter().copied()).collect();
        let lost: Vec<usize> = (1..texts.len()).filter(|index| !targets.contains(index)).collect();
        for index in open {
            function.instructions[index].next.clone_from(&lost);
        }
        function
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

/// The function that a call or a jump leads to.
fn callee(operands: &str, relocation: Option<&str>) -> Option<String> {
    let label = match relocation {
        // `name-0x4`; of a function in a section of its own the section, `.text.name`.
        Some(target) => target.rsplit_once("-0x").map_or(target, |(name, _)| name),
        None => operands.split_once('<')?.1.trim_end_matches('>').split('+').next()?,
    };
    Some(label.trim_start_matches(".text.").trim_start_matches("unlikely.").to_owned())
}

/// The most instructions on any way from `entry` through `nodes`; loops as often as `bounds` says for their depth, or six times.
fn longest(
    code: &[Instruction],
    costs: &[u64],
    nodes: &BTreeSet<usize>,
    entry: usize,
    bounds: &[u64],
) -> u64 {
    let order = components(code, nodes, entry);
    // Components come last ones first, so what follows a component is known before it.
    let (mut after, mut component_of) = (HashMap::new(), HashMap::new());
    let mut result = 0;
    for (number, component) in order.iter().enumerate() {
        component_of.extend(component.iter().map(|&node| (node, number)));
        let inside: BTreeSet<usize> = component.iter().copied().collect();
        let leaving =
            component.iter().flat_map(|&node| &code[node].next).filter(|next| !inside.contains(next));
        let later = leaving.filter_map(|next| after.get(component_of.get(next)?).copied()).max().unwrap_or(0);
        let is_loop = component.len() > 1 || component.iter().any(|node| code[*node].next.contains(node));
        let own = if is_loop {
            // Without the edges back to where the loop is entered, a round is a way through the rest.
            let first = *component.last().unwrap_or(&entry);
            let rounds = bounds.first().copied().unwrap_or(SIX);
            rounds * round(code, costs, &inside, first, bounds.get(1..).unwrap_or(&[]))
        } else {
            costs[component[0]]
        };
        after.insert(number, own + later);
        result = own + later;
    }
    result
}

/// The most instructions of one round of a loop that is entered at `first`.
fn round(code: &[Instruction], costs: &[u64], inside: &BTreeSet<usize>, first: usize, bounds: &[u64]) -> u64 {
    let mut rest = inside.clone();
    rest.remove(&first);
    let ways = code[first].next.iter().filter(|next| rest.contains(next));
    costs[first] + ways.map(|&next| longest(code, costs, &rest, next, bounds)).max().unwrap_or(0)
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

#[cfg(test)]
mod tests {
    use super::{MachineCode, Worst};

    const LISTING: &str = "
0000000000000000 <leaf>:
   0:\tpush   %rbx
   1:\tsub    $0x20,%rsp
   5:\tadd    %rax,%rbx
   8:\tjne    5 <leaf+0x5>
   a:\tret

0000000000000000 <caller>:
   0:\ttest   %rdi,%rdi
   3:\tje     e <caller+0xe>
   5:\tcall   a <caller+0xa>
\t\t\t6: R_X86_64_PLT32\t.text.leaf-0x4
   a:\tnop
   b:\tnop
   c:\tret
   e:\tjmp    13 <caller+0x13>
\t\t\tf: R_X86_64_PLT32\tmemcpy-0x4

0000000000000000 <again>:
   0:\tcall   0 <again>
   5:\tret
";

    #[test]
    fn loops_calls_and_frames_add_up() {
        let code = MachineCode::read(LISTING);
        // Two pushes of the frame, six rounds of two, the return.
        assert_eq!(code.worst("leaf"), Some(Worst { code: 11, stack: 40, instructions: 2 + 12 + 1 }));
        assert_eq!(code.worst("caller"), Some(Worst { code: 15, stack: 48, instructions: 3 + 15 + 3 }));
        assert_eq!(code.reached("caller").into_iter().collect::<Vec<_>>(), ["leaf", "memcpy"]);
        assert_eq!(code.footprint("caller", |_| true), Some((15 + 11, 48)));
        assert_eq!(code.footprint("caller", |name| name != "leaf"), Some((15, 0)));
        assert_eq!(code.footprint("again", |_| true), None);
    }

    #[test]
    fn what_calls_itself_has_no_worst_case() {
        assert_eq!(MachineCode::read(LISTING).worst("again"), None);
    }
}
