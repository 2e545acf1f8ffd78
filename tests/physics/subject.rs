//! What the laws are asked of: generated models with their parameters and states.

use std::sync::LazyLock;

use dyn_gen::graph::Environment;
use dyn_gen::sample::Kind;
use dyn_gen::sampled_states;
use dyn_runtime::models::{Parameters, Uhp, Uhp2016};
use dyn_tests::compiled::{self, Model, baked};
use dyn_tests::platforms::{self, SEED, graph_file};
use nalgebra::{SMatrix, SVector, Vector3};

const STATES_OF_EACH_PLATFORM: usize = 6;

/// From a function's name and a state to outputs by name.
type Call = dyn Fn(&str, &Environment) -> Environment + Send + Sync;

/// A generated model.
pub struct Subject {
    pub label: String,
    /// Its parameters by name, flat and row-major.
    pub parameters: Environment,
    call: Box<Call>,
}

impl Subject {
    fn new(label: String, parameters: Environment, model: impl Model + Send + 'static) -> Subject {
        Subject {
            label,
            parameters,
            call: Box::new(move |function, state| compiled::call(&model, function, state)),
        }
    }

    /// A baked model of a test platform.
    fn baked(name: &str, model: impl Model + Send + 'static) -> Subject {
        Subject::new(format!("baked {name}"), platforms::parameters(&platforms::platform(name)), model)
    }

    /// The model with these parameters, given at run time.
    pub fn at_run_time(label: &str, parameters: Environment) -> Subject {
        let read = |name: &str, values: &mut [f64]| values.copy_from_slice(&parameters[name]);
        let model = Uhp { parameters: Parameters::from_fn(read) };
        Subject::new(format!("run time {label}"), parameters, model)
    }

    /// A function's outputs by name.
    pub fn call(&self, function: &str, state: &Environment) -> Environment {
        (self.call)(function, state)
    }

    /// The 6-vector that a function of the same name computes.
    pub fn vector(&self, function: &str, state: &Environment) -> SVector<f64, 6> {
        self.call(function, state).vector(function)
    }

    /// The 6x6 matrix that a function of the same name computes.
    pub fn matrix(&self, function: &str, state: &Environment) -> SMatrix<f64, 6, 6> {
        self.call(function, state).matrix(function)
    }
}

/// Values by name, with their shapes.
pub trait Values {
    fn scalar(&self, name: &str) -> f64;
    fn vector<const N: usize>(&self, name: &str) -> SVector<f64, N>;
    fn matrix<const R: usize, const C: usize>(&self, name: &str) -> SMatrix<f64, R, C>;
    /// One matrix per leg.
    fn legs<const R: usize, const C: usize>(&self, name: &str) -> [SMatrix<f64, R, C>; 6];
    /// The same values but for one.
    fn with(&self, name: &str, values: &[f64]) -> Self;
}

impl Values for Environment {
    fn scalar(&self, name: &str) -> f64 {
        self[name][0]
    }

    fn vector<const N: usize>(&self, name: &str) -> SVector<f64, N> {
        SVector::from_row_slice(&self[name])
    }

    fn matrix<const R: usize, const C: usize>(&self, name: &str) -> SMatrix<f64, R, C> {
        SMatrix::from_row_slice(&self[name])
    }

    fn legs<const R: usize, const C: usize>(&self, name: &str) -> [SMatrix<f64, R, C>; 6] {
        std::array::from_fn(|leg| SMatrix::from_row_slice(&self[name][leg * R * C..][..R * C]))
    }

    fn with(&self, name: &str, values: &[f64]) -> Environment {
        let mut changed = self.clone();
        assert!(changed.insert(name.to_owned(), values.to_vec()).is_some(), "there was no `{name}`");
        changed
    }
}

/// Linear and angular part of a 6-vector.
pub fn parts(vector: SVector<f64, 6>) -> (Vector3<f64>, Vector3<f64>) {
    (vector.fixed_rows::<3>(0).into(), vector.fixed_rows::<3>(3).into())
}

/// Every subject with its large states, seeded.
pub fn cases() -> &'static [(Subject, Vec<Environment>)] {
    static CASES: LazyLock<Vec<(Subject, Vec<Environment>)>> = LazyLock::new(|| {
        let file = graph_file();
        let states = |name: &str| {
            let kinds = [(Kind::Large, STATES_OF_EACH_PLATFORM)];
            sampled_states(&file.program, &platforms::platform(name), &kinds, SEED)
                .expect("the graph knows the platform")
        };
        let run_time = platforms::all().into_iter().map(|platform| {
            let subject = Subject::at_run_time(&platform.name, platforms::parameters(&platform));
            (subject, states(&platform.name))
        });
        run_time
            .chain([
                (Subject::baked("uhp_2016", Uhp2016), states("uhp_2016")),
                (Subject::baked("tilted_axes", baked::tilted_axes::TiltedAxes), states("tilted_axes")),
                (Subject::baked("unequal_legs", baked::unequal_legs::UnequalLegs), states("unequal_legs")),
                (Subject::baked("long_thin", baked::long_thin::LongThin), states("long_thin")),
                (Subject::baked("everything", baked::everything::Everything), states("everything")),
            ])
            .collect()
    });
    &CASES
}
