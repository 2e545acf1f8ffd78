//! Kinetic and potential energy of payload, legs' bodies and springs.

use nalgebra::Vector3;

use crate::leg::{leg_geometries, leg_velocities};
use crate::legs::{LegType, transverse_inertia};
use crate::matrices::payload_inertia;
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
pub fn energy<L: LegType>(parameters: &Parameters<L>, state: &State) -> Energy {
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
        let inertia = transverse_inertia(leg.turning_inertia(), geometry);
        kinetic += 0.5 * w_s.dot(&(inertia * w_s));
        let (masses, velocities) = (leg.masses(), leg.com_velocity(geometry, velocity, base));
        let positions = leg.com_position(geometry, base, platform);
        for body in 0..2 {
            kinetic += translation(masses[body], &velocities[body]);
            potential -= masses[body] * gravity.dot(&positions[body]);
        }
        let element = leg.axial_element();
        let extension = geometry.length - element.rest_length_m;
        potential += 0.5 * element.stiffness_n_m * extension * extension;
    }
    Energy { kinetic_energy: kinetic, potential_energy: potential }
}
