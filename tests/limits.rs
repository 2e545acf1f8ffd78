//! Limits of a platform file are in its generated model, so that monitors and current controllers need no number twice.

use dyn_platform::Platform;
use dyn_runtime::current::VoiceCoils;
use dyn_runtime::models::Uhp2016;
use dyn_runtime::{
    Acceleration, BaseMotion, Error, Hexapod, Limits, PlatformState, Pose, Quantity, Real, kernels,
};
use dyn_tests::compiled::baked::everything::Everything;
use dyn_tests::compiled::baked::limited::Limited;
use dyn_tests::compiled::baked::ups_everything::UpsEverything;
use nalgebra::{Matrix3, Vector3, Vector6};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

#[test]
fn every_limit_of_a_platform_file_is_in_its_model() {
    let infinite = f64::INFINITY;
    let expected = Limits {
        minimum_length_m: [0.18; 6],
        maximum_length_m: [infinite, infinite, 0.215, infinite, infinite, infinite],
        maximum_force_n: [100.0, 100.0, 80.0, 100.0, 100.0, 100.0],
        maximum_hooke_joint_angle_rad: [0.3; 6],
        ..Uhp2016::limits()
    };
    assert_eq!(Limited::limits(), expected);
    let coils: VoiceCoils = Limited::voice_coils();
    assert_eq!(coils.force_constant_n_per_a, [40.0; 6]);
    assert_eq!(coils.maximum_current_a, [2.5, 2.5, 2.0, 2.5, 2.5, 2.5]);
}

#[test]
fn without_limits_nothing_is_limited() {
    let limits: Limits = Uhp2016::limits();
    let Limits { home_direction_in_base, home_direction_in_platform, .. } = limits;
    assert_eq!(limits, Limits { home_direction_in_base, home_direction_in_platform, ..Limits::none() });
}

#[test]
fn limits_are_there_in_single_precision() {
    let limits: Limits<f32> = Limited::limits();
    assert_eq!(limits.minimum_length_m, [0.18_f32; 6]);
    assert_eq!(limits.maximum_velocity_m_s, [f32::INFINITY; 6]);
}

/// The directions at home against the model's own legs there.
fn directions<M: kernels::RodAlignment + kernels::LegKinematics>(model: M, file: &str, limits: Limits) {
    let path = format!("{}/{file}", env!("CARGO_MANIFEST_DIR"));
    let platform = Platform::from_file(path).expect("a platform");
    let rows = platform.home.rotation;
    let rotation = Matrix3::from_fn(|row, column| rows[row][column]);
    let home = Pose::from_rotation_matrix(platform.home.position.into(), &rotation).expect("a rotation");
    let state = PlatformState::at_rest(home);
    let base = BaseMotion::at_rest(Pose::identity());
    let legs = Hexapod::new(model).leg_kinematics(&base, &state, &Acceleration::zero()).expect("home");
    for (leg, u) in legs.rod_direction.iter().enumerate() {
        let near = |found: [f64; 3], expected: Vector3<f64>| {
            assert!((Vector3::from(found) - expected).amax() < 1e-14, "{file}, leg {leg}: {found:?}");
        };
        near(limits.home_direction_in_base[leg], *u);
        near(limits.home_direction_in_platform[leg], rotation.transpose() * u);
    }
}

#[test]
fn rods_at_home_have_their_directions() {
    directions(Uhp2016, "../platforms/uhp_2016.toml", Uhp2016::limits());
    directions(Everything, "platforms/everything.toml", Everything::limits());
    directions(UpsEverything, "platforms/ups_everything.toml", UpsEverything::limits());
}

/// The forces that saturated coils make are not beyond the forces that their currents are limited by, not by rounding either.
fn saturated_forces_are_within_limits<T: Real>(limits: Limits<T>, coils: VoiceCoils<T>) {
    let mut random = Pcg64::seed_from_u64(23);
    let mut saturated = 0;
    for _ in 0..2000 {
        let wanted = Vector6::from_fn(|_, _| T::constant(random.random_range(-500.0..500.0)));
        let currents = coils.currents(&wanted).expect("coils");
        saturated += usize::from(currents.saturation.is_some());
        for leg in 0..6 {
            let force = currents.actuator_force_n[leg];
            assert!(force.abs() <= limits.maximum_force_n[leg], "leg {leg}: {force:?}");
            assert!(currents.current_a[leg].abs() <= coils.maximum_current_a[leg]);
        }
    }
    assert!(saturated > 1500);
}

#[test]
fn saturation_is_no_violation_of_limits() {
    saturated_forces_are_within_limits::<f64>(Limited::limits(), Limited::voice_coils());
    saturated_forces_are_within_limits::<f32>(Limited::limits(), Limited::voice_coils());
    // Numbers whose products are rounded.
    let mut random = Pcg64::seed_from_u64(24);
    for _ in 0..200 {
        let coils = VoiceCoils {
            force_constant_n_per_a: std::array::from_fn(|_| random.random_range(10.0..40.0)),
            maximum_current_a: std::array::from_fn(|_| random.random_range(1.0..9.0)),
        };
        let product = |leg: usize| coils.force_constant_n_per_a[leg] * coils.maximum_current_a[leg];
        let limits = Limits { maximum_force_n: std::array::from_fn(product), ..Limits::none() };
        saturated_forces_are_within_limits(limits, coils);
    }
}

/// Home of the default platform: what a monitor says of limits that are none.
#[test]
fn limits_that_are_none_are_refused() {
    let home = Pose::from_paper_angles(Vector3::new(0.0, 0.0, 0.382), [0.0; 3]);
    let (base, state) = (BaseMotion::at_rest(Pose::identity()), PlatformState::at_rest(home));
    let check =
        |limits: Limits| Hexapod::new(Uhp2016).monitor(&base, &state, &Vector6::zeros(), &limits).map(|_| ());
    let invalid = |quantity, leg| Err(Error::InvalidLimit { quantity, leg });
    let third = |value| [f64::INFINITY, f64::INFINITY, value, 1.0, 1.0, 1.0];
    let (nan, none) = (third(f64::NAN), Limits::none());
    assert_eq!(check(none), Ok(()));
    for (quantity, limits) in [
        (Quantity::ActuatorLength, Limits { minimum_length_m: nan, ..none }),
        (Quantity::ActuatorLength, Limits { maximum_length_m: nan, ..none }),
        (Quantity::ActuatorVelocity, Limits { maximum_velocity_m_s: nan, ..none }),
        (Quantity::ActuatorForce, Limits { maximum_force_n: nan, ..none }),
        (Quantity::HookeJointAngle, Limits { maximum_hooke_joint_angle_rad: nan, ..none }),
        (Quantity::PlatformJointAngle, Limits { maximum_platform_joint_angle_rad: nan, ..none }),
        (
            Quantity::HookeJointAngle,
            Limits {
                maximum_hooke_joint_angle_rad: third(0.1),
                home_direction_in_base: [[0.0; 3]; 6],
                ..none
            },
        ),
        (
            Quantity::PlatformJointAngle,
            Limits {
                maximum_platform_joint_angle_rad: third(0.1),
                home_direction_in_platform: [[f64::NAN; 3]; 6],
                ..none
            },
        ),
    ] {
        assert_eq!(check(limits), invalid(quantity, Some(2)));
    }
    let limits = Limits { minimum_condition_bound: f64::NAN, ..none };
    assert_eq!(check(limits), invalid(Quantity::Conditioning, None));
    // Without a limited angle nobody asks for directions.
    assert_eq!(check(Limits { home_direction_in_base: [[0.0; 3]; 6], ..none }), Ok(()));
}

#[test]
fn conditioning_without_limit_is_within_it() {
    let margin = |limits: &Limits| {
        let home = Pose::from_paper_angles(Vector3::new(0.0, 0.0, 0.382), [0.0; 3]);
        let (base, state) = (BaseMotion::at_rest(Pose::identity()), PlatformState::at_rest(home));
        let monitor = Hexapod::new(Uhp2016).monitor(&base, &state, &Vector6::zeros(), limits).unwrap();
        monitor.margins[Quantity::Conditioning as usize].margin
    };
    assert_eq!(margin(&Limits::none()), f64::INFINITY);
    let bound = margin(&Limits { minimum_condition_bound: 0.0, ..Limits::none() });
    assert!((1e-3..1.0).contains(&bound), "{bound}");
    assert_eq!(margin(&Limits { minimum_condition_bound: 1.0, ..Limits::none() }), bound - 1.0);
}

/// Models of any number type take the limits that they are asked for.
#[test]
fn a_monitor_takes_them_as_they_are() {
    fn stands<T: Real>(limits: &Limits<T>) -> bool {
        limits.maximum_force_n.iter().all(|force| *force > T::zero())
    }
    assert!(stands(&Limited::limits::<f64>()) && stands(&Limited::limits::<f32>()));
}
