//! Graphs to Rust source. No algebra here: what a graph says is what is printed, operation for operation, so results
//! are bit-identical with the interpreter's.
//!
//! | file | holds |
//! |-|-|
//! | `signature` | the outside of a function: documentation, argument types |
//! | `body`, `expression` | the inside: statements and section comments, expressions |
//! | `placement`, `schedule`, `blocks` | which values get a name, in which order, in which block |
//! | `function`, `model`, `kernels`, `header` | a free function; the files and their first lines |
//! | `generic` | a model's functions for any type of number, its parameters in lanes |
//! | `prepared` | a model with what follows from its parameters alone |
//! | `setters` | checked access to the parameters of a model |
//! | `limits` | what the platform's actuators and joints may do |
//! | `names`, `print` | identifiers; items to text |

mod blocks;
mod body;
mod error;
mod expression;
mod function;
mod generic;
mod header;
mod kernels;
mod limits;
mod model;
mod names;
mod placement;
mod prepared;
mod print;
mod schedule;
mod setters;
mod signature;

pub use error::EmitError;
pub use function::function;
pub use header::{CountRow, Elimination, Header, Source};
pub use kernels::kernels_file;
pub use limits::Limits;
pub use model::{Model, Scalar, model_file};
pub use names::type_name;
pub use signature::Signature;

/// Where generated code finds the runtime crate.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct RuntimePath(String);

impl RuntimePath {
    /// For a file inside the runtime crate itself.
    pub fn inside() -> RuntimePath {
        RuntimePath("crate".into())
    }

    /// A path such as `::dyn_runtime`.
    pub fn new(path: &str) -> Result<RuntimePath, EmitError> {
        syn::parse_str::<syn::Path>(path)
            .ok()
            .filter(|path| path.segments.iter().all(|segment| segment.arguments.is_none()))
            .map(|_| RuntimePath(path.into()))
            .ok_or_else(|| EmitError::RuntimePath { path: path.into() })
    }

    fn tokens(&self) -> proc_macro2::TokenStream {
        // Checked by the constructor.
        self.0.parse().unwrap_or_default()
    }
}
