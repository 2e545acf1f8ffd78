#![doc = include_str!("README.md")]

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::fmt;

use serde::Deserialize;
use serde::de::{self, SeqAccess, Visitor};
use serde_json::Number;

use super::program::{Program, Provenance, Role};
use super::validate::validate;

/// Value of the member `format`.
pub const FORMAT: &str = "dyn-gen graph";
/// Value of the member `version`.
pub const VERSION: u64 = 1;
/// Most elements an array may have: far above any mechanism, low enough that a damaged file cannot exhaust memory.
pub const MOST_ELEMENTS: usize = 1 << 16;
/// Most unknowns a linear system may have. Written out it takes some n^3 operations, and the search for an order of its pivots
/// more.
pub const MOST_UNKNOWNS: usize = 12;

/// Why a graph file is refused.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error, miette::Diagnostic)]
#[error("{place}: {problem}")]
#[diagnostic(code(dyn_gen::graph_file), help("{remedy}"))]
pub struct FormatError {
    /// Function, graph and node, or line and column.
    pub place: String,
    /// What is wrong.
    pub problem: String,
    /// What to do about it.
    pub remedy: String,
}

impl FormatError {
    pub(super) fn new(
        place: impl fmt::Display,
        problem: impl fmt::Display,
        remedy: impl fmt::Display,
    ) -> FormatError {
        FormatError { place: place.to_string(), problem: problem.to_string(), remedy: remedy.to_string() }
    }
}

impl Program {
    /// Reads and checks a graph file.
    pub fn from_json(text: &str) -> Result<Program, FormatError> {
        let header: Header = serde_json::from_str(text).map_err(syntax_error)?;
        if header.format != FORMAT {
            return Err(FormatError::new(
                "graph file",
                format_args!("format is `{}`, expected `{FORMAT}`", header.format),
                "give the file that `cargo regen --derive` writes, codegen/graphs/<leg type>.json",
            ));
        }
        if header.version != VERSION {
            return Err(FormatError::new(
                "graph file",
                format_args!(
                    "version {} of the format, but this dyn-gen reads version {VERSION}",
                    header.version
                ),
                "derive the graph again with the codegen folder of this release: `cargo regen --derive`",
            ));
        }
        validate(serde_json::from_str(text).map_err(syntax_error)?)
    }
}

fn syntax_error(error: serde_json::Error) -> FormatError {
    let place = format!("line {}, column {}", error.line(), error.column());
    let message = error.to_string();
    let message = message.split(" at line ").next().unwrap_or_default();
    FormatError::new(
        place,
        message,
        "derive the graph again: `cargo regen --derive`; the file is not meant to be edited",
    )
}

/// The members that say how to read the others.
#[derive(Deserialize)]
struct Header {
    format: String,
    version: u64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct File {
    #[serde(rename = "format")]
    pub _format: String,
    #[serde(rename = "version")]
    pub _version: u64,
    pub name: String,
    pub leg_count: usize,
    pub provenance: Provenance,
    pub symbols: Vec<FileSymbol>,
    pub graphs: Vec<FileGraph>,
    pub functions: Vec<FileFunction>,
    pub sample: BTreeMap<String, Vec<f64>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FileSymbol {
    pub name: String,
    pub role: Role,
    pub per_leg: bool,
    pub shape: Vec<usize>,
    pub unit: String,
    pub frame: String,
    pub meaning: String,
    pub equation: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FileGraph {
    pub name: String,
    pub meaning: String,
    pub inputs: Vec<String>,
    pub outputs: Vec<FileOutput>,
    pub nodes: Vec<FileNode>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FileOutput {
    pub symbol: String,
    pub nodes: Vec<u32>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FileFunction {
    pub name: String,
    pub meaning: String,
    pub equation: String,
    pub inputs: Vec<String>,
    pub outputs: Vec<String>,
    #[serde(default)]
    pub leg_specific: bool,
    pub steps: Vec<FileStep>,
    pub sample_outputs: BTreeMap<String, Vec<f64>>,
}

#[derive(Deserialize)]
#[serde(
    untagged,
    expecting = "a step is {\"call\": graph} with optional \"over\": \"legs\", or {\"solve\": symbol, \"matrix\": \
                               symbol, \"right_hand_side\": symbol, \"symmetric_positive_definite\": bool}"
)]
pub(super) enum FileStep {
    Call(FileCall),
    Solve(FileSolve),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FileCall {
    pub call: String,
    pub over: Option<Over>,
}

#[derive(Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Over {
    Legs,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FileSolve {
    pub solve: String,
    pub matrix: String,
    pub right_hand_side: String,
    pub symmetric_positive_definite: bool,
}

/// `[operation, operands...]`
pub(super) struct FileNode {
    pub operation: String,
    pub operands: Vec<Number>,
}

impl<'de> Deserialize<'de> for FileNode {
    fn deserialize<D: de::Deserializer<'de>>(deserializer: D) -> Result<FileNode, D::Error> {
        struct NodeVisitor;
        impl<'de> Visitor<'de> for NodeVisitor {
            type Value = FileNode;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a node, [\"operation\", operands...]")
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<FileNode, A::Error> {
                let operation: Cow<'de, str> =
                    items.next_element()?.ok_or_else(|| de::Error::invalid_length(0, &self))?;
                let mut operands = Vec::with_capacity(2);
                while let Some(operand) = items.next_element()? {
                    operands.push(operand);
                }
                Ok(FileNode { operation: operation.into_owned(), operands })
            }
        }
        deserializer.deserialize_seq(NodeVisitor)
    }
}
