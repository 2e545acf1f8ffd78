//! Forward kinematics: the platform's pose from the lengths of the six actuators, its velocity from their
//! rates.
//!
//! Newton's method on the poses themselves: `J_dp delta = d - d(pose)` gives a twist, and the pose moves by it
//! (position by its linear part, orientation by the Cayley transform of its angular part, a rotation without
//! trigonometry). The last step keeps the Jacobian of the one before where that is near enough. Steps that leave the
//! workspace or bring the lengths no nearer are halved. Work is bounded:
//! 30 steps, each halved 8 times at most. The search itself stands in `newton`.

use nalgebra::{Matrix3, Rotation3, Vector3, Vector6};

use crate::arrays::{AllFinite, FromRows};
use crate::check;
use crate::error::{Error, Input};
use crate::hexapod::{Hexapod, StateArrays, arrays, check_poses};
use crate::kernels;
use crate::newton::{Found, Search};
use crate::real::Real;
use crate::state::{BaseMotion, PlatformState, Pose, Twist};

/// A pose with given actuator lengths.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct ForwardKinematics<T: Real = f64> {
    /// Pose of the platform, O.
    pub pose: Pose<T>,
    /// Newton steps that led there.
    pub iterations: u32,
    /// Largest difference between a length given and a length at the pose, m; at most
    /// [`Real::LENGTH_RESIDUAL_M`]. It holds for the pose as seen from the base; added to the position of a base far from O's
    /// origin, the pose in O is rounded to that distance's digits.
    pub residual_m: T,
}

impl<M: kernels::RodAlignment<T>, T: Real> Hexapod<M, T> {
    /// The pose of the platform at which the actuators have the lengths `actuator_length_m` (d, m), found from
    /// `start`, both poses in O. `base` is the base's pose.
    ///
    /// Six lengths have several poses; the one found is, near enough, the one that belongs to `start`: the last
    /// pose in a loop, the base's pose composed with the platform's home at switch-on. `docs/control.md` shows
    /// from how far the paper's platform finds its pose.
    ///
    /// **Wrong lengths have a pose too**, as a rule, and it is returned: compare lengths with the stroke before and the pose with
    /// the last one after, as `docs/control-loop.md` does.
    ///
    /// # Errors
    /// See [`Hexapod`] for poses and lengths that are refused; [`Error::OutOfReach`] and [`Error::RodPerpendicular`] are about
    /// the start. [`Error::SingularJacobian`] where the legs at a pose on the way determine no step;
    /// [`Error::NoConvergence`] otherwise, also where no leg could reach the poses that the lengths lead to.
    ///
    /// ```
    /// use dyn_runtime::nalgebra::Vector3;
    /// use dyn_runtime::{Acceleration, BaseMotion, Hexapod, PlatformState, Pose, models::Uhp2016};
    ///
    /// let hexapod = Hexapod::new(Uhp2016);
    /// let base = BaseMotion::at_rest(Pose::identity());
    /// let home = Pose::from_paper_angles(Vector3::new(0.0, 0.0, 0.382), [0.0; 3]);
    /// let there = Pose::from_paper_angles(Vector3::new(0.003, -0.002, 0.385), [0.01, 0.02, -0.01]);
    /// let legs = hexapod.leg_kinematics(&base, &PlatformState::at_rest(there), &Acceleration::zero())?;
    ///
    /// let found = hexapod.forward_kinematics(&base.pose, &legs.actuator_length_m, &home)?;
    /// assert!((found.pose.position_m - there.position_m).amax() < 1e-12);
    /// assert!(found.iterations <= 5);
    /// # Ok::<(), dyn_runtime::Error>(())
    /// ```
    pub fn forward_kinematics(
        &self,
        base: &Pose<T>,
        actuator_length_m: &Vector6<T>,
        start: &Pose<T>,
    ) -> Result<ForwardKinematics<T>, Error>
    where
        M: kernels::ActuatorGeometry<T>,
    {
        let lengths = check::finite(Input::ActuatorLength, (*actuator_length_m).into())?;
        let on_base = StateArrays::at(base);
        check_poses(&on_base, &StateArrays::at(start))?;
        let mut found = Err(Error::NonFiniteResult);
        T::run(Search {
            model: &self.model,
            base_rotation: &on_base.rotation,
            lengths: &lengths,
            // Seen from the base's origin, in axes of O: a base far from O's origin costs no digits this way.
            position: (start.position_m - base.position_m).into(),
            rotation: &start.rotation,
            found: &mut found,
        });
        let Found { position, rotation: [[a, b, c], [d, e, f], [g, h, i]], iterations, residual } = found?;
        let rotation = Rotation3::from_matrix_unchecked(Matrix3::new(a, b, c, d, e, f, g, h, i));
        let pose = Pose { position_m: base.position_m + Vector3::from(position), rotation };
        Ok(ForwardKinematics { pose, iterations, residual_m: residual })
    }

    /// The platform's velocity from the rates of the actuators: `v_p` of `d' = J_dp v_p - J_db v_b` (30). Of
    /// `platform` the pose counts, of `base` pose and velocity.
    ///
    /// # Errors
    /// See [`Hexapod`]; besides, [`Error::SingularJacobian`].
    ///
    /// ```
    /// use dyn_runtime::nalgebra::{Vector3, Vector6};
    /// use dyn_runtime::{BaseMotion, Hexapod, PlatformState, Pose, models::Uhp2016};
    ///
    /// let base = BaseMotion::at_rest(Pose::identity());
    /// let home = Pose::from_paper_angles(Vector3::new(0.0, 0.0, 0.382), [0.0; 3]);
    /// // Upright actuators that all extend at 10 mm/s raise the platform.
    /// let velocity = Hexapod::new(Uhp2016).platform_velocity(&base, &home, &Vector6::repeat(0.01))?;
    /// assert!((velocity.linear_m_s - Vector3::new(0.0, 0.0, 0.01)).amax() < 1e-15);
    /// # Ok::<(), dyn_runtime::Error>(())
    /// ```
    pub fn platform_velocity(
        &self,
        base: &BaseMotion<T>,
        platform: &Pose<T>,
        actuator_velocity_m_s: &Vector6<T>,
    ) -> Result<Twist<T>, Error>
    where
        M: kernels::JacobianDp<T> + kernels::JacobianDb<T>,
    {
        let rates: [T; 6] = check::finite(Input::ActuatorVelocity, (*actuator_velocity_m_s).into())?;
        let base_velocity = check::finite(Input::BaseVelocity, base.velocity.to_array())?;
        let (b, p) = arrays(base, &PlatformState::at_rest(*platform));
        self.check_poses(&b, &p)?;
        let mut jacobian_dp = [[T::zero(); 6]; 6];
        let mut jacobian_db = jacobian_dp;
        self.model.jacobian_dp(&b.position, &b.rotation, &p.position, &p.rotation, &mut jacobian_dp);
        self.model.jacobian_db(&b.position, &b.rotation, &p.position, &p.rotation, &mut jacobian_db);
        let mut right = rates;
        for (sum, row) in right.iter_mut().zip(&jacobian_db) {
            for (entry, speed) in row.iter().zip(&base_velocity) {
                *sum += *entry * *speed;
            }
        }
        let velocity = check::twist_of_rates(&jacobian_dp, &right)?;
        check::finite_result(velocity.all_finite())?;
        Ok(Twist::from_rows(&velocity))
    }
}
