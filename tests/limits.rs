//! Limits of a platform file are in its generated model, so that monitors and current controllers need no number twice.

use dyn_platform::Platform;
use dyn_runtime::current::VoiceCoils;
use dyn_runtime::models::Uhp2016;
use dyn_runtime::{Acceleration, BaseMotion, Hexapod, Limits, PlatformState, Pose, Real, kernels};
use dyn_tests::compiled::baked::everything::Everything;
use dyn_tests::compiled::baked::limited::Limited;
use dyn_tests::compiled::baked::ups_everything::UpsEverything;
use nalgebra::{Matrix3, Vector3};

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

/// Models of any number type take the limits that they are asked for.
#[test]
fn a_monitor_takes_them_as_they_are() {
    fn stands<T: Real>(limits: &Limits<T>) -> bool {
        limits.maximum_force_n.iter().all(|force| *force > T::zero())
    }
    assert!(stands(&Limited::limits::<f64>()) && stands(&Limited::limits::<f32>()));
}
