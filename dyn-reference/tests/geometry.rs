//! Closure of the legs, the home pose of Table 1, legs out of reach.

#[allow(unused_macros, reason = "these tests are about one leg type each")]
mod common;

use common::{Worst, random_states, table_1, uhp_cases, ups_cases};
use dyn_reference::{
    RigidBodyMotion, State, body_kinematics, forward_dynamics, inverse_dynamics, leg_kinematics,
    rod_alignment,
};
use nalgebra::{Vector1, Vector6};

#[test]
fn rods_keep_their_length_and_actuators_their_axis() {
    let mut length = Worst::new("|platform joint - Hooke joint| = s");
    let mut axis = Worst::new("Hooke joint on the actuator's axis, d from its origin");
    let mut alignment = Worst::new("rod_alignment = (u.a)^2");
    let mut spin = Worst::new("w_s.u = 0");
    let mut joint_rate = Worst::new("universal joint's rate");
    random_states(1, 200, uhp_cases(), |case, state| {
        let legs = leg_kinematics(&case.parameters, state);
        let bodies = body_kinematics(&case.parameters, state);
        let aligned = rod_alignment(&case.parameters, state);
        for (i, leg) in case.parameters.legs.iter().enumerate() {
            let (hooke, joint) = (legs.hooke_joint_position[i], legs.platform_joint_position[i]);
            let (a, u) = (state.base.rotation * leg.actuator_axis, legs.rod_direction[i]);
            length.scalar((joint - hooke).norm(), leg.rod_length_m, leg.rod_length_m);
            let origin = state.base.position_m + state.base.rotation * leg.base_point_m;
            axis.compare(&(hooke - origin), &(legs.actuator_length[i] * a), leg.rod_length_m);
            alignment.scalar(aligned[i], u.dot(&a).powi(2), 1.0);
            assert!(u.dot(&a) > 0.0, "the Hooke joint is below the platform joint");

            let w_s = bodies.leg_angular_velocity[i];
            spin.compare(&Vector1::new(w_s.dot(&u)), &Vector1::zeros(), w_s.norm());
            let rate = state.platform.angular_velocity() - w_s;
            joint_rate.compare(&legs.platform_joint_rate[i], &rate, w_s.norm());
        }
    });
    // Positions of about 2 m carry 4e-16 m of rounding each, 2e-15 of a rod; some ten operations.
    length.within(2e-14);
    axis.within(2e-14);
    // The radicand of (18) subtracts squares five times as large as itself.
    alignment.within(5e-14);
    spin.within(1e-14);
    joint_rate.within(1e-15);
}

#[test]
fn telescopic_legs_span_their_joints() {
    let mut joints = Worst::new("joints of base and platform");
    let mut span = Worst::new("d u from base joint to platform joint");
    let mut spin = Worst::new("w_s.u = 0");
    let mut joint_rate = Worst::new("platform joint's rate");
    random_states(1, 200, ups_cases(), |case, state| {
        let legs = leg_kinematics(&case.parameters, state);
        let bodies = body_kinematics(&case.parameters, state);
        let aligned = rod_alignment(&case.parameters, state);
        for (i, leg) in case.parameters.legs.iter().enumerate() {
            let (base, joint) = (legs.hooke_joint_position[i], legs.platform_joint_position[i]);
            let (u, d) = (legs.rod_direction[i], legs.actuator_length[i]);
            joints.compare(&base, &(state.base.position_m + state.base.rotation * leg.base_point_m), 1.0);
            let expected = state.platform.position_m + state.platform.rotation * leg.platform_point_m;
            joints.compare(&joint, &expected, 1.0);
            span.compare(&(base + d * u), &joint, 1.0);
            span.scalar(aligned[i], 1.0, 1.0);
            assert!(d > 0.0);

            let w_s = bodies.leg_angular_velocity[i];
            spin.compare(&Vector1::new(w_s.dot(&u)), &Vector1::zeros(), w_s.norm());
            let rate = state.platform.angular_velocity() - w_s;
            joint_rate.compare(&legs.platform_joint_rate[i], &rate, w_s.norm());
        }
    });
    // Coordinates of about 2 m: a few of their last places.
    joints.within(2e-15);
    span.within(4e-15);
    spin.within(1e-14);
    joint_rate.within(1e-15);
}

#[test]
fn a_telescopic_leg_without_length_is_reported() {
    let [case, _] = ups_cases();
    let origin = RigidBodyMotion::at_rest(nalgebra::Vector3::zeros(), nalgebra::Matrix3::identity());
    let zero = Vector6::zeros();
    let state = State {
        base: origin,
        platform: origin,
        actuator_force_n: zero,
        external_wrench: zero,
        reference_velocity: zero,
    };
    let mut parameters = case.parameters;
    parameters.legs[2].platform_point_m = parameters.legs[2].base_point_m;
    assert!(rod_alignment(&parameters, &state)[2].is_nan());
    assert_eq!(inverse_dynamics(&parameters, &state), None);
    assert_eq!(forward_dynamics(&parameters, &state), None);
}

fn home() -> (dyn_reference::Parameters, State) {
    let case = table_1();
    let origin = RigidBodyMotion::at_rest(nalgebra::Vector3::zeros(), case.home_rotation);
    let state = State {
        base: origin,
        platform: RigidBodyMotion { position_m: case.home_position, ..origin },
        actuator_force_n: Vector6::zeros(),
        external_wrench: Vector6::zeros(),
        reference_velocity: Vector6::zeros(),
    };
    (case.parameters, state)
}

#[test]
fn table_1_closes_at_home() {
    let (parameters, state) = home();
    let legs = leg_kinematics(&parameters, &state);
    for i in 0..6 {
        // The numbers are given to five decimals.
        assert!((legs.actuator_length[i] - 0.198_21).abs() < 5e-6, "{}", legs.actuator_length[i]);
        let offset = (legs.platform_joint_position[i] - legs.hooke_joint_position[i]).xy().norm();
        assert!((offset - 0.093_04).abs() < 5e-6, "{offset}");
    }
    let expected = 1.0 - (0.093_04_f64 / 0.206).powi(2);
    assert!((rod_alignment(&parameters, &state) - Vector6::repeat(expected)).amax() < 1e-4);
}

#[test]
fn springs_of_table_1_are_preloaded_at_home() {
    let (mut parameters, state) = home();
    // Holding home takes 26.96 N along z against the springs, and the weight of all moving bodies on top:
    // every body follows a pure vertical motion.
    let springs = dyn_reference::passive_forces(&parameters, &state).spring_force;
    assert!((springs.z - 26.96).abs() < 5e-3, "{}", springs.z);
    assert!((springs - Vector6::z() * springs.z).norm() < 1e-12, "symmetry leaves no other component");
    let weight = (6.092 + 6.0 * (1.024 + 0.611)) * 9.81;
    let held = inverse_dynamics(&parameters, &state).unwrap();
    // The legs' forces along z add up; no vertical component is lost, as rods carry no moment.
    assert!((held.sum() - springs.z - weight).abs() < 1e-10, "{held}");
    parameters.gravity_m_s2.fill(0.0);
    let held = inverse_dynamics(&parameters, &state).unwrap();
    assert!((held - Vector6::repeat(springs.z / 6.0)).norm() < 1e-10, "{held}");
}

#[test]
fn a_leg_out_of_reach_is_reported() {
    let (parameters, mut state) = home();
    state.platform.position_m.x += 0.2;
    let alignment = rod_alignment(&parameters, &state);
    assert!(alignment.min() < 0.0);
    let lengths = leg_kinematics(&parameters, &state).actuator_length;
    for i in 0..6 {
        assert_eq!(alignment[i] < 0.0, lengths[i].is_nan());
    }
    assert_eq!(inverse_dynamics(&parameters, &state), None);
    assert_eq!(forward_dynamics(&parameters, &state), None);
}
