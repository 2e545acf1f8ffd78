//! What calls cost on this machine, next to inverse dynamics alone: median of five runs, ns per call.
//!
//! Like with like: `unchecked` is the model's own method on plain arrays, `checked` the call of `Hexapod`. Both ratios are given, to
//! inverse dynamics unchecked and checked. Calls follow each other without waiting for results, but forward kinematics has no
//! unchecked form, and so long a chain of steps that no two of its calls overlap.
//!
//!     cargo run --release -p dyn-runtime --features std --example cost

use std::hint::black_box;
use std::time::Instant;

use dyn_runtime::current::VoiceCoils;
use dyn_runtime::kernels;
use dyn_runtime::models::Uhp2016;
use dyn_runtime::nalgebra::{Vector3, Vector6};
use dyn_runtime::{Acceleration, BaseMotion, Error, Hexapod, Limits, PlatformState, Pose, Twist, Wrench};

/// Calls of one run, unless the first argument says otherwise (few, under valgrind).
const CALLS: u32 = 200_000;

/// The calls to which the others are compared.
const UNCHECKED: &str = "inverse_dynamics, unchecked";
const CHECKED: &str = "inverse_dynamics, checked";

fn main() -> Result<(), Error> {
    let hexapod = Hexapod::new(Uhp2016);
    let base = BaseMotion {
        pose: Pose::from_paper_angles(Vector3::new(0.1, -0.2, 0.3), [0.2, -0.1, 0.3]),
        velocity: Twist {
            linear_m_s: Vector3::new(0.1, 0.2, -0.1),
            angular_rad_s: Vector3::new(0.3, -0.2, 0.1),
        },
        acceleration: Acceleration {
            linear_m_s2: Vector3::new(1.0, -2.0, 0.5),
            angular_rad_s2: Vector3::new(2.0, 1.0, -1.0),
        },
    };
    let relative = Pose::from_paper_angles(Vector3::new(0.002, -0.003, 0.384), [0.02, -0.01, 0.015]);
    let platform = PlatformState {
        pose: base.pose.compose(&relative),
        velocity: Twist {
            linear_m_s: Vector3::new(-0.1, 0.1, 0.2),
            angular_rad_s: Vector3::new(0.2, 0.5, -0.3),
        },
    };
    let (acceleration, wrench) = (base.acceleration, Wrench::zero());
    let legs = hexapod.leg_kinematics(&base, &platform, &acceleration)?;
    // A millimetre and a milliradian away, in every component.
    let moved = Pose::from_paper_angles(Vector3::repeat(1e-3), [1e-3; 3]);
    let near = Pose {
        position_m: platform.pose.position_m + moved.position_m,
        rotation: moved.rotation * platform.pose.rotation,
    };
    let found = hexapod.forward_kinematics(&base.pose, &legs.actuator_length_m, &near)?;

    let rows = |pose: &Pose| -> [[f64; 3]; 3] { pose.rotation.matrix().transpose().into() };
    let (rb, b, rp, p) = (
        base.pose.position_m.into(),
        rows(&base.pose),
        platform.pose.position_m.into(),
        rows(&platform.pose),
    );
    let (vb, ab) = (base.velocity.to_vector().into(), base.acceleration.to_vector().into());
    let (vp, ap, w) = (platform.velocity.to_vector().into(), acceleration.to_vector().into(), [0.0; 6]);

    let [mut d, mut rates, mut bias, mut forces, mut reaction] = [[0.0; 6]; 5];
    let [mut jacobian, mut mass] = [[[0.0; 6]; 6]; 2];
    let model = Uhp2016;
    // Results stay where they are written: moving them would be measured too.
    let found = format!("forward_kinematics, {} steps, checked", found.iterations);
    let reference = base.velocity;
    let limits = Limits {
        minimum_length_m: [0.19; 6],
        maximum_length_m: [0.21; 6],
        maximum_velocity_m_s: [0.5; 6],
        maximum_force_n: [50.0; 6],
        minimum_condition_bound: 1e-3,
        ..Limits::none()
    };
    let angles_too = Limits {
        maximum_hooke_joint_angle_rad: [0.3; 6],
        maximum_platform_joint_angle_rad: [0.3; 6],
        ..limits
    };
    let coils = VoiceCoils { force_constant_n_per_a: [20.0; 6], maximum_current_a: [2.0; 6] };
    let wanted = Vector6::new(30.0, -20.0, 25.0, 10.0, -60.0, 15.0);
    let (at, angles, quaternion) = (base.pose.position_m, [0.02, -0.01, 1.3], [0.5, -0.5, 0.5, 0.5]);
    #[rustfmt::skip]
    let costs = [
        (UNCHECKED, time(|| {
            let rb = black_box(&rb);
            kernels::InverseDynamics::inverse_dynamics(&model, rb, &b, &vb, &ab, &rp, &p, &vp, &ap, &w, &mut forces);
            black_box(&forces);
        })),
        ("control, unchecked", time(|| {
            let rb = black_box(&rb);
            kernels::Control::control(
                &model, rb, &b, &vb, &ab, &rp, &p, &vp, &ap, &w,
                &mut d, &mut rates, &mut jacobian, &mut mass, &mut bias, &mut forces,
            );
            black_box((&d, &rates, &jacobian, &mass, &bias, &forces));
        })),
        ("passive_inverse_dynamics, unchecked", time(|| {
            let rb = black_box(&rb);
            kernels::PassiveInverseDynamics::passive_inverse_dynamics(
                &model, rb, &b, &vb, &ab, &rp, &p, &vp, &ap, &vb, &w, &mut forces,
            );
            black_box(&forces);
        })),
        ("base_reaction, unchecked", time(|| {
            let rb = black_box(&rb);
            kernels::BaseReaction::base_reaction(&model, rb, &b, &vb, &ab, &rp, &p, &vp, &ap, &w, &mut reaction);
            black_box(&reaction);
        })),
        ("actuator_geometry, unchecked", time(|| {
            let rb = black_box(&rb);
            kernels::ActuatorGeometry::actuator_geometry(&model, rb, &b, &rp, &p, &mut d, &mut rates, &mut jacobian);
            black_box((&d, &rates, &jacobian));
        })),
        (CHECKED, time(|| {
            let _ = black_box(hexapod.inverse_dynamics(black_box(&base), &platform, &acceleration, &wrench));
        })),
        ("control, checked", time(|| {
            let _ = black_box(hexapod.control(black_box(&base), &platform, &acceleration, &wrench));
        })),
        ("passive_inverse_dynamics, checked", time(|| {
            let _ = black_box(hexapod.passive_inverse_dynamics(
                black_box(&base), &platform, &reference, &acceleration, &wrench,
            ));
        })),
        ("base_reaction, checked", time(|| {
            let _ = black_box(hexapod.base_reaction(black_box(&base), &platform, &acceleration, &wrench));
        })),
        ("platform_velocity, checked", time(|| {
            let _ = black_box(hexapod.platform_velocity(black_box(&base), &platform.pose, &legs.actuator_velocity_m_s));
        })),
        ("monitor of lengths, rates and forces, checked", time(|| {
            let _ = black_box(hexapod.monitor(black_box(&base), &platform, &wanted, &limits));
        })),
        ("monitor with angles of joints, checked", time(|| {
            let _ = black_box(hexapod.monitor(black_box(&base), &platform, &wanted, &angles_too));
        })),
        ("currents, checked", time(|| {
            let _ = black_box(coils.currents(black_box(&wanted)));
        })),
        (&found, time(|| {
            let base = black_box(&base.pose);
            let _ = black_box(hexapod.forward_kinematics(base, &legs.actuator_length_m, &near));
        })),
        ("Pose::from_paper_angles", time(|| {
            black_box(Pose::from_paper_angles(black_box(at), black_box(angles)));
        })),
        ("sines and cosines of its angles, by std", time(|| {
            black_box(black_box(angles).map(f64::sin_cos));
        })),
        ("Pose::from_quaternion", time(|| {
            let _ = black_box(Pose::from_quaternion(black_box(at), black_box(quaternion)));
        })),
    ];
    let of = |call: &str| costs.iter().find(|row| row.0 == call).map_or(f64::NAN, |row| row.1);
    let (unchecked, checked) = (of(UNCHECKED), of(CHECKED));
    println!("{:<48} {:>8} {:>14} {:>14}", "call", "ns", "to unchecked", "to checked");
    for (call, ns) in costs {
        println!("{call:<48} {ns:>8.1} {:>14.2} {:>14.2}", ns / unchecked, ns / checked);
    }
    Ok(())
}

/// Median of five runs, ns per call.
fn time(mut call: impl FnMut()) -> f64 {
    let calls = std::env::args().nth(1).and_then(|number| number.parse().ok()).unwrap_or(CALLS);
    let mut runs: [f64; 5] = std::array::from_fn(|_| {
        let start = Instant::now();
        (0..calls).for_each(|_| call());
        start.elapsed().as_secs_f64() * 1e9 / f64::from(calls)
    });
    runs.sort_by(f64::total_cmp);
    runs[2]
}
