//! Forward kinematics: the platform's pose from the lengths of the six actuators, its velocity from their
//! rates.
//!
//! Newton's method on the poses themselves: `J_dp delta = d - d(pose)` gives a twist, and the pose moves by it
//! (position by its linear part, orientation by the Cayley transform of its angular part, a rotation without
//! trigonometry). The last step keeps the Jacobian of the one before where that is near enough. Steps that leave the
//! workspace or bring the lengths no nearer are halved. Work is bounded:
//! [`MAX_ITERATIONS`] steps, each halved [`MAX_HALVINGS`] times at most.

use nalgebra::{Matrix3, Rotation3, Vector3, Vector6};

use crate::arrays::{AllFinite, FromRows};
use crate::blocks::{Blocks, difference, product};
use crate::check;
use crate::error::{Error, Input};
use crate::float::sqrt;
use crate::hexapod::{Hexapod, checked_poses};
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

/// A rotation, row by row, as generated functions take it.
type Rows<T> = [[T; 3]; 3];

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
        let (on_base, from) = checked_poses(base, start)?;
        // Seen from the base's origin, in axes of O: a base far from O's origin costs no digits this way.
        let mut position = difference(&from.position, &on_base.position);
        let mut rotation = from.rotation;
        let mut actuators = Actuators::none();
        self.actuators(&on_base.rotation, &position, &rotation, &lengths, &mut actuators)?;
        let mut last = LastStep { blocks: None, residual: T::zero() };
        let mut iterations = 0;
        while actuators.residual > T::LENGTH_RESIDUAL_M {
            if iterations == MAX_ITERATIONS {
                return Err(no_convergence(iterations, actuators.residual));
            }
            let place = (&mut position, &mut rotation);
            self.step(&on_base.rotation, place, &mut actuators, &lengths, &mut last, iterations)?;
            iterations += 1;
        }
        let pose = Pose {
            position_m: base.position_m + Vector3::from(position),
            rotation: orthonormalised(&rotation),
        };
        Ok(ForwardKinematics { pose, iterations, residual_m: actuators.residual })
    }

    /// One Newton step, halved until it leads to a better pose, with the actuators there.
    #[inline]
    fn step(
        &self,
        base_rotation: &Rows<T>,
        (position, rotation): (&mut [T; 3], &mut Rows<T>),
        actuators: &mut Actuators<T>,
        lengths: &[T; 6],
        last: &mut LastStep<T>,
        iterations: u32,
    ) -> Result<(), Error>
    where
        M: kernels::ActuatorGeometry<T>,
    {
        let (from, turned, residual) = (*position, *rotation, actuators.residual);
        // A step from r_0 to r_1 was wrong by r_1 = c r_0^2; with the same Jacobian the next is by 2 c r_0 r_1.
        let is_last = T::constant(4.0) * residual * residual < T::LENGTH_RESIDUAL_M * last.residual;
        if !is_last {
            last.blocks = Blocks::of(&actuators.jacobian_dp);
        }
        last.residual = residual;
        let [x, y, z, wx, wy, wz] = match &last.blocks {
            Some(blocks) => blocks.solve(&actuators.missing),
            None => check::twist_of_rates(&actuators.jacobian_dp, &actuators.missing)?,
        };
        let turn_squared = wx * wx + wy * wy + wz * wz;
        let most = T::constant(MAX_TURN_RAD);
        let mut share = if turn_squared > most * most { most / sqrt(turn_squared) } else { T::one() };
        let mut refusal = None;
        for _ in 0..=MAX_HALVINGS {
            *position = [from[0] + x * share, from[1] + y * share, from[2] + z * share];
            *rotation = turned_by(&[wx * share, wy * share, wz * share], &turned);
            match self.actuators(base_rotation, position, rotation, lengths, actuators) {
                Ok(()) if actuators.residual < residual => return Ok(()),
                Ok(()) => refusal = None,
                Err(reason) => refusal = Some(reason),
            }
            share *= T::constant(0.5);
        }
        Err(refusal.unwrap_or(no_convergence(iterations, residual)))
    }

    /// The actuators at a pose seen from the base's origin.
    #[inline]
    fn actuators(
        &self,
        base_rotation: &Rows<T>,
        position: &[T; 3],
        rotation: &Rows<T>,
        lengths: &[T; 6],
        actuators: &mut Actuators<T>,
    ) -> Result<(), Error>
    where
        M: kernels::ActuatorGeometry<T>,
    {
        let origin = [T::zero(); 3];
        let mut rod_alignment = [T::zero(); 6];
        self.model.actuator_geometry(
            &origin,
            base_rotation,
            position,
            rotation,
            &mut rod_alignment,
            &mut actuators.missing,
            &mut actuators.jacobian_dp,
        );
        check::in_reach(&rod_alignment, &origin, position)?;
        let (mut largest, mut sum) = (T::zero(), T::zero());
        for (length, wanted) in actuators.missing.iter_mut().zip(lengths) {
            *length = *wanted - *length;
            let size = length.abs();
            largest = if size > largest { size } else { largest };
            sum += size;
        }
        actuators.residual = largest;
        // No comparison holds for what is not a number, but a sum is none then. In reach J_dp is finite; were it not, no step
        // would come of it.
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

/// `rows`, turned by an angle (rad) about an axis through the origin: a rotation that agrees with the exponential to third
/// order, exactly orthonormal, without trigonometry.
#[inline]
fn turned_by<T: Real>(angle: &[T; 3], rows: &Rows<T>) -> Rows<T> {
    let (one, two, half) = (T::one(), T::constant(2.0), T::constant(0.5));
    let [x, y, z] = [angle[0] * half, angle[1] * half, angle[2] * half];
    let s = two / (one + x * x + y * y + z * z);
    #[rustfmt::skip]
    let cayley = [
        [one - s * (y * y + z * z), s * (x * y - z),           s * (x * z + y)],
        [s * (x * y + z),           one - s * (x * x + z * z), s * (y * z - x)],
        [s * (x * z - y),           s * (y * z + x),           one - s * (x * x + y * y)],
    ];
    product(&cayley, rows)
}

/// One step of Newton's method towards the nearest rotation: takes out what rounding, and a start that was
/// rounded itself, have put in, so that poses may be passed on from call to call for ever.
#[inline]
fn orthonormalised<T: Real>(rows: &Rows<T>) -> Rotation3<T> {
    let [[a, b, c], [d, e, f], [g, h, i]] = *rows;
    let (half, most) = (T::constant(0.5), T::constant(1.5));
    // 3/2 - R^T R/2, symmetric
    let (xx, yy, zz) = (a * a + d * d + g * g, b * b + e * e + h * h, c * c + f * f + i * i);
    let (xy, yz, zx) = (a * b + d * e + g * h, b * c + e * f + h * i, c * a + f * d + i * g);
    let (xx, yy, zz) = (most - half * xx, most - half * yy, most - half * zz);
    let (xy, yz, zx) = (-half * xy, -half * yz, -half * zx);
    let [[a, b, c], [d, e, f], [g, h, i]] = product(rows, &[[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]]);
    Rotation3::from_matrix_unchecked(Matrix3::new(a, b, c, d, e, f, g, h, i))
}
