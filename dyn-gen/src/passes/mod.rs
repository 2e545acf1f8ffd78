//! Passes: graph in, graph out, the same function in fewer operations.
//!
//! [`PASSES`] is the pipeline in order. An exact pass keeps every bit of every output, up to the sign of zeros, wherever all
//! intermediate values are finite; a rounding pass keeps them up to rounding errors. Passes know no Rust and no mechanics.
//!
//! Why not the sign of zeros: `x + 0`, `0 - x`, `x * 0` and `x - x` are what baked zeros leave behind, by the hundred, and each
//! of them tells `0.0` from `-0.0` for some `x`. To keep that sign would be to keep those operations, and no result of the
//! mechanics depends on it: `-0.0 == 0.0`, and nothing divides by a quantity that may be an exact zero at a regular pose. For
//! the same reason exact passes may take a value that is not finite for a finite one (`0 * x` is `0` although `x` may be
//! infinite): such values occur out of reach and at singular poses only, where no result means anything. Tests compare bits
//! after adding `0.0`, which makes one zero of both.

mod bake;
mod blocks;
mod chain;
mod expand;
mod fold;
mod fuse;
mod invert;
mod linear;
mod merge;
mod pivot;
mod prune;
mod rewrite;
mod settle;
mod share;
mod simplify;

use crate::graph::{Environment, Graph, OperationCount};

pub(crate) use bake::known_values;
pub(crate) use blocks::{EVERY_OTHER, attempted, in_blocks, symmetric_triples};
pub(crate) use expand::{depends_on_parameters, sampled_matrices};
pub use pivot::PivotOrder;
pub(crate) use rewrite::Images;
pub(crate) use simplify::simplified;

/// Whether a pass keeps the bits.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Exactness {
    /// Same bits up to the sign of zeros, where all intermediate values are finite.
    Exact,
    /// Same value up to rounding.
    Rounding,
}

/// What passes know besides the graph.
#[derive(Clone, Debug, Default)]
pub struct Context {
    /// Values of the parameters to bake in; parameters that are not here stay inputs.
    pub parameters: Environment,
    /// States of the mechanism over its workspace, every state input of the graph, from which pivot orders are chosen.
    pub states: Vec<Environment>,
    /// Names of [`PASSES`] and of [`STEPS`](crate::pack::STEPS) that do not run, so that one can see what they are worth.
    pub left_out: Vec<String>,
}

impl Context {
    /// Whether a pass or a step of packing shall run.
    pub fn runs(&self, name: &str) -> bool {
        self.left_out.iter().all(|left_out| left_out != name)
    }
}

/// A row of [`PASSES`].
pub struct Pass {
    /// The verb, also its file.
    pub name: &'static str,
    /// Whether it keeps the bits.
    pub exactness: Exactness,
    /// What holds afterwards.
    pub after: &'static str,
    /// Whether it also runs on graphs in lanes.
    pub in_lanes: bool,
    /// Does it; what it decided goes into the list.
    pub run: fn(&Graph, &Context, &mut Vec<PivotOrder>) -> Graph,
}

use Exactness::{Exact, Rounding};

/// Every pass, in the order in which they run.
pub const PASSES: [Pass; 9] = [
    Pass {
        name: "bake",
        exactness: Rounding,
        after: "no node reads a baked parameter; no operation has only constant operands, unless its value is not finite",
        in_lanes: false,
        run: |graph, context, _| bake::bake(graph, context),
    },
    Pass {
        name: "simplify",
        exactness: Exact,
        after: "no operation has an operand that makes it trivial; negations stand only before roots, solves and outputs",
        in_lanes: false,
        run: |graph, _, _| simplify::simplify(graph),
    },
    Pass {
        name: "expand",
        exactness: Rounding,
        after: "no symmetric positive definite solve is left, nor, given states, a general one free of parameters",
        in_lanes: false,
        run: expand::expand,
    },
    Pass {
        name: "invert",
        exactness: Rounding,
        after: "no two divisions have the same divisor, and no divisor is constant",
        in_lanes: true,
        run: |graph, _, _| invert::invert(graph),
    },
    Pass {
        name: "merge",
        exactness: Rounding,
        after: "in sums of weighted nodes no pair of terms is formed twice where forming it once is cheaper",
        in_lanes: false,
        run: |graph, _, _| merge::merge(graph),
    },
    Pass {
        name: "settle",
        exactness: Exact,
        after: "no negation is left that a difference or a constant used nowhere else could take up",
        in_lanes: true,
        run: |graph, _, _| settle::settle(graph),
    },
    Pass {
        name: "chain",
        exactness: Rounding,
        after: "no term waits for a sum of products, read nowhere else, that it could begin with no later result",
        in_lanes: true,
        run: |graph, _, _| chain::chain(graph),
    },
    Pass {
        name: "fuse",
        exactness: Exact,
        after: "no sum has a product among its operands, unless the other one is a product that is fused",
        in_lanes: true,
        run: |graph, _, _| fuse::fuse(graph),
    },
    Pass {
        name: "prune",
        exactness: Exact,
        after: "every node and solve is needed by an output, and every parameter among the inputs is read",
        in_lanes: true,
        run: |graph, _, _| prune::prune(graph),
    },
];

/// What a pass did.
#[derive(Clone, PartialEq, Debug)]
pub struct PassReport {
    /// The pass.
    pub name: &'static str,
    /// Whether it keeps the bits.
    pub exactness: Exactness,
    /// Operations before it.
    pub before: OperationCount,
    /// Operations after it.
    pub after: OperationCount,
    /// Linear systems it expanded.
    pub pivot_orders: Vec<PivotOrder>,
}

/// Runs every pass in order.
pub fn run_passes(graph: &Graph, context: &Context) -> (Graph, Vec<PassReport>) {
    run(PASSES.iter(), graph, context)
}

/// Runs every pass that works on graphs in lanes, in order.
pub fn run_passes_in_lanes(graph: &Graph, context: &Context) -> Graph {
    run(PASSES.iter().filter(|pass| pass.in_lanes), graph, context).0
}

fn run<'a>(
    passes: impl Iterator<Item = &'a Pass>,
    graph: &Graph,
    context: &Context,
) -> (Graph, Vec<PassReport>) {
    let mut graph = graph.clone();
    let mut before = graph.operation_count();
    let mut reports = Vec::with_capacity(PASSES.len());
    for pass in passes.filter(|pass| context.runs(pass.name)) {
        let mut pivot_orders = Vec::new();
        graph = (pass.run)(&graph, context, &mut pivot_orders);
        let after = graph.operation_count();
        reports.push(PassReport { name: pass.name, exactness: pass.exactness, before, after, pivot_orders });
        before = after;
    }
    (graph, reports)
}
