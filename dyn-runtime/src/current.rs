//! Forces to currents of voice coils, within what the coils and their amplifiers can do.

use nalgebra::Vector6;

use crate::arrays::AllFinite;
use crate::check;
use crate::error::{Error, Input};
use crate::real::Real;

/// The voice coils of the six actuators. A limit of infinity is none.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct VoiceCoils<T = f64> {
    /// Force per current, N/A; not 0.
    pub force_constant_n_per_a: [T; 6],
    /// Largest current either way, A.
    pub maximum_current_a: [T; 6],
}

/// Currents for wanted forces.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Currents<T = f64> {
    /// Current of each coil, A, never beyond its limit.
    pub current_a: Vector6<T>,
    /// The forces that they make, N.
    pub actuator_force_n: Vector6<T>,
    /// Set where the forces are smaller than wanted.
    pub saturation: Option<Saturation<T>>,
}

/// Forces that had to be reduced.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Saturation<T = f64> {
    /// The share of the wanted forces that is left, 0 to 1, the same for all six.
    pub factor: T,
    /// The leg that asked for it: index 0 to 5 of the coil at its limit.
    pub leg: usize,
}

impl<T: Real> VoiceCoils<T> {
    /// The currents for `actuator_force_n` (N). Where one of them is beyond its limit, all six forces are
    /// scaled by one factor: the wrench `J_dp^T F` on the platform becomes smaller but keeps its direction,
    /// which cutting each current by itself would turn. That is no error: [`Currents::saturation`] alone tells.
    ///
    /// # Errors
    /// [`Error::NonFinite`] for forces; [`Error::InvalidCoil`] for a force constant that is 0 or not finite
    /// or a limit that is negative or NaN; [`Error::NonFiniteResult`] for a current too large to compute with.
    ///
    /// ```
    /// use dyn_runtime::{current::VoiceCoils, nalgebra::Vector6};
    ///
    /// let coils = VoiceCoils { force_constant_n_per_a: [20.0; 6], maximum_current_a: [2.0; 6] };
    /// let wanted = Vector6::new(80.0, -20.0, 10.0, 0.0, 0.0, 40.0);
    /// let currents = coils.currents(&wanted)?;
    /// assert_eq!(currents.current_a[0], 2.0);
    /// assert_eq!(currents.actuator_force_n, wanted * 0.5);
    /// assert_eq!(currents.saturation.map(|saturation| saturation.leg), Some(0));
    /// # Ok::<(), dyn_runtime::Error>(())
    /// ```
    pub fn currents(&self, actuator_force_n: &Vector6<T>) -> Result<Currents<T>, Error> {
        let wanted: [T; 6] = check::finite(Input::ActuatorForce, (*actuator_force_n).into())?;
        let coils = || self.force_constant_n_per_a.iter().zip(&self.maximum_current_a);
        let is_no_coil = |(constant, limit): (&T, &T)| {
            !constant.is_finite() || *constant == T::zero() || !(T::zero()..).contains(limit)
        };
        if let Some(leg) = coils().position(is_no_coil) {
            return Err(Error::InvalidCoil { leg });
        }
        let mut most = T::one();
        let mut saturated = None;
        for (leg, (force, (constant, limit))) in wanted.iter().zip(coils()).enumerate() {
            let possible = (*constant * *limit).abs();
            // A coil without current gives no force, whatever is wanted of it.
            let used = if *force == T::zero() { T::zero() } else { force.abs() / possible };
            if used > most {
                (most, saturated) = (used, Some(leg));
            }
        }
        // Forces infinitely beyond the limits leave nothing.
        let factor = if most.is_finite() { T::one() / most } else { T::zero() };
        let [mut current, mut force] = [[T::zero(); 6]; 2];
        for (((current, force), wanted), (constant, limit)) in
            current.iter_mut().zip(&mut force).zip(&wanted).zip(coils())
        {
            let possible = (*constant * *limit).abs();
            // Rounding may put the saturated coil one unit of the last place beyond, and its force too.
            *current = (*wanted * factor / *constant).max(-*limit).min(*limit);
            *force = (*wanted * factor).max(-possible).min(possible);
        }
        check::finite_result(current.all_finite() & force.all_finite())?;
        let saturation = saturated.map(|leg| Saturation { factor, leg });
        Ok(Currents { current_a: current.into(), actuator_force_n: force.into(), saturation })
    }
}
