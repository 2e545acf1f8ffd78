//! Inverse dynamics of a platform of one's own. Its model, `my_platform.rs`, was written by
//!
//! ```text
//! dyn-gen generate my_platform.toml -o src/my_platform.rs --functions rod_alignment,actuator_geometry,inverse_dynamics
//! ```
//!
//! and is made again by the same command when `my_platform.toml` has changed; `dyn-gen check my_platform.toml
//! src/my_platform.rs` tells whether it is up to date.

use dyn_runtime::nalgebra::Vector3;
use dyn_runtime::{Acceleration, BaseMotion, Error, Hexapod, PlatformState, Pose, Twist, Wrench};

#[rustfmt::skip]
mod my_platform;

fn main() -> Result<(), Error> {
    let hexapod = Hexapod::new(my_platform::MyPlatform);
    let base = BaseMotion {
        pose: Pose::identity(),
        velocity: Twist::zero(),
        acceleration: Acceleration { linear_m_s2: Vector3::new(0.981, 0.0, 0.0), ..Acceleration::zero() },
    };
    let home = Pose::from_paper_angles(Vector3::new(0.0, 0.0, 0.382), [0.0; 3]);
    let platform = PlatformState::at_rest(home);
    let forces_n = hexapod.inverse_dynamics(&base, &platform, &Acceleration::zero(), &Wrench::zero())?;
    println!("actuator forces [N]: {forces_n:.3}");
    Ok(())
}
