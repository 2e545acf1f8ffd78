//! Why nothing is generated.

use crate::emit::EmitError;
use crate::evidence::{Evidence, EvidenceError};
use crate::sample::NoPose;

/// Why nothing is generated.
#[derive(Clone, PartialEq, Debug, thiserror::Error, miette::Diagnostic)]
pub enum GenerateError {
    /// The printer refuses a graph or a name.
    #[error(transparent)]
    Emit(#[from] EmitError),
    /// A function that the graph file does not have.
    #[error("the graph file has no function `{name}`")]
    #[diagnostic(help("{help}"))]
    UnknownFunction {
        /// The name asked for.
        name: String,
        /// The nearest, or what there is.
        help: String,
    },
    /// An output that a function does not have.
    #[error("function `{function}` has no output `{output}`")]
    #[diagnostic(help("{help}"))]
    UnknownOutput {
        /// The function.
        function: String,
        /// The output asked for.
        output: String,
        /// The nearest, or what there is.
        help: String,
    },
    /// A parameter to be given at run time that the graph file does not have.
    #[error("no parameter is called `{name}`")]
    #[diagnostic(help("{help}"))]
    UnknownParameterName {
        /// The name asked for.
        name: String,
        /// The nearest, or what there is.
        help: String,
    },
    /// Evidence against what would be printed.
    #[error("{}", refused(.0))]
    #[diagnostic(help("{FAULT}"))]
    Refused(Box<Evidence>),
    /// Nothing can be said for or against what would be printed.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Evidence(#[from] EvidenceError),
    /// A function asked for more than once.
    #[error("function `{name}` is asked for twice")]
    #[diagnostic(help("name every function once"))]
    RepeatedFunction {
        /// Its name.
        name: String,
    },
    /// A function that sampling states needs is missing or has another shape.
    #[error("states cannot be sampled: function `{name}` {problem}")]
    #[diagnostic(help(
        "the table codegen/derivation/functions.py has it: derive again with `cargo regen --derive`"
    ))]
    Sampling {
        /// The function.
        name: &'static str,
        /// What is wrong.
        problem: String,
    },
    /// A parameter of the graph that the platform does not have.
    #[error("the platform has no parameter `{name}`, but the graph reads it")]
    #[diagnostic(help(
        "the graph file and this dyn-gen belong to different versions: derive again with `cargo regen --derive`"
    ))]
    UnknownParameter {
        /// Name of the parameter.
        name: String,
    },
    /// A parameter of another size than the platform's.
    #[error("parameter `{name}` has {platform} numbers in the platform, but shape {graph:?} in the graph")]
    #[diagnostic(help(
        "the graph file and this dyn-gen belong to different versions: derive again with `cargo regen --derive`"
    ))]
    ParameterShape {
        /// Name of the parameter.
        name: String,
        /// Length of the platform's.
        platform: usize,
        /// Shape in the graph.
        graph: Vec<usize>,
    },
    /// An input of the graph that sampled states do not have, or in another size.
    #[error("input `{name}` has shape {graph:?} in the graph, but {sampled} numbers in sampled states")]
    #[diagnostic(help(
        "states are sampled by dyn-gen/src/sample.rs: give it the input, or derive again with `cargo regen --derive`"
    ))]
    InputShape {
        /// Name of the input.
        name: String,
        /// Numbers in a sampled state, 0 where it has no such input.
        sampled: usize,
        /// Shape in the graph.
        graph: Vec<usize>,
    },
    /// An output that nothing in the graph file computes.
    #[error("the graph file has no output `{output}`")]
    #[diagnostic(help(
        "the graph file and this dyn-gen belong to different versions: derive again with `cargo regen --derive`"
    ))]
    MissingOutput {
        /// The output.
        output: String,
    },
    /// The platform's legs are not the ones derived.
    #[error("the platform has legs of type `{platform}`, the graph file derives `{graph}`")]
    #[diagnostic(help("use the graph file of that leg type"))]
    LegType {
        /// The platform's.
        platform: String,
        /// The graph file's.
        graph: String,
    },
    /// The platform cannot move, as far as sampling can tell.
    #[error("platform `{platform}`: {reason}")]
    #[diagnostic(help("{}", remedy(.reason)))]
    NoPose {
        /// The platform.
        platform: String,
        /// What was looked for in vain.
        reason: NoPose,
    },
    /// Without pivoting at run time, rounding errors would get too large.
    #[error(
        "the elimination of `{solve}` in function `{function}` loses digits: rounding errors grow by {growth:.1e} at the \
         worst of {states} sampled states (limit {limit:.0e}), so J_dp is singular or nearly so there"
    )]
    #[diagnostic(help("{LAYOUT}"))]
    Growth {
        /// The function.
        function: String,
        /// Name of the solution.
        solve: String,
        /// [`PivotOrder::growth`](crate::passes::PivotOrder::growth)
        growth: f64,
        /// Number of states looked at.
        states: usize,
        /// [`MOST_GROWTH`](crate::MOST_GROWTH)
        limit: f64,
    },
    /// The platform cannot be written as JSON, of which the header has the hash.
    #[error("the platform cannot be written as JSON: {message}")]
    #[diagnostic(help("give finite numbers"))]
    Json {
        /// What the writer said.
        message: String,
    },
}

/// What makes J_dp singular, and what to do.
const LAYOUT: &str = "check the legs' layout: parallel or coinciding rods, or all rods through one line, cannot hold the \
                      platform; move the joints (in a circular layout, change the pair angles or radii) or the home pose";

/// What evidence against a model tells.
const FAULT: &str = "check the units of the platform file first, SI throughout: lengths in millimetres cost the digits that are \
                     missing here. Otherwise the graph file was altered (derive it again with `cargo regen --derive`, \
                     or leave out --graph), or dyn-gen is at fault; please report it with the platform file and this message";

fn refused(evidence: &Evidence) -> String {
    format!("the evidence is against this model; nothing is written\n{}", evidence.first_failures())
}

fn remedy(reason: &NoPose) -> &'static str {
    match reason {
        NoPose::Singular { .. } => LAYOUT,
        NoPose::Reach { .. } => {
            "check home, joint points and rod lengths: the platform should be free to move until a rod nears a right angle to \
             its actuator"
        }
    }
}
