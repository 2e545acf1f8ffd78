//! The pipeline: flatten -> passes -> emit, function by function, then one file.

use std::time::{Duration, Instant};

use crate::emit::{self, CountRow, Elimination, Header, Model, RuntimePath, Scalar, Signature, Source};
use crate::error::GenerateError;
use crate::evidence::{self, Evidence, Sampling};
use crate::graph::{Function, Graph, OperationCount, Program, Symbol};
use crate::pack::{Hoisted, Packed, hoist, pack};
use crate::passes::{Context, PassReport, PivotOrder, run_passes};
use crate::sample::Kind;
use crate::workspace::{parameters, sampled_states};
use crate::{GraphFile, Numbers, limits, parallel, sha256};
use dyn_platform::nearest;

/// States over which pivot orders are chosen.
const PIVOT_STATES: [(Kind, usize); 4] =
    [(Kind::Home, 1), (Kind::Random, 10), (Kind::Large, 20), (Kind::NearEdge, 20)];
/// Seed of those states.
const PIVOT_SEED: u64 = 1;

/// Largest [`PivotOrder::growth`] of an elimination that is printed: of the sixteen digits of a double four may be lost to the
/// fixed order of the pivots. Sound platforms stay below 100.
pub const MOST_GROWTH: f64 = 1e4;

/// Functions that are also printed in lanes: those that a control loop or a simulation waits for.
pub const IN_LANES: [&str; 5] =
    ["inverse_dynamics", "forward_dynamics", "matrices", "control", "actuator_geometry"];

/// What to generate.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Options {
    /// Name of the model, e.g. `uhp_2016`; its type is called `Uhp2016`.
    pub model: String,
    /// Where generated code finds the runtime crate.
    pub runtime: RuntimePath,
    /// The types of number for which the model implements the kernel traits, see [`Model::scalars`].
    pub scalars: Vec<Scalar>,
    /// Which functions, each `NAME` or, with some of its outputs only, `NAME:OUTPUT:...`; all when `None`. A function without all of
    /// its outputs does less work; it is a free function then and no method of the model, whose trait promises all of them.
    pub functions: Option<Vec<String>>,
    /// The command that makes the file, for its first lines.
    pub command: String,
    /// At which states the model is examined before it is printed; not at all when `None`.
    pub evidence: Option<Sampling>,
    /// Names of [`PASSES`](crate::passes::PASSES) and of [`STEPS`](crate::pack::STEPS) that do not run; none unless one wants to
    /// see what they are worth. Without `bake` or `expand` nothing is printed that could be compiled.
    pub without: Vec<String>,
}

/// A generated file and how it came about.
#[derive(Clone, Debug)]
pub struct Generated {
    /// Text of the file.
    pub source: String,
    /// One entry per function.
    pub functions: Vec<GeneratedFunction>,
    /// What was found, if it was looked for. It is within its tolerances, or nothing would have been generated.
    pub evidence: Option<Evidence>,
    /// How long each stage took.
    pub timings: Vec<(&'static str, Duration)>,
}

/// A function on its way through the passes.
#[derive(Clone, Debug)]
pub struct GeneratedFunction {
    /// Operations as derived.
    pub before: OperationCount,
    /// What each pass did.
    pub passes: Vec<PassReport>,
    /// The graph that is printed.
    pub graph: Graph,
    /// The same function in lanes, if it is also printed so: not where its blocks would lose digits, see [`MOST_GROWTH`].
    pub in_lanes: Option<Packed>,
}

impl GeneratedFunction {
    /// The linear systems it solves in a fixed order of pivots.
    pub fn pivot_orders(&self) -> impl Iterator<Item = &PivotOrder> {
        self.passes.iter().flat_map(|pass| &pass.pivot_orders)
    }

    /// Refuses eliminations that lose too many digits; growth that is not a number is too much as well.
    fn check_growth(&self) -> Result<(), GenerateError> {
        let within = |order: &&PivotOrder| order.growth <= MOST_GROWTH;
        match self.pivot_orders().find(|order| !within(order)) {
            None => Ok(()),
            Some(order) => Err(GenerateError::Growth {
                function: self.graph.name.clone(),
                solve: order.solve.clone(),
                growth: order.growth,
                states: order.states,
                limit: MOST_GROWTH,
            }),
        }
    }
}

/// Generates the file of one model.
///
/// # Errors
/// See [`GenerateError`].
pub fn generate(
    file: &GraphFile,
    numbers: &Numbers<'_>,
    options: &Options,
) -> Result<Generated, GenerateError> {
    let program = &file.program;
    let mut stages = Stages::start();
    let functions = optimise_without(program, numbers, options.functions.as_deref(), &options.without)?;
    stages.end("optimise");
    let examine = |sampling: Sampling| evidence::gather(program, numbers, &functions, sampling);
    let evidence = options.evidence.map(examine).transpose()?;
    if let Some(evidence) = evidence.as_ref().filter(|evidence| !evidence.holds()) {
        return Err(GenerateError::Refused(Box::new(evidence.clone())));
    }
    stages.end("evidence");
    let parameters: Vec<Symbol> = numbers.run_time_parameters(program)?.into_iter().cloned().collect();
    let defaults = numbers.platform().map(|platform| {
        let value = |symbol: &Symbol| platform.parameter(&symbol.name).unwrap_or_default();
        parameters.iter().map(value).collect::<Vec<_>>()
    });
    let in_lanes: Vec<&Packed> = functions.iter().filter_map(|function| function.in_lanes.as_ref()).collect();
    let hoisted: Vec<(String, Hoisted)> = in_lanes
        .iter()
        .filter_map(|packed| Some((packed.graph.name.clone(), hoist(&packed.graph)?)))
        .collect();
    let graphs: Vec<&Graph> = functions
        .iter()
        .map(|function| &function.graph)
        .chain(in_lanes.iter().map(|packed| &packed.graph))
        .chain(hoisted.iter().flat_map(|(_, hoisted)| [&hoisted.preparation, &hoisted.rest]))
        .collect();
    let print = |graph: &&Graph| emit::function(graph, !parameters.is_empty());
    let sources = parallel::map_largest_first(&graphs, |graph| graph.nodes.len(), print)
        .into_iter()
        .collect::<Result<Vec<_>, _>>()?;
    let with_lanes = functions.iter().filter(|function| function.in_lanes.is_some());
    let in_lanes: Vec<String> = with_lanes.map(|function| function.graph.name.clone()).collect();
    // A trait promises all outputs: a function with some of them is a free function only.
    let has_all = |function: &&GeneratedFunction| {
        let all = program.function(&function.graph.name).map(|whole| whole.outputs.len());
        all == Some(function.graph.outputs.len())
    };
    let signatures: Vec<Signature> = functions
        .iter()
        .filter(has_all)
        .map(|function| Signature::of(&function.graph).within(program))
        .collect();
    let rows = |(name, hoisted): &(String, Hoisted)| {
        (name.clone(), hoisted.preparation.outputs[0].symbol.shape.clone())
    };
    let prepared: Vec<(String, Vec<usize>)> = hoisted.iter().map(rows).collect();
    let limits = numbers.platform().and_then(|platform| limits::of_platform(program, platform));
    let model = Model {
        name: &options.model,
        runtime: &options.runtime,
        parameters: &parameters,
        scalars: &options.scalars,
        defaults: defaults.as_deref(),
        limits: limits.as_ref(),
        signatures: &signatures,
        functions: &sources,
        in_lanes: &in_lanes,
        prepared: &prepared,
    };
    let source = emit::model_file(&header(file, numbers, options, &functions, evidence.as_ref())?, &model)?;
    stages.end("print");
    Ok(Generated { source, functions, evidence, timings: stages.ended })
}

/// A clock for consecutive stages.
struct Stages {
    since: Instant,
    ended: Vec<(&'static str, Duration)>,
}

impl Stages {
    fn start() -> Stages {
        Stages { since: Instant::now(), ended: Vec::new() }
    }

    fn end(&mut self, stage: &'static str) {
        self.ended.push((stage, self.since.elapsed()));
        self.since = Instant::now();
    }
}

/// The graphs that [`generate`] prints, without printing them.
///
/// # Errors
/// See [`GenerateError`].
pub fn optimise(
    program: &Program,
    numbers: &Numbers<'_>,
    names: Option<&[String]>,
) -> Result<Vec<GeneratedFunction>, GenerateError> {
    optimise_without(program, numbers, names, &[])
}

/// The same without some passes, see [`Options::without`].
///
/// # Errors
/// See [`GenerateError`].
pub fn optimise_without(
    program: &Program,
    numbers: &Numbers<'_>,
    names: Option<&[String]>,
    without: &[String],
) -> Result<Vec<GeneratedFunction>, GenerateError> {
    let chosen = choose(program, names)?;
    let context = Context { left_out: without.to_vec(), ..context(program, numbers)? };
    // Twice the work for functions in lanes; the number of steps is as good a guess as any before they are flattened.
    let in_lanes = |function: &Function| IN_LANES.contains(&function.name.as_str());
    let size = |function: &Function| function.steps.len() * (1 + usize::from(in_lanes(function)));
    let functions = parallel::map_largest_first(&chosen, size, |function| {
        let (flat, groups) = program.flatten_with_groups(function);
        let before = flat.operation_count();
        let (graph, passes) = run_passes(&flat, &context);
        let in_lanes = in_lanes(function)
            .then(|| pack(&flat, groups, program.leg_count, &context))
            .filter(|packed| packed.partition.growth <= MOST_GROWTH)
            // Pivots chosen at run time take longer than lanes save.
            .filter(|packed| packed.graph.operation_count().solves <= graph.operation_count().solves);
        GeneratedFunction { before, passes, graph, in_lanes }
    });
    functions.iter().try_for_each(GeneratedFunction::check_growth)?;
    Ok(functions)
}

/// Generates the file of kernel traits, one for every function of the graph files. What all leg types have in common is
/// taken from the first.
///
/// # Errors
/// See [`GenerateError`].
pub fn kernels(files: &[GraphFile], command: &str) -> Result<String, GenerateError> {
    let signatures: Vec<Signature> = files
        .iter()
        .enumerate()
        .flat_map(|(number, GraphFile { program, .. })| {
            let functions = program.functions.iter().filter(move |row| number == 0 || row.leg_specific);
            functions.map(|function| Signature::of_function(program, function))
        })
        .collect();
    let header = Header {
        title: "What models can compute: one trait per function.".into(),
        command: command.into(),
        graphs: files.iter().map(source).collect(),
        platform: None,
        casadi: files.first().map(|file| file.program.provenance.casadi.clone()).unwrap_or_default(),
        operations: Vec::new(),
        eliminations: Vec::new(),
        evidence: Vec::new(),
    };
    Ok(emit::kernels_file(&header, &signatures)?)
}

/// The functions called `names`, each `NAME` or, with some of its outputs only, `NAME:OUTPUT:...`.
fn choose(program: &Program, names: Option<&[String]>) -> Result<Vec<Function>, GenerateError> {
    let Some(names) = names else { return Ok(program.functions.clone()) };
    let mut chosen: Vec<Function> = Vec::with_capacity(names.len());
    for words in names {
        let mut words = words.split(':');
        let name = words.next().unwrap_or_default();
        if chosen.iter().any(|function| function.name == name) {
            return Err(GenerateError::RepeatedFunction { name: name.into() });
        }
        let known = program.functions.iter().map(|function| function.name.as_str());
        let mut function = program
            .function(name)
            .cloned()
            .ok_or_else(|| GenerateError::UnknownFunction { name: name.into(), help: help(name, known) })?;
        let outputs: Vec<&str> = words.collect();
        let known = || function.outputs.iter().map(String::as_str);
        if let Some(unknown) = outputs.iter().find(|output| !known().any(|known| known == **output)) {
            let help = help(unknown, known());
            return Err(GenerateError::UnknownOutput {
                function: name.into(),
                output: (*unknown).into(),
                help,
            });
        }
        if !outputs.is_empty() {
            function.outputs.retain(|output| outputs.contains(&output.as_str()));
        }
        chosen.push(function);
    }
    Ok(chosen)
}

/// What to write instead of a name that is not known.
fn help<'a>(name: &str, known: impl Iterator<Item = &'a str> + Clone) -> String {
    match nearest(name, known.clone()) {
        Some(near) => format!("did you mean `{near}`?"),
        None => format!("it has {}", known.collect::<Vec<_>>().join(", ")),
    }
}

/// What the passes need to know: the numbers to bake, and states by which to order eliminations.
fn context(program: &Program, numbers: &Numbers<'_>) -> Result<Context, GenerateError> {
    let Some(platform) = numbers.platform() else { return Ok(Context::default()) };
    if platform.leg_type.name() != program.name {
        let (platform, graph) = (platform.leg_type.name().into(), program.name.clone());
        return Err(GenerateError::LegType { platform, graph });
    }
    let mut parameters = parameters(program, platform)?;
    for symbol in numbers.run_time_parameters(program)? {
        parameters.remove(&symbol.name);
    }
    let states = sampled_states(program, platform, &PIVOT_STATES, PIVOT_SEED)?;
    Ok(Context { parameters, states, ..Context::default() })
}

fn source(file: &GraphFile) -> Source {
    Source { name: file.name.clone(), sha256: file.sha256.clone() }
}

fn header(
    file: &GraphFile,
    numbers: &Numbers<'_>,
    options: &Options,
    functions: &[GeneratedFunction],
    evidence: Option<&Evidence>,
) -> Result<Header, GenerateError> {
    let run_time = numbers.run_time_parameters(&file.program)?;
    let run_time: Vec<&str> = run_time.iter().map(|symbol| symbol.name.as_str()).collect();
    let (title, platform) = match numbers.platform() {
        Some(platform) => {
            let resolved = serde_json::to_vec(platform)
                .map_err(|error| GenerateError::Json { message: error.to_string() })?;
            let source = Source { name: platform.name.clone(), sha256: sha256(&resolved) };
            let baked = match run_time[..] {
                [] => "every number baked in".to_owned(),
                _ => format!("given at run time: {}", run_time.join(", ")),
            };
            (format!("Dynamics of the platform `{}`, {baked}.", platform.name), Some(source))
        }
        None => (
            format!("Dynamics of any `{}` platform, all numbers given at run time.", file.program.name),
            None,
        ),
    };
    let count = |function: &GeneratedFunction| CountRow {
        function: function.graph.name.clone(),
        before: function.before.total(),
        after: function.graph.operation_count().total(),
    };
    let eliminations = functions.iter().flat_map(|function| {
        function.pivot_orders().map(|order| Elimination {
            function: function.graph.name.clone(),
            solve: order.solve.clone(),
            growth: order.growth,
            states: order.states,
        })
    });
    Ok(Header {
        title,
        command: options.command.clone(),
        graphs: vec![source(file)],
        platform,
        casadi: file.program.provenance.casadi.clone(),
        operations: functions.iter().map(count).collect(),
        eliminations: eliminations.collect(),
        evidence: evidence.map(Evidence::summary).unwrap_or_default(),
    })
}
