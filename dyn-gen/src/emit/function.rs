//! A graph as a free function.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::EmitError;
use super::body::{Body, body};
use super::names::{CONSTANT, PARAMETERS, SCALAR};
use super::print::{parse, source_with_comments};
use super::signature::Signature;
use crate::graph::{Graph, Node};

/// Source of one function: signature and flat body, generic in the scalar.
///
/// Names it expects in scope: `Scalar`, `sqrt`, `solve_general`, and `Parameters` where the graph still has parameters.
pub fn function(graph: &Graph, with_parameters: bool) -> Result<String, EmitError> {
    let signature = Signature::of(graph);
    let name = signature.identifier()?;
    let documentation = signature.documentation();
    let scalar = format_ident!("{SCALAR}");
    let arguments = signature.arguments(&quote!(#scalar))?;
    let parameters = format_ident!("{PARAMETERS}");
    let parameters = with_parameters.then(|| quote!(#parameters: &Parameters<#scalar>,));
    // Named once per function: `c(0.5)` alone would leave its type open on the left of an operator.
    let is_constant = |node: &Node| matches!(node, Node::Constant(_));
    let constant = graph.nodes.iter().any(is_constant).then(|| {
        let name = format_ident!("{CONSTANT}");
        quote!(let #name = #scalar::constant;)
    });
    // Every model has the same signatures: what its numbers make unnecessary stays an argument.
    let allow = allow(quote!(unused_variables));
    let mut item: syn::ItemFn = parse(
        &graph.name,
        quote! {
            #documentation
            #allow
            #[inline(always)]
            pub fn #name<#scalar: Scalar>(#parameters #(#arguments),*) {
                #constant
            }
        },
    )?;
    let Body { statements, comments } = body(graph)?;
    item.block.stmts.extend(statements);
    Ok(source_with_comments(item, &comments))
}

/// Lints made for code that people write: whatever a caller's crate turns on, generated items stay silent.
pub(super) fn allow(and: TokenStream) -> TokenStream {
    quote!(#[allow(clippy::all, clippy::pedantic, #and)])
}
