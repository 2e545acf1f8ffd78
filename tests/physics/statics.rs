//! Equilibrium under gravity and springs.

use dyn_gen::graph::Environment;
use dyn_runtime::models::Uhp2016;
use dyn_tests::compiled::Model;
use dyn_tests::platforms::platform;
use nalgebra::Vector6;

use crate::kinematics::columns;
use crate::law::{Law, difference, largest, unbalance};
use crate::motion::{REASON, TOLERANCE, gradient};
use crate::subject::Values;

/// The same pose at rest, without load.
fn at_rest(state: &Environment) -> Environment {
    let still = [
        "base_velocity",
        "base_acceleration",
        "platform_velocity",
        "platform_acceleration",
        "external_wrench",
    ];
    still.iter().fold(state.clone(), |state, name| state.with(name, &[0.0; 6]))
}

/// gravity_force + spring_force = dV/dq_p.
#[test]
fn passive_forces_are_the_gradient_of_potential_energy() {
    let law = Law { name: "gravity_force + spring_force = dV/dq_p", tolerance: TOLERANCE, reason: REASON };
    law.holds(|subject, state| {
        let state = at_rest(state);
        let potential = |state: &Environment| subject.call("energy", state)["potential_energy"].clone();
        let slope = Vector6::from_row_slice(&gradient(&state, "platform", potential).concat());
        let forces = subject.call("passive_forces", &state);
        unbalance(&[forces.vector::<6>("gravity_force"), forces.vector("spring_force"), -slope])
    });
}

/// J_dp^T F = gravity_force + spring_force at rest: actuators hold the mechanism by the principle of virtual work.
#[test]
fn inverse_dynamics_at_rest_holds_the_mechanism() {
    let law = Law {
        name: "at rest: J_dp^T F = gravity_force + spring_force",
        tolerance: 1e-12,
        reason: "solving with J_dp leaves a residual of rounding size, whatever its condition",
    };
    law.holds(|subject, state| {
        let state = at_rest(state);
        let held =
            subject.matrix("jacobian_dp", &state).transpose() * subject.vector("inverse_dynamics", &state);
        let forces = subject.call("passive_forces", &state);
        unbalance(&[held, -forces.vector::<6>("gravity_force"), -forces.vector::<6>("spring_force")])
    });
}

/// K_p = J_dp^T k_e J_dp is the change of the spring force by displacements of the platform, and K_b minus that by
/// displacements of the base, where the springs are relaxed (elsewhere their preload turns with the legs as well).
#[test]
fn stiffness_is_the_gradient_of_the_force_of_relaxed_springs() {
    let law =
        Law { name: "K_p, K_b = d(spring_force)/dq where relaxed", tolerance: TOLERANCE, reason: REASON };
    law.holds(|subject, state| {
        let lengths = subject.call("leg_kinematics", state)["actuator_length"].clone();
        let relaxed = subject.with(subject.parameters.with("rest_length", &lengths));
        let spring_force =
            |state: &Environment| relaxed.call("passive_forces", state)["spring_force"].clone();
        let stiffness = subject.call("stiffness_matrices", state);
        largest([
            difference(
                stiffness.matrix("stiffness_matrix_p"),
                columns(gradient(state, "platform", spring_force)),
            ),
            difference(
                -stiffness.matrix::<6, 6>("stiffness_matrix_b"),
                columns(gradient(state, "base", spring_force)),
            ),
        ])
    });
}

/// Holding the default platform at home, upright actuators carry the moving weight and the springs' preload together; with
/// their symmetry each carries a sixth. Computed by hand from Table 1:
/// mass 6.092 + 6 (1.024 + 0.611) = 15.902 kg; offset of the rods from the vertical, squared,
/// 0.18^2 + 0.12^2 - 2 0.18 0.12 cos 28° = 0.0086567 m^2; d = 0.382 - sqrt(0.206^2 - 0.0086567) = 0.198208 m;
/// preload 6 * 21555.9 * 0.00020844 = 26.96 N.
#[test]
fn default_platform_at_home_carries_its_weight_and_preload() {
    const WEIGHT: f64 = 15.902 * 9.81;
    const PRELOAD: f64 = 26.96;
    const ROUNDED: f64 = 0.005;
    let home = &platform("uhp_2016").home;
    let identity = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
    let mut state = Environment::from([
        ("base_position".to_owned(), vec![0.0; 3]),
        ("base_rotation".to_owned(), identity.to_vec()),
        ("platform_position".to_owned(), home.position.to_vec()),
        ("platform_rotation".to_owned(), home.rotation.as_flattened().to_vec()),
    ]);
    for name in [
        "base_velocity",
        "base_acceleration",
        "platform_velocity",
        "platform_acceleration",
        "external_wrench",
    ] {
        state.insert(name.to_owned(), vec![0.0; 6]);
    }
    let force = Uhp2016.call("inverse_dynamics", &state).vector::<6>("inverse_dynamics");
    let excess = force.sum() - (WEIGHT + PRELOAD);
    println!(
        "{:76} {excess:8.1e} N (tolerance {ROUNDED:.0e} N)",
        "uhp_2016 at home: sum F = weight + preload"
    );
    assert!(excess.abs() < ROUNDED, "forces {force} add up to {} N", force.sum());
    let uneven = (force.max() - force.min()) / force.max();
    assert!(uneven < 1e-12, "the legs of a symmetric platform share alike: {force}");
    let spring = Uhp2016.call("passive_forces", &state);
    let preload = spring.vector::<6>("spring_force")[2];
    assert!((preload - PRELOAD).abs() < ROUNDED, "preload {preload} N along z");
}
