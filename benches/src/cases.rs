//! The table of what is measured: each function by each implementation, on the same states.

use dyn_platform::Platform;
use dyn_runtime::kernels::{
    CoriolisMatrices, ForwardDynamics, InverseDynamics, JacobianDp, MassMatrixP, Matrices,
};
use dyn_runtime::models::{Uhp, Uhp2016};

use crate::call::{Call, Generated, Reference};
use crate::output::Output;
use crate::states::{COUNT, Inputs, States, reference_parameters, runtime_model};

/// Every function, in the order of tables.
pub const FUNCTIONS: [&str; 6] =
    ["inverse_dynamics", "forward_dynamics", "matrices", "mass_matrix_p", "coriolis_matrices", "jacobian_dp"];

/// Every implementation: numbers baked in, parameters at run time, written by hand.
pub const IMPLEMENTATIONS: [&str; 3] = ["generated", "generated_runtime", "reference"];

/// Does something with a function of each implementation.
pub trait Visitor {
    /// With this implementation. `call` with `states[i]` computes the same whatever the implementation.
    fn visit<C: Call>(
        &mut self,
        function: &'static str,
        implementation: &'static str,
        states: &[C::State; COUNT],
        call: C,
    );
}

/// Shows `visitor` one of [`FUNCTIONS`] by every implementation for `platform`, which must be the one whose numbers
/// are baked in.
///
/// # Panics
/// If there is no such function.
pub fn visit(function: &str, platform: &Platform, states: &States, visitor: &mut impl Visitor) {
    let mut cases =
        Cases { states, visitor, model: runtime_model(platform), parameters: reference_parameters(platform) };
    match function {
        "inverse_dynamics" => {
            cases.visit(
                "inverse_dynamics",
                inverse_dynamics,
                inverse_dynamics,
                dyn_reference::inverse_dynamics,
            );
        }
        "forward_dynamics" => {
            cases.visit(
                "forward_dynamics",
                forward_dynamics,
                forward_dynamics,
                dyn_reference::forward_dynamics,
            );
        }
        "matrices" => cases.visit("matrices", matrices, matrices, dyn_reference::matrices),
        "mass_matrix_p" => {
            cases.visit("mass_matrix_p", mass_matrix_p, mass_matrix_p, dyn_reference::mass_matrix_p);
        }
        "coriolis_matrices" => {
            let reference = dyn_reference::coriolis_matrices;
            cases.visit("coriolis_matrices", coriolis_matrices, coriolis_matrices, reference);
        }
        "jacobian_dp" => cases.visit("jacobian_dp", jacobian_dp, jacobian_dp, dyn_reference::jacobian_dp),
        unknown => panic!("no function `{unknown}`; there are {}", FUNCTIONS.join(", ")),
    }
}

/// Compares all implementations at all states, so that only equal results are ever measured.
///
/// # Panics
/// If two differ by more than 1e-9 of the largest number of the result. How exact they are is for the agreement
/// tests; this finds mistaken arguments.
pub fn check_agreement(platform: &Platform, states: &States) {
    for function in FUNCTIONS {
        let mut first = Agreement::default();
        visit(function, platform, states, &mut first);
    }
}

/// Results of the implementation seen first, for all states.
#[derive(Default)]
struct Agreement {
    expected: Vec<Vec<f64>>,
}

impl Visitor for Agreement {
    fn visit<C: Call>(
        &mut self,
        function: &'static str,
        implementation: &'static str,
        states: &[C::State; COUNT],
        mut call: C,
    ) {
        let results: Vec<Vec<f64>> = states
            .iter()
            .map(|state| {
                let mut values = Vec::new();
                call.call(state, |output| output.read(&mut values));
                values
            })
            .collect();
        if self.expected.is_empty() {
            self.expected = results;
            return;
        }
        for (index, (found, expected)) in results.iter().zip(&self.expected).enumerate() {
            let largest = expected.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
            let agree = |(x, y): (&f64, &f64)| (x - y).abs() <= 1e-9 * largest;
            assert!(
                found.len() == expected.len() && found.iter().zip(expected).all(agree),
                "{function}: {implementation} and {} differ at state {index}",
                IMPLEMENTATIONS[0]
            );
        }
    }
}

struct Cases<'a, V> {
    states: &'a States,
    visitor: &'a mut V,
    model: Uhp,
    parameters: dyn_reference::Parameters,
}

impl<V: Visitor> Cases<'_, V> {
    fn visit<O: Output + Default, R: Output>(
        &mut self,
        name: &'static str,
        baked: impl Fn(&Uhp2016, &Inputs, &mut O),
        runtime: impl Fn(&Uhp, &Inputs, &mut O),
        reference: impl Fn(&dyn_reference::Parameters, &dyn_reference::State) -> R,
    ) {
        let [generated, generated_runtime, by_hand] = IMPLEMENTATIONS;
        let states = self.states;
        let baked = Generated { model: Uhp2016, function: baked, output: O::default() };
        self.visitor.visit(name, generated, &states.inputs, baked);
        let runtime = Generated { model: self.model, function: runtime, output: O::default() };
        self.visitor.visit(name, generated_runtime, &states.inputs, runtime);
        let reference = Reference { parameters: self.parameters, function: reference };
        self.visitor.visit(name, by_hand, &states.reference, reference);
    }
}

type Matrix = [[f64; 6]; 6];

fn inverse_dynamics(model: &impl InverseDynamics, state: &Inputs, output: &mut [f64; 6]) {
    model.inverse_dynamics(
        &state.base_position,
        &state.base_rotation,
        &state.base_velocity,
        &state.base_acceleration,
        &state.platform_position,
        &state.platform_rotation,
        &state.platform_velocity,
        &state.platform_acceleration,
        &state.external_wrench,
        output,
    );
}

fn forward_dynamics(model: &impl ForwardDynamics, state: &Inputs, output: &mut [f64; 6]) {
    model.forward_dynamics(
        &state.base_position,
        &state.base_rotation,
        &state.base_velocity,
        &state.base_acceleration,
        &state.platform_position,
        &state.platform_rotation,
        &state.platform_velocity,
        &state.actuator_force,
        &state.external_wrench,
        output,
    );
}

fn matrices(model: &impl Matrices, state: &Inputs, output: &mut [Matrix; 6]) {
    let [mass_p, coriolis_p, jacobian_dp, mass_b, coriolis_b, jacobian_db] = output;
    model.matrices(
        &state.base_position,
        &state.base_rotation,
        &state.base_velocity,
        &state.platform_position,
        &state.platform_rotation,
        &state.platform_velocity,
        mass_p,
        coriolis_p,
        jacobian_dp,
        mass_b,
        coriolis_b,
        jacobian_db,
    );
}

fn mass_matrix_p(model: &impl MassMatrixP, state: &Inputs, output: &mut Matrix) {
    model.mass_matrix_p(
        &state.base_position,
        &state.base_rotation,
        &state.platform_position,
        &state.platform_rotation,
        output,
    );
}

fn coriolis_matrices(model: &impl CoriolisMatrices, state: &Inputs, output: &mut [Matrix; 2]) {
    let [coriolis_p, coriolis_b] = output;
    model.coriolis_matrices(
        &state.base_position,
        &state.base_rotation,
        &state.base_velocity,
        &state.platform_position,
        &state.platform_rotation,
        &state.platform_velocity,
        coriolis_p,
        coriolis_b,
    );
}

fn jacobian_dp(model: &impl JacobianDp, state: &Inputs, output: &mut Matrix) {
    model.jacobian_dp(
        &state.base_position,
        &state.base_rotation,
        &state.platform_position,
        &state.platform_rotation,
        output,
    );
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::states::{platform, sampled};

    #[test]
    fn implementations_agree_at_the_measured_states() {
        let platform = platform();
        check_agreement(&platform, &States::new(&sampled(&platform)));
    }

    #[test]
    #[should_panic(expected = "differ at state")]
    fn other_states_for_one_implementation_are_noticed() {
        let platform = platform();
        let mut states = States::new(&sampled(&platform));
        states.reference.swap(0, 1);
        check_agreement(&platform, &states);
    }
}
