//! The file of one model: a type that implements the kernel traits, parameters if any remain, the functions.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::function::allow;
use super::names::{PARAMETERS, check_type_names, identifier, type_identifier};
use super::print::source;
use super::setters;
use super::signature::{Signature, array_type, documentation, symbol_line};
use super::{EmitError, Header, RuntimePath};
use crate::graph::Symbol;

/// A model to print. It is baked when it has no parameters.
pub struct Model<'a> {
    /// Name of the platform or family, e.g. `uhp_2016`; the type is called `Uhp2016`.
    pub name: &'a str,
    /// Where the runtime crate is, seen from the generated file.
    pub runtime: &'a RuntimePath,
    /// What stays a run-time number, in the order of the fields.
    pub parameters: &'a [Symbol],
    /// Their values until others are given, flat, in the same order; none for a model of any platform.
    pub defaults: Option<&'a [Vec<f64>]>,
    /// What callers see of each function.
    pub signatures: &'a [Signature],
    /// Source of each function, as printed by [`super::function`].
    pub functions: &'a [String],
}

/// Text of the model's file.
pub fn model_file(header: &Header, model: &Model) -> Result<String, EmitError> {
    check_type_names(model.signatures.iter().map(|signature| signature.name.as_str()))?;
    let mut text = header.text();
    for item in items(model)? {
        text.push('\n');
        text.push_str(&source(model.name, item)?);
    }
    for function in model.functions {
        text.push('\n');
        text.push_str(function);
    }
    Ok(text)
}

/// Everything before the functions, one item after another.
fn items(model: &Model) -> Result<Vec<TokenStream>, EmitError> {
    let runtime = model.runtime.tokens();
    let name = type_identifier(model.name)?;
    if name == "Parameters" {
        return Err(EmitError::Name {
            function: model.name.into(),
            name: name.to_string(),
            reason: "the generated code uses it itself",
        });
    }
    let mut items = vec![quote! {
        #[allow(unused_imports)]
        use #runtime::float::sqrt;
        #[allow(unused_imports)]
        use #runtime::solve::solve_general;
    }];
    if model.parameters.is_empty() {
        let title = documentation(&[format!("The platform `{}`, every number baked in.", model.name)]);
        items.push(quote! {
            #title
            #[derive(Clone, Copy, Debug, Default, PartialEq)]
            pub struct #name;
        });
    } else {
        items.extend(parameters(model)?);
        let title =
            documentation(&[format!("The model `{}`, physical numbers given at run time.", model.name)]);
        items.push(quote! {
            #title
            #[derive(Clone, Copy, Debug, PartialEq)]
            pub struct #name {
                /// The physical numbers.
                pub parameters: Parameters,
            }
        });
        items.extend(setters::items(model)?);
    }
    for signature in model.signatures {
        items.push(implementation(model, signature)?);
    }
    Ok(items)
}

/// The struct of run-time numbers and its constructor.
fn parameters(model: &Model) -> Result<[TokenStream; 2], EmitError> {
    let mut fields = TokenStream::new();
    let mut unfilled = TokenStream::new();
    let mut fills = TokenStream::new();
    for symbol in model.parameters {
        let field = identifier(model.name, &symbol.name)?;
        let line = documentation(&[symbol_line(symbol)]);
        let array = array_type(&symbol.shape);
        let nan = symbol.shape.iter().rev().fold(quote!(f64::NAN), |element, length| {
            let length = proc_macro2::Literal::usize_unsuffixed(*length);
            quote!([#element; #length])
        });
        let flat = match symbol.shape.len() {
            0 => quote!(core::slice::from_mut(&mut parameters.#field)),
            1 => quote!(&mut parameters.#field),
            nested => {
                let first = quote!(parameters.#field);
                (1..nested).fold(first, |array, _| quote!(#array.as_flattened_mut()))
            }
        };
        let name = &symbol.name;
        fields.extend(quote!(#line pub #field: #array,));
        unfilled.extend(quote!(#field: #nan,));
        fills.extend(quote!(fill(#name, #flat);));
    }
    let structure = quote! {
        /// Physical numbers of a platform; of a quantity that legs have, the leg is the first dimension.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct Parameters {
            #fields
        }
    };
    let constructor = quote! {
        impl Parameters {
            /// Parameters filled field by field: `fill(name, values)` gets the name of each field and its elements,
            /// row-major, to be written. What it leaves alone stays NaN, so that no result can come from it.
            pub fn from_fn(mut fill: impl FnMut(&str, &mut [f64])) -> Self {
                let mut parameters = Parameters { #unfilled };
                #fills
                parameters
            }
        }
    };
    Ok([structure, constructor])
}

/// The kernel trait of one function, by a call of the free function.
fn implementation(model: &Model, signature: &Signature) -> Result<TokenStream, EmitError> {
    let runtime = model.runtime.tokens();
    let model_name = type_identifier(model.name)?;
    let kernel = signature.kernel()?;
    let function = signature.identifier()?;
    let arguments = signature.arguments()?;
    let names = signature.argument_names()?;
    let allow = allow(quote!(unused_qualifications));
    let field = format_ident!("{PARAMETERS}");
    let parameters = (!model.parameters.is_empty()).then(|| quote!(&self.#field,));
    // `self::`: an output may have the function's name.
    Ok(quote! {
        #allow
        impl #runtime::kernels::#kernel for #model_name {
            fn #function(&self, #(#arguments),*) {
                self::#function(#parameters #(#names),*);
            }
        }
    })
}
