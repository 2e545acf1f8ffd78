//! A model's functions for any type of number, and its parameters in lanes.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use super::EmitError;
use super::function::allow;
use super::model::Model;
use super::names::{PARAMETERS, SCALAR, identifier, type_identifier};
use super::signature::Signature;

/// Implementations of the runtime's traits `Generic`, `InLanes` and `kernels::generic`.
pub(super) fn items(model: &Model) -> Result<Vec<TokenStream>, EmitError> {
    let runtime = model.runtime.tokens();
    let name = type_identifier(model.name)?;
    let mut items = if model.parameters.is_empty() {
        vec![
            quote! {
                impl #runtime::lanes::Generic for #name {
                    type Parameters<T: Scalar> = ();
                }
            },
            quote! {
                impl<S: #runtime::lanes::Number> #runtime::lanes::InLanes<S> for #name {
                    #[inline(always)]
                    fn in_lanes<'a, T: #runtime::lanes::Lanes<Number = S>>(_: impl Fn(usize) -> &'a Self) {}
                }
            },
        ]
    } else {
        let fields = model.parameters.iter().map(|symbol| {
            let field = identifier(model.name, &symbol.name)?;
            let depth = 0..symbol.shape.len();
            let indices: Vec<Ident> = depth.map(|k| format_ident!("i{k}")).collect();
            let number = quote!(T::from_fn(|lane| of_lane(lane).parameters.#field #([#indices])*));
            let array = indices
                .iter()
                .rev()
                .fold(number, |element, index| quote!(core::array::from_fn(|#index| #element)));
            Ok(quote!(#field: #array,))
        });
        let fields = fields.collect::<Result<Vec<_>, EmitError>>()?;
        vec![
            quote! {
                impl<S> #runtime::lanes::Generic for #name<S> {
                    type Parameters<T: Scalar> = Parameters<T>;
                }
            },
            quote! {
                impl<S: #runtime::lanes::Number> #runtime::lanes::InLanes<S> for #name<S> {
                    #[inline(always)]
                    fn in_lanes<'a, T: #runtime::lanes::Lanes<Number = S>>(of_lane: impl Fn(usize) -> &'a Self) -> Parameters<T> {
                        Parameters { #(#fields)* }
                    }
                }
            },
        ]
    };
    for signature in model.signatures {
        items.push(implementation(model, signature)?);
    }
    Ok(items)
}

/// The generic kernel trait of one function, by a call of the free function.
fn implementation(model: &Model, signature: &Signature) -> Result<TokenStream, EmitError> {
    let runtime = model.runtime.tokens();
    let model_name = type_identifier(model.name)?;
    let kernel = signature.kernel()?;
    let function = signature.identifier()?;
    let scalar = format_ident!("{SCALAR}");
    let arguments = signature.arguments(&quote!(#scalar))?;
    let names = signature.argument_names()?;
    let allow = allow(quote!(unused_qualifications));
    let parameters = format_ident!("{PARAMETERS}");
    let (of_model, generic, parameter, passed) = if model.parameters.is_empty() {
        (None, None, quote!(_: &(),), None)
    } else {
        let of = quote!(<S>);
        (Some(of.clone()), Some(of), quote!(#parameters: &Parameters<#scalar>,), Some(quote!(#parameters,)))
    };
    Ok(quote! {
        #allow
        impl #generic #runtime::kernels::generic::#kernel for #model_name #of_model {
            #[inline(always)]
            fn #function<#scalar: Scalar>(#parameter #(#arguments),*) {
                self::#function(#passed #(#names),*);
            }
        }
    })
}
