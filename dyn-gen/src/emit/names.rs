//! Names in generated code: checked identifiers, type names, temporaries.

use std::collections::BTreeSet;

use proc_macro2::{Ident, Span};

use super::EmitError;

/// Argument through which run-time parameters reach a function.
pub const PARAMETERS: &str = "parameters";
/// The scalar that a generated function computes with.
pub const SCALAR: &str = "T";
/// What a function calls the conversion of a literal to its scalar.
pub const CONSTANT: &str = "c";
/// The imported square root.
pub const SQRT: &str = "sqrt";
/// The imported multiplications with an addition, by the names of their operations.
pub const MULTIPLY_ADDITIONS: [&str; 3] = ["mul_add", "mul_sub", "neg_mul_add"];
/// The type in lanes that a function in lanes computes with.
pub const SCALARS_IN_LANES: &str = "P";
/// What a function in lanes calls the conversion of a literal to its type in lanes.
pub const CONSTANT_IN_LANES: &str = "w";
/// The imported constructor of a value in lanes.
pub const TRIPLE: &str = "triple";
/// The imported access to a lane.
pub const LANE: &str = "lane";
/// The imported reading of lanes that stand side by side in memory.
pub const LOAD: &str = "load";
/// The imported copy of a number to all lanes.
pub const SPLAT: &str = "splat";
/// The imported pivoted linear solver.
pub const SOLVE_GENERAL: &str = "solve_general";
/// The imported linear solver that examines an attempt.
pub const SOLVE_AFTER_ATTEMPT: &str = "solve_after_attempt";
/// The same in lanes.
pub const SOLVE_AFTER_ATTEMPT_IN_LANES: &str = "solve_after_attempt_in_lanes";

/// `name` as an identifier of `function`, refused when it is not one or would hide a name the printer uses itself.
pub fn identifier(function: &str, name: &str) -> Result<Ident, EmitError> {
    let refuse = |reason| Err(EmitError::Name { function: function.into(), name: name.into(), reason });
    if syn::parse_str::<Ident>(name).is_err() {
        return refuse("it is not an identifier of Rust");
    }
    if [PARAMETERS, CONSTANT, CONSTANT_IN_LANES, TRIPLE, LANE, LOAD, SPLAT, SQRT].contains(&name)
        || [SOLVE_GENERAL, SOLVE_AFTER_ATTEMPT, SOLVE_AFTER_ATTEMPT_IN_LANES].contains(&name)
        || MULTIPLY_ADDITIONS.contains(&name)
    {
        return refuse("the generated code uses it itself");
    }
    if is_temporary(name) {
        return refuse("names like `t12` are temporaries");
    }
    Ok(Ident::new(name, Span::call_site()))
}

fn is_temporary(name: &str) -> bool {
    name.strip_prefix('t')
        .is_some_and(|digits| !digits.is_empty() && digits.bytes().all(|b| b.is_ascii_digit()))
}

/// `inverse_dynamics` as the type name `InverseDynamics`; digits keep their place: `uhp_2016` is `Uhp2016`.
pub fn type_name(name: &str) -> String {
    name.split('_')
        .flat_map(|word| {
            let mut letters = word.chars();
            letters.next().map(|first| first.to_uppercase().chain(letters).collect::<String>())
        })
        .collect()
}

/// The type named after `name`, if it is an identifier.
pub fn type_identifier(name: &str) -> Result<Ident, EmitError> {
    let camel = type_name(name);
    syn::parse_str::<Ident>(&camel).map_err(|_| EmitError::Name {
        function: name.into(),
        name: camel.clone(),
        reason: "it is not an identifier of Rust",
    })
}

/// Refuses functions whose types would have one name: `a_1` and `a1` are both `A1`.
pub fn check_type_names<'a>(functions: impl Iterator<Item = &'a str>) -> Result<(), EmitError> {
    let mut known = BTreeSet::new();
    for function in functions {
        if !known.insert(type_name(function)) {
            return Err(EmitError::Name {
                function: function.into(),
                name: type_name(function),
                reason: "two functions would have this type",
            });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn type_names_keep_digits_and_drop_underscores() {
        assert_eq!(type_name("inverse_dynamics"), "InverseDynamics");
        assert_eq!(type_name("uhp_2016"), "Uhp2016");
        assert_eq!(type_name("bias"), "Bias");
    }

    #[test]
    fn functions_need_types_of_their_own() {
        assert!(check_type_names(["a_1", "b_1"].into_iter()).is_ok());
        let error = check_type_names(["a_1", "a1"].into_iter()).unwrap_err();
        assert_eq!(
            error.to_string(),
            "function `a1`: `A1` cannot be used as a name in generated code: two functions would have this type"
        );
    }

    #[test]
    fn names_that_would_hide_others_are_refused() {
        for name in [
            "t1",
            "t123",
            "parameters",
            "c",
            "sqrt",
            "mul_add",
            "solve_general",
            "fn",
            "2b",
            "a-b",
            "",
            "self",
        ] {
            assert!(identifier("f", name).is_err(), "{name} was accepted");
        }
        for name in ["t", "torque", "t1a", "time_2"] {
            assert!(identifier("f", name).is_ok(), "{name} was refused");
        }
    }
}
