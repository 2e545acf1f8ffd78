//! One call, several lanes: a function's graph with three numbers in each operation wherever three are computed alike.
//!
//! Alike are the components of a vector, the entries of a row, and legs: the derivation writes one leg and maps it over
//! six, so legs 1 to 6 stand in two times three lanes. Nothing here knows mechanics or Rust; what is alike is read off the
//! graph, starting from the arrays that the steps of the function hand on.
//!
//! | file | does |
//! |-|-|
//! | `partition` | says which legs stand side by side |
//! | `blocks` | writes linear systems out in 3 x 3 blocks, which suit lanes and need two divisions one after the other |
//! | `sums` | sums over legs: first lane by lane, then across lanes |
//! | `superword` | finds three alike from their results back to their operands |
//! | `attempts` | hands solutions in blocks and their systems on as they stand in lanes, for examination at run time |
//! | `order` | puts operations in the order in which a processor can begin them |
//! | `hoist` | takes out what follows from parameters at run time alone |
//! | `unpack` | the same graph without lanes, for evaluation |

mod attempts;
mod blocks;
mod hoist;
mod order;
mod partition;
mod sums;
mod superword;
mod unpack;

pub(crate) use hoist::row;
pub use hoist::{Hoisted, PREPARED, hoist};
pub use partition::Partition;
pub use unpack::unpack;

use crate::graph::{Graph, Group, NodeId};
use crate::passes::{Context, run_passes_in_lanes};

/// A function in lanes.
#[derive(Clone, Debug)]
pub struct Packed {
    /// The graph, ready to be printed in the order of its nodes.
    pub graph: Graph,
    /// Which legs stand side by side.
    pub partition: Partition,
}

/// Steps of [`pack`] that a function in lanes can do without.
pub const STEPS: [&str; 3] = ["partition", "sums", "order"];

/// A flattened function of `leg_count` legs in lanes, its parameters baked as `context` says; `groups` as
/// [`Program::flatten_with_groups`](crate::graph::Program::flatten_with_groups) gives them.
pub fn pack(graph: &Graph, groups: Vec<Group>, leg_count: usize, context: &Context) -> Packed {
    let partition = if context.runs("partition") {
        partition::choose(graph, context, leg_count)
    } else {
        Partition::in_order(leg_count)
    };
    let (graph, groups) = blocks::expand(graph, groups, &partition);
    let (graph, groups) = if context.runs("sums") {
        sums::regroup(&graph, groups, context, &partition)
    } else {
        (graph, groups)
    };
    let graph = superword::superword(&graph, &groups, context, &partition);
    let graph = run_passes_in_lanes(&graph, context);
    let graph = attempts::side_by_side(&graph, &partition);
    let graph = if context.runs("order") { order::order(&graph) } else { graph };
    Packed { graph, partition }
}

/// The groups with their nodes replaced; those with a node that is no longer there are dropped.
fn mapped(groups: Vec<Group>, image: impl Fn(NodeId) -> Option<NodeId>) -> Vec<Group> {
    let of = |nodes: Vec<NodeId>| nodes.into_iter().map(&image).collect::<Option<Vec<_>>>();
    groups
        .into_iter()
        .filter_map(|group| match group {
            Group::Array { shape, nodes } => of(nodes).map(|nodes| Group::Array { shape, nodes }),
            Group::Legs(nodes) => of(nodes).map(Group::Legs),
        })
        .collect()
}
