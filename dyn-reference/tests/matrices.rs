//! Mass and Coriolis matrices against energy, against their definition, and against the rod's two ends.

#[macro_use]
mod common;

use std::array::from_fn;

use common::{DIFFERENCES, TIME_STEP, Worst, derivative, moved_state, random_states, uhp_cases, unit};
use dyn_reference::partial_velocities::LegPartials;
use dyn_reference::{
    LegType, Parameters, State, body_kinematics, coriolis_matrices, energy, equation_of_motion,
    generalised_forces, jacobian_db, jacobian_dp, mass_matrix_b, mass_matrix_p, matrices, partial_velocities,
    passive_forces, stiffness_matrices,
};
use nalgebra::{Matrix3, Matrix3x6, Matrix6, Vector1, Vector6};

#[test]
fn mass_matrix_is_symmetric_positive_definite() {
    let mut symmetry = Worst::new("M_p symmetric");
    for_random_states!(10, 200, |case, state| {
        let mass = mass_matrix_p(&case.parameters, state);
        symmetry.compare(&mass, &mass.transpose(), mass.norm());
        let smallest = mass.symmetric_eigenvalues().min();
        // The least inertia in the system is the payload's about its centre of mass, above 0.01 kg m^2; every
        // other body only adds.
        assert!(smallest > 1e-3, "{smallest}");
    });
    // J^T I J with a symmetric I, rounded.
    symmetry.within(1e-15);
}

#[test]
fn mass_matrices_are_derivatives_of_kinetic_energy() {
    let mut momentum = Worst::new("dT/dv_p = M_p v_p - M_b v_b");
    let mut quadratic = Worst::new("T = v_p M_p v_p / 2 over a base at rest");
    for_random_states!(11, 100, |case, state| {
        let parameters = &case.parameters;
        let (m_p, m_b) = (mass_matrix_p(parameters, state), mass_matrix_b(parameters, state));
        let p = m_p * state.platform.velocity - m_b * state.base.velocity;
        let gradient = Vector6::from_fn(|j, _| {
            derivative(0.5, |h| {
                let mut varied = *state;
                varied.platform.velocity[j] += h;
                Vector1::new(energy(parameters, &varied).kinetic_energy)
            })
            .x
        });
        momentum.compare(&gradient, &p, m_p.norm() * state.platform.velocity.norm());
        let mut still = *state;
        still.base.velocity = Vector6::zeros();
        let v = &still.platform.velocity;
        let kinetic = energy(parameters, &still).kinetic_energy;
        quadratic.scalar(kinetic, 0.5 * v.dot(&(m_p * v)), kinetic);
    });
    // T is quadratic in the speeds: differences are exact but for rounding of sums, of thirteen bodies.
    momentum.within(2e-14);
    quadratic.within(2e-14);
}

#[test]
fn coriolis_matrix_makes_the_mass_rate_skew() {
    let mut skew = Worst::new("M_p' - 2 C_p skew");
    for_random_states!(12, 100, |case, state| {
        let coriolis = coriolis_matrices(&case.parameters, state).coriolis_matrix_p;
        let rate = derivative(TIME_STEP, |t| mass_matrix_p(&case.parameters, &moved_state(state, t)));
        let n = rate - 2.0 * coriolis;
        skew.compare(&n, &-n.transpose(), coriolis.norm());
    });
    skew.within(DIFFERENCES);
}

/// The same bodies' partial velocities: payload (or zero), legs' bodies.
struct Partials {
    payload: [Matrix3x6<f64>; 2],
    com: [[Matrix3x6<f64>; 2]; 6],
    angular: [Matrix3x6<f64>; 6],
}

fn by_platform<L: LegType>(parameters: &Parameters<L>, state: &State) -> Partials {
    let partials = partial_velocities(parameters, state);
    Partials {
        payload: [partials.payload_partial_velocity, partials.payload_partial_angular_velocity],
        com: partials.com_partial_velocity,
        angular: partials.leg_partial_angular_velocity,
    }
}

/// Partial velocities by `v_b`, from the velocities of all bodies at unit speeds.
fn by_base<L: LegType>(parameters: &Parameters<L>, state: &State) -> Partials {
    let columns: [_; 6] = from_fn(|j| {
        let mut speed = *state;
        speed.platform.velocity = Vector6::zeros();
        speed.base.velocity = unit(j);
        body_kinematics(parameters, &speed)
    });
    Partials {
        payload: [Matrix3x6::zeros(); 2],
        com: from_fn(|i| {
            from_fn(|body| Matrix3x6::from_columns(&from_fn::<_, 6, _>(|j| columns[j].com_velocity[i][body])))
        }),
        angular: from_fn(|i| {
            Matrix3x6::from_columns(&from_fn::<_, 6, _>(|j| columns[j].leg_angular_velocity[i]))
        }),
    }
}

/// Time derivatives along the state's motion, by differences.
fn rates(state: &State, partials: impl Fn(&State) -> Partials) -> Partials {
    let at = |t| partials(&moved_state(state, t));
    Partials {
        payload: from_fn(|i| derivative(TIME_STEP, |t| at(t).payload[i])),
        com: from_fn(|i| from_fn(|body| derivative(TIME_STEP, |t| at(t).com[i][body]))),
        angular: from_fn(|i| derivative(TIME_STEP, |t| at(t).angular[i])),
    }
}

/// `sum J^T m K' + J_w^T (I K_w' + [w]x I K_w)`, written out as the definition stands.
fn natural<L: LegType>(
    parameters: &Parameters<L>,
    state: &State,
    j: &Partials,
    k: &Partials,
    k_rate: &Partials,
) -> Matrix6<f64> {
    let rotation = state.platform.rotation;
    let inertia = rotation * parameters.payload.inertia_kg_m2 * rotation.transpose();
    let w = state.platform.angular_velocity().cross_matrix();
    let mut sum = parameters.payload.mass_kg * j.payload[0].transpose() * k_rate.payload[0]
        + j.payload[1].transpose() * (inertia * k_rate.payload[1] + w * inertia * k.payload[1]);
    let u = dyn_reference::leg_kinematics(parameters, state).rod_direction;
    let w_s = body_kinematics(parameters, state).leg_angular_velocity;
    for (i, leg) in parameters.legs.iter().enumerate() {
        for (body, (mass, inertia)) in leg.masses().into_iter().zip(leg.inertias()).enumerate() {
            let inertia = inertia * (Matrix3::identity() - u[i] * u[i].transpose());
            let angular = inertia * k_rate.angular[i] + w_s[i].cross_matrix() * inertia * k.angular[i];
            sum +=
                mass * j.com[i][body].transpose() * k_rate.com[i][body] + j.angular[i].transpose() * angular;
        }
    }
    sum
}

#[test]
fn coriolis_matrices_are_the_natural_factorisation() {
    let mut of_platform = Worst::new("C_p against its definition");
    let mut of_base = Worst::new("C_b against its definition");
    for_random_states!(13, 20, |case, state| {
        let parameters = &case.parameters;
        let found = coriolis_matrices(parameters, state);
        let j = by_platform(parameters, state);
        let c_p = natural(parameters, state, &j, &j, &rates(state, |s| by_platform(parameters, s)));
        of_platform.compare(&found.coriolis_matrix_p, &c_p, c_p.norm());
        let b = by_base(parameters, state);
        let c_b = -natural(parameters, state, &j, &b, &rates(state, |s| by_base(parameters, s)));
        of_base.compare(&found.coriolis_matrix_b, &c_b, c_b.norm());
    });
    of_platform.within(DIFFERENCES);
    of_base.within(DIFFERENCES);
}

#[test]
fn matrices_agree_with_body_accelerations() {
    let mut velocity_terms = Worst::new("C_p v_p - C_b v_b against accelerations without v'");
    let mut inertia_terms = Worst::new("M_p v_p' - M_b v_b' + C_p v_p - C_b v_b against inertia forces");
    let mut bias = Worst::new("bias by matrices and by bodies");
    for_random_states!(14, 200, |case, state| {
        let parameters = &case.parameters;
        let eom = equation_of_motion(parameters, state);
        let inertia = |s: &State| {
            let forces = generalised_forces(parameters, s);
            let legs: Vector6<f64> = forces.inertia_force.iter().flatten().sum();
            forces.payload_inertia_force + legs
        };
        let mut unaccelerated = *state;
        unaccelerated.platform.acceleration = Vector6::zeros();
        unaccelerated.base.acceleration = Vector6::zeros();
        let coriolis =
            eom.coriolis_matrix_p * state.platform.velocity - eom.coriolis_matrix_b * state.base.velocity;
        velocity_terms.compare(&-inertia(&unaccelerated), &coriolis, coriolis.norm());
        let all = eom.mass_matrix_p * state.platform.acceleration
            - eom.mass_matrix_b * state.base.acceleration
            + coriolis;
        inertia_terms.compare(&-inertia(state), &all, coriolis.norm());
        bias.compare(&dyn_reference::bias(parameters, state), &eom.bias, eom.bias.norm());
    });
    // Two ways of summing the same products. Relative motion may cancel most of C_p v_p against C_b v_b.
    velocity_terms.within(1e-13);
    inertia_terms.within(1e-13);
    bias.within(1e-13);
}

#[test]
fn a_rod_without_spin_is_two_end_masses_and_a_coupling() {
    let mut mass = Worst::new("rods in M_p as two ends");
    let mut mass_b = Worst::new("rods in M_b as two ends");
    let mut coriolis = Worst::new("rods in C_p as two ends");
    let mut coriolis_b = Worst::new("rods in C_b as two ends");
    random_states(15, 100, uhp_cases(), |case, state| {
        let parameters = &case.parameters;
        let mut massless = case.parameters;
        for leg in &mut massless.legs {
            leg.rod_mass_kg = 0.0;
            leg.rod_inertia_kg_m2 = 0.0;
        }
        let (with, without) = (matrices(parameters, state), matrices(&massless, state));
        let mut ends = [Matrix6::zeros(); 4];
        for leg in &parameters.legs {
            let geometry = leg.geometry(&state.base, &state.platform);
            let velocity = leg.velocity(&geometry, &state.base, &state.platform);
            let j = leg.partials_by_platform(&geometry);
            let b = leg.partials_by_base(&geometry);
            let j_rate = leg.partial_rates_by_platform(&j, &geometry, &velocity, &state.platform);
            let b_rate = leg.partial_rates_by_base(&b, &geometry, &velocity, &state.base);
            let (m, k) = (leg.rod_mass_kg, leg.rod_com_fraction);
            let turning = leg.rod_inertia_kg_m2 / (leg.rod_length_m * leg.rod_length_m);
            let product = |right: &LegPartials| {
                (m * (1.0 - k) * (1.0 - k) + turning) * j.hooke.transpose() * right.hooke
                    + (m * k * k + turning) * j.platform_joint.transpose() * right.platform_joint
                    + (m * k * (1.0 - k) - turning)
                        * (j.hooke.transpose() * right.platform_joint
                            + j.platform_joint.transpose() * right.hooke)
            };
            ends[0] += product(&j);
            ends[1] -= product(&b);
            ends[2] += product(&j_rate);
            ends[3] -= product(&b_rate);
        }
        mass.compare(&(with.mass_matrix_p - without.mass_matrix_p), &ends[0], ends[0].norm());
        mass_b.compare(&(with.mass_matrix_b - without.mass_matrix_b), &ends[1], ends[1].norm());
        coriolis.compare(&(with.coriolis_matrix_p - without.coriolis_matrix_p), &ends[2], ends[2].norm());
        coriolis_b.compare(&(with.coriolis_matrix_b - without.coriolis_matrix_b), &ends[3], ends[3].norm());
    });
    // Exact identities; the rods' share is a difference of larger numbers.
    mass.within(2e-14);
    mass_b.within(2e-14);
    coriolis.within(2e-14);
    coriolis_b.within(2e-14);
}

#[test]
fn stiffness_is_the_derivative_of_the_spring_force_without_preload() {
    let mut stiffness_p = Worst::new("K_p against differences of the spring force");
    let mut stiffness_b = Worst::new("K_b against differences of the spring force");
    for_random_states!(16, 40, |case, state| {
        let mut parameters = case.parameters;
        let lengths = dyn_reference::leg_kinematics(&parameters, state).actuator_length;
        for (i, leg) in parameters.legs.iter_mut().enumerate() {
            leg.rest_length_m = lengths[i];
        }
        let found = stiffness_matrices(&parameters, state);
        for j in 0..6 {
            let force = |s: &State| passive_forces(&parameters, s).spring_force;
            let column = derivative(common::POSE_STEP, |h| {
                force(&State { platform: common::displaced(&state.platform, j, h), ..*state })
            });
            let k_p = found.stiffness_matrix_p;
            stiffness_p.compare(&k_p.column(j).into_owned(), &column, k_p.norm());
            let column = derivative(common::POSE_STEP, |h| {
                force(&State { base: common::displaced(&state.base, j, h), ..*state })
            });
            let k_b = found.stiffness_matrix_b;
            stiffness_b.compare(&k_b.column(j).into_owned(), &-column, k_b.norm());
        }
    });
    stiffness_p.within(DIFFERENCES);
    stiffness_b.within(DIFFERENCES);
}

#[test]
fn combined_functions_return_what_the_single_ones_do() {
    for_random_states!(17, 5, |case, state| {
        let p = &case.parameters;
        let (all, eom) = (matrices(p, state), equation_of_motion(p, state));
        let coriolis = coriolis_matrices(p, state);
        let (stiffness, passive) = (stiffness_matrices(p, state), passive_forces(p, state));
        assert_eq!(mass_matrix_p(p, state), all.mass_matrix_p);
        assert_eq!(mass_matrix_b(p, state), all.mass_matrix_b);
        assert_eq!(coriolis.coriolis_matrix_p, all.coriolis_matrix_p);
        assert_eq!(coriolis.coriolis_matrix_b, all.coriolis_matrix_b);
        assert_eq!(jacobian_dp(p, state), all.jacobian_dp);
        assert_eq!(jacobian_db(p, state), all.jacobian_db);
        assert_eq!(eom.mass_matrix_p, all.mass_matrix_p);
        assert_eq!(eom.mass_matrix_b, all.mass_matrix_b);
        assert_eq!(eom.coriolis_matrix_p, all.coriolis_matrix_p);
        assert_eq!(eom.coriolis_matrix_b, all.coriolis_matrix_b);
        assert_eq!(eom.jacobian_dp, all.jacobian_dp);
        assert_eq!(eom.jacobian_db, all.jacobian_db);
        assert_eq!(eom.stiffness_matrix_p, stiffness.stiffness_matrix_p);
        assert_eq!(eom.stiffness_matrix_b, stiffness.stiffness_matrix_b);
        assert_eq!(eom.gravity_force, passive.gravity_force);
        assert_eq!(eom.spring_force, passive.spring_force);
        assert_eq!(eom.damping_force, passive.damping_force);
    });
}
