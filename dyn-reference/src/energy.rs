//! Kinetic and potential energy of payload, rods, movers and springs.

use nalgebra::Vector3;

use crate::bodies::{mover_arm, mover_velocity, rod_com};
use crate::leg::{leg_geometries, leg_velocities};
use crate::matrices::{payload_inertia, rod_inertia};
use crate::parameters::Parameters;
use crate::state::State;

/// What [`energy`] returns, J.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Energy {
    /// `sum m r'.r' / 2 + w.I w / 2`.
    pub kinetic_energy: f64,
    /// `-sum m g.r + sum k_e (d - d_0)^2 / 2`, heights from O's origin.
    pub potential_energy: f64,
}

/// Energy of all moving bodies in O, and of the springs.
pub fn energy(parameters: &Parameters, state: &State) -> Energy {
    let State { base, platform, .. } = state;
    let gravity = &parameters.gravity_m_s2;
    let translation = |mass: f64, velocity: &Vector3<f64>| 0.5 * mass * velocity.norm_squared();
    let payload = &parameters.payload;
    let payload_arm = platform.rotation * payload.com_m;
    let w_p = platform.angular_velocity();
    let mut kinetic = translation(payload.mass_kg, &platform.point_velocity(&payload_arm))
        + 0.5 * w_p.dot(&(payload_inertia(parameters, platform) * w_p));
    let mut potential = -payload.mass_kg * gravity.dot(&(platform.position_m + payload_arm));

    let geometries = leg_geometries(parameters, state);
    let velocities = leg_velocities(parameters, state, &geometries);
    for i in 0..6 {
        let (leg, geometry, velocity) = (&parameters.legs[i], &geometries[i], &velocities[i]);
        let w_s = &velocity.rod_angular;
        kinetic += translation(leg.rod_mass_kg, &rod_com(leg, &velocity.hooke, &velocity.platform_joint))
            + 0.5 * w_s.dot(&(rod_inertia(leg, geometry) * w_s))
            + translation(leg.mover_mass_kg, &mover_velocity(leg, geometry, velocity, base));

        let hooke = base.position_m + geometry.hooke_arm;
        let rod = rod_com(leg, &hooke, &(platform.position_m + geometry.platform_arm));
        let mover = base.position_m + mover_arm(leg, geometry);
        let extension = geometry.length - leg.rest_length_m;
        potential += 0.5 * leg.axial_stiffness_n_m * extension * extension
            - leg.rod_mass_kg * gravity.dot(&rod)
            - leg.mover_mass_kg * gravity.dot(&mover);
    }
    Energy { kinetic_energy: kinetic, potential_energy: potential }
}
