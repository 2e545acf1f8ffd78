//! Forward kinematics: the platform's pose from the lengths of the six actuators, its velocity from their
//! rates.
//!
//! Newton's method on the poses themselves: `J_dp delta = d - d(pose)` gives a twist, and the pose moves by it
//! (position by its linear part, orientation by the Cayley transform of its angular part, a rotation without
//! trigonometry). The last step keeps the Jacobian of the one before where that is near enough. Steps that leave the
//! workspace or bring the lengths no nearer are halved. Work is bounded:
//! [`MAX_ITERATIONS`] steps, each halved [`MAX_HALVINGS`] times at most.

use nalgebra::{Matrix3, Rotation3, Vector3, Vector6};

use crate::arrays::{AllFinite, FromRows, halves, rotation_rows};
use crate::blocks::Blocks;
use crate::check;
use crate::error::{Error, Input};
use crate::float::sqrt;
use crate::hexapod::{Hexapod, PoseArrays, checked_pose};
use crate::kernels;
use crate::real::Real;
use crate::state::{BaseMotion, PlatformState, Pose, Twist};

/// Most Newton steps of one call.
pub const MAX_ITERATIONS: u32 = 30;
/// Most times that a step is halved.
pub const MAX_HALVINGS: u32 = 8;
/// Largest angle of one step, rad; larger ones are shortened.
const MAX_TURN_RAD: f64 = 0.5;

/// A pose with given actuator lengths.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct ForwardKinematics<T: Real = f64> {
    /// Pose of the platform, O.
    pub pose: Pose<T>,
    /// Newton steps that led there.
    pub iterations: u32,
    /// Largest difference between a length given and a length at the pose, m; at most
    /// [`Real::LENGTH_RESIDUAL_M`].
    pub residual_m: T,
}

/// Actuators at a pose, seen from the lengths that are wanted.
struct Actuators<T> {
    jacobian_dp: [[T; 6]; 6],
    /// Wanted less present lengths, m.
    missing: [T; 6],
    /// Largest of them, m.
    residual: T,
}

/// What the last step leaves to the next.
struct LastStep<T> {
    /// The Jacobian that it was made with, where it is one for blocks.
    blocks: Option<Blocks<T>>,
    /// Largest missing length before it, m; 0 before the first step.
    residual: T,
}

impl<T: Real> Actuators<T> {
    /// To be filled in.
    fn none() -> Self {
        Self { jacobian_dp: [[T::zero(); 6]; 6], missing: [T::zero(); 6], residual: T::zero() }
    }
}

impl<M: kernels::RodAlignment<T>, T: Real> Hexapod<M, T> {
    /// The pose of the platform at which the actuators have the lengths `actuator_length_m` (d, m), found from
    /// `start`, both poses in O. `base` is the base's pose.
    ///
    /// Six lengths have several poses; the one found is, near enough, the one that belongs to `start`: the last
    /// pose in a loop, the base's pose composed with the platform's home at switch-on. `docs/control.md` shows
    /// from how far the paper's platform finds its pose.
    ///
    /// # Errors
    /// See [`Hexapod`] for poses and lengths that are refused. [`Error::OutOfReach`] or
    /// [`Error::RodPerpendicular`] where the start, or every pose towards the lengths, is out of this leg's reach;
    /// [`Error::SingularJacobian`] where the legs at a pose on the way determine no step;
    /// [`Error::NoConvergence`] otherwise.
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
        checked_pose(base, Input::BasePosition, Input::BaseRotation)?;
        checked_pose(start, Input::PlatformPosition, Input::PlatformRotation)?;
        // Lengths depend on the relative pose alone; a base far from O's origin costs no digits this way.
        let to_base = base.rotation.transpose();
        let mut pose = Pose {
            position_m: to_base * (start.position_m - base.position_m),
            rotation: to_base * start.rotation,
        };
        let mut actuators = Actuators::none();
        self.actuators(&pose, &lengths, &mut actuators)?;
        let mut last = LastStep { blocks: None, residual: T::zero() };
        let mut iterations = 0;
        while actuators.residual > T::LENGTH_RESIDUAL_M {
            if iterations == MAX_ITERATIONS {
                return Err(no_convergence(iterations, actuators.residual));
            }
            self.step(&mut pose, &mut actuators, &lengths, &mut last, iterations)?;
            iterations += 1;
        }
        pose.rotation = orthonormalised(&pose.rotation);
        Ok(ForwardKinematics { pose: base.compose(&pose), iterations, residual_m: actuators.residual })
    }

    /// One Newton step, halved until it leads to a better pose, with the actuators there.
    fn step(
        &self,
        pose: &mut Pose<T>,
        actuators: &mut Actuators<T>,
        lengths: &[T; 6],
        last: &mut LastStep<T>,
        iterations: u32,
    ) -> Result<(), Error>
    where
        M: kernels::ActuatorGeometry<T>,
    {
        let (from, residual) = (*pose, actuators.residual);
        // A step from r_0 to r_1 was wrong by r_1 = c r_0^2; with the same Jacobian the next is by 2 c r_0 r_1.
        let is_last = T::constant(4.0) * residual * residual < T::LENGTH_RESIDUAL_M * last.residual;
        if !is_last {
            last.blocks = Blocks::of(&actuators.jacobian_dp);
        }
        last.residual = residual;
        let (linear, angular) = halves(&match &last.blocks {
            Some(blocks) => blocks.solve(&actuators.missing),
            None => check::twist_of_rates(&actuators.jacobian_dp, &actuators.missing)?,
        });
        let turn_squared = angular.norm_squared();
        let most = T::constant(MAX_TURN_RAD);
        let mut share = if turn_squared > most * most { most / sqrt(turn_squared) } else { T::one() };
        let mut refusal = None;
        for _ in 0..=MAX_HALVINGS {
            *pose = Pose {
                position_m: from.position_m + linear * share,
                rotation: cayley(&(angular * share)) * from.rotation,
            };
            match self.actuators(pose, lengths, actuators) {
                Ok(()) if actuators.residual < residual => return Ok(()),
                Ok(()) => refusal = None,
                Err(reason) => refusal = Some(reason),
            }
            share *= T::constant(0.5);
        }
        Err(refusal.unwrap_or(no_convergence(iterations, residual)))
    }

    /// The actuators at a pose relative to the base.
    fn actuators(
        &self,
        relative: &Pose<T>,
        lengths: &[T; 6],
        actuators: &mut Actuators<T>,
    ) -> Result<(), Error>
    where
        M: kernels::ActuatorGeometry<T>,
    {
        let (zero, one) = (T::zero(), T::one());
        let base = PoseArrays {
            position: [zero; 3],
            rotation: [[one, zero, zero], [zero, one, zero], [zero, zero, one]],
        };
        let position = relative.position_m.into();
        let mut rod_alignment = [zero; 6];
        self.model.actuator_geometry(
            &base.position,
            &base.rotation,
            &position,
            &rotation_rows(&relative.rotation),
            &mut rod_alignment,
            &mut actuators.missing,
            &mut actuators.jacobian_dp,
        );
        check::in_reach(&rod_alignment, &base.position, &position)?;
        let (mut largest, mut sum) = (zero, zero);
        for (length, wanted) in actuators.missing.iter_mut().zip(lengths) {
            *length = *wanted - *length;
            largest = largest.max(length.abs());
            sum += length.abs();
        }
        actuators.residual = largest;
        // `max` drops what is not a number, a sum does not. In reach J_dp is finite; were it not, no step would come of it.
        if sum.is_finite() { Ok(()) } else { Err(Error::NonFiniteResult) }
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
        let (b, p) = self.poses(base, &PlatformState::at_rest(*platform))?;
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

fn no_convergence<T: Real>(iterations: u32, residual: T) -> Error {
    Error::NoConvergence { iterations, residual_m: residual.to_f64() }
}

/// A rotation about `angle` (rad) that agrees with the exponential to third order: exactly orthonormal, and no
/// trigonometry.
fn cayley<T: Real>(angle: &Vector3<T>) -> Rotation3<T> {
    let [x, y, z]: [T; 3] = (angle * T::constant(0.5)).into();
    let (one, two) = (T::one(), T::constant(2.0));
    let s = two / (one + x * x + y * y + z * z);
    #[rustfmt::skip]
    let matrix = Matrix3::new(
        one - s * (y * y + z * z), s * (x * y - z),           s * (x * z + y),
        s * (x * y + z),           one - s * (x * x + z * z), s * (y * z - x),
        s * (x * z - y),           s * (y * z + x),           one - s * (x * x + y * y),
    );
    Rotation3::from_matrix_unchecked(matrix)
}

/// One step of Newton's method towards the nearest rotation: takes out what rounding, and a start that was
/// rounded itself, have put in, so that poses may be passed on from call to call for ever.
fn orthonormalised<T: Real>(rotation: &Rotation3<T>) -> Rotation3<T> {
    let r = rotation.matrix();
    let correction = Matrix3::identity() * T::constant(1.5) - r.transpose() * r * T::constant(0.5);
    Rotation3::from_matrix_unchecked(r * correction)
}
