//! What the laws are asked of: generated models with their parameters and states.

use std::sync::LazyLock;

use dyn_gen::graph::Environment;
use dyn_gen::sample::Kind;
use dyn_gen::sampled_states;
use dyn_platform::{LegType, Platform};
use dyn_tests::compiled::{self, Model};
use dyn_tests::platforms::{self, SEED, graph_file};
use nalgebra::{SMatrix, SVector, Vector3};

const STATES_OF_EACH_PLATFORM: usize = 6;

/// From a function's name and a state to outputs by name.
type Call = dyn Fn(&str, &Environment) -> Environment + Send + Sync;

/// What a leg is made of, by the names that outputs and parameters begin with.
pub struct LegBodies {
    /// What turns with the leg: `.._angular_velocity`, `.._partial_angular_velocity`.
    pub turning: &'static str,
    /// Both bodies: `.._mass`, `.._partial_velocity`; and their centres of mass: `.._position`, `.._velocity`.
    pub bodies: [(&'static str, &'static str); 2],
    /// Transverse moments of inertia, of bodies that turn with the leg.
    pub inertias: &'static [&'static str],
}

/// A generated model.
pub struct Subject {
    pub label: String,
    pub leg_type: LegType,
    /// Its parameters by name, flat and row-major.
    pub parameters: Environment,
    call: Box<Call>,
}

impl Subject {
    /// A baked model of a test platform.
    fn baked(platform: &Platform, model: &'static dyn Model) -> Subject {
        Subject {
            label: format!("baked {}", platform.name),
            leg_type: platform.leg_type,
            parameters: platforms::parameters(platform),
            call: Box::new(|function, state| model.call(function, state)),
        }
    }

    /// The model with these parameters, given at run time.
    pub fn at_run_time(label: &str, leg_type: LegType, parameters: Environment) -> Subject {
        let read = |name: &str, values: &mut [f64]| values.copy_from_slice(&parameters[name]);
        let model = compiled::with_parameters(leg_type, &read);
        Subject {
            label: format!("run time {label}"),
            leg_type,
            parameters,
            call: Box::new(move |function, state| model.call(function, state)),
        }
    }

    /// The same mechanism with other numbers, given at run time.
    pub fn with(&self, parameters: Environment) -> Subject {
        Subject::at_run_time(&self.label, self.leg_type, parameters)
    }

    /// What its legs are made of.
    pub fn bodies(&self) -> &'static LegBodies {
        match self.leg_type {
            LegType::Uhp => &LegBodies {
                turning: "rod",
                bodies: [("rod", "rod_com"), ("mover", "mover")],
                inertias: &["rod_inertia"],
            },
            LegType::Ups => &LegBodies {
                turning: "leg",
                bodies: [("lower", "lower_com"), ("upper", "upper_com")],
                inertias: &["lower_inertia", "upper_inertia"],
            },
        }
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
        let with_states = |subject: Subject, platform: &Platform| {
            let kinds = [(Kind::Large, STATES_OF_EACH_PLATFORM)];
            let program = graph_file(platform.leg_type).program;
            let states = sampled_states(&program, platform, &kinds, SEED);
            (subject, states.expect("the graph knows the platform"))
        };
        let run_time = platforms::all().into_iter().map(|platform| {
            let parameters = platforms::parameters(&platform);
            with_states(Subject::at_run_time(&platform.name, platform.leg_type, parameters), &platform)
        });
        let baked = compiled::BAKED.map(|(name, model)| {
            let platform = platforms::platform(name);
            with_states(Subject::baked(&platform, model), &platform)
        });
        run_time.chain(baked).collect()
    });
    &CASES
}
