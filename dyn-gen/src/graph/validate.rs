//! Checks a graph file as read and makes a [`Program`] of it, which nothing later needs to doubt.

use std::collections::{BTreeMap, BTreeSet};

use super::format::{
    File, FileFunction, FileGraph, FileSolve, FileStep, FileSymbol, FormatError, MOST_ELEMENTS, MOST_UNKNOWNS,
};
use super::interpreter::Environment;
use super::read_node::read_node;
use super::{Declaration, Function, Graph, NodeId, Output, Program, Role, SolveKind, Step, Symbol};
use crate::text::is_unprintable;

const REDERIVE: &str = "correct the derivation in codegen/ and derive again: `cargo regen --derive`";
const MOST_LEGS: usize = 64;

type Result<T> = std::result::Result<T, FormatError>;

fn refuse<T>(place: &str, problem: impl std::fmt::Display) -> Result<T> {
    Err(FormatError::new(place, problem, REDERIVE))
}

pub(super) fn validate(file: File) -> Result<Program> {
    if !(1..=MOST_LEGS).contains(&file.leg_count) {
        return refuse(
            "graph file",
            format_args!("leg_count is {}, expected 1 to {MOST_LEGS}", file.leg_count),
        );
    }
    check_name("graph file", "program", &file.name)?;
    check_text("provenance", &[&file.provenance.casadi, &file.provenance.derivation_sha256])?;
    let mut symbols = BTreeMap::new();
    let mut program = Program {
        name: file.name,
        leg_count: file.leg_count,
        provenance: file.provenance,
        symbols: Vec::new(),
        graphs: Vec::new(),
        functions: Vec::new(),
        sample: file.sample,
    };
    for symbol in file.symbols {
        let declaration = declaration(symbol, program.leg_count)?;
        let name = declaration.symbol.name.clone();
        if symbols.insert(name.clone(), program.symbols.len()).is_some() {
            return refuse(&format!("symbol `{name}`"), "declared twice");
        }
        program.symbols.push(declaration);
    }
    let over_legs = call_modes(&file.graphs, &file.functions)?;
    let scope = Scope { declarations: &program.symbols, symbols: &symbols };
    let graphs =
        file.graphs.into_iter().zip(&over_legs).map(|(graph, over_legs)| scope.graph(graph, *over_legs));
    let graphs = graphs.collect::<Result<Vec<_>>>()?;
    let mut functions: Vec<Function> = Vec::new();
    for function in file.functions {
        if functions.iter().any(|known| known.name == function.name) {
            return refuse(&format!("function `{}`", function.name), "defined twice");
        }
        functions.push(scope.function(function, &graphs)?);
    }
    scope.check_sample(&program.sample)?;
    (program.graphs, program.functions) = (graphs, functions);
    Ok(program)
}

/// For each graph whether functions call it over legs. Element numbers mean different things in the two cases, so a graph is
/// called in one way only, and one that nothing calls could not be checked.
fn call_modes(graphs: &[FileGraph], functions: &[FileFunction]) -> Result<Vec<bool>> {
    let mut modes: BTreeMap<&str, Option<bool>> = BTreeMap::new();
    for graph in graphs {
        if modes.insert(&graph.name, None).is_some() {
            return refuse(&format!("graph `{}`", graph.name), "defined twice");
        }
    }
    for function in functions {
        for step in &function.steps {
            let FileStep::Call(call) = step else { continue };
            let over_legs = call.over.is_some();
            match modes.get_mut(call.call.as_str()) {
                None => {
                    return refuse(
                        &function_place(function),
                        format_args!("calls unknown graph `{}`", call.call),
                    );
                }
                Some(mode) if mode.is_some_and(|mode| mode != over_legs) => {
                    let problem = format!("calls graph `{}` both once and over legs", call.call);
                    return refuse(&function_place(function), problem);
                }
                Some(mode) => *mode = Some(over_legs),
            }
        }
    }
    let mode = |graph: &FileGraph| match modes[graph.name.as_str()] {
        Some(over_legs) => Ok(over_legs),
        None => refuse(&format!("graph `{}`", graph.name), "no function calls it"),
    };
    graphs.iter().map(mode).collect()
}

fn function_place(function: &FileFunction) -> String {
    format!("function `{}`", function.name)
}

/// Names become Rust identifiers and file names.
fn check_name(place: &str, what: &str, name: &str) -> Result<()> {
    let tail = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
    if name.starts_with(|c: char| c.is_ascii_lowercase()) && name.chars().all(tail) {
        return Ok(());
    }
    refuse(place, format_args!("{what} name {name:?} is not of the form lower_case_1"))
}

/// Texts become comments, where a line break would begin code.
fn check_text(place: &str, texts: &[&str]) -> Result<()> {
    match texts.iter().find(|text| text.contains(is_unprintable)) {
        None => Ok(()),
        Some(text) => refuse(place, format_args!("the text {text:?} has a character that cannot be printed")),
    }
}

fn declaration(file: FileSymbol, leg_count: usize) -> Result<Declaration> {
    let place = format!("symbol `{}`", file.name);
    check_name(&place, "symbol", &file.name)?;
    check_text(&place, &[&file.unit, &file.frame, &file.meaning, &file.equation])?;
    let leg = file.per_leg.then_some(leg_count);
    let shape: Vec<usize> = leg.into_iter().chain(file.shape).collect();
    let length = shape.iter().try_fold(1_usize, |length, dimension| length.checked_mul(*dimension));
    if !length.is_some_and(|length| (1..=MOST_ELEMENTS).contains(&length)) {
        return refuse(&place, format_args!("shape {shape:?} does not have 1 to {MOST_ELEMENTS} elements"));
    }
    let parameter = file.role == Role::Parameter;
    let FileSymbol { name, role, per_leg, unit, frame, meaning, equation, .. } = file;
    Ok(Declaration {
        symbol: Symbol { name, shape, unit, frame, meaning, equation, parameter },
        role,
        per_leg,
    })
}

/// The symbols a file declares.
struct Scope<'a> {
    declarations: &'a [Declaration],
    symbols: &'a BTreeMap<String, usize>,
}

impl Scope<'_> {
    fn declared(&self, place: &str, name: &str) -> Result<&Declaration> {
        match self.symbols.get(name) {
            Some(index) => Ok(&self.declarations[*index]),
            None => refuse(place, format_args!("unknown symbol `{name}`")),
        }
    }

    /// The symbol as a graph sees it: without the leg dimension where the graph is called over legs.
    fn seen(&self, place: &str, name: &str, over_legs: bool) -> Result<Symbol> {
        let declaration = self.declared(place, name)?;
        let mut symbol = declaration.symbol.clone();
        if over_legs && declaration.per_leg {
            symbol.shape.remove(0);
        }
        Ok(symbol)
    }

    fn graph(&self, file: FileGraph, over_legs: bool) -> Result<Graph> {
        let place = format!("graph `{}`", file.name);
        check_name(&place, "graph", &file.name)?;
        check_text(&place, &[&file.meaning])?;
        let inputs =
            file.inputs.iter().map(|name| self.seen(&place, name, over_legs)).collect::<Result<Vec<_>>>()?;
        if let Some(name) = repeated(&file.inputs) {
            return refuse(&place, format_args!("input `{name}` listed twice"));
        }
        if file.nodes.len() > u32::MAX as usize {
            return refuse(&place, "too many nodes");
        }
        let mut nodes = Vec::with_capacity(file.nodes.len());
        for (index, node) in file.nodes.into_iter().enumerate() {
            nodes.push(
                read_node(node, index, &inputs)
                    .or_else(|problem| refuse(&format!("{place}, node {index}"), problem))?,
            );
        }
        let mut outputs = Vec::new();
        for output in file.outputs {
            let place = format!("{place}, output `{}`", output.symbol);
            let symbol = self.seen(&place, &output.symbol, over_legs)?;
            let declaration = self.declared(&place, &output.symbol)?;
            if matches!(declaration.role, Role::Input | Role::Parameter) {
                return refuse(&place, "an input or parameter cannot be computed");
            }
            if over_legs && !declaration.per_leg {
                return refuse(&place, "computed over legs but not declared per leg");
            }
            if output.nodes.len() != symbol.len() {
                let shape = &symbol.shape;
                return refuse(&place, format_args!("{} nodes for shape {shape:?}", output.nodes.len()));
            }
            if let Some(node) = output.nodes.iter().find(|node| **node as usize >= nodes.len()) {
                return refuse(&place, format_args!("node {node} does not exist ({} nodes)", nodes.len()));
            }
            outputs.push(Output { symbol, nodes: output.nodes.into_iter().map(NodeId).collect() });
        }
        let section_of = vec![0; nodes.len()];
        Ok(Graph {
            name: file.name,
            meaning: file.meaning,
            equation: String::new(),
            inputs,
            nodes,
            solves: Vec::new(),
            outputs,
            sections: vec![String::new()],
            section_of,
        })
    }

    fn function(&self, file: FileFunction, graphs: &[Graph]) -> Result<Function> {
        let place = function_place(&file);
        check_name(&place, "function", &file.name)?;
        check_text(&place, &[&file.meaning, &file.equation])?;
        for (names, role) in [(&file.inputs, Role::Input), (&file.outputs, Role::Output)] {
            if let Some(name) = repeated(names) {
                return refuse(&place, format_args!("`{name}` listed twice"));
            }
            for name in names {
                let declared = self.declared(&place, name)?.role;
                if declared != role {
                    return refuse(
                        &place,
                        format_args!("`{name}` is listed as {role:?}, but declared {declared:?}"),
                    );
                }
            }
        }
        let mut known: BTreeSet<&str> = file.inputs.iter().map(String::as_str).collect();
        let parameters = self.declarations.iter().filter(|declaration| declaration.role == Role::Parameter);
        known.extend(parameters.map(|declaration| declaration.symbol.name.as_str()));
        let mut steps = Vec::with_capacity(file.steps.len());
        for (index, step) in file.steps.iter().enumerate() {
            let place = format!("{place}, step {index}");
            let (step, reads, defines): (_, Vec<&str>, Vec<&str>) = match step {
                FileStep::Call(call) => {
                    let Some(graph) = graphs.iter().position(|graph| graph.name == call.call) else {
                        return refuse(&place, format_args!("unknown graph `{}`", call.call));
                    };
                    let reads = graphs[graph].inputs.iter().map(|symbol| symbol.name.as_str()).collect();
                    let defines =
                        graphs[graph].outputs.iter().map(|output| output.symbol.name.as_str()).collect();
                    (Step::Call { graph, over_legs: call.over.is_some() }, reads, defines)
                }
                FileStep::Solve(solve) => {
                    let step = self.solve(&place, solve)?;
                    (step, vec![&solve.matrix, &solve.right_hand_side], vec![&solve.solve])
                }
            };
            if let Some(name) = reads.into_iter().find(|name| !known.contains(name)) {
                return refuse(&place, format_args!("`{name}` has no value yet"));
            }
            if let Some(name) = defines.into_iter().find(|name| !known.insert(name)) {
                return refuse(&place, format_args!("`{name}` gets a second value"));
            }
            steps.push(step);
        }
        if let Some(name) = file.outputs.iter().find(|name| !known.contains(name.as_str())) {
            return refuse(&place, format_args!("no step computes output `{name}`"));
        }
        for (name, values) in &file.sample_outputs {
            if !file.outputs.contains(name) {
                return refuse(&place, format_args!("sample of `{name}`, which is not an output"));
            }
            self.check_length(&format!("{place}, sample"), name, values)?;
        }
        let FileFunction { name, meaning, equation, inputs, outputs, leg_specific, sample_outputs, .. } =
            file;
        Ok(Function { name, meaning, equation, inputs, outputs, leg_specific, steps, sample_outputs })
    }

    fn solve(&self, place: &str, file: &FileSolve) -> Result<Step> {
        let solution = self.declared(place, &file.solve)?;
        if matches!(solution.role, Role::Input | Role::Parameter) {
            return refuse(
                place,
                format_args!("`{}` is an input or parameter and cannot be computed", file.solve),
            );
        }
        let shape = |name: &str| Ok::<_, FormatError>(self.declared(place, name)?.symbol.shape.as_slice());
        let (matrix, right_hand_side, solution) =
            (shape(&file.matrix)?, shape(&file.right_hand_side)?, shape(&file.solve)?);
        let n = right_hand_side.first().copied().unwrap_or(0);
        if right_hand_side.len() != 1 || solution != right_hand_side || matrix != [n, n] {
            let problem = format!(
                "solve needs shapes [n, n], [n] and [n]: matrix `{}` has {matrix:?}, right-hand side `{}` {right_hand_side:?}, \
                 solution `{}` {solution:?}",
                file.matrix, file.right_hand_side, file.solve
            );
            return refuse(place, problem);
        }
        if n > MOST_UNKNOWNS {
            let problem =
                format!("`{}` has {n} unknowns; at most {MOST_UNKNOWNS} can be written out", file.solve);
            return refuse(place, problem);
        }
        let kind = match file.symmetric_positive_definite {
            true => SolveKind::SymmetricPositiveDefinite,
            false => SolveKind::General,
        };
        Ok(Step::Solve {
            solution: file.solve.clone(),
            matrix: file.matrix.clone(),
            right_hand_side: file.right_hand_side.clone(),
            kind,
        })
    }

    fn check_length(&self, place: &str, name: &str, values: &[f64]) -> Result<()> {
        let symbol = &self.declared(place, name)?.symbol;
        if values.len() != symbol.len() {
            return refuse(
                place,
                format_args!("{} numbers for `{name}` of shape {:?}", values.len(), symbol.shape),
            );
        }
        Ok(())
    }

    fn check_sample(&self, sample: &Environment) -> Result<()> {
        for (name, values) in sample {
            self.check_length("sample", name, values)?;
        }
        for Declaration { symbol, role, .. } in self.declarations {
            if matches!(role, Role::Input | Role::Parameter) && !sample.contains_key(&symbol.name) {
                return refuse("sample", format_args!("no value for `{}`", symbol.name));
            }
        }
        Ok(())
    }
}

fn repeated(names: &[String]) -> Option<&String> {
    names.iter().enumerate().find(|(index, name)| names[..*index].contains(name)).map(|(_, name)| name)
}
