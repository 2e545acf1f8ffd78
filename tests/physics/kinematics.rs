//! Velocities are derivatives of positions, Jacobians of lengths, and rods stay rods.

use dyn_gen::deviation::{Scale, relative_error};
use dyn_gen::graph::Environment;
use dyn_platform::LegType;
use nalgebra::{Matrix6, Vector3, Vector6};

use crate::law::{Law, difference, largest, unbalance};
use crate::motion::{REASON, TIME_STEP, TOLERANCE, after, derivative, gradient};
use crate::subject::{LegBodies, Subject, Values, parts};

/// Function, quantity, its rate.
type Rate = (&'static str, &'static str, &'static str);

fn rates_hold(law: &Law, common: &[Rate], of_legs: impl Fn(&LegBodies) -> Vec<(String, String)>) {
    law.holds(|subject, state| {
        let deviation = |function: &str, quantity: &str, rate: &str| {
            let along = derivative(|t| subject.call(function, &after(state, t))[quantity].clone(), TIME_STEP);
            relative_error(&subject.call(function, state)[rate], &along, Scale::own())
        };
        let common = common.iter().map(|(function, quantity, rate)| deviation(function, quantity, rate));
        let of_legs = of_legs(subject.bodies());
        let of_legs = of_legs.iter().map(|(quantity, rate)| deviation("body_kinematics", quantity, rate));
        largest(common.chain(of_legs))
    });
}

/// Names of a quantity and its rate, of both bodies of a leg.
fn of_bodies(legs: &LegBodies, quantity: &str, rate: &str) -> Vec<(String, String)> {
    legs.bodies.iter().map(|(_, com)| (format!("{com}_{quantity}"), format!("{com}_{rate}"))).collect()
}

/// x' is the velocity of every body and actuator.
#[test]
fn velocities_are_rates_of_positions() {
    let law = Law { name: "velocities are rates of positions", tolerance: TOLERANCE, reason: REASON };
    rates_hold(
        &law,
        &[
            ("leg_kinematics", "actuator_length", "actuator_velocity"),
            ("body_kinematics", "payload_com_position", "payload_com_velocity"),
        ],
        |legs| of_bodies(legs, "position", "velocity"),
    );
}

/// x'' is the acceleration of every body and actuator, w_s' that of a rod's turning.
#[test]
fn accelerations_are_rates_of_velocities() {
    let law = Law { name: "accelerations are rates of velocities", tolerance: TOLERANCE, reason: REASON };
    rates_hold(
        &law,
        &[
            ("leg_kinematics", "actuator_velocity", "actuator_acceleration"),
            ("body_kinematics", "payload_com_velocity", "payload_com_acceleration"),
        ],
        |legs| {
            let turning = ["velocity", "acceleration"].map(|rate| format!("{}_angular_{rate}", legs.turning));
            let mut rates = of_bodies(legs, "velocity", "acceleration");
            rates.push(turning.into());
            rates
        },
    );
}

fn angular_velocity(subject: &Subject, state: &Environment) -> [Vector3<f64>; 6] {
    let name = format!("{}_angular_velocity", subject.bodies().turning);
    subject.call("body_kinematics", state).legs::<3, 1>(&name)
}

/// u' = w_s × u: the rod turns with its angular velocity.
#[test]
fn rod_direction_turns_with_the_rod() {
    let law = Law { name: "u' = w_s x u", tolerance: TOLERANCE, reason: REASON };
    law.holds(|subject, state| {
        let direction = |state: &Environment| subject.call("leg_kinematics", state)["rod_direction"].clone();
        let rate: Vec<f64> = derivative(|t| direction(&after(state, t)), TIME_STEP);
        let u = subject.call("leg_kinematics", state).legs::<3, 1>("rod_direction");
        let w = angular_velocity(subject, state);
        let turning: Vec<f64> = (0..6).flat_map(|leg| w[leg].cross(&u[leg]).data.0[0]).collect();
        relative_error(&turning, &rate, Scale::own())
    });
}

/// w_s.u = 0 (22): rods do not spin; and the universal joint's rate is w_p - w_s.
#[test]
fn rods_do_not_spin() {
    let law = Law {
        name: "w_s.u = 0, joint rate w_p - w_s",
        tolerance: 1e-12,
        reason: "products of rounded vectors",
    };
    law.holds(|subject, state| {
        let legs = subject.call("leg_kinematics", state);
        let (u, joint) = (legs.legs::<3, 1>("rod_direction"), legs.legs::<3, 1>("platform_joint_rate"));
        let w = angular_velocity(subject, state);
        let (_, w_p) = parts(state.vector("platform_velocity"));
        largest((0..6).flat_map(|leg| {
            [w[leg].dot(&u[leg]).abs() / w[leg].norm(), difference(joint[leg], w_p - w[leg])]
        }))
    });
}

/// The loop closes (14), (17): platform joint r_p + R_p p, and a unit vector u from the Hooke joint to it. Of the paper's legs:
/// Hooke joint r_b + R_b b + d a, the rod's length s between the joints, u.a > 0, and the alignment is (u.a)^2. Of telescopic
/// legs: Hooke joint r_b + R_b b, d between the joints, alignment 1.
#[test]
fn legs_close() {
    let law = Law {
        name: "u spans Hooke and platform joint",
        tolerance: 1e-13,
        reason: "a few rounded operations",
    };
    law.holds(|subject, state| {
        let legs = subject.call("leg_kinematics", state);
        let [u, hooke, joint] = ["rod_direction", "hooke_joint_position", "platform_joint_position"]
            .map(|name| legs.legs::<3, 1>(name));
        let [base_point, platform_point] =
            ["base_point", "platform_point"].map(|name| subject.parameters.legs::<3, 1>(name));
        let alignment = subject.vector("rod_alignment", state);
        let (r_b, r_p) = (state.vector::<3>("base_position"), state.vector::<3>("platform_position"));
        let (base, platform) =
            (state.matrix::<3, 3>("base_rotation"), state.matrix::<3, 3>("platform_rotation"));
        largest((0..6).flat_map(|leg| {
            let d = legs["actuator_length"][leg];
            let (span, cosine, slide): (f64, f64, Vector3<f64>) = match subject.leg_type {
                LegType::Uhp => {
                    let a: Vector3<f64> = base * subject.parameters.legs::<3, 1>("actuator_axis")[leg];
                    (subject.parameters["rod_length"][leg], u[leg].dot(&a), a * d)
                }
                LegType::Ups => (d, 1.0, Vector3::zeros()),
            };
            assert!(cosine > 0.0, "the Hooke joint is below the platform joint");
            assert!(span > 0.0, "joints are apart");
            [
                (cosine.powi(2) - alignment[leg]).abs(),
                (u[leg].norm() - 1.0).abs(),
                difference(joint[leg] - hooke[leg], u[leg] * span),
                difference(hooke[leg], r_b + base * base_point[leg] + slide),
                difference(joint[leg], r_p + platform * platform_point[leg]),
            ]
        }))
    });
}

/// (32): J_dp is the derivative of d by displacements of the platform, (31): -J_db that by displacements of the base.
#[test]
fn jacobians_are_derivatives_of_length() {
    let law = Law { name: "J_dp, J_db are derivatives of d", tolerance: TOLERANCE, reason: REASON };
    law.holds(|subject, state| {
        let by = |body| columns(gradient(state, body, |state| lengths(subject, state)));
        let (dp, db) = (subject.matrix("jacobian_dp", state), subject.matrix("jacobian_db", state));
        largest([difference(dp, by("platform")), difference(-db, by("base"))])
    });
}

fn lengths(subject: &Subject, state: &Environment) -> Vec<f64> {
    subject.call("leg_kinematics", state)["actuator_length"].clone()
}

/// The matrix of these columns.
pub fn columns(columns: [Vec<f64>; 6]) -> Matrix6<f64> {
    Matrix6::from_column_slice(&columns.concat())
}

/// d' = J_dp v_p - J_db v_b (30).
#[test]
fn actuator_velocity_is_linear_in_both_velocities() {
    let law =
        Law { name: "d' = J_dp v_p - J_db v_b", tolerance: 1e-12, reason: "partly cancelling rounded terms" };
    law.holds(|subject, state| {
        let velocity = subject.call("leg_kinematics", state).vector::<6>("actuator_velocity");
        let by_platform = subject.matrix("jacobian_dp", state) * state.vector::<6>("platform_velocity");
        let by_base = subject.matrix("jacobian_db", state) * state.vector::<6>("base_velocity");
        unbalance(&[velocity, -by_platform, by_base])
    });
}

/// (33)-(38): partial velocities times v_p are the change of a velocity when the platform's own velocity v_p sets in.
#[test]
fn partial_velocities_are_derivatives_of_velocities() {
    let law =
        Law { name: "J v_p = v(v_p) - v(0)", tolerance: 1e-12, reason: "partly cancelling rounded terms" };
    law.holds(|subject, state| {
        let partial = subject.call("partial_velocities", state);
        let moving = subject.call("body_kinematics", state);
        let carried = subject.call("body_kinematics", &state.with("platform_velocity", &[0.0; 6]));
        let v_p = state.vector::<6>("platform_velocity");
        let change = |velocity: &str, jacobian: &str| {
            let rows = partial[jacobian].chunks(6).map(Vector6::from_row_slice);
            let products: Vec<f64> = rows.map(|row| row.dot(&v_p)).collect();
            let expected: Vec<f64> =
                moving[velocity].iter().zip(&carried[velocity]).map(|(a, b)| a - b).collect();
            relative_error(&products, &expected, Scale::own())
        };
        let (_, w_p) = parts(v_p);
        let turning = partial.matrix::<3, 6>("payload_partial_angular_velocity") * v_p;
        let LegBodies { turning: leg, bodies, .. } = subject.bodies();
        let of_bodies =
            bodies.map(|(body, com)| change(&format!("{com}_velocity"), &format!("{body}_partial_velocity")));
        let of_payload = [
            difference(turning, w_p),
            change("payload_com_velocity", "payload_partial_velocity"),
            change(&format!("{leg}_angular_velocity"), &format!("{leg}_partial_angular_velocity")),
        ];
        largest(of_payload.into_iter().chain(of_bodies))
    });
}
