//! A model whose parameters are set: with what follows from them alone.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use super::EmitError;
use super::function::allow;
use super::model::{Model, Scalar, call_in_lanes};
use super::names::{PARAMETERS, SCALAR, identifier, type_identifier};
use super::signature::{Signature, array_type, documentation};

/// The type, how it is made, and that it computes what the model computes; nothing if no function would gain by it.
pub(super) fn items(model: &Model) -> Result<Vec<TokenStream>, EmitError> {
    if model.prepared.is_empty() || !model.scalars.contains(&Scalar::F64) {
        return Ok(Vec::new());
    }
    let runtime = model.runtime.tokens();
    let name = type_identifier(model.name)?;
    let prepared = format_ident!("Prepared{name}");
    let (mut fields, mut empty, mut calls) = (TokenStream::new(), TokenStream::new(), TokenStream::new());
    for (function, shape) in model.prepared {
        let field = identifier(model.name, function)?;
        let prepare = identifier(model.name, &format!("prepare_{function}"))?;
        let array = array_type(&quote!(f64), shape);
        let zeros = array_type(&quote!(0.0), shape);
        fields.extend(quote!(#field: #array,));
        empty.extend(quote!(#field: #zeros,));
        calls.extend(quote!(self::#prepare(&self.parameters, &mut prepared.#field);));
    }
    let title = documentation(&[
        format!("[`{name}`] for many calls with the same parameters: what follows from them alone is"),
        "computed already, for functions in lanes.".into(),
        String::new(),
        "Its parameters stay as they are; others make another one.".into(),
    ]);
    let allow = allow(quote!(dead_code, unused_qualifications));
    let mut items = vec![
        quote! {
            #title
            #[derive(Clone, Copy, Debug, PartialEq)]
            pub struct #prepared {
                model: #name,
                #fields
            }
        },
        quote! {
            #allow
            impl #name {
                /// The model with everything computed that follows from its parameters alone.
                pub fn prepared(self) -> #prepared {
                    let mut prepared = #prepared { model: self, #empty };
                    #calls
                    prepared
                }
            }
        },
        quote! {
            #allow
            impl #prepared {
                /// The model as it was when this was made, with its parameters.
                pub fn model(&self) -> &#name {
                    &self.model
                }
            }
        },
        quote! {
            impl #runtime::lanes::Generic for #prepared {
                type Parameters<T: Scalar> = Parameters<T>;
            }
        },
        quote! {
            impl #runtime::lanes::InLanes<f64> for #prepared {
                #[inline(always)]
                fn in_lanes<'a, T: #runtime::lanes::Lanes<Number = f64>>(of_lane: impl Fn(usize) -> &'a Self) -> Parameters<T> {
                    <#name as #runtime::lanes::InLanes<f64>>::in_lanes(|lane| &of_lane(lane).model)
                }
            }
        },
    ];
    for signature in model.signatures {
        items.push(kernel(model, signature, &prepared)?);
        items.push(generic(model, signature, &prepared)?);
    }
    Ok(items)
}

/// The kernel trait of one function.
fn kernel(model: &Model, signature: &Signature, prepared: &Ident) -> Result<TokenStream, EmitError> {
    let runtime = model.runtime.tokens();
    let kernel = signature.kernel()?;
    let function = signature.identifier()?;
    let arguments = signature.arguments(&quote!(f64))?;
    let names = signature.argument_names()?;
    let allow = allow(quote!(unused_qualifications));
    let body = match model.prepared.iter().find(|(name, _)| *name == signature.name) {
        Some((_, shape)) => {
            let parameters = format_ident!("{PARAMETERS}");
            let array = array_type(&quote!(f64), shape);
            let call = call_in_lanes(model, signature, Scalar::F64, Some(&array))?;
            quote! {
                let #parameters = &self.model.#parameters;
                let prepared = &self.#function;
                #call
            }
        }
        None => quote!(#runtime::kernels::#kernel::#function(&self.model, #(#names),*);),
    };
    Ok(quote! {
        #allow
        impl #runtime::kernels::#kernel for #prepared {
            #[inline]
            fn #function(&self, #(#arguments),*) {
                #body
            }
        }
    })
}

/// The generic kernel trait of one function.
fn generic(model: &Model, signature: &Signature, prepared: &Ident) -> Result<TokenStream, EmitError> {
    let runtime = model.runtime.tokens();
    let kernel = signature.kernel()?;
    let function = signature.identifier()?;
    let scalar = format_ident!("{SCALAR}");
    let arguments = signature.arguments(&quote!(#scalar))?;
    let names = signature.argument_names()?;
    let allow = allow(quote!(unused_qualifications));
    Ok(quote! {
        #allow
        impl #runtime::kernels::generic::#kernel for #prepared {
            #[inline(always)]
            fn #function<#scalar: Scalar>(parameters: &Parameters<#scalar>, #(#arguments),*) {
                self::#function(parameters, #(#names),*);
            }
        }
    })
}
