//! The equation of motion as a whole: Hamilton's principle, balance of power, momentum, inverse against
//! forward.

#[macro_use]
mod common;

use common::{DIFFERENCES, POSE_STEP, TIME_STEP, Worst, derivative, displaced, moved_state, twist};
use dyn_reference::{
    LegType, Parameters, State, body_kinematics, energy, equation_of_motion, forward_dynamics,
    generalised_forces, inverse_dynamics, leg_kinematics, mass_matrix_b, mass_matrix_p, passive_forces,
};
use nalgebra::{Matrix3, Vector1, Vector3, Vector6};

/// The state with the acceleration that its forces give.
fn solved<L: LegType>(parameters: &Parameters<L>, state: &State) -> State {
    let mut solved = *state;
    solved.platform.acceleration = forward_dynamics(parameters, state).unwrap();
    solved
}

/// `[F_D; M_D]` moved from the payload's centre of mass to `r_p`.
fn wrench_at_origin<L: LegType>(parameters: &Parameters<L>, state: &State) -> Vector6<f64> {
    let force: Vector3<f64> = state.external_wrench.fixed_rows::<3>(0).into();
    let moment: Vector3<f64> = state.external_wrench.fixed_rows::<3>(3).into();
    let arm = state.platform.rotation * parameters.payload.com_m;
    twist(&force, &(moment + arm.cross(&force)))
}

#[test]
fn generalised_forces_vanish_at_the_forward_acceleration() {
    let mut bodies = Worst::new("total of generalised forces");
    let mut equation = Worst::new("M_p v_p' + bias = Jdp^T F + W_ext + M_b v_b'");
    for_random_states!(20, 200, |case, state| {
        let parameters = &case.parameters;
        let state = solved(parameters, state);
        let f = generalised_forces(parameters, &state);
        let legs = [f.active_force, f.inertia_force];
        let total = f.payload_active_force
            + f.payload_inertia_force
            + legs.iter().flatten().flatten().sum::<Vector6<f64>>();
        let size = legs.iter().flatten().flatten().map(|force| force.norm()).fold(0.0, f64::max);
        bodies.compare(&total, &Vector6::zeros(), size);

        let eom = equation_of_motion(parameters, &state);
        let left = eom.mass_matrix_p * state.platform.acceleration + eom.bias;
        let right = eom.jacobian_dp.transpose() * state.actuator_force_n
            + wrench_at_origin(parameters, &state)
            + eom.mass_matrix_b * state.base.acceleration;
        equation.compare(&left, &right, size);
    });
    // The residual of a backward stable solution: rounding of the largest force, summed over 26 forces.
    bodies.within(3e-14);
    equation.within(1e-13);
}

#[test]
fn inverse_undoes_forward_and_forward_undoes_inverse() {
    let mut force = Worst::new("inverse after forward");
    let mut acceleration = Worst::new("forward after inverse");
    for_random_states!(21, 200, |case, state| {
        let parameters = &case.parameters;
        let found = inverse_dynamics(parameters, &solved(parameters, state)).unwrap();
        // Forces that act together with F, of which F is the remainder.
        let size = parameters.legs.iter().map(|leg| leg.axial_stiffness_n_m).fold(0.0, f64::max) * 0.05;
        force.compare(&found, &state.actuator_force_n, size);

        let mut actuated = *state;
        actuated.actuator_force_n = inverse_dynamics(parameters, state).unwrap();
        let found = forward_dynamics(parameters, &actuated).unwrap();
        acceleration.compare(&found, &state.platform.acceleration, size / parameters.payload.mass_kg);
    });
    // Rounding times the conditions of Jdp and of M_p in mixed units, some 1e2 to 1e3 each within reach.
    force.within(1e-13);
    acceleration.within(3e-13);
}

#[test]
fn every_force_enters_the_inverse_dynamics() {
    let mut difference = Worst::new("F is affine in the external wrench and in v_p'");
    for_random_states!(22, 50, |case, state| {
        let parameters = &case.parameters;
        let eom = equation_of_motion(parameters, state);
        let force = inverse_dynamics(parameters, state).unwrap();
        let expected = eom.mass_matrix_p * state.platform.acceleration + eom.bias
            - wrench_at_origin(parameters, state)
            - eom.mass_matrix_b * state.base.acceleration;
        difference.compare(&(eom.jacobian_dp.transpose() * force), &expected, expected.norm());
    });
    // Bias by matrices against bodies, and a residual of the linear solution.
    difference.within(1e-13);
}

/// Hamilton's principle with the base's motion prescribed: from energies alone, no accelerations of bodies.
///
/// With `p = dT/dv_p = [P; L]` in O coordinates and variations `dR = [dtheta]x R`, hence `dw = dtheta' +
/// dtheta x w`: `P' = d(T - V)/dr + Q_force`, `L' = w x L + d(T - V)/dtheta + Q_moment`.
#[test]
fn motion_obeys_hamiltons_principle() {
    let mut worst = Worst::new("Hamilton's principle");
    for_random_states!(23, 60, |case, state| {
        let parameters = &case.parameters;
        let state = solved(parameters, state);
        let momentum = |t: f64| {
            let s = moved_state(&state, t);
            mass_matrix_p(parameters, &s) * s.platform.velocity
                - mass_matrix_b(parameters, &s) * s.base.velocity
        };
        let rate = derivative(TIME_STEP, momentum);
        let gradient = Vector6::from_fn(|j, _| {
            derivative(POSE_STEP, |h| {
                let e = energy(parameters, &State { platform: displaced(&state.platform, j, h), ..state });
                Vector1::new(e.kinetic_energy - e.potential_energy)
            })
            .x
        });
        let angular_momentum: Vector3<f64> = momentum(0.0).fixed_rows::<3>(3).into();
        let turning = state.platform.angular_velocity().cross(&angular_momentum);
        let eom = equation_of_motion(parameters, &state);
        let applied = eom.jacobian_dp.transpose() * state.actuator_force_n
            + wrench_at_origin(parameters, &state)
            - passive_forces(parameters, &state).damping_force;
        let right = twist(&Vector3::zeros(), &turning) + gradient + applied;
        worst.compare(&rate, &right, right.norm());
    });
    // Differences in time and by pose; energies of some 100 J round at 1e-14 J / 2.5e-4 = 4e-11 N of some 100
    // N.
    worst.within(DIFFERENCES);
}

#[test]
fn power_is_balanced() {
    let mut worst = Worst::new("power");
    for_random_states!(24, 100, |case, state| {
        let parameters = &case.parameters;
        let state = solved(parameters, state);
        let rate = derivative(TIME_STEP, |t| {
            let e = energy(parameters, &moved_state(&state, t));
            Vector1::new(e.kinetic_energy + e.potential_energy)
        })
        .x;
        let speed = leg_kinematics(parameters, &state).actuator_velocity;
        let damped: f64 = (0..6).map(|i| parameters.legs[i].axial_damping_n_s_m * speed[i] * speed[i]).sum();
        let power = [
            state.actuator_force_n.dot(&speed),
            -damped,
            wrench_at_origin(parameters, &state).dot(&state.platform.velocity),
            base_wrench(parameters, &state).dot(&state.base.velocity),
        ];
        let size = power.iter().map(|term| term.abs()).sum::<f64>();
        worst.scalar(rate, power.iter().sum(), size);
    });
    worst.within(DIFFERENCES);
}

/// Wrench of the base on the mechanism, moments about `r_b`: rate of its momentum less gravity, `F_D` and
/// `M_D`.
fn base_wrench<L: LegType>(parameters: &Parameters<L>, state: &State) -> Vector6<f64> {
    let bodies = body_kinematics(parameters, state);
    let gravity = parameters.gravity_m_s2;
    let mut wrench = Vector6::zeros();
    let mut add = |mass: f64, position: &Vector3<f64>, acceleration: &Vector3<f64>| {
        let force = mass * (acceleration - gravity);
        wrench += twist(&force, &(position - state.base.position_m).cross(&force));
    };
    add(parameters.payload.mass_kg, &bodies.payload_com_position, &bodies.payload_com_acceleration);
    for (i, leg) in parameters.legs.iter().enumerate() {
        for (body, mass) in leg.masses().into_iter().enumerate() {
            add(mass, &bodies.com_position[i][body], &bodies.com_acceleration[i][body]);
        }
    }
    let rotation = state.platform.rotation;
    let inertia = rotation * parameters.payload.inertia_kg_m2 * rotation.transpose();
    let w = state.platform.angular_velocity();
    let mut moment = inertia * state.platform.angular_acceleration() + w.cross(&(inertia * w));
    let u = leg_kinematics(parameters, state).rod_direction;
    for (i, leg) in parameters.legs.iter().enumerate() {
        let inertia = leg.turning_inertia() * (Matrix3::identity() - u[i] * u[i].transpose());
        let w = bodies.leg_angular_velocity[i];
        moment += inertia * bodies.leg_angular_acceleration[i] + w.cross(&(inertia * w));
    }
    let force: Vector3<f64> = state.external_wrench.fixed_rows::<3>(0).into();
    let external: Vector3<f64> = state.external_wrench.fixed_rows::<3>(3).into();
    let arm = bodies.payload_com_position - state.base.position_m;
    wrench + twist(&Vector3::zeros(), &moment) - twist(&force, &(external + arm.cross(&force)))
}

#[test]
fn the_common_frame_does_not_matter() {
    let mut worst = Worst::new("inverse dynamics in a frame of constant rotation and velocity");
    for_random_states!(25, 50, |case, state| {
        let mut parameters = case.parameters;
        let force = inverse_dynamics(&parameters, state).unwrap();
        let turn = nalgebra::Rotation3::new(Vector3::new(0.7, -1.1, 0.4)).into_inner();
        let drift = Vector3::new(5.0, -3.0, 2.0);
        let mut other = *state;
        for body in [&mut other.base, &mut other.platform] {
            body.position_m = turn * body.position_m + drift;
            body.rotation = turn * body.rotation;
            body.velocity =
                twist(&(turn * body.linear_velocity() + drift), &(turn * body.angular_velocity()));
            body.acceleration =
                twist(&(turn * body.linear_acceleration()), &(turn * body.angular_acceleration()));
        }
        let wrench = &state.external_wrench;
        other.external_wrench =
            twist(&(turn * wrench.fixed_rows::<3>(0)), &(turn * wrench.fixed_rows::<3>(3)));
        parameters.gravity_m_s2 = turn * parameters.gravity_m_s2;
        worst.compare(&inverse_dynamics(&parameters, &other).unwrap(), &force, force.norm());
    });
    // Rounding of coordinates of 10 m against rods of 0.2 m, times the stiffness, times the condition of Jdp.
    worst.within(1e-12);
}
