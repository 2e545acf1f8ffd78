//! Pieces of Rust's syntax tree. Parentheses are the layout's business: trees hold their operands as they are.
//!
//! Bodies are built as trees, not as tokens: tens of thousands of expressions would otherwise be tokenised only to be
//! parsed again, which took most of the generator's time.

use proc_macro2::{Ident, Span, TokenStream};
use syn::{BinOp, Expr, Lit, LitFloat, LitInt, Pat, Stmt, UnOp, token};

/// `name`
pub fn path(name: &Ident) -> Expr {
    Expr::Path(syn::ExprPath { attrs: Vec::new(), qself: None, path: name.clone().into() })
}

/// `base.name`
pub fn field(base: Expr, name: &Ident) -> Expr {
    Expr::Field(syn::ExprField {
        attrs: Vec::new(),
        base: Box::new(base),
        dot_token: Default::default(),
        member: name.clone().into(),
    })
}

/// `array[index]`
pub fn index(array: Expr, index: usize) -> Expr {
    let digits = LitInt::new(&index.to_string(), Span::call_site());
    Expr::Index(syn::ExprIndex {
        attrs: Vec::new(),
        expr: Box::new(array),
        bracket_token: token::Bracket::default(),
        index: Box::new(literal(Lit::Int(digits))),
    })
}

/// `7`
pub fn integer(value: usize) -> Expr {
    literal(Lit::Int(LitInt::new(&value.to_string(), Span::call_site())))
}

/// `Type::function`
pub fn associated(of: &Ident, function: &Ident) -> Expr {
    let mut path = syn::Path::from(of.clone());
    path.segments.push(function.clone().into());
    Expr::Path(syn::ExprPath { attrs: Vec::new(), qself: None, path })
}

/// A finite number with the fewest digits that read back as the same number.
pub fn number(value: f64) -> Expr {
    let magnitude = literal(Lit::Float(LitFloat::new(&format!("{:?}", value.abs()), Span::call_site())));
    if value.is_sign_negative() { negative(magnitude) } else { magnitude }
}

fn literal(lit: Lit) -> Expr {
    Expr::Lit(syn::ExprLit { attrs: Vec::new(), lit })
}

/// `(inner)`
fn parenthesised(inner: Expr) -> Expr {
    Expr::Paren(syn::ExprParen {
        attrs: Vec::new(),
        paren_token: token::Paren::default(),
        expr: Box::new(inner),
    })
}

/// `-operand`; `-(-operand)`, as `--` looks like an operator of other languages and rustc warns of it.
pub fn negative(operand: Expr) -> Expr {
    let operand = if matches!(operand, Expr::Unary(_)) { parenthesised(operand) } else { operand };
    unary(UnOp::Neg(Default::default()), operand)
}

/// `*operand`
pub fn dereferenced(operand: Expr) -> Expr {
    unary(UnOp::Deref(Default::default()), operand)
}

fn unary(op: UnOp, operand: Expr) -> Expr {
    Expr::Unary(syn::ExprUnary { attrs: Vec::new(), op, expr: Box::new(operand) })
}

/// `left op right`
pub fn binary(op: BinOp, left: Expr, right: Expr) -> Expr {
    Expr::Binary(syn::ExprBinary { attrs: Vec::new(), left: Box::new(left), op, right: Box::new(right) })
}

/// `function(arguments)`
pub fn call(function: &Ident, arguments: impl IntoIterator<Item = Expr>) -> Expr {
    call_value(path(function), arguments)
}

/// `function(arguments)`
pub fn call_value(function: Expr, arguments: impl IntoIterator<Item = Expr>) -> Expr {
    Expr::Call(syn::ExprCall {
        attrs: Vec::new(),
        func: Box::new(function),
        paren_token: token::Paren::default(),
        args: arguments.into_iter().collect(),
    })
}

/// `[elements]`
pub fn array(elements: impl IntoIterator<Item = Expr>) -> Expr {
    Expr::Array(syn::ExprArray {
        attrs: Vec::new(),
        bracket_token: token::Bracket::default(),
        elems: elements.into_iter().collect(),
    })
}

/// `&operand`
pub fn borrowed(operand: Expr) -> Expr {
    Expr::Reference(syn::ExprReference {
        attrs: Vec::new(),
        and_token: Default::default(),
        mutability: None,
        expr: Box::new(operand),
    })
}

/// `let name = value;`
pub fn define(name: &Ident, value: Expr) -> Stmt {
    bind(pattern(name), value)
}

/// `target = value;`
pub fn assign(target: Expr, value: Expr) -> Stmt {
    let assignment = syn::ExprAssign {
        attrs: Vec::new(),
        left: Box::new(target),
        eq_token: Default::default(),
        right: Box::new(value),
    };
    Stmt::Expr(Expr::Assign(assignment), Some(Default::default()))
}

/// `{ statements }`, or with values to hand on `let (a, b) = { statements (a, b) };`
pub fn block(mut statements: Vec<Stmt>, live: &[&Ident]) -> Stmt {
    let value = match live {
        [] => None,
        [name] => Some((pattern(name), path(name))),
        names => {
            let patterns = syn::PatTuple {
                attrs: Vec::new(),
                paren_token: token::Paren::default(),
                elems: names.iter().map(|name| pattern(name)).collect(),
            };
            let values = syn::ExprTuple {
                attrs: Vec::new(),
                paren_token: token::Paren::default(),
                elems: names.iter().map(|name| path(name)).collect(),
            };
            Some((Pat::Tuple(patterns), Expr::Tuple(values)))
        }
    };
    let in_braces = |stmts| {
        let block = syn::Block { brace_token: token::Brace::default(), stmts };
        Expr::Block(syn::ExprBlock { attrs: Vec::new(), label: None, block })
    };
    match value {
        None => Stmt::Expr(in_braces(statements), None),
        Some((pattern, value)) => {
            statements.push(Stmt::Expr(value, None));
            bind(pattern, in_braces(statements))
        }
    }
}

/// `name!(tokens);`
pub fn macro_statement(name: &str, tokens: TokenStream) -> Stmt {
    Stmt::Macro(syn::StmtMacro {
        attrs: Vec::new(),
        mac: syn::Macro {
            path: Ident::new(name, Span::call_site()).into(),
            bang_token: Default::default(),
            delimiter: syn::MacroDelimiter::Paren(token::Paren::default()),
            tokens,
        },
        semi_token: Some(Default::default()),
    })
}

fn bind(pat: Pat, value: Expr) -> Stmt {
    let init = syn::LocalInit { eq_token: Default::default(), expr: Box::new(value), diverge: None };
    Stmt::Local(syn::Local {
        attrs: Vec::new(),
        let_token: Default::default(),
        modifiers: Default::default(),
        pat,
        init: Some(init),
        semi_token: Default::default(),
    })
}

fn pattern(name: &Ident) -> Pat {
    Pat::Ident(syn::PatIdent {
        attrs: Vec::new(),
        by_ref: None,
        mutability: None,
        ident: name.clone(),
        subpat: None,
    })
}
