//! The equation of motion and its parts.

use std::collections::BTreeMap;

use dyn_gen::deviation::{Scale, relative_error};
use dyn_gen::graph::Environment;
use dyn_tests::compiled::FUNCTIONS;
use nalgebra::{Matrix6, SMatrix, Vector6};

use crate::conservation::external_force;
use crate::law::{Law, difference, largest, unbalance};
use crate::subject::{Subject, Values};

const ROUNDING: &str = "sums of some hundred rounded terms, partly cancelling";

/// M_p v_p' + bias = J_dp^T F + W_ext + M_b v_b' with F of the inverse dynamics.
#[test]
fn inverse_dynamics_solves_the_equation_of_motion() {
    let law =
        Law { name: "M_p v_p' + bias = J_dp^T F + W_ext + M_b v_b'", tolerance: 1e-12, reason: ROUNDING };
    law.holds(|subject, state| {
        let force = subject.vector("inverse_dynamics", state);
        unbalance(&equation_of_motion(subject, state, state.vector("platform_acceleration"), force))
    });
}

/// The same with v_p' of the forward dynamics.
#[test]
fn forward_dynamics_solves_the_equation_of_motion() {
    let law = Law {
        name: "M_p v_p' + bias = J_dp^T F + W_ext + M_b v_b', forward",
        tolerance: 1e-12,
        reason: "solving with M_p leaves a residual of rounding size, whatever its condition",
    };
    law.holds(|subject, state| {
        let acceleration = subject.vector("forward_dynamics", state);
        unbalance(&equation_of_motion(subject, state, acceleration, state.vector("actuator_force")))
    });
}

/// Terms of the equation of motion, which add up to zero.
fn equation_of_motion(
    subject: &Subject,
    state: &Environment,
    acceleration: Vector6<f64>,
    force: Vector6<f64>,
) -> [Vector6<f64>; 5] {
    let parts = subject.call("equation_of_motion", state);
    let matrix = |name| -> Matrix6<f64> { parts.matrix(name) };
    [
        matrix("mass_matrix_p") * acceleration,
        parts.vector("bias"),
        -matrix("jacobian_dp").transpose() * force,
        -external_force(subject, state),
        -matrix("mass_matrix_b") * state.vector::<6>("base_acceleration"),
    ]
}

/// bias = C_p v_p - C_b v_b + gravity_force + spring_force + damping_force.
#[test]
fn bias_is_the_sum_of_its_parts() {
    let law = Law { name: "bias = C_p v_p - C_b v_b + passive forces", tolerance: 1e-12, reason: ROUNDING };
    law.holds(|subject, state| {
        let parts = subject.call("equation_of_motion", state);
        let product = |matrix, velocity| parts.matrix::<6, 6>(matrix) * state.vector::<6>(velocity);
        unbalance(&[
            parts.vector("bias"),
            -product("coriolis_matrix_p", "platform_velocity"),
            product("coriolis_matrix_b", "base_velocity"),
            -parts.vector::<6>("gravity_force"),
            -parts.vector::<6>("spring_force"),
            -parts.vector::<6>("damping_force"),
        ])
    });
}

/// spring_force = J_dp^T k_e (d - d0), damping_force = J_dp^T c_e d', gravity_force = -sum J^T m g.
#[test]
fn passive_forces_follow_from_lengths_and_partial_velocities() {
    let law = Law {
        name: "spring, damping and gravity force by their definitions",
        tolerance: 1e-12,
        reason: ROUNDING,
    };
    law.holds(|subject, state| {
        let (parameters, legs) = (&subject.parameters, subject.call("leg_kinematics", state));
        let parameter = |name: &str| parameters.vector::<6>(name);
        let along_legs = |force| subject.matrix("jacobian_dp", state).transpose() * force;
        let stretch: Vector6<f64> = legs.vector::<6>("actuator_length") - parameter("rest_length");
        let spring = along_legs(parameter("axial_stiffness").component_mul(&stretch));
        let damping = along_legs(parameter("axial_damping").component_mul(&legs.vector("actuator_velocity")));

        let partial = subject.call("partial_velocities", state);
        let payload = partial.matrix::<3, 6>("payload_partial_velocity") * parameters.scalar("payload_mass");
        let weighted = |jacobian: &str, mass: &str| -> SMatrix<f64, 3, 6> {
            partial.legs::<3, 6>(jacobian).iter().zip(parameter(mass).iter()).map(|(j, m)| j * *m).sum()
        };
        let bodies = subject.bodies().bodies.iter();
        let moving = bodies.fold(payload, |sum, (body, _)| {
            sum + weighted(&format!("{body}_partial_velocity"), &format!("{body}_mass"))
        });
        let gravity = -moving.transpose() * parameters.vector::<3>("gravity");

        let forces = subject.call("passive_forces", state);
        largest([
            difference(forces.vector("spring_force"), spring),
            difference(forces.vector("damping_force"), damping),
            difference(forces.vector("gravity_force"), gravity),
        ])
    });
}

/// Kane: generalised active and inertia forces of all bodies together vanish (49), with F of the inverse dynamics.
#[test]
fn generalised_forces_vanish_along_inverse_dynamics() {
    let law = Law { name: "sum of active and inertia forces = 0", tolerance: 1e-12, reason: ROUNDING };
    law.holds(|subject, state| {
        let force = subject.vector("inverse_dynamics", state);
        let driven = state.with("actuator_force", force.as_slice());
        let forces = subject.call("generalised_forces", &driven);
        let per_body: Vec<Vector6<f64>> =
            forces.values().flat_map(|values| values.chunks(6)).map(Vector6::from_row_slice).collect();
        assert_eq!(per_body.len(), 2 * 13, "payload, two bodies of six legs");
        unbalance(&per_body)
    });
}

/// Forces that give an acceleration are those that the acceleration asks for. Their error is that of the far larger forces
/// which cancel in them, such as what holds the platform without acceleration.
#[test]
fn inverse_of_forward_dynamics() {
    let law = Law { name: "inverse(forward(F)) = F", tolerance: 1e-12, reason: SOLVING };
    law.holds(|subject, state| {
        let forces_for = |acceleration: &[f64]| {
            subject.vector("inverse_dynamics", &state.with("platform_acceleration", acceleration))
        };
        let still = forces_for(&[0.0; 6]);
        let accelerating = forces_for(subject.vector("forward_dynamics", state).as_slice()) - still;
        unbalance(&[still, accelerating, -state.vector::<6>("actuator_force")])
    });
}

/// Forces of the sampled motion, there and back, relative to themselves.
#[test]
fn forces_of_a_motion_come_back() {
    let law =
        Law { name: "inverse(forward(inverse(v_p'))) = inverse(v_p')", tolerance: 1e-11, reason: SOLVING };
    law.holds(|subject, state| {
        let force = subject.vector("inverse_dynamics", state);
        let acceleration =
            subject.vector("forward_dynamics", &state.with("actuator_force", force.as_slice()));
        let again = state.with("platform_acceleration", acceleration.as_slice());
        difference(subject.vector("inverse_dynamics", &again), force)
    });
}

/// The acceleration that its own forces give.
#[test]
fn forward_of_inverse_dynamics() {
    let law = Law { name: "forward(inverse(v_p')) = v_p'", tolerance: 1e-11, reason: SOLVING };
    law.holds(|subject, state| {
        let force = subject.vector("inverse_dynamics", state);
        let driven = state.with("actuator_force", force.as_slice());
        difference(subject.vector("forward_dynamics", &driven), state.vector("platform_acceleration"))
    });
}

const SOLVING: &str = "rounding errors times the condition of J_dp and M_p";

/// An output that several functions compute is the same in all.
#[test]
fn functions_agree_on_common_outputs() {
    let law = Law { name: "the same output from different functions", tolerance: 1e-12, reason: ROUNDING };
    law.holds(|subject, state| {
        let mut found: BTreeMap<String, Vec<f64>> = BTreeMap::new();
        let mut repeated = 0;
        let outputs = FUNCTIONS.iter().flat_map(|function| subject.call(function, state));
        let worst = largest(outputs.map(|(name, values)| match found.get(&name) {
            Some(first) => {
                repeated += 1;
                relative_error(&values, first, Scale::own())
            }
            None => {
                found.insert(name, values);
                0.0
            }
        }));
        assert!(repeated > 10, "only {repeated} outputs are computed more than once");
        worst
    });
}
