//! Kinetic and potential energy.

use crate::check::finite_result;
use crate::error::Error;
use crate::hexapod::{Hexapod, States};
use crate::kernels;
use crate::state::{BaseMotion, PlatformState};

/// Energy of payload, rods, movers and springs.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Energy {
    /// T, J, of the motion in O.
    pub kinetic_j: f64,
    /// V, J: gravity, by absolute height over O's origin along g, and springs.
    pub potential_j: f64,
}

impl<M: kernels::RodAlignment> Hexapod<M> {
    /// T and V. Depends on poses and velocities.
    ///
    /// Without actuator forces, dampers and external wrench, and with the base at rest, `T + V` is constant
    /// along a motion.
    ///
    /// # Errors
    /// See [`Hexapod`].
    pub fn energy(&self, base: &BaseMotion, platform: &PlatformState) -> Result<Energy, Error>
    where
        M: kernels::Energy,
    {
        let States {
            base_position,
            base_rotation,
            base_velocity,
            platform_position,
            platform_rotation,
            platform_velocity,
        } = self.states(base, platform)?;
        let mut kinetic_energy = 0.0;
        let mut potential_energy = 0.0;
        self.model.energy(
            &base_position,
            &base_rotation,
            &base_velocity,
            &platform_position,
            &platform_rotation,
            &platform_velocity,
            &mut kinetic_energy,
            &mut potential_energy,
        );
        finite_result(&[&kinetic_energy, &potential_energy])?;
        Ok(Energy { kinetic_j: kinetic_energy, potential_j: potential_energy })
    }
}
