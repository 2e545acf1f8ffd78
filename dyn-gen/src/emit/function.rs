//! A graph as a free function.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use super::EmitError;
use super::body::body;
use super::names::{CONSTANT, CONSTANT_IN_LANES, PARAMETERS, SCALAR, SCALARS_IN_LANES};
use super::print::source;
use super::signature::Signature;
use crate::graph::{Graph, Node};

/// Source of one function: signature and flat body, generic in the scalar, or in the triple of scalars if the graph has lanes.
///
/// Names it expects in scope: `Scalar`, `Triple`, `sqrt`, the multiplications with an addition, `solve_general`, and `Parameters` where the graph still has parameters.
pub fn function(graph: &Graph, with_parameters: bool) -> Result<String, EmitError> {
    let signature = Signature::of(graph);
    let name = signature.identifier()?;
    let documentation = signature.documentation();
    let in_lanes = graph.has_lanes();
    let name = if in_lanes { name_in_lanes(&name) } else { name };
    let (generics, scalar) = if in_lanes {
        let lanes = format_ident!("{SCALARS_IN_LANES}");
        (quote!(#lanes: Triple), quote!(#lanes::Lane))
    } else {
        let scalar = format_ident!("{SCALAR}");
        (quote!(#scalar: Scalar), quote!(#scalar))
    };
    let arguments = signature.arguments(&scalar)?;
    let parameters = format_ident!("{PARAMETERS}");
    let parameters = with_parameters.then(|| quote!(#parameters: &Parameters<#scalar>,));
    // Named once per function: `c(0.5)` alone would leave its type open on the left of an operator.
    let is_constant = |node: &Node| matches!(node, Node::Constant(_));
    let constant = graph.nodes.iter().any(is_constant).then(|| {
        let name = format_ident!("{CONSTANT}");
        let in_lanes = in_lanes.then(|| {
            let (name, lanes) = (format_ident!("{CONSTANT_IN_LANES}"), format_ident!("{SCALARS_IN_LANES}"));
            quote!(let #name = <#lanes as Scalar>::constant;)
        });
        let of = if in_lanes.is_some() { quote!(<#scalar as Scalar>) } else { quote!(#scalar) };
        quote!(let #name = #of::constant; #in_lanes)
    });
    // Every model has the same signatures: what its numbers make unnecessary stays an argument.
    let allow = allow(quote!(unused_variables));
    let empty = source(
        &graph.name,
        quote! {
            #documentation
            #allow
            #[inline(always)]
            pub fn #name<#generics>(#parameters #(#arguments),*) {
                #constant
            }
        },
    )?;
    let head = empty.trim_end().trim_end_matches('}').trim_end();
    Ok([head, "\n", &body(graph)?, "}\n"].concat())
}

/// Name of the function in lanes.
pub(super) fn name_in_lanes(name: &Ident) -> Ident {
    format_ident!("{name}_in_lanes")
}

/// Lints made for code that people write: whatever a caller's crate turns on, generated items stay silent.
pub(super) fn allow(and: TokenStream) -> TokenStream {
    quote!(#[allow(clippy::all, clippy::pedantic, #and)])
}
