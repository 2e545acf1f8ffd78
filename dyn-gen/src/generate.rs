//! The pipeline: flatten -> passes -> emit, function by function, then one file.

use dyn_platform::Platform;

use crate::emit::{self, CountRow, Elimination, Header, Model, RuntimePath, Scalar, Signature, Source};
use crate::error::GenerateError;
use crate::graph::{Function, Graph, OperationCount, Program, Symbol};
use crate::passes::{Context, PassReport, PivotOrder, run_passes};
use crate::sample::Kind;
use crate::workspace::{parameters, sampled_states};
use crate::{GraphFile, parallel, sha256};

/// States over which pivot orders are chosen.
const PIVOT_STATES: [(Kind, usize); 4] =
    [(Kind::Home, 1), (Kind::Random, 10), (Kind::Large, 20), (Kind::NearEdge, 20)];
/// Seed of those states.
const PIVOT_SEED: u64 = 1;

/// Largest [`PivotOrder::growth`] of an elimination that is printed: of the sixteen digits of a double four may be lost to the
/// fixed order of the pivots. Sound platforms stay below 100.
pub const MOST_GROWTH: f64 = 1e4;

/// Where a model's physical numbers come from.
#[derive(Clone, Copy, Debug)]
pub enum Numbers<'a> {
    /// Baked into the code.
    Baked(&'a Platform),
    /// Fields of a struct, given at run time.
    AtRunTime,
}

/// What to generate.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Options {
    /// Name of the model, e.g. `uhp_2016`; its type is called `Uhp2016`.
    pub model: String,
    /// Where generated code finds the runtime crate.
    pub runtime: RuntimePath,
    /// The types of number for which the model implements the kernel traits, see [`Model::scalars`].
    pub scalars: Vec<Scalar>,
    /// Which functions; all when `None`.
    pub functions: Option<Vec<String>>,
    /// The command that makes the file, for its first lines.
    pub command: String,
}

/// A generated file and how it came about.
#[derive(Clone, Debug)]
pub struct Generated {
    /// Text of the file.
    pub source: String,
    /// One entry per function.
    pub functions: Vec<GeneratedFunction>,
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
    numbers: Numbers<'_>,
    options: &Options,
) -> Result<Generated, GenerateError> {
    let program = &file.program;
    let functions = optimise(program, numbers, options.functions.as_deref())?;
    let parameters: Vec<Symbol> = match numbers {
        Numbers::Baked(_) => Vec::new(),
        Numbers::AtRunTime => program.parameters().cloned().collect(),
    };
    let print = |function: &GeneratedFunction| emit::function(&function.graph, !parameters.is_empty());
    let sources = parallel::map(&functions, print).into_iter().collect::<Result<Vec<_>, _>>()?;
    let signatures: Vec<Signature> =
        functions.iter().map(|function| Signature::of(&function.graph)).collect();
    let model = Model {
        name: &options.model,
        runtime: &options.runtime,
        parameters: &parameters,
        scalars: &options.scalars,
        signatures: &signatures,
        functions: &sources,
    };
    let source = emit::model_file(&header(file, numbers, options, &functions)?, &model)?;
    Ok(Generated { source, functions })
}

/// The graphs that [`generate`] prints, without printing them.
///
/// # Errors
/// See [`GenerateError`].
pub fn optimise(
    program: &Program,
    numbers: Numbers<'_>,
    names: Option<&[String]>,
) -> Result<Vec<GeneratedFunction>, GenerateError> {
    let chosen = choose(program, names)?;
    let context = context(program, numbers)?;
    let functions = parallel::map(&chosen, |function| {
        let graph = program.flatten(function);
        let before = graph.operation_count();
        let (graph, passes) = run_passes(&graph, &context);
        GeneratedFunction { before, passes, graph }
    });
    functions.iter().try_for_each(GeneratedFunction::check_growth)?;
    Ok(functions)
}

/// Generates the file of kernel traits, one for every function of the graph file.
///
/// # Errors
/// See [`GenerateError`].
pub fn kernels(file: &GraphFile, command: &str) -> Result<String, GenerateError> {
    let program = &file.program;
    let signatures: Vec<Signature> =
        program.functions.iter().map(|function| Signature::of_function(program, function)).collect();
    let header = Header {
        title: "What every model can compute: one trait per function.".into(),
        command: command.into(),
        graph: Source { name: file.name.clone(), sha256: file.sha256.clone() },
        platform: None,
        casadi: program.provenance.casadi.clone(),
        operations: Vec::new(),
        eliminations: Vec::new(),
    };
    Ok(emit::kernels_file(&header, &signatures)?)
}

fn choose<'a>(program: &'a Program, names: Option<&[String]>) -> Result<Vec<&'a Function>, GenerateError> {
    let Some(names) = names else { return Ok(program.functions.iter().collect()) };
    if let Some((_, name)) = names.iter().enumerate().find(|(k, name)| names[..*k].contains(name)) {
        return Err(GenerateError::RepeatedFunction { name: name.clone() });
    }
    let find = |name: &String| {
        program.function(name).ok_or_else(|| {
            let known: Vec<&str> = program.functions.iter().map(|function| function.name.as_str()).collect();
            GenerateError::UnknownFunction {
                name: name.clone(),
                known: format!("it has {}", known.join(", ")),
            }
        })
    };
    names.iter().map(find).collect()
}

/// What the passes need to know: the numbers to bake, and states by which to order eliminations.
fn context(program: &Program, numbers: Numbers<'_>) -> Result<Context, GenerateError> {
    let Numbers::Baked(platform) = numbers else { return Ok(Context::default()) };
    if platform.leg_type.name() != program.name {
        let (platform, graph) = (platform.leg_type.name().into(), program.name.clone());
        return Err(GenerateError::LegType { platform, graph });
    }
    let parameters = parameters(program, platform)?;
    Ok(Context { parameters, states: sampled_states(program, platform, &PIVOT_STATES, PIVOT_SEED)? })
}

fn header(
    file: &GraphFile,
    numbers: Numbers<'_>,
    options: &Options,
    functions: &[GeneratedFunction],
) -> Result<Header, GenerateError> {
    let (title, platform) = match numbers {
        Numbers::Baked(platform) => {
            let resolved = serde_json::to_vec(platform)
                .map_err(|error| GenerateError::Json { message: error.to_string() })?;
            let source = Source { name: platform.name.clone(), sha256: sha256(&resolved) };
            (format!("Dynamics of the platform `{}`, every number baked in.", platform.name), Some(source))
        }
        Numbers::AtRunTime => (
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
        graph: Source { name: file.name.clone(), sha256: file.sha256.clone() },
        platform,
        casadi: file.program.provenance.casadi.clone(),
        operations: functions.iter().map(count).collect(),
        eliminations: eliminations.collect(),
    })
}
