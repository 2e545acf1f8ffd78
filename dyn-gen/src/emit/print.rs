//! Items, from tokens to text laid out by prettyplease.

use proc_macro2::TokenStream;

use super::EmitError;

/// Source text of an item called `name` in messages.
pub fn source(name: &str, item: TokenStream) -> Result<String, EmitError> {
    Ok(prettyplease::unparse(&parse(name, item)?))
}

/// `tokens` as a syntax tree: `name` is what the message says when they are none.
pub fn parse<T: syn::parse::Parse>(name: &str, tokens: TokenStream) -> Result<T, EmitError> {
    syn::parse2(tokens)
        .map_err(|error| EmitError::Unparsable { item: name.into(), message: error.to_string() })
}

#[cfg(test)]
mod tests {
    use quote::quote;

    use super::*;

    #[test]
    fn what_does_not_parse_stops_the_emission() {
        let error = source("f", quote!(fn f -> )).unwrap_err();
        assert!(error.to_string().starts_with("`f`: the generated source does not parse"), "{error}");
    }
}
