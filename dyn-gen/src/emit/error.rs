//! Why a graph cannot be printed.

/// A graph that has no Rust source. Each message names the function and what stands in the way.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum EmitError {
    /// A constant that Rust has no literal for.
    #[error(
        "function `{function}`: node {node} is the constant {value}; only finite constants can be printed"
    )]
    NonFiniteConstant {
        /// The function.
        function: String,
        /// Index of the node.
        node: u32,
        /// The constant.
        value: f64,
    },
    /// A symmetric system that no pass has expanded into arithmetic.
    #[error(
        "function `{function}`: the symmetric system `{solve}` is still one operation; run the pass that expands it"
    )]
    SymmetricSolve {
        /// The function.
        function: String,
        /// Name of the solution.
        solve: String,
    },
    /// A name that cannot stand in the generated source.
    #[error("function `{function}`: `{name}` cannot be used as a name in generated code: {reason}")]
    Name {
        /// The function (or model) the name occurs in.
        function: String,
        /// The name.
        name: String,
        /// Why not.
        reason: &'static str,
    },
    /// An option that is not a path such as `::dyn_runtime`.
    #[error("`{path}` is not a path to the runtime crate (examples: `::dyn_runtime`, `crate`)")]
    RuntimePath {
        /// What was given.
        path: String,
    },
    /// A type of number that models cannot have.
    #[error("`{name}` is not a type of number; f64 and f32 are")]
    Scalar {
        /// What was given.
        name: String,
    },
    /// The printed tokens are not Rust: a fault of the generator.
    #[error("`{item}`: the generated source does not parse ({message}); this is a fault of dyn-gen")]
    Unparsable {
        /// Function or item.
        item: String,
        /// What the parser said.
        message: String,
    },
}
