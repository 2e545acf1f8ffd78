//! Access to the parameters of a model: default values, checked setters.

use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

use super::function::allow;
use super::names::{SCALAR, identifier, type_identifier};
use super::signature::{array_type, documentation, symbol_line};
use super::{EmitError, model::Model};
use crate::graph::Symbol;

/// Parameters that may not be any number, with the variant of `dyn_runtime::parameter::Domain`, and what is refused.
const DOMAINS: [(&str, &str, &[&str]); 5] = [
    (
        "Positive",
        "it is not positive",
        &[
            "rod_length",
            "rod_mass",
            "rod_inertia",
            "mover_mass",
            "payload_mass",
            "lower_mass",
            "lower_inertia",
            "upper_mass",
            "upper_inertia",
        ],
    ),
    ("NotNegative", "it is negative", &["axial_stiffness", "axial_damping"]),
    ("Fraction", "it is not between 0 and 1", &["rod_com_fraction"]),
    ("UnitVectors", "a vector is not of length 1", &["actuator_axis"]),
    ("Inertia", "no body has this tensor", &["payload_inertia"]),
];

/// The setters, and the defaults if there are any.
pub fn items(model: &Model) -> Result<Vec<TokenStream>, EmitError> {
    let runtime = model.runtime.tokens();
    let name = type_identifier(model.name)?;
    let scalar = format_ident!("{SCALAR}");
    // What a program does not use of a model is no fault of it.
    let allow = allow(quote!(dead_code, unused_qualifications));
    let mut setters = TokenStream::new();
    let mut checks = TokenStream::new();
    for symbol in model.parameters {
        let field = identifier(model.name, &symbol.name)?;
        let setter = format_ident!("set_{field}");
        let label = &symbol.name;
        let row = DOMAINS.iter().find(|(_, _, names)| names.contains(&label.as_str()));
        let (domain, refused) = row.map_or(("Any", None), |(domain, refused, _)| (*domain, Some(*refused)));
        let domain = format_ident!("{domain}");
        let lines = documentation(&[
            format!("Sets `{label}`: {}", symbol_line(symbol)),
            String::new(),
            "# Errors".into(),
            String::new(),
            match refused {
                Some(refused) => format!("If it is not finite or {refused}; then it keeps its value."),
                None => "If it is not finite; then it keeps its value.".into(),
            },
        ]);
        let array = array_type(&quote!(#scalar), &symbol.shape);
        let given = flat(&quote!(#field), symbol);
        let own = flat(&quote!(self.#field), symbol);
        setters.extend(quote! {
            #lines
            pub fn #setter(&mut self, #field: #array) -> Result<&mut Self, #runtime::parameter::ParameterError> {
                #runtime::parameter::check(#label, #runtime::parameter::Domain::#domain, #given)?;
                self.#field = #field;
                Ok(self)
            }
        });
        checks
            .extend(quote!(#runtime::parameter::check(#label, #runtime::parameter::Domain::#domain, #own)?;));
    }
    let mut items = vec![
        quote! {
            #allow
            impl<#scalar: Scalar + Into<f64>> Parameters<#scalar> {
                #setters

                /// Checks all parameters as their setters do, however they got their values.
                ///
                /// # Errors
                ///
                /// The first that is refused.
                pub fn check(&self) -> Result<(), #runtime::parameter::ParameterError> {
                    #checks
                    Ok(())
                }
            }
        },
        quote! {
            #allow
            impl<#scalar> #name<#scalar> {
                /// The model with these parameters.
                pub fn new(parameters: Parameters<#scalar>) -> Self {
                    #name { parameters }
                }
            }
        },
    ];
    if let Some(defaults) = model.defaults {
        let mut fields = TokenStream::new();
        for (symbol, values) in model.parameters.iter().zip(defaults) {
            let field = identifier(model.name, &symbol.name)?;
            let value = nested(&symbol.shape, &mut values.iter());
            fields.extend(quote!(#field: #value,));
        }
        let title = documentation(&["The numbers of the platform file.".into()]);
        // One for each type of number instead of one for any: a model with a single one needs no annotation.
        for number in model.scalars.iter().map(|scalar| format_ident!("{}", scalar.name())) {
            items.push(quote! {
                #allow
                impl Default for Parameters<#number> {
                    #title
                    fn default() -> Self {
                        let c = <#number as Scalar>::constant;
                        Parameters { #fields }
                    }
                }
            });
            items.push(quote! {
                impl Default for #name<#number> {
                    #title
                    fn default() -> Self {
                        #name::new(Parameters::default())
                    }
                }
            });
        }
    }
    Ok(items)
}

/// The elements of an array as a slice.
fn flat(array: &TokenStream, symbol: &Symbol) -> TokenStream {
    match symbol.shape.len() {
        0 => quote!(core::slice::from_ref(&#array)),
        1 => quote!(&#array),
        nested => (1..nested).fold(array.clone(), |array, _| quote!(#array.as_flattened())),
    }
}

/// An array of these elements, row-major.
fn nested(shape: &[usize], values: &mut std::slice::Iter<f64>) -> TokenStream {
    match shape {
        [] => number(values.next().copied().unwrap_or(f64::NAN)),
        [length, inner @ ..] => {
            let elements = (0..*length).map(|_| nested(inner, values));
            quote!([#(#elements),*])
        }
    }
}

fn number(value: f64) -> TokenStream {
    let magnitude = Literal::f64_unsuffixed(value.abs());
    if value.is_sign_negative() { quote!(c(-#magnitude)) } else { quote!(c(#magnitude)) }
}
