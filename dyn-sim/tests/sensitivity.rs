//! The large experiment can fail: forces of wrong models, played to the right one, are caught by a wide margin; the
//! published experiment lets half of them pass.

mod common;

use dyn_platform::Platform;
use dyn_runtime::models::Uhp;
use dyn_runtime::nalgebra::{Vector3, Vector6};
use dyn_runtime::{Acceleration, BaseMotion, Error, Hexapod, LegKinematics, Limits, Monitor, PlatformState};
use dyn_sim::compare::time_errors;
use dyn_sim::mechanism::{self, Mechanism, Model};
use dyn_sim::scenario::Scenario;
use dyn_sim::simulate;

use common::{scenario, series, target};

/// What the acceleration may be wrong by at most with the right model, here and by another engine.
const BOUND: f64 = 1e-4;
/// How far beyond that each wrong model must be.
const MARGIN: f64 = 50.0;

/// Relative error of the acceleration under the forces of `model`.
fn error_of(scenario: &Scenario, model: &dyn Mechanism) -> f64 {
    let (truth, _) = mechanism::of_platform(&scenario.platform, scenario.gravity_on);
    let (grid, motion) = (scenario.grid, target(scenario));
    let base = simulate::sample(grid, &scenario.base, |_| ());
    let wanted = simulate::sample(grid, motion, |_| ());
    let (drive, stop) = simulate::forces_along(model, grid, &base, &wanted, scenario.stroke, |_| ());
    assert_eq!(stop, None);
    // A wrong model may drive the legs anywhere: no limits.
    let run = simulate::simulate(&*truth, &drive, &wanted[0].as_platform(), None, |_| ());
    time_errors(&series(grid, motion), &run.series).acceleration_relative
}

fn with_parameters(scenario: &Scenario, change: impl Fn(&mut Platform)) -> f64 {
    let mut platform = scenario.platform.clone();
    change(&mut platform);
    error_of(scenario, &*mechanism::of_platform(&platform, scenario.gravity_on).0)
}

/// An error in the generalised forces of a state and the acceleration wanted there.
type ForceError =
    fn(&Hexapod<Uhp>, &BaseMotion, &PlatformState, &Acceleration) -> Result<Vector6<f64>, Error>;

/// A model whose inverse dynamics has an error in the generalised forces.
struct Wrong {
    right: Model<Uhp>,
    hexapod: Hexapod<Uhp>,
    error: ForceError,
}

impl Mechanism for Wrong {
    fn forward_dynamics(
        &self,
        base: &BaseMotion,
        platform: &PlatformState,
        force: &Vector6<f64>,
    ) -> Result<Acceleration, Error> {
        self.right.forward_dynamics(base, platform, force)
    }

    fn inverse_dynamics(
        &self,
        base: &BaseMotion,
        platform: &PlatformState,
        acceleration: &Acceleration,
    ) -> Result<Vector6<f64>, Error> {
        let force = self.right.inverse_dynamics(base, platform, acceleration)?;
        let error = (self.error)(&self.hexapod, base, platform, acceleration)?;
        let jacobian = self.hexapod.jacobian_dp(base, platform)?;
        Ok(force + jacobian.transpose().lu().solve(&error).expect("a regular pose"))
    }

    fn leg_kinematics(&self, base: &BaseMotion, platform: &PlatformState) -> Result<LegKinematics, Error> {
        self.right.leg_kinematics(base, platform)
    }

    fn jacobian_determinant(&self, base: &BaseMotion, platform: &PlatformState) -> f64 {
        self.right.jacobian_determinant(base, platform)
    }

    fn monitor(
        &self,
        base: &BaseMotion,
        platform: &PlatformState,
        actuator_force_n: &Vector6<f64>,
        limits: &Limits,
    ) -> Result<Monitor, Error> {
        self.right.monitor(base, platform, actuator_force_n, limits)
    }
}

fn wrong(scenario: &Scenario, error: ForceError) -> f64 {
    let model = mechanism::run_time_model(&scenario.platform);
    let gravity = scenario.platform.parameters.gravity;
    let right =
        if scenario.gravity_on { Model::with_gravity(model) } else { Model::without_gravity(model, gravity) };
    error_of(scenario, &Wrong { right, hexapod: Hexapod::new(model), error })
}

/// (26) and (29) as printed: 2 d' a where 2 d' (w_b x a) belongs, in the accelerations of movers and rods.
fn coriolis_as_printed(
    hexapod: &Hexapod<Uhp>,
    base: &BaseMotion,
    platform: &PlatformState,
    acceleration: &Acceleration,
) -> Result<Vector6<f64>, Error> {
    coriolis_wrong_by(hexapod, base, platform, acceleration, |w_b, a| a - w_b.cross(a))
}

/// The term left out altogether.
fn no_coriolis(
    hexapod: &Hexapod<Uhp>,
    base: &BaseMotion,
    platform: &PlatformState,
    acceleration: &Acceleration,
) -> Result<Vector6<f64>, Error> {
    coriolis_wrong_by(hexapod, base, platform, acceleration, |w_b, a| -w_b.cross(a))
}

/// 2 d' times `difference` of the base's angular velocity and an actuator's axis, in the accelerations of movers and
/// rods.
fn coriolis_wrong_by(
    hexapod: &Hexapod<Uhp>,
    base: &BaseMotion,
    platform: &PlatformState,
    acceleration: &Acceleration,
    difference: fn(&Vector3<f64>, &Vector3<f64>) -> Vector3<f64>,
) -> Result<Vector6<f64>, Error> {
    let p = &hexapod.model.parameters;
    let legs = hexapod.leg_kinematics(base, platform, acceleration)?;
    let partial = hexapod.partial_velocities(base, platform)?;
    let mut error = Vector6::zeros();
    for i in 0..6 {
        let a = base.pose.rotation * Vector3::from(p.actuator_axis[i]);
        let rate = 2.0 * legs.actuator_velocity_m_s[i];
        let difference = difference(&base.velocity.angular_rad_s, &a) * rate;
        let hooke = p.rod_mass[i] * (1.0 - p.rod_com_fraction[i]);
        error += partial.mover_partial_velocity[i].transpose() * difference * p.mover_mass[i];
        error += partial.rod_partial_velocity[i].transpose() * difference * hooke;
    }
    Ok(error)
}

/// Neither C_p v_p nor C_b v_b.
fn no_quadratic_terms(
    hexapod: &Hexapod<Uhp>,
    base: &BaseMotion,
    platform: &PlatformState,
    _: &Acceleration,
) -> Result<Vector6<f64>, Error> {
    let terms = hexapod.equation_of_motion(base, platform)?;
    let platform_part = terms.coriolis_matrix_p * platform.velocity.to_vector();
    Ok(terms.coriolis_matrix_b * base.velocity.to_vector() - platform_part)
}

fn caught(what: &str, error: f64) {
    println!("{what}: {error:.1e}");
    assert!(error > MARGIN * BOUND, "{what}: the large experiment sees only {error:.1e}");
}

#[test]
fn the_right_model() {
    let large = scenario("large");
    let error = with_parameters(&large, |_| ());
    println!("right: {error:.1e}");
    assert!(error < 1e-7, "{error:e}");
}

#[test]
fn coriolis_term_as_printed() {
    caught("2 d' a instead of 2 d' (w_b x a)", wrong(&scenario("large"), coriolis_as_printed));
}

#[test]
fn coriolis_term_left_out() {
    caught("no 2 d' (w_b x a)", wrong(&scenario("large"), no_coriolis));
}

#[test]
fn quadratic_terms_left_out() {
    caught("no quadratic terms", wrong(&scenario("large"), no_quadratic_terms));
}

#[test]
fn rod_mass_five_percent_low() {
    let change = |platform: &mut Platform| {
        let rod_mass = platform.parameters.get_mut("rod_mass").expect("legs have rods");
        rod_mass.iter_mut().for_each(|m| *m *= 0.95);
    };
    caught("m_s - 5 %", with_parameters(&scenario("large"), change));
}

#[test]
fn payload_inertia_ten_percent_high() {
    let change = |platform: &mut Platform| {
        platform.parameters.payload_inertia =
            platform.parameters.payload_inertia.map(|row| row.map(|x| 1.1 * x));
    };
    caught("I_c + 10 %", with_parameters(&scenario("large"), change));
}

/// Why there is a large experiment.
#[test]
fn the_published_experiment_does_not_see_velocity_terms() {
    let error = wrong(&scenario("published"), no_quadratic_terms);
    println!("published experiment without quadratic terms: {error:.1e}");
    assert!(error < BOUND, "{error:e}");
}
