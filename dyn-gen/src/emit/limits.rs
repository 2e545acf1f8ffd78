//! What a platform's actuators and joints may do, as functions of the model that a monitor and a current controller take.

use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

use super::EmitError;
use super::function::allow;
use super::model::Model;
use super::names::{SCALAR, type_identifier};

/// One number for each leg that has it.
type Limit = [Option<f64>; 6];

/// The limits of a platform, in the units of `dyn_runtime::Limits`. Its numbers are finite.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Limits {
    /// Shortest actuator length, m.
    pub minimum_length: Limit,
    /// Longest actuator length, m.
    pub maximum_length: Limit,
    /// Highest speed, m/s.
    pub maximum_velocity: Limit,
    /// Largest force, N.
    pub maximum_force: Limit,
    /// Largest angle between a rod and its direction at home, base axes, rad.
    pub maximum_hooke_joint_angle: Limit,
    /// The same in platform axes.
    pub maximum_platform_joint_angle: Limit,
    /// Direction of each rod at home, B.
    pub home_direction_in_base: [[f64; 3]; 6],
    /// Direction of each rod at home, P.
    pub home_direction_in_platform: [[f64; 3]; 6],
    /// Force of each voice coil per current, N/A, where all legs have one.
    pub force_constant: Option<[f64; 6]>,
    /// Current of the largest force, A.
    pub maximum_current: Limit,
}

/// The functions `limits` and, where all legs have a force constant, `voice_coils`; nothing for a model of any platform.
pub(super) fn items(model: &Model) -> Result<Vec<TokenStream>, EmitError> {
    let Some(limits) = model.limits else { return Ok(Vec::new()) };
    let runtime = model.runtime.tokens();
    let name = type_identifier(model.name)?;
    let scalar = format_ident!("{SCALAR}");
    let allow = allow(quote!(dead_code, unused_qualifications));
    let fields = [
        ("minimum_length_m", &limits.minimum_length),
        ("maximum_length_m", &limits.maximum_length),
        ("maximum_velocity_m_s", &limits.maximum_velocity),
        ("maximum_force_n", &limits.maximum_force),
        ("maximum_hooke_joint_angle_rad", &limits.maximum_hooke_joint_angle),
        ("maximum_platform_joint_angle_rad", &limits.maximum_platform_joint_angle),
    ];
    // What no leg has stands in `none()`.
    let given =
        fields.into_iter().filter(|(_, limit)| limit.iter().any(Option::is_some)).map(|(field, limit)| {
            let (field, numbers) = (format_ident!("{field}"), or_none(limit, field.starts_with("minimum")));
            quote!(#field: #numbers,)
        });
    let directions = [
        ("home_direction_in_base", &limits.home_direction_in_base),
        ("home_direction_in_platform", &limits.home_direction_in_platform),
    ]
    .into_iter()
    .map(|(field, directions)| {
        let field = format_ident!("{field}");
        let rows = directions.iter().map(|row| array(row.iter().map(|x| number(*x))));
        quote!(#field: [#(#rows),*],)
    });
    let coils = limits.force_constant.map(|constants| {
        let constants = array(constants.iter().map(|x| number(*x)));
        let currents = or_none(&limits.maximum_current, false);
        quote! {
            /// The voice coils as the platform file has them: force constants, and the currents of the largest forces.
            pub fn voice_coils<#scalar: #runtime::Real>() -> #runtime::current::VoiceCoils<#scalar> {
                let c = <#scalar as Scalar>::constant;
                #runtime::current::VoiceCoils { force_constant_n_per_a: #constants, maximum_current_a: #currents }
            }
        }
    });
    Ok(vec![quote! {
        #allow
        impl #name {
            /// What actuators and joints may do by the platform file, and the directions of the rods at home; what it does not
            /// limit is not limited. In single precision each number is the nearest one.
            pub fn limits<#scalar: #runtime::Real>() -> #runtime::Limits<#scalar> {
                let c = <#scalar as Scalar>::constant;
                #runtime::Limits { #(#given)* #(#directions)* ..#runtime::Limits::none() }
            }
            #coils
        }
    }])
}

/// Six numbers; infinite, so that nothing is beyond them, for legs without limit.
fn or_none(limit: &Limit, is_least: bool) -> TokenStream {
    let none = if is_least { quote!(c(f64::NEG_INFINITY)) } else { quote!(c(f64::INFINITY)) };
    array(limit.iter().map(|limit| limit.map_or_else(|| none.clone(), number)))
}

fn array(elements: impl Iterator<Item = TokenStream>) -> TokenStream {
    quote!([#(#elements),*])
}

fn number(value: f64) -> TokenStream {
    let size = Literal::f64_unsuffixed(value.abs());
    if value.is_sign_negative() { quote!(c(-#size)) } else { quote!(c(#size)) }
}
