//! The committed models: checked against raw calls, the borders of the workspace, and any input whatever.

use std::array;
use std::f64::consts::{PI, TAU};

use dyn_runtime::kernels::{self, InverseDynamics as _};
use dyn_runtime::models::{Parameters, Uhp, Uhp2016};
use dyn_runtime::nalgebra::{Matrix3, Matrix6, Rotation3, Vector3, Vector6};
use dyn_runtime::{
    Acceleration, BaseMotion, Error, Hexapod, MIN_RECIPROCAL_CONDITION, MIN_ROD_ALIGNMENT, PlatformState,
    Pose, Twist, Wrench, jacobian_reciprocal_condition,
};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

/// Platform relative to base.
fn home() -> Pose {
    Pose::from_paper_angles(Vector3::new(0.0, 0.0, 0.382), [0.0; 3])
}

fn still_base() -> BaseMotion {
    BaseMotion::at_rest(Pose::identity())
}

fn vector(random: &mut Pcg64, size: f64) -> Vector3<f64> {
    Vector3::from_fn(|_, _| random.random_range(-size..=size))
}

fn random_pose(random: &mut Pcg64, metres: f64, radians: f64) -> Pose {
    let position = vector(random, metres);
    Pose::from_paper_angles(position, vector(random, radians).into())
}

fn random_base(random: &mut Pcg64) -> BaseMotion {
    BaseMotion {
        pose: random_pose(random, 1.0, 1.2),
        velocity: Twist { linear_m_s: vector(random, 2.0), angular_rad_s: vector(random, 2.0) },
        acceleration: random_acceleration(random),
    }
}

/// Near home on that base.
fn random_platform(random: &mut Pcg64, base: &BaseMotion) -> PlatformState {
    let displacement = random_pose(random, 0.02, 0.1);
    PlatformState {
        pose: base.pose.compose(&home()).compose(&displacement),
        velocity: Twist { linear_m_s: vector(random, 2.0), angular_rad_s: vector(random, 2.0) },
    }
}

fn random_acceleration(random: &mut Pcg64) -> Acceleration {
    Acceleration { linear_m_s2: vector(random, 20.0), angular_rad_s2: vector(random, 20.0) }
}

fn random_wrench(random: &mut Pcg64) -> Wrench {
    Wrench { force_n: vector(random, 50.0), moment_n_m: vector(random, 5.0) }
}

fn rows(rotation: &Rotation3<f64>) -> [[f64; 3]; 3] {
    array::from_fn(|r| array::from_fn(|c| rotation[(r, c)]))
}

fn six(vector: Vector6<f64>) -> [f64; 6] {
    vector.into()
}

/// The unchecked call with the same arguments.
fn raw_inverse_dynamics(
    base: &BaseMotion,
    platform: &PlatformState,
    platform_acceleration: &Acceleration,
    external_wrench: &Wrench,
) -> [f64; 6] {
    let mut forces = [0.0; 6];
    Uhp2016.inverse_dynamics(
        &base.pose.position_m.into(),
        &rows(&base.pose.rotation),
        &six(base.velocity.to_vector()),
        &six(base.acceleration.to_vector()),
        &platform.pose.position_m.into(),
        &rows(&platform.pose.rotation),
        &six(platform.velocity.to_vector()),
        &six(platform_acceleration.to_vector()),
        &six(external_wrench.to_vector()),
        &mut forces,
    );
    forces
}

/// Table 1 for the run-time model, with the layout of the platform file.
fn table_1() -> Parameters {
    let joint = |radius: f64, pair_angle: f64, leg: usize| {
        let side = if leg.is_multiple_of(2) { -0.5 } else { 0.5 };
        let angle = TAU / 3.0 * (leg / 2) as f64 + side * pair_angle;
        [radius * angle.cos(), radius * angle.sin(), 0.0]
    };
    let joints =
        |radius, pair_angle| (0..6).flat_map(|leg| joint(radius, pair_angle, leg)).collect::<Vec<f64>>();
    Parameters::from_fn(|name, values| match name {
        "base_point" => values.copy_from_slice(&joints(0.180, 86.0 / 180.0 * PI)),
        "platform_point" => values.copy_from_slice(&joints(0.120, PI / 6.0)),
        "actuator_axis" => values.copy_from_slice([[0.0, 0.0, 1.0]; 6].as_flattened()),
        "rod_length" => values.fill(0.206),
        "rod_mass" => values.fill(1.024),
        "rod_inertia" => values.fill(1.024 * 0.206 * 0.206 / 12.0),
        "rod_com_fraction" => values.fill(0.5),
        "mover_mass" => values.fill(0.611),
        "mover_offset" => values.fill(0.05),
        "rest_length" => values.fill(0.198),
        "axial_stiffness" => values.fill(21_555.9),
        "axial_damping" => values.fill(0.0),
        "payload_mass" => values.fill(6.092),
        "payload_com" => values.copy_from_slice(&[0.0, 0.0, 0.031]),
        "payload_inertia" => values.copy_from_slice(&[0.025, 0.0, 0.0, 0.0, 0.025, 0.0, 0.0, 0.0, 0.035]),
        "gravity" => values.copy_from_slice(&[0.0, 0.0, -9.81]),
        _ => panic!("unknown parameter {name}"),
    })
}

#[test]
fn checked_and_raw_calls_give_the_same_bits() {
    let mut random = Pcg64::seed_from_u64(10);
    for _ in 0..500 {
        let base = random_base(&mut random);
        let platform = random_platform(&mut random, &base);
        let acceleration = random_acceleration(&mut random);
        let wrench = random_wrench(&mut random);
        let checked = Hexapod::new(Uhp2016)
            .inverse_dynamics(&base, &platform, &acceleration, &wrench)
            .expect("in the workspace");
        assert_eq!(six(checked), raw_inverse_dynamics(&base, &platform, &acceleration, &wrench));
    }
}

/// Written once, for any model.
fn forces_and_acceleration<M>(
    hexapod: &Hexapod<M>,
    base: &BaseMotion,
    platform: &PlatformState,
    acceleration: &Acceleration,
    wrench: &Wrench,
) -> Result<(Vector6<f64>, Acceleration), Error>
where
    M: kernels::RodAlignment
        + kernels::ActuatorGeometry
        + kernels::InverseDynamics
        + kernels::ForwardDynamics,
{
    let forces = hexapod.inverse_dynamics(base, platform, acceleration, wrench)?;
    Ok((forces, hexapod.forward_dynamics(base, platform, &forces, wrench)?))
}

#[test]
fn both_models_stand_behind_one_interface() {
    let baked = Hexapod::new(Uhp2016);
    let at_run_time = Hexapod::new(Uhp { parameters: table_1() });
    let mut random = Pcg64::seed_from_u64(11);
    for _ in 0..200 {
        let base = random_base(&mut random);
        let platform = random_platform(&mut random, &base);
        let acceleration = random_acceleration(&mut random);
        let wrench = random_wrench(&mut random);
        let (forces, back) = forces_and_acceleration(&baked, &base, &platform, &acceleration, &wrench)
            .expect("in the workspace");
        let (other_forces, other_back) =
            forces_and_acceleration(&at_run_time, &base, &platform, &acceleration, &wrench)
                .expect("likewise");
        assert!((forces - other_forces).amax() <= 1e-11 * forces.amax());
        for back in [back, other_back] {
            assert!(
                (back.to_vector() - acceleration.to_vector()).amax()
                    < 1e-11 * acceleration.to_vector().amax()
            );
        }
    }
}

/// The same operations; multiply-adds of the preparation may be rounded otherwise.
#[test]
fn a_prepared_model_is_the_model() {
    let model = Uhp { parameters: table_1() };
    let (prepared, model) = (Hexapod::new(model.prepared()), Hexapod::new(model));
    let mut random = Pcg64::seed_from_u64(12);
    for _ in 0..200 {
        let base = random_base(&mut random);
        let platform = random_platform(&mut random, &base);
        let acceleration = random_acceleration(&mut random);
        let wrench = random_wrench(&mut random);
        let call = |forces: Vector6<f64>, other: Vector6<f64>| {
            assert!((forces - other).amax() <= 1e-11 * forces.amax(), "{forces} and {other}");
        };
        let (forces, back) =
            forces_and_acceleration(&model, &base, &platform, &acceleration, &wrench).unwrap();
        let (same, same_back) =
            forces_and_acceleration(&prepared, &base, &platform, &acceleration, &wrench).unwrap();
        call(forces, same);
        call(back.to_vector(), same_back.to_vector());
        let masses = model.mass_matrix_p(&base, &platform).unwrap();
        assert_eq!(masses, prepared.mass_matrix_p(&base, &platform).unwrap());
        let near =
            |a: Matrix6<f64>, b: Matrix6<f64>| assert!((a - b).amax() <= 1e-11 * a.amax(), "{a} and {b}");
        let (one, other) = (
            model.control(&base, &platform, &acceleration, &wrench).unwrap(),
            prepared.control(&base, &platform, &acceleration, &wrench).unwrap(),
        );
        near(one.jacobian_dp, other.jacobian_dp);
        near(one.mass_matrix_p, other.mass_matrix_p);
        call(one.total_bias, other.total_bias);
        call(one.actuator_length_m, other.actuator_length_m);
        call(one.inverse_dynamics_n, other.inverse_dynamics_n);
        let (one, other) =
            (model.matrices(&base, &platform).unwrap(), prepared.matrices(&base, &platform).unwrap());
        near(one.coriolis_matrix_p, other.coriolis_matrix_p);
        near(one.coriolis_matrix_b, other.coriolis_matrix_b);
        near(one.mass_matrix_b, other.mass_matrix_b);
        near(one.jacobian_db, other.jacobian_db);
    }
    assert_eq!(prepared.model.model(), &Uhp { parameters: table_1() });
}

/// A name that the caller of `from_fn` forgets, or fills with what is no number.
#[test]
fn forgotten_geometry_is_not_called_out_of_reach() {
    let forces = |parameters| {
        Hexapod::new(Uhp { parameters }).inverse_dynamics(
            &still_base(),
            &PlatformState::at_rest(home()),
            &Acceleration::zero(),
            &Wrench::zero(),
        )
    };
    assert!(forces(table_1()).is_ok());
    let no_length = Parameters { rod_length: [0.0; 6], ..table_1() };
    assert_eq!(forces(no_length), Err(Error::InvalidModel { leg: 0 }));
    let mut no_axis = table_1();
    no_axis.actuator_axis[3] = [f64::NAN; 3];
    assert_eq!(forces(no_axis), Err(Error::InvalidModel { leg: 3 }));
    let mut no_joint = table_1();
    no_joint.platform_point[5][1] = f64::INFINITY;
    assert_eq!(forces(no_joint), Err(Error::InvalidModel { leg: 5 }));
    assert_eq!(forces(Parameters { payload_mass: f64::NAN, ..table_1() }), Err(Error::NonFiniteResult));
}

/// Sideways along x until a rod lies flat, and on.
#[test]
fn the_border_of_reach() {
    let hexapod = Hexapod::new(Uhp2016);
    let at = |x: f64| {
        let displacement = Pose::from_paper_angles(Vector3::new(x, 0.0, 0.0), [0.0; 3]);
        PlatformState::at_rest(home().compose(&displacement))
    };
    let least_alignment = |x| {
        hexapod.rod_alignment(&still_base(), &at(x)).expect("finite").into_iter().copied().fold(1.0, f64::min)
    };
    let call = |x| hexapod.inverse_dynamics(&still_base(), &at(x), &Acceleration::zero(), &Wrench::zero());

    let (mut inside, mut outside) = (0.0, 0.2);
    for _ in 0..60 {
        let middle = 0.5 * (inside + outside);
        *(if least_alignment(middle) < 0.0 { &mut outside } else { &mut inside }) = middle;
    }
    assert!((inside - 0.1161817).abs() < 1e-7);
    // Legs 4 and 5 (indices 3 and 4) stand in mirror image: rounding decides which is named.
    assert!(matches!(call(outside + 1e-9), Err(Error::OutOfReach { leg: 3 | 4 })));
    assert!(matches!(call(inside - 1e-7), Err(Error::RodPerpendicular { leg: 3 | 4 })));
    let near = inside - 1e-3;
    assert!(least_alignment(near) > MIN_ROD_ALIGNMENT);
    assert!(call(near).is_ok());
    // What the unchecked call gives out there.
    let raw = raw_inverse_dynamics(&still_base(), &at(0.15), &Acceleration::zero(), &Wrench::zero());
    assert!(raw.iter().all(|force| force.is_nan()), "{raw:?}");
}

/// Tilting about y leads through a singular pose at about 1.1 rad, all legs in reach.
#[test]
fn a_singular_pose() {
    let hexapod = Hexapod::new(Uhp2016);
    let at = |tilt: f64| PlatformState::at_rest(Pose::from_paper_angles(home().position_m, [0.0, tilt, 0.0]));
    let jacobian = |tilt: f64| hexapod.jacobian_dp(&still_base(), &at(tilt)).expect("in reach");
    let call =
        |tilt| hexapod.inverse_dynamics(&still_base(), &at(tilt), &Acceleration::zero(), &Wrench::zero());

    let (mut before, mut after) = (1.0, 1.2);
    assert!(jacobian(before).determinant() * jacobian(after).determinant() < 0.0);
    for _ in 0..60 {
        let middle = 0.5 * (before + after);
        let passed = jacobian(middle).determinant() * jacobian(after).determinant() > 0.0;
        *(if passed { &mut after } else { &mut before }) = middle;
    }
    let Err(Error::SingularJacobian { reciprocal_condition }) = call(before) else { panic!("singular") };
    assert!(reciprocal_condition < 1e-12, "{reciprocal_condition:e}");
    // The condition falls in proportion to the distance; home is far away.
    for distance in [1e-4, 1e-3, 1e-2] {
        assert!(call(before - distance).is_ok() && call(before + distance).is_ok(), "{distance}");
    }
    assert!(matches!(call(before + 1e-7), Err(Error::SingularJacobian { .. })));
    let home_rows: [[f64; 6]; 6] = jacobian(0.0).transpose().into();
    assert!(jacobian_reciprocal_condition(&home_rows) > 1e4 * MIN_RECIPROCAL_CONDITION);
    // Forward dynamics does not mind.
    let forces = Vector6::repeat(30.0);
    assert!(hexapod.forward_dynamics(&still_base(), &at(before), &forces, &Wrench::zero()).is_ok());
}

/// Inputs from nowhere: whatever comes, no panic, and no number that is not finite.
#[test]
fn any_input_gets_a_finite_answer_or_an_error() {
    let hexapod = Hexapod::new(Uhp2016);
    let mut random = Pcg64::seed_from_u64(12);
    let mut answered = 0;
    let mut refused = 0;
    for _ in 0..20_000 {
        let mut base = random_base(&mut random);
        let mut platform = random_platform(&mut random, &base);
        let mut acceleration = random_acceleration(&mut random);
        let mut wrench = random_wrench(&mut random);
        let numbers: [&mut f64; 8] = [
            &mut base.pose.position_m.x,
            &mut base.velocity.linear_m_s.y,
            &mut base.acceleration.angular_rad_s2.z,
            &mut platform.pose.position_m.z,
            &mut platform.velocity.angular_rad_s.x,
            &mut acceleration.linear_m_s2.y,
            &mut wrench.force_n.z,
            &mut wrench.moment_n_m.x,
        ];
        for number in numbers {
            match random.random_range(0..40) {
                0 => *number = f64::from_bits(random.random()),
                1 => *number *= 10_f64.powi(random.random_range(-300..300)),
                _ => {}
            }
        }
        if random.random_range(0..20) == 0 {
            let matrix = Matrix3::from_fn(|_, _| random.random_range(-2.0..2.0));
            platform.pose.rotation = Rotation3::from_matrix_unchecked(matrix);
        }
        match forces_and_acceleration(&hexapod, &base, &platform, &acceleration, &wrench) {
            Ok((forces, back)) => {
                answered += 1;
                assert!(forces.iter().chain(&back.to_vector()).all(|number| number.is_finite()));
            }
            Err(error) => {
                refused += 1;
                assert!(!error.to_string().is_empty());
            }
        }
    }
    assert!(answered > 4_000 && refused > 2_000, "{answered} answered, {refused} refused");
}
