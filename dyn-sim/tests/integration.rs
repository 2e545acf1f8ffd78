//! The integrator: order against an independent reference, energy, power.

mod common;

use dyn_runtime::Pose;
use dyn_runtime::nalgebra::{Matrix3, Vector3, Vector6};
use dyn_runtime::{Acceleration, BaseMotion, Hexapod, PlatformState, models::Uhp, rotation_vector};
use dyn_sim::mechanism::{self, Mechanism, Model};
use dyn_sim::motion::{BodyMotion, Motion};
use dyn_sim::scenario::Scenario;
use dyn_sim::simulate::{self, Drive, Grid};

use common::{bases, distance, scenario, target};

/// Base motion of the large experiment, forces zero, platform let go at home: everything nonlinear, nothing steered.
fn let_go(scenario: &Scenario, grid: Grid) -> (Drive, PlatformState) {
    let base = simulate::sample(grid, &scenario.base, |_| ());
    let start = target(scenario).at(0.0).as_platform();
    let forces = vec![Vector6::zeros(); base.len()];
    (Drive { grid, base: bases(&base), actuator_force_n: forces }, start)
}

#[test]
fn fourth_order_against_the_adaptive_reference() {
    let scenario = scenario("large");
    let (mechanism, _) = mechanism::of_platform(&scenario.platform, true);
    let end = 0.2;
    let last = |step_s: f64| {
        let grid = Grid { step_s, steps: (end / step_s).round() as usize };
        let (drive, start) = let_go(&scenario, grid);
        let run = simulate::simulate(&*mechanism, &drive, &start, None, |_| ());
        assert_eq!(run.stop, None);
        run.series.state(grid.steps)
    };
    let reference = {
        let grid = Grid { step_s: 0.05, steps: 4 };
        let (_, start) = let_go(&scenario, grid);
        let drive_at = |t: f64| Ok((scenario.base.at(t).as_base(), Vector6::zeros()));
        let run = simulate::simulate_adaptively(&*mechanism, grid, 1e-13, &start, None, drive_at, |_| ());
        assert_eq!(run.stop, None);
        run.series.state(4)
    };
    let errors = [2e-3, 1e-3, 5e-4].map(|step| distance(&last(step), &reference));
    println!("errors at h = 2, 1, 0.5 ms: {errors:?}");
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((3.7..4.4).contains(&order), "order {order:.2}, errors {errors:?}");
    }
}

fn energy(hexapod: &Hexapod<Uhp>, base: &BaseMotion, state: &PlatformState) -> f64 {
    let energy = hexapod.energy(base, state).expect("a pose within reach");
    energy.kinetic_j + energy.potential_j
}

#[test]
fn undamped_free_vibration_keeps_its_energy() {
    let scenario = scenario("large");
    let model = mechanism::run_time_model(&scenario.platform);
    let (hexapod, mechanism) = (Hexapod::new(model), Model::with_gravity(model));
    let grid = Grid { step_s: 1e-4, steps: 10_000 };
    let base = BaseMotion::at_rest(Pose::identity());
    let home = scenario.platform.home.position;
    let pose = Pose {
        position_m: Vector3::from(home) + Vector3::new(0.004, -0.003, 0.006),
        rotation: rotation_vector::rotation(&Vector3::new(0.03, 0.02, -0.05)),
    };
    let samples = 2 * grid.steps + 1;
    let drive = Drive { grid, base: vec![base; samples], actuator_force_n: vec![Vector6::zeros(); samples] };
    let run = simulate::simulate(&mechanism, &drive, &PlatformState::at_rest(pose), None, |_| ());
    assert_eq!(run.stop, None);
    let energies: Vec<f64> =
        (0..=grid.steps).map(|k| energy(&hexapod, &base, &run.series.state(k))).collect();
    let kinetic = |k: usize| hexapod.energy(&base, &run.series.state(k)).expect("within reach").kinetic_j;
    let swing = (0..=grid.steps).map(kinetic).fold(0.0, f64::max);
    let drift = energies.iter().map(|e| (e - energies[0]).abs()).fold(0.0, f64::max);
    println!("energy drift over 1 s: {:.1e} of the vibration's {swing:.3} J", drift / swing);
    assert!(swing > 0.1 && drift < 1e-8 * swing, "drift {drift:e} J of {swing} J");
}

/// d/dt(T + V) = sum F_i d_i' - sum c_e d_i'^2 + w_B.v_b, with w_B from the bodies' own accelerations.
#[test]
fn power_balance_under_base_motion() {
    let mut scenario = scenario("large");
    scenario.platform.parameters.axial_damping = [20.0, 5.0, 12.0, 30.0, 8.0, 16.0];
    let model = mechanism::run_time_model(&scenario.platform);
    let (hexapod, mechanism) = (Hexapod::new(model), Model::with_gravity(model));
    let grid = Grid { step_s: 2e-4, steps: 1000 };
    let (mut drive, start) = let_go(&scenario, grid);
    for (halves, force) in drive.actuator_force_n.iter_mut().enumerate() {
        let t = grid.half_step_time(halves);
        *force = Vector6::from_fn(|i, _| 10.0 * (20.0 * t + i as f64).sin());
    }
    let run = simulate::simulate(&mechanism, &drive, &start, None, |_| ());
    assert_eq!(run.stop, None);
    let power =
        |k: usize| power(&scenario, &hexapod, &drive, k, &run.series.state(k), &run.series.acceleration[k]);
    let total = |k: usize| energy(&hexapod, &drive.base[2 * k], &run.series.state(k));
    // Simpson's rule.
    let work: f64 = (0..grid.steps)
        .step_by(2)
        .map(|k| (power(k) + 4.0 * power(k + 1) + power(k + 2)) * grid.step_s / 3.0)
        .sum();
    let size: f64 = (0..grid.steps).map(|k| power(k).abs() * grid.step_s).sum();
    let error = (total(grid.steps) - total(0) - work).abs();
    println!("power balance: error {:.1e} of {size:.2} J exchanged", error / size);
    assert!(size > 1.0 && error < 1e-8 * size, "{error:e} J of {size} J");
}

fn power(
    scenario: &Scenario,
    hexapod: &Hexapod<Uhp>,
    drive: &Drive,
    k: usize,
    state: &PlatformState,
    acceleration: &[f64; 6],
) -> f64 {
    let p = &scenario.platform.parameters;
    let of_legs = |name: &str| p.legs(name).expect("a parameter of legs uhp");
    let (rod_mass, rod_inertia, mover_mass) =
        (of_legs("rod_mass"), of_legs("rod_inertia"), of_legs("mover_mass"));
    let (base, force) = (&drive.base[2 * k], &drive.actuator_force_n[2 * k]);
    let [x, y, z, rx, ry, rz] = *acceleration;
    let acceleration =
        Acceleration { linear_m_s2: Vector3::new(x, y, z), angular_rad_s2: Vector3::new(rx, ry, rz) };
    let legs = hexapod.leg_kinematics(base, state, &acceleration).expect("within reach");
    let bodies = hexapod.body_kinematics(base, state, &acceleration).expect("within reach");
    let g = Vector3::from(p.gravity);
    let r = state.pose.rotation.matrix();
    let inertia = r * Matrix3::from(p.payload_inertia) * r.transpose();
    let (w, w_rate) = (state.velocity.angular_rad_s, acceleration.angular_rad_s2);
    let (mut push, mut moment) = (Vector3::zeros(), inertia * w_rate + w.cross(&(inertia * w)));
    let mut add = |mass: f64, at: &Vector3<f64>, acceleration: &Vector3<f64>| {
        let force = (acceleration - g) * mass;
        push += force;
        moment += (at - base.pose.position_m).cross(&force);
    };
    add(p.payload_mass, &bodies.payload_com_position_m, &bodies.payload_com_acceleration_m_s2);
    for i in 0..6 {
        add(rod_mass[i], &bodies.rod_com_position_m[i], &bodies.rod_com_acceleration_m_s2[i]);
        add(mover_mass[i], &bodies.mover_position_m[i], &bodies.mover_acceleration_m_s2[i]);
    }
    for (inertia, w_rate) in rod_inertia.iter().zip(&bodies.rod_angular_acceleration_rad_s2) {
        // Without spin a rod's angular momentum is J_s w_s.
        moment += w_rate * *inertia;
    }
    let rates = &legs.actuator_velocity_m_s;
    let damped: f64 = (0..6).map(|i| p.axial_damping[i] * rates[i] * rates[i]).sum();
    force.dot(rates) - damped + push.dot(&base.velocity.linear_m_s) + moment.dot(&base.velocity.angular_rad_s)
}

/// The baked model sees a world without gravity as the model does whose gravity is zero.
#[test]
fn without_gravity() {
    let scenario = scenario("large");
    let mut weightless = scenario.platform.clone();
    weightless.parameters.gravity = [0.0; 3];
    let (baked, kind) = mechanism::of_platform(&scenario.platform, false);
    assert_eq!(kind, "baked uhp_2016");
    let (run_time, kind) = mechanism::of_platform(&weightless, true);
    assert_eq!(kind, "uhp with parameters at run time");
    let BodyMotion { acceleration, .. } = target(&scenario).at(0.1);
    let (base, state) = (scenario.base.at(0.1).as_base(), target(&scenario).at(0.1).as_platform());
    let of = |m: &dyn Mechanism| m.inverse_dynamics(&base, &state, &acceleration).expect("within reach");
    let (one, other) = (of(&*baked), of(&*run_time));
    assert!((one - other).amax() < 1e-11 * one.amax(), "{one} {other}");
    let of = |m: &dyn Mechanism| m.forward_dynamics(&base, &state, &one).expect("within reach").to_vector();
    assert!((of(&*baked) - acceleration.to_vector()).amax() < 1e-10);
    assert!((of(&*run_time) - acceleration.to_vector()).amax() < 1e-10);
    let within = baked.forward_dynamics_within_step(&base, &state, &one).expect("within reach").to_vector();
    assert_eq!(within, of(&*baked), "the unchecked call is the same computation");
    let _: &Motion = target(&scenario);
}
