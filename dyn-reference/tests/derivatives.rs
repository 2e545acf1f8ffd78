//! Velocities, accelerations and partial velocities against finite differences of positions along exact rigid
//! motions.
//!
//! Nothing here uses an equation of the model beyond the positions of joints and bodies, which `geometry.rs`
//! checks.

#[macro_use]
mod common;

use common::{
    DIFFERENCES, POSE_STEP, TIME_STEP, Worst, derivative, displaced, moved, moved_state, random_states,
    uhp_cases, unit, ups_cases,
};
use dyn_reference::partial_velocities::{LegPartials, PayloadPartials};
use dyn_reference::{
    LegType, State, body_kinematics, jacobian_db, jacobian_dp, leg_kinematics, partial_velocities,
};
use nalgebra::{Matrix3x6, SMatrix, Vector3, Vector6};

/// Six vectors as one matrix.
fn columns(vectors: &[Vector3<f64>; 6]) -> SMatrix<f64, 3, 6> {
    SMatrix::from_columns(vectors)
}

/// One of two bodies of every leg.
fn of<T: Copy>(body: usize, bodies: [[T; 2]; 6]) -> [T; 6] {
    bodies.map(|two| two[body])
}

#[test]
fn the_test_motion_is_a_rigid_motion() {
    let mut rotation = Worst::new("R' = [w]x R");
    let mut orthonormal = Worst::new("R R^T = 1");
    let mut acceleration = Worst::new("(v, w)' = (a, w')");
    let mut start = Worst::new("motion starts at the state");
    for_random_states!(2, 50, |_, state| {
        for body in [&state.base, &state.platform] {
            let now = moved(body, 0.0);
            start.compare(&now.acceleration, &body.acceleration, body.acceleration.norm());
            start.compare(&now.velocity, &body.velocity, body.velocity.norm());
            start.compare(&now.rotation, &body.rotation, 1.0);
            let then = moved(body, 0.05);
            orthonormal.compare(&(then.rotation * then.rotation.transpose()), &SMatrix::identity(), 1.0);
            let at = |t| moved(body, 0.05 + t);
            let w = then.angular_velocity().cross_matrix() * then.rotation;
            rotation.compare(&derivative(TIME_STEP, |t| at(t).rotation), &w, w.norm());
            let a = derivative(TIME_STEP, |t| at(t).velocity);
            acceleration.compare(&a, &then.acceleration, a.norm());
        }
    });
    // Exact formulas; rounding only.
    start.within(1e-14);
    orthonormal.within(1e-14);
    rotation.within(DIFFERENCES);
    acceleration.within(DIFFERENCES);
}

#[test]
fn actuator_rates() {
    let mut velocity = Worst::new("d' against differences of d");
    let mut acceleration = Worst::new("d'' against differences of d'");
    let mut linear = Worst::new("d' = Jdp v_p - Jdb v_b");
    let mut second = Worst::new("d'' = (Jdp v_p - Jdb v_b)'");
    for_random_states!(3, 100, |case, state| {
        let legs = leg_kinematics(&case.parameters, state);
        let at = |t| leg_kinematics(&case.parameters, &moved_state(state, t));
        let d1 = derivative(TIME_STEP, |t| at(t).actuator_length);
        velocity.compare(&legs.actuator_velocity, &d1, d1.norm());
        let d2 = derivative(TIME_STEP, |t| at(t).actuator_velocity);
        acceleration.compare(&legs.actuator_acceleration, &d2, d2.norm());

        let projected = |s: &State| {
            jacobian_dp(&case.parameters, s) * s.platform.velocity
                - jacobian_db(&case.parameters, s) * s.base.velocity
        };
        linear.compare(&legs.actuator_velocity, &projected(state), d1.norm());
        let d2 = derivative(TIME_STEP, |t| projected(&moved_state(state, t)));
        second.compare(&legs.actuator_acceleration, &d2, d2.norm());
    });
    velocity.within(DIFFERENCES);
    acceleration.within(DIFFERENCES);
    // The same numbers summed in another order.
    linear.within(1e-14);
    second.within(DIFFERENCES);
}

#[test]
fn body_velocities_and_accelerations() {
    let mut velocity = Worst::new("velocities of centres of mass");
    let mut acceleration = Worst::new("accelerations of centres of mass");
    let mut direction = Worst::new("u' = w_s x u");
    let mut angular = Worst::new("w_s' against differences of w_s");
    for_random_states!(4, 100, |case, state| {
        let now = body_kinematics(&case.parameters, state);
        let at = |t| body_kinematics(&case.parameters, &moved_state(state, t));

        let v = derivative(TIME_STEP, |t| at(t).payload_com_position);
        velocity.compare(&now.payload_com_velocity, &v, v.norm());
        for body in 0..2 {
            let v = derivative(TIME_STEP, |t| columns(&of(body, at(t).com_position)));
            velocity.compare(&columns(&of(body, now.com_velocity)), &v, v.norm());
        }

        let a = derivative(TIME_STEP, |t| at(t).payload_com_velocity);
        acceleration.compare(&now.payload_com_acceleration, &a, a.norm());
        for body in 0..2 {
            let a = derivative(TIME_STEP, |t| columns(&of(body, at(t).com_velocity)));
            acceleration.compare(&columns(&of(body, now.com_acceleration)), &a, a.norm());
        }

        let u = leg_kinematics(&case.parameters, state).rod_direction;
        let rate = derivative(TIME_STEP, |t| {
            columns(&leg_kinematics(&case.parameters, &moved_state(state, t)).rod_direction)
        });
        let turned: [Vector3<f64>; 6] = std::array::from_fn(|i| now.leg_angular_velocity[i].cross(&u[i]));
        direction.compare(&columns(&turned), &rate, rate.norm());
        let w = derivative(TIME_STEP, |t| columns(&at(t).leg_angular_velocity));
        angular.compare(&columns(&now.leg_angular_acceleration), &w, w.norm());
    });
    velocity.within(DIFFERENCES);
    acceleration.within(DIFFERENCES);
    direction.within(DIFFERENCES);
    angular.within(DIFFERENCES);
}

#[test]
fn bodies_lie_where_their_parameters_say() {
    let mut place = Worst::new("centres of mass");
    random_states(5, 50, uhp_cases(), |case, state| {
        let bodies = body_kinematics(&case.parameters, state);
        let legs = leg_kinematics(&case.parameters, state);
        let payload = state.platform.position_m + state.platform.rotation * case.parameters.payload.com_m;
        place.compare(&bodies.payload_com_position, &payload, 1.0);
        for (i, leg) in case.parameters.legs.iter().enumerate() {
            let (hooke, joint) = (legs.hooke_joint_position[i], legs.platform_joint_position[i]);
            let rod = hooke + (joint - hooke) * leg.rod_com_fraction;
            place.compare(&bodies.com_position[i][0], &rod, 1.0);
            let mover = hooke - state.base.rotation * leg.actuator_axis * leg.mover_offset_m;
            place.compare(&bodies.com_position[i][1], &mover, 1.0);
        }
    });
    random_states(5, 50, ups_cases(), |case, state| {
        let bodies = body_kinematics(&case.parameters, state);
        let legs = leg_kinematics(&case.parameters, state);
        for (i, leg) in case.parameters.legs.iter().enumerate() {
            let (base, joint) = (legs.hooke_joint_position[i], legs.platform_joint_position[i]);
            let along = (joint - base) / legs.actuator_length[i];
            place.compare(&bodies.com_position[i][0], &(base + along * leg.lower_com_distance_m), 1.0);
            place.compare(&bodies.com_position[i][1], &(joint - along * leg.upper_com_distance_m), 1.0);
        }
    });
    // Coordinates of about 2 m: a few of their last places.
    place.within(4e-15);
}

#[test]
fn jacobians_are_derivatives_by_pose() {
    let mut by_platform = Worst::new("Jdp against differences of d");
    let mut by_base = Worst::new("Jdb against differences of d");
    for_random_states!(6, 60, |case, state| {
        let length = |s: &State| leg_kinematics(&case.parameters, s).actuator_length;
        let (jdp, jdb) = (jacobian_dp(&case.parameters, state), jacobian_db(&case.parameters, state));
        for j in 0..6 {
            let column = derivative(POSE_STEP, |h| {
                length(&State { platform: displaced(&state.platform, j, h), ..*state })
            });
            by_platform.compare(&jdp.column(j).into_owned(), &column, jdp.norm());
            let column =
                derivative(POSE_STEP, |h| length(&State { base: displaced(&state.base, j, h), ..*state }));
            by_base.compare(&jdb.column(j).into_owned(), &-column, jdb.norm());
        }
    });
    by_platform.within(DIFFERENCES);
    by_base.within(DIFFERENCES);
}

#[test]
fn partial_velocities_are_derivatives_by_pose_and_speed() {
    let mut by_pose = Worst::new("partial velocities against differences of positions");
    let mut turning = Worst::new("partial angular velocities against differences of u");
    let mut by_speed = Worst::new("partial velocities against velocities for unit speeds");
    for_random_states!(7, 60, |case, state| {
        let parameters = &case.parameters;
        let partials = partial_velocities(parameters, state);
        let column = |matrices: &[SMatrix<f64, 3, 6>; 6], j: usize| {
            columns(&std::array::from_fn(|i| matrices[i].column(j).into_owned()))
        };
        for j in 0..6 {
            let at = |h| State { platform: displaced(&state.platform, j, h), ..*state };
            let bodies = |h| body_kinematics(parameters, &at(h));
            let payload = derivative(POSE_STEP, |h| bodies(h).payload_com_position);
            by_pose.compare(&partials.payload_partial_velocity.column(j).into_owned(), &payload, 1.0);
            for body in 0..2 {
                let moved = derivative(POSE_STEP, |h| columns(&of(body, bodies(h).com_position)));
                let partial = column(&of(body, partials.com_partial_velocity), j);
                by_pose.compare(&partial, &moved, moved.norm());
            }
            let rate = derivative(POSE_STEP, |h| columns(&leg_kinematics(parameters, &at(h)).rod_direction));
            let u = leg_kinematics(parameters, state).rod_direction;
            let w = partials.leg_partial_angular_velocity;
            let turned: [Vector3<f64>; 6] = std::array::from_fn(|i| w[i].column(j).into_owned().cross(&u[i]));
            turning.compare(&columns(&turned), &rate, rate.norm());

            let mut speed = *state;
            speed.base.velocity = Vector6::zeros();
            speed.platform.velocity = unit(j);
            let moving = body_kinematics(parameters, &speed);
            let mut same = |partial: &SMatrix<f64, 3, 6>, velocity: &SMatrix<f64, 3, 6>| {
                by_speed.compare(partial, velocity, velocity.norm());
            };
            for body in 0..2 {
                let partial = column(&of(body, partials.com_partial_velocity), j);
                same(&partial, &columns(&of(body, moving.com_velocity)));
            }
            same(&column(&partials.leg_partial_angular_velocity, j), &columns(&moving.leg_angular_velocity));
            let w_p = partials.payload_partial_angular_velocity.column(j).into_owned();
            by_speed.compare(&w_p, &speed.platform.angular_velocity(), 1.0);
            let payload = partials.payload_partial_velocity.column(j).into_owned();
            by_speed.compare(&payload, &moving.payload_com_velocity, 1.0);
        }
    });
    by_pose.within(DIFFERENCES);
    turning.within(DIFFERENCES);
    // The same numbers in another order.
    by_speed.within(1e-14);
}

/// The rates are compared directly, because some of their parts drop out of `C_p` and `C_b`: the rods'
/// inertia has no part along `u`, the movers' partial velocities none across `a`.
#[test]
fn partial_velocity_rates() {
    let mut of_legs = Worst::new("rates of the legs' partial velocities");
    let mut of_payload = Worst::new("rates of the payload's partial velocities");
    for_random_states!(8, 60, |case, state| {
        let payload = |s: &State| PayloadPartials::new(&case.parameters, &s.platform);
        let rates = PayloadPartials::rates(&case.parameters, &state.platform);
        let expected = derivative(TIME_STEP, |t| payload(&moved_state(state, t)).velocity);
        of_payload.compare(&rates.velocity, &expected, expected.norm());
        let expected = derivative(TIME_STEP, |t| payload(&moved_state(state, t)).angular_velocity);
        of_payload.compare(&rates.angular_velocity, &expected, 1.0);

        for leg in &case.parameters.legs {
            let geometry = |s: &State| leg.geometry(&s.base, &s.platform);
            let by_platform = |s: &State| leg.partials_by_platform(&geometry(s));
            let by_base = |s: &State| leg.partials_by_base(&geometry(s));
            let now = geometry(state);
            let velocity = leg.velocity(&now, &state.base, &state.platform);
            let platform_rates =
                leg.partial_rates_by_platform(&by_platform(state), &now, &velocity, &state.platform);
            let base_rates = leg.partial_rates_by_base(&by_base(state), &now, &velocity, &state.base);
            let mut check = |partials: &dyn Fn(&State) -> LegPartials, rates: &LegPartials| {
                let at = |t| partials(&moved_state(state, t));
                let length = derivative(TIME_STEP, |t| at(t).length);
                of_legs.compare(&rates.length, &length, length.norm());
                let parts: [fn(&LegPartials) -> Matrix3x6<f64>; 5] =
                    [|p| p.hooke, |p| p.platform_joint, |p| p.com[0], |p| p.com[1], |p| p.angular];
                for part in parts {
                    let expected = derivative(TIME_STEP, |t| part(&at(t)));
                    of_legs.compare(&part(rates), &expected, length.norm());
                }
            };
            check(&by_platform, &platform_rates);
            check(&by_base, &base_rates);
        }
    });
    of_payload.within(DIFFERENCES);
    // Of a rod's angular velocity they are larger by one over the rod's length.
    of_legs.within(5.0 * DIFFERENCES);
}
