//! Syntax trees to text, laid out by prettyplease, section comments put in.
//!
//! Trees have no comments. A comment therefore travels as the statement `section!(7);` and becomes text here.

use proc_macro2::{Literal, TokenStream};
use quote::ToTokens;
use syn::Stmt;

use super::EmitError;
use super::tree::macro_statement;

/// Statement that becomes the comment number `index`.
pub fn comment_marker(index: usize) -> Stmt {
    macro_statement(MARKER, Literal::usize_unsuffixed(index).into_token_stream())
}

const MARKER: &str = "section";

/// Source text of an item called `name` in messages.
pub fn source(name: &str, item: TokenStream) -> Result<String, EmitError> {
    Ok(prettyplease::unparse(&parse(name, item)?))
}

/// `tokens` as a syntax tree: `name` is what the message says when they are none.
pub fn parse<T: syn::parse::Parse>(name: &str, tokens: TokenStream) -> Result<T, EmitError> {
    syn::parse2(tokens)
        .map_err(|error| EmitError::Unparsable { item: name.into(), message: error.to_string() })
}

/// Source text of a function whose markers stand for `comments`.
pub fn source_with_comments(function: syn::ItemFn, comments: &[String]) -> String {
    let file = syn::File {
        shebang: None,
        frontmatter: None,
        attrs: Vec::new(),
        items: vec![syn::Item::Fn(function)],
    };
    let text = prettyplease::unparse(&file);
    if comments.is_empty() {
        return text;
    }
    let mut commented = String::with_capacity(text.len());
    for line in text.lines() {
        match marked_comment(line, comments) {
            Some((indent, comment)) => {
                commented.push_str(indent);
                commented.push_str("// ");
                commented.push_str(comment);
            }
            None => commented.push_str(line),
        }
        commented.push('\n');
    }
    commented
}

fn marked_comment<'a>(line: &'a str, comments: &'a [String]) -> Option<(&'a str, &'a str)> {
    let (indent, rest) = line.split_once(MARKER)?;
    let index: usize = rest.strip_prefix("!(")?.strip_suffix(");")?.parse().ok()?;
    Some((indent, comments.get(index)?))
}

#[cfg(test)]
mod tests {
    use quote::quote;

    use super::*;

    #[test]
    fn markers_become_comments() {
        let mut function: syn::ItemFn = parse(
            "f",
            quote!(
                fn f() {}
            ),
        )
        .unwrap();
        function.block.stmts.push(comment_marker(1));
        let text = source_with_comments(function, &["none".into(), "leg 3: rod direction".into()]);
        assert_eq!(text, "fn f() {\n    // leg 3: rod direction\n}\n");
    }

    #[test]
    fn what_does_not_parse_stops_the_emission() {
        let error = source("f", quote!(fn f -> )).unwrap_err();
        assert!(error.to_string().starts_with("`f`: the generated source does not parse"), "{error}");
    }
}
