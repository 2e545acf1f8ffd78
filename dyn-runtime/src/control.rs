//! What a controller asks of a model: all of it in one call, and forces for passivity-based control.
//!
//! With the platform's pose and velocity and a commanded acceleration `a_c` (the reference's, plus gains on
//! the errors of pose and velocity), **computed torque** is [`Hexapod::inverse_dynamics`] at `a_c`: under its
//! forces the platform accelerates with `a_c` exactly. [`Hexapod::control`] gives the same forces together
//! with whatever else a controller needs. [`Hexapod::passive_inverse_dynamics`] does not cancel the velocity
//! terms but uses them.

use nalgebra::{Matrix6, Vector6};

use crate::arrays::{AllFinite, FromRows};
use crate::check::{finite, finite_result, invertible};
use crate::error::{Error, Input};
use crate::evaluate::evaluate;
use crate::hexapod::{Hexapod, arrays};
use crate::kernels;
use crate::real::Real;
use crate::state::{Acceleration, BaseMotion, PlatformState, Twist, Wrench};

/// What a controller needs in every cycle, from one shared evaluation; O axes.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Control<T = f64> {
    /// d, m (18).
    pub actuator_length_m: Vector6<T>,
    /// d', m/s (30).
    pub actuator_velocity_m_s: Vector6<T>,
    /// J_dp, as [`Hexapod::jacobian_dp`] gives it.
    pub jacobian_dp: Matrix6<T>,
    /// M_p, as [`Hexapod::mass_matrix_p`] gives it.
    pub mass_matrix_p: Matrix6<T>,
    /// `bias - M_b v_b'`, N and N m: all of (49) that does not depend on commands,
    /// `M_p v_p' + total_bias = J_dp^T F + W_ext`. With a base that does not accelerate it is
    /// [`Hexapod::bias`].
    pub total_bias: Vector6<T>,
    /// F, N, as [`Hexapod::inverse_dynamics`] gives it.
    pub inverse_dynamics_n: Vector6<T>,
}

impl<M: kernels::RodAlignment<T>, T: Real> Hexapod<M, T> {
    /// Lengths, rates, J_dp, M_p, total bias and the forces F for `platform_acceleration`, in one call of about
    /// 1.6 times the operations of inverse dynamics alone (18), (30), (32), (49). Depends on poses, velocities and
    /// accelerations of both bodies and on the external wrench.
    ///
    /// # Errors
    /// See [`Hexapod`]; besides, [`Error::SingularJacobian`].
    ///
    /// ```
    /// use dyn_runtime::nalgebra::Vector3;
    /// use dyn_runtime::{Acceleration, BaseMotion, Hexapod, PlatformState, Pose, Wrench, models::Uhp2016};
    ///
    /// let base = BaseMotion::at_rest(Pose::identity());
    /// let home = Pose::from_paper_angles(Vector3::new(0.0, 0.0, 0.382), [0.0; 3]);
    /// let platform = PlatformState::at_rest(home);
    /// let commanded = Acceleration { linear_m_s2: Vector3::new(0.0, 0.0, 0.5), ..Acceleration::zero() };
    /// let control = Hexapod::new(Uhp2016).control(&base, &platform, &commanded, &Wrench::zero())?;
    /// // The forces are those that the bundle's own matrices ask for.
    /// let left = control.mass_matrix_p * commanded.to_vector() + control.total_bias;
    /// let right = control.jacobian_dp.transpose() * control.inverse_dynamics_n;
    /// assert!((left - right).amax() < 1e-10);
    /// # Ok::<(), dyn_runtime::Error>(())
    /// ```
    pub fn control(
        &self,
        base: &BaseMotion<T>,
        platform: &PlatformState<T>,
        platform_acceleration: &Acceleration<T>,
        external_wrench: &Wrench<T>,
    ) -> Result<Control<T>, Error>
    where
        M: kernels::Control<T>,
    {
        let base_acceleration = finite(Input::BaseAcceleration, base.acceleration.to_array())?;
        let platform_acceleration = finite(Input::PlatformAcceleration, platform_acceleration.to_array())?;
        let external_wrench = finite(Input::ExternalWrench, external_wrench.to_array())?;
        let (b, p) = arrays(base, platform);
        self.check_states(&b, &p)?;
        let [mut lengths, mut velocities, mut total_bias, mut forces] = [[T::zero(); 6]; 4];
        let [mut jacobian_dp, mut mass_matrix_p] = [[[T::zero(); 6]; 6]; 2];
        self.model.control(
            &b.position,
            &b.rotation,
            &b.velocity,
            &base_acceleration,
            &p.position,
            &p.rotation,
            &p.velocity,
            &platform_acceleration,
            &external_wrench,
            &mut lengths,
            &mut velocities,
            &mut jacobian_dp,
            &mut mass_matrix_p,
            &mut total_bias,
            &mut forces,
        );
        // J_dp is at hand, and says better than huge numbers what is wrong.
        invertible(&jacobian_dp)?;
        let vectors_are_finite = [lengths, velocities, total_bias, forces].all_finite();
        finite_result(vectors_are_finite & jacobian_dp.all_finite() & mass_matrix_p.all_finite())?;
        Ok(Control {
            actuator_length_m: FromRows::from_rows(&lengths),
            actuator_velocity_m_s: FromRows::from_rows(&velocities),
            jacobian_dp: FromRows::from_rows(&jacobian_dp),
            mass_matrix_p: FromRows::from_rows(&mass_matrix_p),
            total_bias: FromRows::from_rows(&total_bias),
            inverse_dynamics_n: FromRows::from_rows(&forces),
        })
    }

    /// F, N, at reference velocity `v_r` and reference acceleration `a_r` (Slotine and Li): the solution of
    ///
    /// ```text
    /// J_dp^T F = M_p a_r + C_p v_r - C_b v_b - M_b v_b' + gravity, springs, dampers - W_ext
    /// ```
    ///
    /// with the natural factorisation C_p, for which `M_p' - 2 C_p` is skew-symmetric. Springs and dampers act
    /// as they stand, at the actual lengths and rates. No matrix is formed. With `v_r = v_p` it is
    /// [`inverse_dynamics`](Self::inverse_dynamics).
    ///
    /// With `s = v_p - v_r`, forces `F - J_dp^-T K s` (the controller's share, as a wrench `-K s` on the
    /// platform: `J_dp^T F_s = -K s`) leave `M_p s' + C_p s = -K s`, in which `s^T M_p s` falls at the rate
    /// `2 s^T K s` for any positive definite K. `v_r` is made of twists (`r'` and angular velocity in O), not of
    /// rates of angles. Depends on everything that inverse dynamics depends on.
    ///
    /// # Errors
    /// See [`Hexapod`]; besides, [`Error::SingularJacobian`].
    ///
    /// ```
    /// use dyn_runtime::nalgebra::{Matrix6, Vector3, Vector6};
    /// use dyn_runtime::{Acceleration, BaseMotion, Hexapod, PlatformState, Pose, Twist, Wrench, models::Uhp2016};
    ///
    /// let hexapod = Hexapod::new(Uhp2016);
    /// let base = BaseMotion::at_rest(Pose::identity());
    /// let home = Pose::from_paper_angles(Vector3::new(0.0, 0.0, 0.382), [0.0; 3]);
    /// let velocity = Twist { linear_m_s: Vector3::new(0.01, 0.0, 0.0), angular_rad_s: Vector3::new(0.0, 0.0, 0.1) };
    /// let platform = PlatformState { pose: home, velocity };
    /// // The reference stands still, so that s is the platform's velocity.
    /// let (rest, none) = (Acceleration::zero(), Wrench::zero());
    /// let feed_forward =
    ///     hexapod.passive_inverse_dynamics(&base, &platform, &Twist::zero(), &rest, &none)?;
    /// let gain = Matrix6::from_diagonal(&Vector6::new(900.0, 900.0, 900.0, 20.0, 20.0, 20.0));
    /// let s = velocity.to_vector();
    /// let wrench = -gain * s;
    /// let jacobian_dp = hexapod.jacobian_dp(&base, &platform)?;
    /// let share = jacobian_dp.transpose().lu().solve(&wrench).expect("J_dp is regular at home");
    /// let there = hexapod.forward_dynamics(&base, &platform, &(feed_forward + share), &none)?;
    /// // The energy of the error falls: at the rate 2 s^T K s, as C_p's part of its change is without power.
    /// let masses = hexapod.mass_matrix_p(&base, &platform)?;
    /// let coriolis = hexapod.coriolis_matrices(&base, &platform)?.coriolis_matrix_p;
    /// let left = masses * there.to_vector() + coriolis * s;
    /// assert!((left - wrench).amax() < 1e-9 * wrench.amax() && s.dot(&wrench) < 0.0);
    /// # Ok::<(), dyn_runtime::Error>(())
    /// ```
    pub fn passive_inverse_dynamics(
        &self,
        base: &BaseMotion<T>,
        platform: &PlatformState<T>,
        reference_velocity: &Twist<T>,
        reference_acceleration: &Acceleration<T>,
        external_wrench: &Wrench<T>,
    ) -> Result<Vector6<T>, Error>
    where
        M: kernels::PassiveInverseDynamics<T> + kernels::ActuatorGeometry<T>,
    {
        let base_acceleration = finite(Input::BaseAcceleration, base.acceleration.to_array())?;
        let reference_velocity = finite(Input::ReferenceVelocity, reference_velocity.to_array())?;
        let acceleration = finite(Input::PlatformAcceleration, reference_acceleration.to_array())?;
        let external_wrench = finite(Input::ExternalWrench, external_wrench.to_array())?;
        let (b, p) = arrays(base, platform);
        self.check_determinate(&b, &p)?;
        evaluate!(self.model.passive_inverse_dynamics(
            b.position, b.rotation, b.velocity, base_acceleration,
            p.position, p.rotation, p.velocity, acceleration, reference_velocity,
            external_wrench,
        ) -> forces)
    }
}
