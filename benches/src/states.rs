//! The states that every implementation gets: the same numbers, in the form each one takes, prepared before anything
//! is measured.

use std::path::Path;

use dyn_gen::graph::Environment;
use dyn_gen::sample::Kind;
use dyn_gen::{GraphFile, sampled_states};
use dyn_platform::Platform;
use dyn_reference::State;
use dyn_runtime::models;

/// Number of states, gone through again and again. Small enough for a first-level cache, enough that a branch
/// predictor does not learn every pivot by heart.
pub const COUNT: usize = 64;

/// Seed of the states.
pub const SEED: u64 = 2016;

/// A state as generated functions take it; names, units and frames as in their documentation. Peers read it by this layout.
#[derive(Clone, Copy, Debug)]
#[allow(missing_docs)]
#[repr(C)]
pub struct Inputs<T = f64> {
    pub base_position: [T; 3],
    pub base_rotation: [[T; 3]; 3],
    pub base_velocity: [T; 6],
    pub base_acceleration: [T; 6],
    pub platform_position: [T; 3],
    pub platform_rotation: [[T; 3]; 3],
    pub platform_velocity: [T; 6],
    pub platform_acceleration: [T; 6],
    pub actuator_force: [T; 6],
    pub external_wrench: [T; 6],
}

/// The states in both forms; the same index is the same state.
pub struct States {
    /// For generated functions.
    pub inputs: Box<[Inputs; COUNT]>,
    /// For the reference.
    pub reference: Box<[State; COUNT]>,
}

/// The platform whose numbers are baked in: the paper's, or that of `cargo xtask bench --platform`.
pub fn platform() -> Platform {
    let path = Path::new(env!("DYN_BENCHES_PLATFORM"));
    Platform::from_file(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// [`COUNT`] states of `platform` by name: half near home with moderate rates, half anywhere with large ones.
pub fn sampled(platform: &Platform) -> Vec<Environment> {
    let file = GraphFile::uhp().expect("the committed graph file is checked by its own tests");
    let kinds = [(Kind::Random, COUNT / 2), (Kind::Large, COUNT / 2)];
    sampled_states(&file.program, platform, &kinds, SEED).expect("the graph knows the platform")
}

impl States {
    /// From [`COUNT`] states by name.
    ///
    /// # Panics
    /// If their number is another or an array is missing.
    pub fn new(environments: &[Environment]) -> Self {
        let reference = |state: &Environment| State::from_arrays(|name| state.get(name).cloned());
        let reference: Result<Vec<_>, _> = environments.iter().map(reference).collect();
        Self {
            inputs: boxed(environments.iter().map(Inputs::new).collect()),
            reference: boxed(reference.expect("sampled states are complete")),
        }
    }
}

fn boxed<T>(states: Vec<T>) -> Box<[T; COUNT]> {
    states.into_boxed_slice().try_into().ok().expect("as many states as were asked for")
}

impl Inputs {
    fn new(state: &Environment) -> Self {
        Self {
            base_position: row(state, "base_position"),
            base_rotation: rows(state, "base_rotation"),
            base_velocity: row(state, "base_velocity"),
            base_acceleration: row(state, "base_acceleration"),
            platform_position: row(state, "platform_position"),
            platform_rotation: rows(state, "platform_rotation"),
            platform_velocity: row(state, "platform_velocity"),
            platform_acceleration: row(state, "platform_acceleration"),
            actuator_force: row(state, "actuator_force"),
            external_wrench: row(state, "external_wrench"),
        }
    }

    /// In single precision.
    pub fn narrowed(&self) -> Inputs<f32> {
        let narrow = |values: [f64; 6]| values.map(|value| value as f32);
        let vector = |values: [f64; 3]| values.map(|value| value as f32);
        Inputs {
            base_position: vector(self.base_position),
            base_rotation: self.base_rotation.map(vector),
            base_velocity: narrow(self.base_velocity),
            base_acceleration: narrow(self.base_acceleration),
            platform_position: vector(self.platform_position),
            platform_rotation: self.platform_rotation.map(vector),
            platform_velocity: narrow(self.platform_velocity),
            platform_acceleration: narrow(self.platform_acceleration),
            actuator_force: narrow(self.actuator_force),
            external_wrench: narrow(self.external_wrench),
        }
    }
}

fn row<const N: usize>(state: &Environment, name: &str) -> [f64; N] {
    state[name].as_slice().try_into().expect("sampled states have the shapes of the graph")
}

fn rows(state: &Environment, name: &str) -> [[f64; 3]; 3] {
    let flat: [f64; 9] = row(state, name);
    std::array::from_fn(|i| std::array::from_fn(|j| flat[3 * i + j]))
}

/// The reference's parameters of a platform.
pub fn reference_parameters(platform: &Platform) -> dyn_reference::Parameters {
    dyn_reference::Parameters::from_arrays(|name| platform.parameter(name))
        .expect("platforms have every parameter")
}

/// The generated model with a platform's parameters at run time, ready to be called.
pub fn runtime_model(platform: &Platform) -> models::PreparedUhp {
    let parameters = models::Parameters::from_fn(|name, values| {
        values.copy_from_slice(&platform.parameter(name).expect("platforms have every parameter"));
    });
    models::Uhp { parameters }.prepared()
}
