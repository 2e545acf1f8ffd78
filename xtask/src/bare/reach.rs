//! What the functions of a library can reach, directly or through others.

use std::collections::{BTreeSet, HashMap};

use super::archive::Archive;
use crate::runner::Failure;

/// What compilers call where they copy or compare memory; every C library has them, and so has `core` without one.
const MEMORY_FUNCTIONS: [&str; 5] = ["memcpy", "memmove", "memset", "memcmp", "bcmp"];

/// Names that only a panic has.
const PANICS: [&str; 3] = ["panicking::", "begin_unwind", "panic_fmt"];

/// A library, measured.
#[derive(Debug)]
pub struct Measured {
    /// Target and number type.
    pub title: String,
    /// Its functions.
    pub functions: Vec<Function>,
    /// Bytes of code and constants of all functions together: what they share is counted once.
    pub together: (u64, u64),
}

/// An exported function.
#[derive(Debug)]
pub struct Function {
    /// Its name.
    pub name: String,
    /// Bytes of code that it can reach.
    pub code: u64,
    /// Bytes of constants that it can reach.
    pub constants: u64,
    /// Bytes of stack that it needs at most; none if a frame is not known.
    pub stack: Option<u64>,
    /// A function that can call itself.
    pub recursion: Option<String>,
    /// A panic, and the functions on the way there.
    pub panic: Option<String>,
    /// What it needs besides the library.
    pub externals: BTreeSet<String>,
}

/// Measures every exported function.
pub fn measure(title: &str, archive: &Archive) -> Result<Measured, Failure> {
    let exported = archive.globals("dyn_");
    if exported.is_empty() {
        return Err(Failure::new(format!("{title}: no function dyn_... in the library"), ""));
    }
    let mut functions = Vec::new();
    let mut all = BTreeSet::new();
    for (name, start) in exported {
        let mut search = Search::new(archive);
        let stack = search.visit(start);
        if archive.sections[start].stack.is_none() {
            return Err(Failure::new(format!("{title}: the stack frame of {name} is not known"), ""));
        }
        let (code, constants) = bytes(archive, search.depths.keys());
        functions.push(Function {
            name: name.into(),
            code,
            constants,
            stack,
            recursion: search.recursion,
            panic: search.panic,
            externals: search.externals,
        });
        all.extend(search.depths.into_keys());
    }
    Ok(Measured { title: title.into(), functions, together: bytes(archive, all.iter()) })
}

/// Bytes of code and of constants.
fn bytes<'a>(archive: &Archive, sections: impl Iterator<Item = &'a usize>) -> (u64, u64) {
    sections.map(|&index| &archive.sections[index]).fold((0, 0), |(code, constants), section| {
        if section.is_code { (code + section.size, constants) } else { (code, constants + section.size) }
    })
}

/// Depth-first, from one function.
struct Search<'a> {
    archive: &'a Archive,
    /// Stack below each section that is done with.
    depths: HashMap<usize, Option<u64>>,
    /// From the function to where the search stands.
    path: Vec<usize>,
    recursion: Option<String>,
    panic: Option<String>,
    externals: BTreeSet<String>,
}

impl<'a> Search<'a> {
    fn new(archive: &'a Archive) -> Self {
        Self {
            archive,
            depths: HashMap::new(),
            path: Vec::new(),
            recursion: None,
            panic: None,
            externals: BTreeSet::new(),
        }
    }

    /// Stack that `index` and what it refers to need. A constant needs what it refers to: it may hold a table of functions.
    fn visit(&mut self, index: usize) -> Option<u64> {
        if let Some(depth) = self.depths.get(&index) {
            return *depth;
        }
        let section = &self.archive.sections[index];
        if self.path.contains(&index) {
            if section.is_code {
                self.recursion.get_or_insert_with(|| self.archive.sections[index].names.join(", "));
            }
            return Some(0);
        }
        self.path.push(index);
        if section.names.iter().any(|name| PANICS.iter().any(|panic| name.contains(panic))) {
            let names = self.path.iter().filter_map(|&step| self.archive.sections[step].names.first());
            let way = names.map(String::as_str).collect::<Vec<_>>().join(" -> ");
            self.panic.get_or_insert(way);
        }
        self.externals.extend(section.externals.iter().cloned());
        let mut below = Some(0);
        for &reference in &section.references {
            let depth = self.visit(reference);
            below = below.zip(depth).map(|(below, depth): (u64, u64)| below.max(depth));
        }
        self.path.pop();
        let own = if section.is_code { section.stack } else { Some(0) };
        let depth = own.zip(below).map(|(own, below)| own + below);
        self.depths.insert(index, depth);
        depth
    }
}

impl Measured {
    /// For machines whose code does not tell calls from jumps.
    pub fn forget_recursion(&mut self) {
        for function in &mut self.functions {
            function.recursion = None;
        }
    }

    /// A table, and what all functions have in common.
    pub fn text(&self) -> String {
        let mut text = format!(
            "\n{}: bytes\n{:<32}{:>10}{:>10}{:>10}\n",
            self.title, "function", "code", "constants", "stack"
        );
        for function in &self.functions {
            let stack = function.stack.map_or("?".into(), |stack| stack.to_string());
            text +=
                &format!("{:<32}{:>10}{:>10}{stack:>10}\n", function.name, function.code, function.constants);
        }
        let (code, constants) = self.together;
        text += &format!("{:<32}{code:>10}{constants:>10}\n", "all together");
        let externals: BTreeSet<_> = self.functions.iter().flat_map(|function| &function.externals).collect();
        let externals: Vec<_> = externals.into_iter().map(String::as_str).collect();
        if self.defects().is_empty() {
            text += &format!(
                "no panic reachable; from outside: {}\n\n",
                if externals.is_empty() { "nothing".into() } else { externals.join(", ") }
            );
        }
        text
    }

    /// What must not be, in words.
    pub fn defects(&self) -> Vec<String> {
        let mut defects = Vec::new();
        for function in &self.functions {
            let name = &function.name;
            if let Some(way) = &function.panic {
                defects.push(format!("{name} can panic: {way}"));
            }
            if let Some(which) = &function.recursion {
                defects.push(format!("{name} can recurse: {which}"));
            }
            let strange = function.externals.iter().filter(|external| {
                !MEMORY_FUNCTIONS.contains(&external.as_str())
                    && !external.starts_with("_GLOBAL_OFFSET_TABLE_")
            });
            defects.extend(strange.map(|external| format!("{name} needs {external}")));
        }
        defects
    }
}

/// The measurements for scripts.
pub fn json(libraries: &[Measured]) -> String {
    let libraries: Vec<String> = libraries
        .iter()
        .map(|library| {
            let functions: Vec<String> = library
                .functions
                .iter()
                .map(|function| {
                    let stack = function.stack.map_or("null".into(), |stack| stack.to_string());
                    format!(
                        "{{\"name\":{:?},\"code\":{},\"constants\":{},\"stack\":{stack}}}",
                        function.name, function.code, function.constants
                    )
                })
                .collect();
            format!("{{\"library\":{:?},\"functions\":[{}]}}", library.title, functions.join(","))
        })
        .collect();
    format!("[{}]", libraries.join(","))
}
