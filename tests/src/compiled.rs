//! Generated models as compiled code, every function callable by name.

use dyn_gen::graph::Environment;
use dyn_platform::Platform;
use dyn_runtime::models::{Parameters, Uhp};

include!(concat!(env!("OUT_DIR"), "/by_name.rs"));

/// Test platforms with baked numbers.
#[allow(missing_docs)]
#[rustfmt::skip]
pub mod baked {
    include!(concat!(env!("OUT_DIR"), "/models.rs"));
}

/// The model with parameters at run time, for any platform.
pub fn at_run_time(platform: &Platform) -> Uhp {
    Uhp {
        parameters: Parameters::from_fn(|name, values| {
            values.copy_from_slice(&platform.parameter(name).expect("platforms have every parameter"));
        }),
    }
}

/// All outputs of all functions. Outputs that several functions give appear under `function/output`.
pub fn outputs<M: Model>(model: &M, state: &Environment) -> Vec<(String, String, Vec<f64>)> {
    FUNCTIONS
        .iter()
        .flat_map(|function| {
            call(model, function, state)
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

fn array<T: Flat>(values: &[f64]) -> T {
    let mut result = T::START;
    result.fill(&mut values.iter().copied());
    result
}

fn flat<T: Flat>(value: &T) -> Vec<f64> {
    let mut values = Vec::new();
    value.read(&mut values);
    values
}
