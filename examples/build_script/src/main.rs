//! Inverse dynamics of a platform of one's own, with the payload that is on it today. The model is made by `build.rs`.

use dyn_runtime::nalgebra::Vector3;
use dyn_runtime::{Acceleration, BaseMotion, Hexapod, PlatformState, Pose, Twist, Wrench};

#[rustfmt::skip]
mod model {
    include!(concat!(env!("OUT_DIR"), "/model.rs"));
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // The platform file's payload, then a heavier one; an impossible one is refused and changes nothing.
    let mut parameters = model::Parameters::default();
    let base = BaseMotion { pose: Pose::identity(), velocity: Twist::zero(), acceleration: Acceleration::zero() };
    let home = Pose::from_paper_angles(Vector3::new(0.0, 0.0, 0.382), [0.0; 3]);
    for payload_mass_kg in [parameters.payload_mass, 8.5, -1.0] {
        if let Err(refusal) = parameters.set_payload_mass(payload_mass_kg) {
            println!("{refusal}");
            continue;
        }
        let hexapod = Hexapod::new(model::MyPlatform::new(parameters));
        let forces_n = hexapod.inverse_dynamics(
            &base,
            &PlatformState::at_rest(home),
            &Acceleration::zero(),
            &Wrench::zero(),
        )?;
        println!("{payload_mass_kg} kg, actuator forces [N]: {forces_n:.3}");
    }
    Ok(())
}
