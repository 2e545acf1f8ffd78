//! Kinetic and potential energy.

use crate::error::Error;
use crate::evaluate::evaluate;
use crate::hexapod::{Hexapod, arrays};
use crate::kernels;
use crate::real::Real;
use crate::state::{BaseMotion, PlatformState};

/// Energy of payload, rods, movers and springs.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Energy<T = f64> {
    /// T, J, of the motion in O.
    pub kinetic_j: T,
    /// V, J: gravity, by absolute height over O's origin along g, and springs.
    pub potential_j: T,
}

impl<M: kernels::RodAlignment<T>, T: Real> Hexapod<M, T> {
    /// T and V. Depends on poses and velocities.
    ///
    /// Without actuator forces, dampers and external wrench, and with the base at rest, `T + V` is constant
    /// along a motion.
    ///
    /// # Errors
    /// See [`Hexapod`].
    pub fn energy(&self, base: &BaseMotion<T>, platform: &PlatformState<T>) -> Result<Energy<T>, Error>
    where
        M: kernels::Energy<T>,
    {
        let (b, p) = arrays(base, platform);
        self.check_states(&b, &p)?;
        evaluate!(self.model.energy(
            b.position, b.rotation, b.velocity, p.position, p.rotation, p.velocity
        ) -> Energy {
            kinetic_j, potential_j,
        })
    }
}
