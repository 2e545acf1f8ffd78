//! The table of what is measured: each function by each implementation, on the same states.

use dyn_platform::Platform;
use dyn_runtime::kernels::{
    CoriolisMatrices, ForwardDynamics, InverseDynamics, JacobianDp, MassMatrixP, Matrices,
};
use dyn_runtime::models::PreparedUhp;

use crate::angles;
use crate::call::{Call, Generated, Reference};
use crate::flat::Flat;
use crate::model::Baked;
use crate::output::Output;
use crate::payload::{Payload, payload};
use crate::peers::{Peer, Pinocchio};
use crate::states::{COUNT, Inputs, States, reference_parameters, runtime_model};

/// Every function, in the order of tables. The last is inverse dynamics with the rotations given by the paper's angles.
pub const FUNCTIONS: [&str; 7] = [
    "inverse_dynamics",
    "forward_dynamics",
    "matrices",
    "mass_matrix_p",
    "coriolis_matrices",
    "jacobian_dp",
    "inverse_dynamics_from_angles",
];

/// Every implementation, in the order of tables; not each has every function. Numbers baked in: without lanes, by the model's own
/// method in lanes, many states in lanes; all parameters at run time, some of them; written by hand, C by CasADi of the same graph
/// and of the naive one, Pinocchio.
pub const IMPLEMENTATIONS: [&str; 9] = [
    "generated",
    "generated_lanes",
    "generated_batch",
    "generated_runtime",
    "generated_payload",
    "reference",
    "casadi_c_same",
    "casadi_c_naive",
    "pinocchio",
];

/// A function of an implementation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Case {
    /// One of [`FUNCTIONS`].
    pub function: &'static str,
    /// One of [`IMPLEMENTATIONS`].
    pub implementation: &'static str,
    /// Which of several ways to write and compile it; empty where there is one.
    pub variant: &'static str,
}

/// Does something with a function of each implementation.
pub trait Visitor {
    /// With this one. `call` with `states[i]` computes the same whatever the implementation.
    fn visit<C: Call>(&mut self, case: Case, states: &[C::State; COUNT], call: C);
}

/// Shows `visitor` one of [`FUNCTIONS`] by every implementation that is there for `platform`, which must be the one whose
/// numbers are baked in.
///
/// # Panics
/// If there is no such function.
pub fn visit(function: &str, platform: &Platform, states: &States, visitor: &mut impl Visitor) {
    let mut cases = Cases {
        platform,
        states,
        visitor,
        model: runtime_model(platform),
        parameters: reference_parameters(platform),
    };
    match function {
        "inverse_dynamics" => {
            cases.own(
                "inverse_dynamics",
                inverse_dynamics,
                inverse_dynamics,
                inverse_dynamics,
                dyn_reference::inverse_dynamics,
            );
            cases.with_payload("inverse_dynamics", inverse_dynamics);
            cases.peers::<[f64; 6], 9>("inverse_dynamics", inverse_dynamics_inputs);
        }
        "forward_dynamics" => {
            cases.own(
                "forward_dynamics",
                forward_dynamics,
                forward_dynamics,
                forward_dynamics,
                dyn_reference::forward_dynamics,
            );
            cases.with_payload("forward_dynamics", forward_dynamics);
            cases.peers::<[f64; 6], 9>("forward_dynamics", forward_dynamics_inputs);
            cases.pinocchio();
        }
        "matrices" => {
            cases.own("matrices", matrices, matrices, matrices, dyn_reference::matrices);
            cases.with_payload("matrices", matrices);
            cases.peers::<[Matrix; 6], 6>("matrices", matrices_inputs);
        }
        "mass_matrix_p" => {
            let reference = dyn_reference::mass_matrix_p;
            cases.own("mass_matrix_p", mass_matrix_p, mass_matrix_p, mass_matrix_p, reference);
        }
        "coriolis_matrices" => {
            let reference = dyn_reference::coriolis_matrices;
            cases.own(
                "coriolis_matrices",
                coriolis_matrices,
                coriolis_matrices,
                coriolis_matrices,
                reference,
            );
        }
        "jacobian_dp" => {
            let reference = dyn_reference::jacobian_dp;
            cases.own("jacobian_dp", jacobian_dp, jacobian_dp, jacobian_dp, reference);
        }
        "inverse_dynamics_from_angles" => cases.turned_by_angles(),
        unknown => panic!("no function `{unknown}`; there are {}", FUNCTIONS.join(", ")),
    }
}

/// Everything that there is to measure, peers included where they are linked.
pub fn all(platform: &Platform, states: &States) -> Vec<Case> {
    let mut names = Names::default();
    for function in FUNCTIONS {
        visit(function, platform, states, &mut names);
    }
    names.cases
}

#[derive(Default)]
struct Names {
    cases: Vec<Case>,
}

impl Visitor for Names {
    fn visit<C: Call>(&mut self, case: Case, _: &[C::State; COUNT], _: C) {
        self.cases.push(case);
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
    fn visit<C: Call>(&mut self, case: Case, states: &[C::State; COUNT], mut call: C) {
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
                "{}: {} {} and {} differ at state {index}",
                case.function,
                case.implementation,
                case.variant,
                IMPLEMENTATIONS[0]
            );
        }
    }
}

/// Whether a baked model's method is code in lanes of its own: not every function has such, nor every processor registers for it.
fn has_lanes(function: &str) -> bool {
    dyn_gen::IN_LANES.contains(&function) && dyn_runtime::triple::in_registers()
}

struct Cases<'a, V> {
    platform: &'a Platform,
    states: &'a States,
    visitor: &'a mut V,
    model: PreparedUhp,
    parameters: dyn_reference::Parameters,
}

impl<V: Visitor> Cases<'_, V> {
    /// What this workspace has for every function.
    fn own<O: Output + Default, R: Output>(
        &mut self,
        function: &'static str,
        flat: impl Fn(&Flat<Baked>, &Inputs, &mut O),
        method: impl Fn(&Baked, &Inputs, &mut O),
        runtime: impl Fn(&PreparedUhp, &Inputs, &mut O),
        reference: impl Fn(&dyn_reference::Parameters, &dyn_reference::State) -> R,
    ) {
        let case = |implementation| Case { function, implementation, variant: "" };
        let states = self.states;
        let flat = Generated { model: Flat::default(), function: flat, output: O::default() };
        self.visitor.visit(case("generated"), &states.inputs, flat);
        if has_lanes(function) {
            let method = Generated { model: Baked, function: method, output: O::default() };
            self.visitor.visit(case("generated_lanes"), &states.inputs, method);
        }
        let runtime = Generated { model: self.model, function: runtime, output: O::default() };
        self.visitor.visit(case("generated_runtime"), &states.inputs, runtime);
        let reference = Reference { parameters: self.parameters, function: reference };
        self.visitor.visit(case("reference"), &states.reference, reference);
    }

    /// The model with its payload at run time, if it is there.
    fn with_payload<O: Output + Default>(
        &mut self,
        function: &'static str,
        method: impl Fn(&Payload, &Inputs, &mut O),
    ) {
        if let Some(model) = payload() {
            let case = Case { function, implementation: "generated_payload", variant: "" };
            self.visitor.visit(
                case,
                &self.states.inputs,
                Generated { model, function: method, output: O::default() },
            );
        }
    }

    /// C by CasADi, every variant that is linked.
    fn peers<O: Output + Default, const N: usize>(
        &mut self,
        function: &'static str,
        inputs: impl Fn(&Inputs) -> [*const f64; N] + Copy,
    ) {
        for peer in Peer::all().iter().filter(|peer| peer.function == function) {
            let case = Case { function, implementation: peer.implementation, variant: peer.variant };
            self.visitor.visit(case, &self.states.inputs, peer.call::<_, O, N>(inputs));
        }
    }

    fn pinocchio(&mut self) {
        if let Some((peer, states)) = Pinocchio::new(self.platform, &self.states.inputs) {
            let case = Case { function: "forward_dynamics", implementation: "pinocchio", variant: "" };
            self.visitor.visit(case, &states, peer);
        }
    }

    /// Rotations from the paper's angles, then inverse dynamics.
    fn turned_by_angles(&mut self) {
        let case =
            |implementation| Case { function: "inverse_dynamics_from_angles", implementation, variant: "" };
        let states = angles::states(self.states);
        let flat = angles::Generated { model: Flat::<Baked>::default(), output: [0.0; 6] };
        self.visitor.visit(case("generated"), &states, flat);
        if has_lanes("inverse_dynamics") {
            let method = angles::Generated { model: Baked, output: [0.0; 6] };
            self.visitor.visit(case("generated_lanes"), &states, method);
        }
        let runtime = angles::Generated { model: self.model, output: [0.0; 6] };
        self.visitor.visit(case("generated_runtime"), &states, runtime);
        let reference = angles::Reference { parameters: self.parameters };
        self.visitor.visit(case("reference"), &states, reference);
    }
}

type Matrix<T = f64> = [[T; 6]; 6];

/// Addresses of an array's inputs in the order of the function's arguments.
macro_rules! addresses {
    ($function:ident: $count:literal, $($input:ident),*) => {
        fn $function(state: &Inputs) -> [*const f64; $count] {
            [$((&raw const state.$input).cast()),*]
        }
    };
}

addresses!(inverse_dynamics_inputs: 9, base_position, base_rotation, base_velocity, base_acceleration, platform_position,
    platform_rotation, platform_velocity, platform_acceleration, external_wrench);
addresses!(forward_dynamics_inputs: 9, base_position, base_rotation, base_velocity, base_acceleration, platform_position,
    platform_rotation, platform_velocity, actuator_force, external_wrench);
addresses!(matrices_inputs: 6, base_position, base_rotation, base_velocity, platform_position, platform_rotation,
    platform_velocity);

/// Calls a model with a state.
pub fn inverse_dynamics<T>(model: &impl InverseDynamics<T>, state: &Inputs<T>, output: &mut [T; 6]) {
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

/// Calls a model with a state.
pub fn forward_dynamics<T>(model: &impl ForwardDynamics<T>, state: &Inputs<T>, output: &mut [T; 6]) {
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

/// Calls a model with a state.
pub fn matrices<T>(model: &impl Matrices<T>, state: &Inputs<T>, output: &mut [Matrix<T>; 6]) {
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
