//! The file of kernel traits: one per function that all leg types have in common, and a module per leg type for the others;
//! then the same once more in the module `generic`, for any type of number.

use std::collections::BTreeMap;

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::function::allow;
use super::names::{PARAMETERS, SCALAR, check_type_names, identifier, type_identifier};
use super::print::source;
use super::signature::Signature;
use super::{EmitError, Header};

/// Text of the file.
pub fn kernels_file(header: &Header, signatures: &[Signature]) -> Result<String, EmitError> {
    let mut text = header.text();
    let mut of_leg_types: BTreeMap<&str, Vec<&Signature>> = BTreeMap::new();
    let mut common = Vec::new();
    for signature in signatures {
        match &signature.leg_type {
            None => common.push(signature),
            Some(leg_type) => of_leg_types.entry(leg_type).or_default().push(signature),
        }
    }
    check_type_names(common.iter().map(|signature| signature.name.as_str()))?;
    let mut generic: Vec<TokenStream> =
        common.iter().map(|signature| generic_kernel(signature)).collect::<Result<_, _>>()?;
    for signature in common {
        text.push('\n');
        text.push_str(&source(&signature.name, kernel(signature)?)?);
    }
    for (leg_type, signatures) in of_leg_types {
        check_type_names(signatures.iter().map(|signature| signature.name.as_str()))?;
        let of_generic =
            signatures.iter().map(|signature| generic_kernel(signature)).collect::<Result<_, _>>()?;
        generic.push(module(leg_type, of_generic)?);
        let kernels = signatures.into_iter().map(kernel).collect::<Result<Vec<_>, _>>()?;
        text.push('\n');
        text.push_str(&source(leg_type, module(leg_type, kernels)?)?);
    }
    text.push('\n');
    text.push_str(&source(
        GENERIC,
        quote! {
            /// The same functions for any type of number, such as [lanes](crate::lanes). Code is made where they are called.
            pub mod generic { #(#generic)* }
        },
    )?);
    Ok(text)
}

/// Module of the traits for any type of number.
const GENERIC: &str = "generic";

/// The module of a leg type.
fn module(leg_type: &str, kernels: Vec<TokenStream>) -> Result<TokenStream, EmitError> {
    let module = identifier(leg_type, leg_type)?;
    let line = format!("Functions whose outputs belong to legs of type `{leg_type}`.");
    let title = super::signature::documentation(&[line]);
    Ok(quote!(#title pub mod #module { #(#kernels)* }))
}

/// The trait of one function.
fn kernel(signature: &Signature) -> Result<TokenStream, EmitError> {
    let kernel = type_identifier(&signature.name)?;
    let function = signature.identifier()?;
    let documentation = signature.documentation();
    let scalar = format_ident!("{SCALAR}");
    let arguments = signature.arguments(&quote!(#scalar))?;
    let allow = allow(quote!());
    let title = super::signature::documentation(&[format!("A model that has `{}`.", signature.name)]);
    Ok(quote! {
        #title
        #allow
        pub trait #kernel<#scalar = f64> {
            #documentation
            fn #function(&self, #(#arguments),*);
        }
    })
}

/// The trait of one function for any type of number.
fn generic_kernel(signature: &Signature) -> Result<TokenStream, EmitError> {
    let kernel = type_identifier(&signature.name)?;
    let function = signature.identifier()?;
    let scalar = format_ident!("{SCALAR}");
    let parameters = format_ident!("{PARAMETERS}");
    let arguments = signature.arguments(&quote!(#scalar))?;
    let allow = allow(quote!());
    let path = signature.kernel()?.to_string().replace(' ', "");
    let name = &signature.name;
    let title =
        super::signature::documentation(&[format!("A model that has `{name}` for any type of number.")]);
    let documentation = super::signature::documentation(&[format!(
        "[`{name}`](crate::kernels::{path}::{name}), with parameters of the same type of number."
    )]);
    Ok(quote! {
        #title
        #allow
        pub trait #kernel: crate::lanes::Generic {
            #documentation
            fn #function<#scalar: crate::float::Scalar>(#parameters: &Self::Parameters<#scalar>, #(#arguments),*);
        }
    })
}
