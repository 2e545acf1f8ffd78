//! The outside of a function: documentation, argument types, names.

use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;

use super::EmitError;
use super::names::{identifier, type_identifier};
use crate::graph::{Function, Graph, Program, Symbol};
use crate::text::one_line;

/// What a caller sees of a function. Run-time parameters are not part of it: they belong to the model.
#[derive(Clone, PartialEq, Debug)]
pub struct Signature {
    /// Name of the function.
    pub name: String,
    /// The leg type, if its outputs belong to one.
    pub leg_type: Option<String>,
    /// What it computes, one line.
    pub meaning: String,
    /// Equation number(s) in the source, or empty.
    pub equation: String,
    /// Arrays that enter, in order.
    pub inputs: Vec<Symbol>,
    /// Arrays that leave, in order, after the inputs.
    pub outputs: Vec<Symbol>,
}

impl Signature {
    /// The signature of `graph`: every input that is not a parameter, whether or not a pass has made it unused.
    pub fn of(graph: &Graph) -> Signature {
        Signature {
            name: graph.name.clone(),
            leg_type: None,
            meaning: graph.meaning.clone(),
            equation: graph.equation.clone(),
            inputs: graph.inputs.iter().filter(|symbol| !symbol.parameter).cloned().collect(),
            outputs: graph.outputs.iter().map(|output| output.symbol.clone()).collect(),
        }
    }

    /// The signature, with the leg type that the function of this name has in `program`.
    pub fn within(self, program: &Program) -> Signature {
        let leg_type = program.function(&self.name).and_then(|function| leg_type(program, function));
        Signature { leg_type, ..self }
    }

    /// The signature of a function of `program`, without its body.
    pub fn of_function(program: &Program, function: &Function) -> Signature {
        let symbols = |names: &[String]| {
            let declared = |name: &String| program.declaration(name).map(|found| found.symbol.clone());
            names.iter().filter_map(declared).collect()
        };
        Signature {
            name: function.name.clone(),
            leg_type: leg_type(program, function),
            meaning: function.meaning.clone(),
            equation: function.equation.clone(),
            inputs: symbols(&function.inputs),
            outputs: symbols(&function.outputs),
        }
    }

    /// Name of its kernel trait, seen from the module of kernels.
    pub(super) fn kernel(&self) -> Result<TokenStream, EmitError> {
        let kernel = type_identifier(&self.name)?;
        Ok(match &self.leg_type {
            None => quote!(#kernel),
            Some(leg_type) => {
                let module = identifier(&self.name, leg_type)?;
                quote!(#module::#kernel)
            }
        })
    }

    /// The function's name.
    pub(super) fn identifier(&self) -> Result<Ident, EmitError> {
        identifier(&self.name, &self.name)
    }

    /// Names of the arguments: inputs, then outputs. An output called like an input gets the suffix `_out`.
    pub(super) fn argument_names(&self) -> Result<Vec<Ident>, EmitError> {
        let mut names: Vec<String> = self.inputs.iter().map(|symbol| symbol.name.clone()).collect();
        for output in &self.outputs {
            let taken = self.inputs.iter().any(|input| input.name == output.name);
            names.push(if taken { format!("{}_out", output.name) } else { output.name.clone() });
        }
        if let Some((_, twice)) = names.iter().enumerate().find(|(k, name)| names[..*k].contains(name)) {
            return Err(EmitError::Name {
                function: self.name.clone(),
                name: twice.clone(),
                reason: "two arguments have it",
            });
        }
        names.iter().map(|name| identifier(&self.name, name)).collect()
    }

    /// `name: &[[f64; 3]; 3], ..., name: &mut [f64; 6]` with this type of number.
    pub(super) fn arguments(&self, scalar: &TokenStream) -> Result<Vec<TokenStream>, EmitError> {
        let names = self.argument_names()?;
        let (inputs, outputs) = names.split_at(self.inputs.len());
        let inputs = inputs.iter().zip(&self.inputs).map(|(name, symbol)| {
            let array = array_type(scalar, &symbol.shape);
            if symbol.shape.is_empty() { quote!(#name: #array) } else { quote!(#name: &#array) }
        });
        let outputs = outputs.iter().zip(&self.outputs).map(|(name, symbol)| {
            let array = array_type(scalar, &symbol.shape);
            quote!(#name: &mut #array)
        });
        Ok(inputs.chain(outputs).collect())
    }

    /// Doc attributes: meaning and equation, then shape, unit, frame and meaning of every argument.
    pub(super) fn documentation(&self) -> TokenStream {
        let mut lines =
            vec![title(&self.meaning, &self.equation), String::new(), "Inputs:".into(), String::new()];
        lines.extend(self.inputs.iter().map(argument_line));
        lines.extend([String::new(), "Outputs:".into(), String::new()]);
        lines.extend(self.outputs.iter().map(argument_line));
        documentation(&lines)
    }
}

fn leg_type(program: &Program, function: &Function) -> Option<String> {
    function.leg_specific.then(|| program.name.clone())
}

/// `[[T; 3]; 6]` for the shape 6x3, `T` for a scalar.
pub(super) fn array_type(scalar: &TokenStream, shape: &[usize]) -> TokenStream {
    shape.iter().rev().fold(scalar.clone(), |element, &length| {
        let length = Literal::usize_unsuffixed(length);
        quote!([#element; #length])
    })
}

/// One `#[doc]` attribute per line, whatever the lines hold.
pub(super) fn documentation(lines: &[String]) -> TokenStream {
    lines
        .iter()
        .map(|line| {
            let line = if line.is_empty() { String::new() } else { format!(" {}", one_line(line)) };
            quote!(#[doc = #line])
        })
        .collect()
}

/// Documentation of a symbol: shape, unit, frame, meaning, equation.
pub(super) fn symbol_line(symbol: &Symbol) -> String {
    let shape = match symbol.shape.as_slice() {
        [] => "scalar".into(),
        shape => shape.iter().map(usize::to_string).collect::<Vec<_>>().join("x"),
    };
    let unit = if matches!(symbol.unit.as_str(), "" | "-" | "1") { "dimensionless" } else { &symbol.unit };
    let frame = match symbol.frame.as_str() {
        "" | "-" => String::new(),
        frame => format!(", frame {frame}"),
    };
    format!(
        "{shape}, {}{}: {}",
        markdown(unit),
        markdown(&frame),
        sentence(&symbol.meaning, &symbol.equation)
    )
}

fn argument_line(symbol: &Symbol) -> String {
    format!("- `{}`: {}", symbol.name, symbol_line(symbol))
}

/// A sentence that begins with a capital letter.
fn title(meaning: &str, equation: &str) -> String {
    let sentence = sentence(meaning, equation);
    let mut letters = sentence.chars();
    letters.next().map(|first| first.to_uppercase().chain(letters).collect()).unwrap_or_default()
}

/// `meaning, equation (49).`
pub(super) fn sentence(meaning: &str, equation: &str) -> String {
    let meaning = markdown(meaning.trim().trim_end_matches('.'));
    match equation {
        "" | "-" => format!("{meaning}."),
        equation => format!("{meaning}, equation {}.", markdown(equation)),
    }
}

/// `text` so that rustdoc shows it as it stands.
fn markdown(text: &str) -> String {
    text.chars().fold(String::with_capacity(text.len()), |mut escaped, letter| {
        match letter {
            '[' | ']' | '<' | '*' | '`' | '\\' => escaped.extend(['\\', letter]),
            letter => escaped.push(letter),
        }
        escaped
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_leg_is_the_outer_dimension() {
        assert_eq!(array_type(&quote!(T), &[6, 3]).to_string(), quote!([[T; 3]; 6]).to_string());
        assert_eq!(array_type(&quote!(f32), &[]).to_string(), "f32");
    }

    #[test]
    fn brackets_are_not_links_in_documentation() {
        assert_eq!(sentence("[r_b'; w_b] of the base", ""), "\\[r_b'; w_b\\] of the base.");
    }
}
