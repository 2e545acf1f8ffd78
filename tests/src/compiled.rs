//! Generated models as compiled code, every function callable by name.

use dyn_gen::graph::Environment;
use dyn_platform::{LegType, Platform};
use dyn_runtime::models::{self, uhp, ups};

include!(concat!(env!("OUT_DIR"), "/by_name.rs"));

/// Test platforms with baked numbers.
#[allow(missing_docs)]
#[rustfmt::skip]
pub mod baked {
    include!(concat!(env!("OUT_DIR"), "/models.rs"));
}

/// A model with every function.
pub trait Model: Sync {
    /// Outputs of a function of the table by name, flat and row-major.
    fn call(&self, function: &str, state: &Environment) -> Environment;
}

/// The model with parameters at run time, for any platform.
pub fn at_run_time(platform: &Platform) -> Box<dyn Model + Send> {
    with_parameters(platform.leg_type, &of(platform))
}

/// The same with what follows from the parameters alone computed once.
pub fn prepared(platform: &Platform) -> Box<dyn Model + Send> {
    match platform.leg_type {
        LegType::Uhp => Box::new(uhp_model(&of(platform)).prepared()),
        LegType::Ups => Box::new(ups_model(&of(platform)).prepared()),
    }
}

/// The model of a leg type, its parameters filled by name.
pub fn with_parameters(leg_type: LegType, fill: &dyn Fn(&str, &mut [f64])) -> Box<dyn Model + Send> {
    match leg_type {
        LegType::Uhp => Box::new(uhp_model(fill)),
        LegType::Ups => Box::new(ups_model(fill)),
    }
}

fn of(platform: &Platform) -> impl Fn(&str, &mut [f64]) {
    move |name, values| {
        values.copy_from_slice(&platform.parameter(name).expect("platforms have every parameter"));
    }
}

fn uhp_model(fill: &dyn Fn(&str, &mut [f64])) -> models::Uhp {
    models::Uhp { parameters: uhp::Parameters::from_fn(fill) }
}

fn ups_model(fill: &dyn Fn(&str, &mut [f64])) -> models::Ups {
    models::Ups { parameters: ups::Parameters::from_fn(fill) }
}

/// All outputs of all functions: function, output, values.
pub fn outputs(model: &dyn Model, state: &Environment) -> Vec<(String, String, Vec<f64>)> {
    FUNCTIONS
        .iter()
        .flat_map(|function| {
            model
                .call(function, state)
                .into_iter()
                .map(|(output, values)| (function.to_string(), output, values))
        })
        .collect()
}

/// Arrays that nest to any depth, as flat numbers.
trait Flat: Sized {
    fn fill(&mut self, values: &mut dyn Iterator<Item = f64>);
    fn read(&self, values: &mut Vec<f64>);
    const START: Self;
}

impl Flat for f64 {
    // A function that forgets an output leaves this, which no tolerance accepts.
    const START: f64 = f64::NAN;
    fn fill(&mut self, values: &mut dyn Iterator<Item = f64>) {
        *self = values.next().expect("the state has every element");
    }
    fn read(&self, values: &mut Vec<f64>) {
        values.push(*self);
    }
}

impl<T: Flat, const N: usize> Flat for [T; N] {
    const START: [T; N] = [T::START; N];
    fn fill(&mut self, values: &mut dyn Iterator<Item = f64>) {
        self.iter_mut().for_each(|element| element.fill(values));
    }
    fn read(&self, values: &mut Vec<f64>) {
        self.iter().for_each(|element| element.read(values));
    }
}

fn filled<T: Flat>() -> T {
    T::START
}

/// An array of any shape from its elements, row-major.
#[allow(private_bounds)]
pub fn array<T: Flat>(values: &[f64]) -> T {
    let mut result = T::START;
    result.fill(&mut values.iter().copied());
    result
}

fn flat<T: Flat>(value: &T) -> Vec<f64> {
    let mut values = Vec::new();
    value.read(&mut values);
    values
}
