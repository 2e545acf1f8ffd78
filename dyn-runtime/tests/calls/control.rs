//! The control bundle, reference speeds, the base's wrench, monitors and currents.

use dyn_runtime::current::VoiceCoils;
use dyn_runtime::models::Uhp2016;
use dyn_runtime::nalgebra::{Vector3, Vector6};
use dyn_runtime::{
    Acceleration, BaseMotion, Error, Hexapod, Limits, PlatformState, Pose, Quantity, Twist, Wrench,
    jacobian_condition_bound, jacobian_reciprocal_condition,
};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

struct Motion {
    base: BaseMotion,
    platform: PlatformState,
    acceleration: Acceleration,
    wrench: Wrench,
    reference: Twist,
}

fn motion(random: &mut Pcg64) -> Motion {
    let mut vector = |size: f64| Vector3::from_fn(|_, _| random.random_range(-size..size));
    let base = Pose::from_paper_angles(vector(0.5), vector(1.0).into());
    let mut relative = Pose::from_paper_angles(vector(0.02), vector(0.05).into());
    relative.position_m.z += 0.382;
    let mut twist = || Twist { linear_m_s: vector(1.0), angular_rad_s: vector(2.0) };
    let (base_velocity, velocity, reference) = (twist(), twist(), twist());
    let mut acceleration = || Acceleration { linear_m_s2: vector(5.0), angular_rad_s2: vector(20.0) };
    let (base_acceleration, acceleration) = (acceleration(), acceleration());
    Motion {
        base: BaseMotion { pose: base, velocity: base_velocity, acceleration: base_acceleration },
        platform: PlatformState { pose: base.compose(&relative), velocity },
        acceleration,
        wrench: Wrench { force_n: vector(20.0), moment_n_m: vector(2.0) },
        reference,
    }
}

fn near(one: f64, scale: f64, relative: f64) {
    assert!(one <= relative * scale, "{:e} of {scale:e}", one / scale);
}

#[test]
fn the_bundle_is_its_parts() {
    let (hexapod, mut random) = (Hexapod::new(Uhp2016), Pcg64::seed_from_u64(1));
    for _ in 0..200 {
        let Motion { base, platform, acceleration, wrench, .. } = motion(&mut random);
        let bundle = hexapod.control(&base, &platform, &acceleration, &wrench).unwrap();
        let legs = hexapod.leg_kinematics(&base, &platform, &acceleration).unwrap();
        assert!((bundle.actuator_length_m - legs.actuator_length_m).amax() < 1e-15);
        assert!((bundle.actuator_velocity_m_s - legs.actuator_velocity_m_s).amax() < 1e-14);
        let jacobian = hexapod.jacobian_dp(&base, &platform).unwrap();
        near((bundle.jacobian_dp - jacobian).amax(), jacobian.amax(), 1e-14);
        let mass = hexapod.mass_matrix_p(&base, &platform).unwrap();
        near((bundle.mass_matrix_p - mass).amax(), mass.amax(), 1e-14);
        let total = hexapod.bias(&base, &platform).unwrap()
            - hexapod.mass_matrix_b(&base, &platform).unwrap() * base.acceleration.to_vector();
        near((bundle.total_bias - total).amax(), total.amax(), 1e-12);
        let forces = hexapod.inverse_dynamics(&base, &platform, &acceleration, &wrench).unwrap();
        near((bundle.inverse_dynamics_n - forces).amax(), forces.amax(), 1e-11);
    }
}

/// J_dp^T (F - F at v_r = v_p) is C_p (v_r - v_p), and at the platform's own velocity nothing is left.
#[test]
fn reference_speeds_enter_through_the_natural_factorisation() {
    let (hexapod, mut random) = (Hexapod::new(Uhp2016), Pcg64::seed_from_u64(2));
    for _ in 0..200 {
        let Motion { base, platform, acceleration, wrench, reference } = motion(&mut random);
        let at = |v: &Twist| {
            hexapod.passive_inverse_dynamics(&base, &platform, v, &acceleration, &wrench).unwrap()
        };
        let own = hexapod.inverse_dynamics(&base, &platform, &acceleration, &wrench).unwrap();
        near((at(&platform.velocity) - own).amax(), own.amax(), 1e-12);
        let matrices = hexapod.matrices(&base, &platform).unwrap();
        let error = reference.to_vector() - platform.velocity.to_vector();
        let expected = matrices.coriolis_matrix_p * error;
        let found = matrices.jacobian_dp.transpose() * (at(&reference) - own);
        near((found - expected).amax(), expected.amax(), 1e-9);
    }
}

#[test]
fn the_condition_bound_is_a_bound_and_not_a_bad_one() {
    let (hexapod, mut random) = (Hexapod::new(Uhp2016), Pcg64::seed_from_u64(3));
    for _ in 0..500 {
        let Motion { base, platform, .. } = motion(&mut random);
        let rows = hexapod.jacobian_dp(&base, &platform).unwrap().transpose().into();
        let (bound, exact) = (jacobian_condition_bound(&rows), jacobian_reciprocal_condition(&rows));
        assert!(bound <= exact && bound > 0.2 * exact, "{bound} of {exact}");
    }
    // Any matrix, nearly singular ones among them.
    for k in 0..20_000 {
        let mut rows: [[f64; 6]; 6] =
            std::array::from_fn(|_| std::array::from_fn(|_| random.random_range(-1.0..1.0)));
        let share = 10.0_f64.powi(-(k % 12));
        rows[5] = std::array::from_fn(|c| rows[0][c] + share * rows[5][c]);
        let (bound, exact) = (jacobian_condition_bound(&rows), jacobian_reciprocal_condition(&rows));
        assert!(bound <= exact * (1.0 + 1e-9) || bound < 1e-15, "{bound:e} of {exact:e}");
    }
}

#[test]
fn monitors_name_the_leg_and_its_margin() {
    let hexapod = Hexapod::new(Uhp2016);
    let base = BaseMotion::at_rest(Pose::identity());
    let home = Pose::from_paper_angles(Vector3::new(0.0, 0.0, 0.382), [0.0; 3]);
    let velocity = Twist { linear_m_s: Vector3::new(0.0, 0.0, 0.2), ..Twist::zero() };
    let platform = PlatformState { pose: home, velocity };
    let legs = hexapod.leg_kinematics(&base, &platform, &Acceleration::zero()).unwrap();
    let directions = legs.rod_direction.map(Into::into);
    let forces = Vector6::new(1.0, -9.0, 3.0, 2.0, 0.0, 5.0);
    let mut limits = Limits {
        minimum_length_m: [0.19; 6],
        maximum_length_m: [0.21; 6],
        maximum_velocity_m_s: [0.3; 6],
        maximum_force_n: [10.0; 6],
        maximum_hooke_joint_angle_rad: [0.1; 6],
        maximum_platform_joint_angle_rad: [0.1; 6],
        home_direction_in_base: directions,
        home_direction_in_platform: directions,
        minimum_condition_bound: 1e-3,
    };
    let monitor = hexapod.monitor(&base, &platform, &forces, &limits).unwrap();
    assert_eq!(monitor.check(), Ok(()));
    let margin = |quantity| monitor.margins[quantity as usize];
    assert!((margin(Quantity::ActuatorLength).margin - 0.00821).abs() < 1e-5);
    assert!((margin(Quantity::ActuatorVelocity).margin - 0.1).abs() < 1e-12);
    assert_eq!(margin(Quantity::ActuatorForce).leg, Some(1));
    assert_eq!(margin(Quantity::ActuatorForce).margin, 1.0);
    assert!((margin(Quantity::HookeJointAngle).margin - 0.1).abs() < 1e-7);
    assert!((margin(Quantity::PlatformJointAngle).margin - 0.1).abs() < 1e-7);
    assert_eq!(margin(Quantity::Conditioning).leg, None);

    // The platform tilts against the rods by as much as the angle says.
    let tilted = PlatformState::at_rest(Pose::from_paper_angles(home.position_m, [0.0, 0.0, 0.05]));
    let monitor = hexapod.monitor(&base, &tilted, &Vector6::zeros(), &limits).unwrap();
    let angle = 0.1 - monitor.margins[Quantity::PlatformJointAngle as usize].margin;
    assert!((0.01..0.1).contains(&angle), "{angle}");

    limits.maximum_force_n = [8.0; 6];
    let refused = hexapod.monitor(&base, &platform, &forces, &limits).unwrap().check().unwrap_err();
    assert_eq!(refused, Error::BeyondLimit { quantity: Quantity::ActuatorForce, leg: Some(1), margin: -1.0 });
    assert!(
        refused.to_string().starts_with("leg 2 (index 1): actuator force is beyond its limit by 1.000e0 N")
    );
}

#[test]
fn saturated_currents_keep_the_direction_of_the_forces() {
    let mut random = Pcg64::seed_from_u64(5);
    for _ in 0..1000 {
        let mut any = |low: f64, high: f64| std::array::from_fn(|_| random.random_range(low..high));
        let coils = VoiceCoils { force_constant_n_per_a: any(5.0, 40.0), maximum_current_a: any(0.5, 3.0) };
        let wanted = Vector6::from(any(-100.0, 100.0));
        let currents = coils.currents(&wanted).unwrap();
        for leg in 0..6 {
            assert!(currents.current_a[leg].abs() <= coils.maximum_current_a[leg]);
            let force = currents.current_a[leg] * coils.force_constant_n_per_a[leg];
            assert!((force - currents.actuator_force_n[leg]).abs() < 1e-13);
        }
        match currents.saturation {
            None => assert_eq!(currents.actuator_force_n, wanted),
            Some(saturation) => {
                assert!(saturation.factor < 1.0);
                // One coil stands at its limit, up to which its force is cut, by rounding alone.
                let scaled = wanted * saturation.factor;
                let cut = |leg: usize| coils.force_constant_n_per_a[leg] * coils.maximum_current_a[leg];
                for leg in 0..6 {
                    let force = scaled[leg].clamp(-cut(leg), cut(leg));
                    assert_eq!(currents.actuator_force_n[leg], force);
                    assert!((force - scaled[leg]).abs() <= f64::EPSILON * force.abs());
                }
                let (found, limit) =
                    (currents.current_a[saturation.leg], coils.maximum_current_a[saturation.leg]);
                assert!((found.abs() - limit).abs() < 1e-15);
            }
        }
    }
}

#[test]
fn impossible_coils_and_currents_are_refused() {
    let coils = VoiceCoils { force_constant_n_per_a: [20.0; 6], maximum_current_a: [2.0; 6] };
    let forces = Vector6::repeat(10.0);
    let mut broken = coils;
    broken.force_constant_n_per_a[3] = 0.0;
    assert_eq!(broken.currents(&forces), Err(Error::InvalidCoil { leg: 3 }));
    let mut broken = coils;
    broken.maximum_current_a[1] = -1.0;
    assert_eq!(broken.currents(&forces), Err(Error::InvalidCoil { leg: 1 }));
    assert!(matches!(coils.currents(&Vector6::repeat(f64::NAN)), Err(Error::NonFinite { .. })));
    let off = VoiceCoils { maximum_current_a: [0.0; 6], ..coils };
    assert_eq!(off.currents(&forces).unwrap().current_a, Vector6::zeros());
    assert_eq!(off.currents(&Vector6::zeros()).unwrap().saturation, None);
    let unlimited = VoiceCoils { maximum_current_a: [f64::INFINITY; 6], force_constant_n_per_a: [1e-300; 6] };
    assert_eq!(unlimited.currents(&Vector6::repeat(1e300)), Err(Error::NonFiniteResult));
}
