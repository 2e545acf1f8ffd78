//! Forward kinematics: back from lengths to poses, and typed failures.

use dyn_runtime::models::Uhp2016;
use dyn_runtime::nalgebra::{Vector3, Vector6};
use dyn_runtime::{Acceleration, BaseMotion, Error, Hexapod, Input, PlatformState, Pose, Twist};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

fn vector(size: f64, random: &mut Pcg64) -> Vector3<f64> {
    Vector3::from_fn(|_, _| random.random_range(-size..size))
}

fn pose(metres: f64, radians: f64, random: &mut Pcg64) -> Pose {
    Pose::from_paper_angles(vector(metres, random), vector(radians, random).into())
}

/// Base and platform, the platform near home.
fn poses(metres: f64, radians: f64, random: &mut Pcg64) -> (Pose, Pose) {
    let base = pose(3.0, 1.0, random);
    let mut relative = pose(metres, radians, random);
    relative.position_m.z += 0.382;
    (base, base.compose(&relative))
}

fn lengths(base: &Pose, platform: &Pose) -> Result<Vector6<f64>, Error> {
    let legs = Hexapod::new(Uhp2016).leg_kinematics(
        &BaseMotion::at_rest(*base),
        &PlatformState::at_rest(*platform),
        &Acceleration::zero(),
    )?;
    Ok(legs.actuator_length_m)
}

fn distance(one: &Pose, other: &Pose) -> f64 {
    let turned = (one.rotation.matrix() - other.rotation.matrix()).amax();
    (one.position_m - other.position_m).amax().max(turned)
}

#[test]
fn warm_start_within_a_millimetre_takes_four_steps_at_most() {
    let mut random = Pcg64::seed_from_u64(1);
    let mut most = 0;
    for _ in 0..5_000 {
        let (base, platform) = poses(0.02, 0.05, &mut random);
        let moved = pose(1e-3, 1e-3, &mut random);
        let start = Pose {
            position_m: platform.position_m + moved.position_m,
            rotation: moved.rotation * platform.rotation,
        };
        let wanted = lengths(&base, &platform).unwrap();
        let found = Hexapod::new(Uhp2016).forward_kinematics(&base, &wanted, &start).unwrap();
        assert!(found.residual_m <= 1e-12);
        assert!(distance(&found.pose, &platform) < 1e-11, "{:e}", distance(&found.pose, &platform));
        most = most.max(found.iterations);
    }
    assert!((2..=4).contains(&most), "{most} steps");
}

#[test]
fn cold_start_at_home_finds_the_workspace() {
    let mut random = Pcg64::seed_from_u64(2);
    for _ in 0..2_000 {
        let (base, platform) = poses(0.02, 0.1, &mut random);
        let home = base.compose(&Pose::from_paper_angles(Vector3::new(0.0, 0.0, 0.382), [0.0; 3]));
        let Ok(wanted) = lengths(&base, &platform) else { continue };
        let found = Hexapod::new(Uhp2016).forward_kinematics(&base, &wanted, &home).unwrap();
        assert!(distance(&found.pose, &platform) < 1e-10);
        assert!(found.iterations <= 8, "{}", found.iterations);
    }
}

#[test]
fn single_precision_finds_its_poses() {
    let hexapod = Hexapod::single_precision(Uhp2016);
    let home = Pose::from_paper_angles(Vector3::new(0.0_f32, 0.0, 0.382), [0.0; 3]);
    let base = Pose::identity();
    for k in 0..100 {
        let at = 0.0002 * k as f32;
        let there = Pose::from_paper_angles(Vector3::new(at, -at, 0.382 + at), [at, 2.0 * at, -at]);
        let legs = hexapod
            .leg_kinematics(&BaseMotion::at_rest(base), &PlatformState::at_rest(there), &Acceleration::zero())
            .unwrap();
        let found = hexapod.forward_kinematics(&base, &legs.actuator_length_m, &home).unwrap();
        assert!((found.pose.position_m - there.position_m).amax() < 1e-5);
    }
}

/// A pose handed on from call to call stays a rotation.
#[test]
fn poses_may_be_passed_on() {
    let mut random = Pcg64::seed_from_u64(3);
    let hexapod = Hexapod::new(Uhp2016);
    let (base, mut start) = poses(1e-3, 1e-3, &mut random);
    for _ in 0..20_000 {
        let platform = Pose { position_m: start.position_m + vector(1e-5, &mut random), ..start };
        let Ok(wanted) = lengths(&base, &platform) else { break };
        start = hexapod.forward_kinematics(&base, &wanted, &start).unwrap().pose;
    }
    let matrix = start.rotation.matrix();
    assert!(
        (matrix.transpose() * matrix).map_with_location(|r, c, x| x - f64::from(u8::from(r == c))).amax()
            < 1e-15
    );
}

#[test]
fn failures_are_typed() {
    let hexapod = Hexapod::new(Uhp2016);
    let base = Pose::identity();
    let home = Pose::from_paper_angles(Vector3::new(0.0, 0.0, 0.382), [0.0; 3]);
    let at_home = lengths(&base, &home).unwrap();
    let from = |lengths: &Vector6<f64>, start: &Pose| hexapod.forward_kinematics(&base, lengths, start);

    let mut nan = at_home;
    nan[2] = f64::NAN;
    assert_eq!(from(&nan, &home).unwrap_err(), Error::NonFinite { input: Input::ActuatorLength, element: 2 });
    let far = Pose { position_m: Vector3::new(1.0, 0.0, 0.382), ..home };
    assert!(matches!(from(&at_home, &far), Err(Error::OutOfReach { .. })));
    // Neighbours half a metre apart: no pose has such lengths.
    let apart = at_home + Vector6::new(0.5, 0.0, 0.0, 0.0, 0.0, 0.0);
    let refused = from(&apart, &home).unwrap_err();
    assert!(matches!(refused, Error::NoConvergence { residual_m, .. } if residual_m > 1e-3), "{refused}");
    let huge = Vector6::repeat(1e300);
    assert!(from(&huge, &home).is_err());
}

#[test]
fn velocity_from_rates_is_the_velocity_that_makes_them() {
    let mut random = Pcg64::seed_from_u64(4);
    let hexapod = Hexapod::new(Uhp2016);
    for _ in 0..200 {
        let (base, platform) = poses(0.02, 0.05, &mut random);
        let mut twist =
            || Twist { linear_m_s: vector(1.0, &mut random), angular_rad_s: vector(1.0, &mut random) };
        let base = BaseMotion { velocity: twist(), ..BaseMotion::at_rest(base) };
        let state = PlatformState { pose: platform, velocity: twist() };
        let legs = hexapod.leg_kinematics(&base, &state, &Acceleration::zero()).unwrap();
        let found = hexapod.platform_velocity(&base, &platform, &legs.actuator_velocity_m_s).unwrap();
        assert!((found.to_vector() - state.velocity.to_vector()).amax() < 1e-11);
    }
}
