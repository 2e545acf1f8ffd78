//! The wrench between base and mechanism: what the spacecraft feels.

use crate::arrays::{FromRows, halves};
use crate::check::finite;
use crate::error::{Error, Input};
use crate::evaluate::evaluate;
use crate::hexapod::{Hexapod, arrays};
use crate::kernels;
use crate::real::Real;
use crate::state::{Acceleration, BaseMotion, PlatformState, Wrench};

use nalgebra::Vector3;

/// Force and moment between base and mechanism, O axes, moments about the base's origin r_b.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct BaseReaction<T = f64> {
    /// Force of the base on the mechanism, N, O.
    pub force_n: Vector3<T>,
    /// Its moment about r_b, N m, O.
    pub moment_n_m: Vector3<T>,
}

impl<T: Real> BaseReaction<T> {
    /// The same wrench as the base feels it: force (N) and moment about r_b (N m) of the mechanism on the base.
    pub fn on_base(&self) -> Self {
        Self { force_n: -self.force_n, moment_n_m: -self.moment_n_m }
    }
}

impl<T: Real> FromRows<[T; 6]> for BaseReaction<T> {
    fn from_rows(stacked: &[T; 6]) -> Self {
        let (force_n, moment_n_m) = halves(stacked);
        Self { force_n, moment_n_m }
    }
}

impl<M: kernels::RodAlignment<T>, T: Real> Hexapod<M, T> {
    /// The whole wrench of the base on payload, rods and movers, actuators, bearings and springs together:
    /// the rate of their momentum less gravity and less the external wrench F_D, M_D. Moments about the base's
    /// origin. Depends on poses, velocities and accelerations of both bodies and on the external wrench; the
    /// platform's acceleration is the one that it has (from [`forward_dynamics`](Self::forward_dynamics)) or that
    /// it is to have.
    ///
    /// # Errors
    /// See [`Hexapod`].
    ///
    /// ```
    /// use dyn_runtime::nalgebra::Vector3;
    /// use dyn_runtime::{Acceleration, BaseMotion, Hexapod, PlatformState, Pose, Wrench, models::Uhp2016};
    ///
    /// let base = BaseMotion::at_rest(Pose::identity());
    /// let home = Pose::from_paper_angles(Vector3::new(0.0, 0.0, 0.382), [0.0; 3]);
    /// let platform = PlatformState::at_rest(home);
    /// let reaction =
    ///     Hexapod::new(Uhp2016).base_reaction(&base, &platform, &Acceleration::zero(), &Wrench::zero())?;
    /// // At rest the base carries the weight of everything that moves.
    /// assert!((reaction.force_n.z - 15.902 * 9.81).abs() < 1e-9);
    /// assert!((reaction.on_base().force_n.z + 15.902 * 9.81).abs() < 1e-9);
    /// # Ok::<(), dyn_runtime::Error>(())
    /// ```
    pub fn base_reaction(
        &self,
        base: &BaseMotion<T>,
        platform: &PlatformState<T>,
        platform_acceleration: &Acceleration<T>,
        external_wrench: &Wrench<T>,
    ) -> Result<BaseReaction<T>, Error>
    where
        M: kernels::BaseReaction<T>,
    {
        let base_acceleration = finite(Input::BaseAcceleration, base.acceleration.to_array())?;
        let platform_acceleration = finite(Input::PlatformAcceleration, platform_acceleration.to_array())?;
        let external_wrench = finite(Input::ExternalWrench, external_wrench.to_array())?;
        let (b, p) = arrays(base, platform);
        self.check_states(&b, &p)?;
        evaluate!(self.model.base_reaction(
            b.position, b.rotation, b.velocity, base_acceleration,
            p.position, p.rotation, p.velocity, platform_acceleration,
            external_wrench,
        ) -> base_wrench)
    }
}
