//! The file of one model: a type that implements the kernel traits, parameters if any remain, the functions.

use std::str::FromStr;

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::function::{allow, name_in_lanes};
use super::names::{PARAMETERS, SCALAR, SCALARS_IN_LANES, check_type_names, identifier, type_identifier};
use super::print::source;
use super::signature::{Signature, array_type, documentation, symbol_line};
use super::{EmitError, Header, RuntimePath};
use super::{Limits, generic, limits, prepared, setters};
use crate::graph::Symbol;
use crate::pack::PREPARED;

/// A type of number that a model computes with.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Scalar {
    /// Double precision.
    F64,
    /// Single precision.
    F32,
}

impl Scalar {
    /// The type's name in Rust.
    pub fn name(self) -> &'static str {
        match self {
            Scalar::F64 => "f64",
            Scalar::F32 => "f32",
        }
    }
}

impl FromStr for Scalar {
    type Err = EmitError;

    fn from_str(name: &str) -> Result<Scalar, EmitError> {
        let named = |scalar: &Scalar| scalar.name() == name;
        [Scalar::F64, Scalar::F32]
            .into_iter()
            .find(named)
            .ok_or_else(|| EmitError::Scalar { name: name.into() })
    }
}

/// A model to print. It is baked when it has no parameters.
pub struct Model<'a> {
    /// Name of the platform or family, e.g. `uhp_2016`; the type is called `Uhp2016`.
    pub name: &'a str,
    /// Where the runtime crate is, seen from the generated file.
    pub runtime: &'a RuntimePath,
    /// What stays a run-time number, in the order of the fields.
    pub parameters: &'a [Symbol],
    /// The types of number for which the model implements the kernel traits; its functions take any. Code is made where a
    /// function is called: it is faster for what a caller's code tells of the arguments, and what nobody calls costs nothing.
    pub scalars: &'a [Scalar],
    /// Their values until others are given, flat, in the same order; none for a model of any platform.
    pub defaults: Option<&'a [Vec<f64>]>,
    /// What actuators and joints may do; none for a model of any platform.
    pub limits: Option<&'a Limits>,
    /// What callers see of each function.
    pub signatures: &'a [Signature],
    /// Source of each function, as printed by [`super::function`], without lanes and then in lanes.
    pub functions: &'a [String],
    /// Names of the functions that also exist in lanes.
    pub in_lanes: &'a [String],
    /// Those of them that are also printed in two parts, with the shape of what the first hands to the second.
    pub prepared: &'a [(String, Vec<usize>)],
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
    if ["Parameters", "Scalar", "Triple", "S", SCALAR, SCALARS_IN_LANES].iter().any(|taken| name == taken) {
        return Err(EmitError::Name {
            function: model.name.into(),
            name: name.to_string(),
            reason: "the generated code uses it itself",
        });
    }
    let scalar = format_ident!("{SCALAR}");
    let mut items = vec![quote! {
        #[allow(unused_imports)]
        use #runtime::float::{Scalar, mul_add, mul_sub, neg_mul_add, sqrt};
        #[allow(unused_imports)]
        use #runtime::solve::{solve_after_attempt, solve_after_attempt_in_lanes, solve_general};
        #[allow(unused_imports)]
        use #runtime::triple::Triple;
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
            pub struct #name<#scalar = f64> {
                /// The physical numbers.
                pub parameters: Parameters<#scalar>,
            }
        });
        items.extend(setters::items(model)?);
    }
    items.extend(limits::items(model)?);
    for (place, &scalar) in model.scalars.iter().enumerate() {
        if model.scalars[..place].contains(&scalar) {
            continue;
        }
        for signature in model.signatures {
            items.push(implementation(model, signature, scalar)?);
        }
    }
    items.extend(generic::items(model)?);
    items.extend(prepared::items(model)?);
    Ok(items)
}

/// The struct of run-time numbers and its constructor.
fn parameters(model: &Model) -> Result<[TokenStream; 2], EmitError> {
    let scalar = format_ident!("{SCALAR}");
    let mut fields = TokenStream::new();
    let mut unfilled = TokenStream::new();
    let mut fills = TokenStream::new();
    for symbol in model.parameters {
        let field = identifier(model.name, &symbol.name)?;
        let line = documentation(&[symbol_line(symbol)]);
        let array = array_type(&quote!(#scalar), &symbol.shape);
        let nan = symbol.shape.iter().rev().fold(quote!(#scalar::constant(f64::NAN)), |element, length| {
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
        #[allow(dead_code)]
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct Parameters<#scalar = f64> {
            #fields
        }
    };
    let constructor = quote! {
        #[allow(dead_code)]
        impl<#scalar: Scalar> Parameters<#scalar> {
            /// Parameters filled field by field: `fill(name, values)` gets the name of each field and its elements,
            /// row-major, to be written. What it leaves alone stays NaN, so that no result can come from it.
            pub fn from_fn(mut fill: impl FnMut(&str, &mut [#scalar])) -> Self {
                let mut parameters = Parameters { #unfilled };
                #fills
                parameters
            }
        }
    };
    Ok([structure, constructor])
}

/// The kernel trait of one function for one type of number, by a call of the free function.
fn implementation(model: &Model, signature: &Signature, scalar: Scalar) -> Result<TokenStream, EmitError> {
    let runtime = model.runtime.tokens();
    let model_name = type_identifier(model.name)?;
    let kernel = signature.kernel()?;
    let function = signature.identifier()?;
    let number = format_ident!("{}", scalar.name());
    let arguments = signature.arguments(&quote!(#number))?;
    let names = signature.argument_names()?;
    // The default of the traits and of the model's type.
    let of_number = (scalar != Scalar::F64).then(|| quote!(<#number>));
    let of_model = if model.parameters.is_empty() { None } else { of_number.clone() };
    let allow = allow(quote!(unused_qualifications));
    let field = format_ident!("{PARAMETERS}");
    let parameters = (!model.parameters.is_empty()).then(|| quote!(&self.#field,));
    let in_lanes = scalar == Scalar::F64 && model.in_lanes.contains(&signature.name);
    let body = if in_lanes {
        let given = (!model.parameters.is_empty()).then(|| quote!(let #field = &self.#field;));
        let call = call_in_lanes(model, signature, scalar, None)?;
        quote! {
            #given
            #call
        }
    } else {
        // `self::`: an output may have the function's name.
        quote!(self::#function(#parameters #(#names),*);)
    };
    Ok(quote! {
        #allow
        impl #runtime::kernels::#kernel #of_number for #model_name #of_model {
            #[inline]
            fn #function(&self, #(#arguments),*) {
                #body
            }
        }
    })
}

/// The call of a function in lanes, or without where there are no registers for them; of its second part with the array
/// `prepared` of this type, if it is given.
pub(super) fn call_in_lanes(
    model: &Model,
    signature: &Signature,
    scalar: Scalar,
    prepared: Option<&TokenStream>,
) -> Result<TokenStream, EmitError> {
    let runtime = model.runtime.tokens();
    let function = signature.identifier()?;
    let number = format_ident!("{}", scalar.name());
    let names = signature.argument_names()?;
    let field = format_ident!("{PARAMETERS}");
    let parameters = (!model.parameters.is_empty()).then(|| quote!(#field: Parameters<#number>,));
    let inputs = signature.inputs.iter().zip(&names);
    let outputs = signature.outputs.iter().zip(&names[signature.inputs.len()..]);
    let typed = |(symbol, name): (&Symbol, &proc_macro2::Ident)| {
        let array = array_type(&quote!(#number), &symbol.shape);
        quote!(#name: #array)
    };
    let (inputs, outputs) = (inputs.map(typed), outputs.map(typed));
    Ok(match prepared {
        None => {
            let in_lanes = name_in_lanes(&function);
            quote!(#runtime::single_state!(#in_lanes, #function; #parameters #(#inputs),*; #(#outputs),*);)
        }
        Some(array) => {
            let in_lanes = name_in_lanes(&format_ident!("{function}_{PREPARED}"));
            let prepared = format_ident!("{PREPARED}");
            quote! {
                #runtime::single_state!(
                    #in_lanes, #function; #parameters #(#inputs),*; only in lanes #prepared: #array; #(#outputs),*
                );
            }
        }
    })
}
