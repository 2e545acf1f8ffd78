//! Power and the mechanism's momentum.

use dyn_gen::graph::Environment;
use nalgebra::{Matrix3, Vector1, Vector3, Vector6};

use crate::law::{Law, unbalance};
use crate::motion::{REASON, TIME_STEP, TOLERANCE, after, derivative};
use crate::subject::{LegBodies, Subject, Values, parts};

/// d/dt(T + V) = F.d' - sum c_e d'^2 + W_ext.v_p + w_B.v_b: what the actuators, the load and the moving base do is what the
/// mechanism stores or the dampers lose. F is what the inverse dynamics asks for along the motion.
#[test]
fn power_balance_with_a_moving_base() {
    let law =
        Law { name: "(T + V)' = F.d' - c d'^2 + W.v_p + w_B.v_b", tolerance: TOLERANCE, reason: REASON };
    law.holds(|subject, state| {
        let energy = |t: f64| {
            let energy = subject.call("energy", &after(state, t));
            vec![energy.scalar("kinetic_energy") + energy.scalar("potential_energy")]
        };
        let stored = derivative(energy, TIME_STEP)[0];
        let force = subject.vector("inverse_dynamics", state);
        let speed = subject.call("leg_kinematics", state).vector::<6>("actuator_velocity");
        let lost = subject.parameters.vector::<6>("axial_damping").dot(&speed.component_mul(&speed));
        let load = external_force(subject, state).dot(&state.vector::<6>("platform_velocity"));
        let base = base_wrench(subject, state).dot(&state.vector::<6>("base_velocity"));
        unbalance(&[stored, -force.dot(&speed), lost, -load, -base].map(Vector1::new))
    });
}

/// W_ext = [F_D; M_D + (R_p r_c) × F_D], the external wrench as it acts on the platform's speeds.
pub fn external_force(subject: &Subject, state: &Environment) -> Vector6<f64> {
    let (force, moment) = parts(state.vector("external_wrench"));
    let arm = state.matrix::<3, 3>("platform_rotation") * subject.parameters.vector::<3>("payload_com");
    stacked(force, moment + arm.cross(&force))
}

/// The whole wrench of the base on the mechanism, moments about r_b: rate of momentum less gravity and external wrench.
fn base_wrench(subject: &Subject, state: &Environment) -> Vector6<f64> {
    let parameters = &subject.parameters;
    let bodies = subject.call("body_kinematics", state);
    let (origin, gravity) = (state.vector::<3>("base_position"), parameters.vector::<3>("gravity"));
    // Force by which a body of this mass at this place exceeds free fall, with its moment.
    let excess = |mass: f64, position: Vector3<f64>, acceleration: Vector3<f64>| {
        let force = (acceleration - gravity) * mass;
        stacked(force, (position - origin).cross(&force))
    };
    let payload_position = bodies.vector::<3>("payload_com_position");
    let mut wrench = excess(
        parameters.scalar("payload_mass"),
        payload_position,
        bodies.vector("payload_com_acceleration"),
    );
    for (body, place) in subject.bodies().bodies {
        let positions = bodies.legs::<3, 1>(&format!("{place}_position"));
        let accelerations = bodies.legs::<3, 1>(&format!("{place}_acceleration"));
        let masses = parameters.vector::<6>(&format!("{body}_mass"));
        wrench +=
            (0..6).map(|leg| excess(masses[leg], positions[leg], accelerations[leg])).sum::<Vector6<f64>>();
    }
    let (force, moment) = parts(state.vector("external_wrench"));
    let load = stacked(force, moment + (payload_position - origin).cross(&force));
    wrench + stacked(Vector3::zeros(), angular_momentum_rate(subject, state)) - load
}

/// Sum over payload and legs of I w' + w × I w, each about its own centre of mass.
fn angular_momentum_rate(subject: &Subject, state: &Environment) -> Vector3<f64> {
    let rate = |inertia: Matrix3<f64>, w: Vector3<f64>, w_rate: Vector3<f64>| {
        inertia * w_rate + w.cross(&(inertia * w))
    };
    let rotation = state.matrix::<3, 3>("platform_rotation");
    let payload_inertia =
        rotation * subject.parameters.matrix::<3, 3>("payload_inertia") * rotation.transpose();
    let (_, w_p) = parts(state.vector("platform_velocity"));
    let (_, w_p_rate) = parts(state.vector("platform_acceleration"));

    let LegBodies { turning, inertias, .. } = subject.bodies();
    let bodies = subject.call("body_kinematics", state);
    let directions = subject.call("leg_kinematics", state).legs::<3, 1>("rod_direction");
    let (w, w_rate) = ["velocity", "acceleration"]
        .map(|rate| bodies.legs::<3, 1>(&format!("{turning}_angular_{rate}")))
        .into();
    let transverse: Vector6<f64> = inertias.iter().map(|name| subject.parameters.vector::<6>(name)).sum();
    let legs = (0..6).map(|leg| {
        let u = directions[leg];
        rate((Matrix3::identity() - u * u.transpose()) * transverse[leg], w[leg], w_rate[leg])
    });
    rate(payload_inertia, w_p, w_p_rate) + legs.sum::<Vector3<f64>>()
}

fn stacked(linear: Vector3<f64>, angular: Vector3<f64>) -> Vector6<f64> {
    Vector6::from_iterator(linear.iter().chain(&angular).copied())
}
