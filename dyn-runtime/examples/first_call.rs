//! Actuator lengths and forces along a short motion: the base shakes with 0.1 g at 40 Hz along x, the
//! platform does not follow but tilts by 10 mrad at 2 Hz about y.
//!
//!     cargo run -p dyn-runtime --example first_call

use std::f64::consts::TAU;

use dyn_runtime::nalgebra::Vector3;
use dyn_runtime::{
    Acceleration, BaseMotion, Error, Hexapod, PlatformState, Pose, Twist, Wrench, angles, models::Uhp2016,
};

fn main() -> Result<(), Error> {
    let hexapod = Hexapod::new(Uhp2016);
    println!("   t ms | {:<47} | actuator forces F, N", "actuator lengths d, mm");
    for step in 0..=10 {
        let t = 0.0025 * f64::from(step);
        let base = base_motion(t);
        let (platform, acceleration) = platform_motion(t);
        let legs = hexapod.leg_kinematics(&base, &platform, &acceleration)?;
        let forces = hexapod.inverse_dynamics(&base, &platform, &acceleration, &Wrench::zero())?;

        print!(" {:6.1} |", 1e3 * t);
        legs.actuator_length_m.iter().for_each(|length| print!(" {:7.3}", 1e3 * length));
        print!(" |");
        forces.iter().for_each(|force| print!(" {force:7.3}"));
        println!();
    }
    Ok(())
}

/// `x = -A/W^2 sin(W t)` with A = 0.1 g and W = 40 Hz, so that the acceleration is `A sin(W t)`.
fn base_motion(t: f64) -> BaseMotion {
    let amplitude_m_s2 = 0.981;
    let frequency_rad_s = TAU * 40.0;
    let (sin, cos) = (frequency_rad_s * t).sin_cos();
    let along_x = |value| Vector3::new(value, 0.0, 0.0);
    BaseMotion {
        pose: Pose::from_paper_angles(along_x(-amplitude_m_s2 / frequency_rad_s.powi(2) * sin), [0.0; 3]),
        velocity: Twist { linear_m_s: along_x(-amplitude_m_s2 / frequency_rad_s * cos), ..Twist::zero() },
        acceleration: Acceleration { linear_m_s2: along_x(amplitude_m_s2 * sin), ..Acceleration::zero() },
    }
}

/// At home, tilting about y; the motion is given by the paper's angle theta and its derivatives.
fn platform_motion(t: f64) -> (PlatformState, Acceleration) {
    let amplitude_rad = 0.010;
    let frequency_rad_s = TAU * 2.0;
    let (sin, cos) = (frequency_rad_s * t).sin_cos();
    let about_y = |value| [0.0, value, 0.0];
    let paper_angles = about_y(amplitude_rad * sin);
    let rates = about_y(amplitude_rad * frequency_rad_s * cos);
    let second_derivatives = about_y(-amplitude_rad * frequency_rad_s.powi(2) * sin);

    let home_m = Vector3::new(0.0, 0.0, 0.382);
    let platform = PlatformState {
        pose: Pose::from_paper_angles(home_m, paper_angles),
        velocity: Twist { angular_rad_s: angles::angular_velocity(paper_angles, rates), ..Twist::zero() },
    };
    let acceleration = Acceleration {
        angular_rad_s2: angles::angular_acceleration(paper_angles, rates, second_derivatives),
        ..Acceleration::zero()
    };
    (platform, acceleration)
}
