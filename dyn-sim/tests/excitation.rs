//! Prescribed motions: each derivative is that of the quantity before it, nothing drifts, accelerations are those given.

mod common;

use std::f64::consts::TAU;

use dyn_runtime::Pose;
use dyn_runtime::nalgebra::{Matrix3, Vector6};
use dyn_sim::measured::{Measured, Record};
use dyn_sim::motion::{BodyMotion, Motion};

use common::{scenario, target};

/// Largest mismatch of velocity and acceleration with central differences of pose and velocity, relative to the
/// larger of the two.
fn mismatch(motion: &Motion, t: f64, d: f64) -> f64 {
    let at = |n: f64| motion.at(t + n * d);
    let stencil = [(-2.0, 1.0), (-1.0, -8.0), (1.0, 8.0), (2.0, -1.0)].map(|(n, w)| (at(n), w / (12.0 * d)));
    let mut velocity = Vector6::zeros();
    let mut acceleration = Vector6::zeros();
    let mut turning = Matrix3::zeros();
    let BodyMotion { pose, velocity: v, acceleration: a } = at(0.0);
    for (sample, weight) in stencil {
        let r = (sample.pose.position_m - pose.position_m) * weight;
        velocity += Vector6::new(r.x, r.y, r.z, 0.0, 0.0, 0.0);
        acceleration += (sample.velocity.to_vector() - v.to_vector()) * weight;
        turning += (sample.pose.rotation.matrix() - pose.rotation.matrix()) * weight;
    }
    let linear = (velocity.fixed_rows::<3>(0) - v.linear_m_s).amax() / v.linear_m_s.amax();
    let spin = v.angular_rad_s.cross_matrix() * pose.rotation.matrix();
    let angular = (turning - spin).amax() / v.angular_rad_s.amax();
    let change = (acceleration - a.to_vector()).amax() / a.to_vector().amax();
    linear.max(angular).max(change)
}

#[test]
fn derivatives_of_large_motion() {
    let scenario = scenario("large");
    for motion in [&scenario.base, target(&scenario)] {
        for t in [0.0, 0.123, 0.5, 0.77] {
            let error = mismatch(motion, t, 1e-3);
            assert!(error < 1e-7, "{t}: {error:e}");
        }
    }
}

#[test]
fn derivatives_of_small_motion() {
    let scenario = scenario("published");
    for motion in [&scenario.base, target(&scenario)] {
        for t in [0.001, 0.0123, 0.0482, 0.077] {
            let error = mismatch(motion, t, 2e-5);
            assert!(error < 1e-6, "{t}: {error:e}");
        }
    }
}

/// The angular acceleration is the harmonic itself, far beyond first order in the rotation (3e-7 rad).
#[test]
fn small_rotations_have_the_angular_acceleration_that_was_given() {
    let scenario = scenario("published");
    for t in [0.001, 0.0123, 0.3, 0.477] {
        let given = [(40.0, 0.020), (100.0, 0.030), (200.0, 0.050)];
        let wanted: f64 = given.iter().map(|(f, a)| a * (TAU * f * t).sin()).sum();
        let found = target(&scenario).at(t).acceleration.angular_rad_s2.x;
        assert!((found - wanted).abs() < 1e-12 * 0.1, "{t}: {found} {wanted}");
    }
}

fn record() -> Record {
    let spacing_s = 1e-3;
    let sample = |k: usize| -> [f64; 6] {
        let t = spacing_s * k as f64;
        std::array::from_fn(|i| 0.7 + (1.0 + i as f64) * (TAU * (3.0 + i as f64) * t + 0.4 * i as f64).sin())
    };
    Record { spacing_s, acceleration: (0..=1000).map(sample).collect() }
}

#[test]
fn measured_motion_is_consistent_and_does_not_drift() {
    let measured = Measured::new(&record(), Pose::identity());
    for bias in measured.bias() {
        assert!((bias - 0.7).abs() < 1e-6, "{bias}");
    }
    let motion = Motion::Measured(Box::new(measured));
    for t in [0.1, 0.4321, 0.8] {
        let error = mismatch(&motion, t, 2e-4);
        assert!(error < 1e-6, "{t}: {error:e}");
    }
    let mean = |of: &dyn Fn(&BodyMotion) -> Vector6<f64>| {
        (0..1000).map(|k| of(&motion.at(1e-3 * (k as f64 + 0.5)))).sum::<Vector6<f64>>() / 1000.0
    };
    let velocity = mean(&|m| m.velocity.to_vector());
    assert!(velocity.amax() < 1e-6, "{velocity}");
    let position =
        mean(&|m| Vector6::new(m.pose.position_m.x, m.pose.position_m.y, m.pose.position_m.z, 0., 0., 0.));
    assert!(position.amax() < 1e-7, "{position}");
}

/// A measured sine gives the analytic motion.
#[test]
fn measured_sine() {
    let motion = Motion::Measured(Box::new(Measured::new(&record(), Pose::identity())));
    for t in [0.05, 0.333, 0.9004] {
        let x = -(TAU * 3.0 * t).sin() / (TAU * 3.0).powi(2);
        let found = motion.at(t).pose.position_m.x;
        assert!((found - x).abs() < 1e-8, "{t}: {found} {x}");
    }
}
