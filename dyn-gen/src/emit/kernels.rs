//! The file of kernel traits: one per function, implemented by every model.

use quote::{format_ident, quote};

use super::function::allow;
use super::names::{SCALAR, check_type_names, type_identifier};
use super::print::source;
use super::signature::Signature;
use super::{EmitError, Header};

/// Text of the file.
pub fn kernels_file(header: &Header, signatures: &[Signature]) -> Result<String, EmitError> {
    check_type_names(signatures.iter().map(|signature| signature.name.as_str()))?;
    let mut text = header.text();
    let scalar = format_ident!("{SCALAR}");
    for signature in signatures {
        let kernel = type_identifier(&signature.name)?;
        let function = signature.identifier()?;
        let documentation = signature.documentation();
        let arguments = signature.arguments(&quote!(#scalar))?;
        let allow = allow(quote!());
        let title = super::signature::documentation(&[format!("A model that has `{}`.", signature.name)]);
        text.push('\n');
        text.push_str(&source(
            &signature.name,
            quote! {
                #title
                #allow
                pub trait #kernel<#scalar = f64> {
                    #documentation
                    fn #function(&self, #(#arguments),*);
                }
            },
        )?);
    }
    Ok(text)
}
