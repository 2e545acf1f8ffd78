//! The model behind checked calls; the calls themselves stand in one file per service.

use core::marker::PhantomData;

use nalgebra::Matrix3;

use crate::arrays::{AllFinite, rotation_rows};
use crate::check;
use crate::error::{Error, Input};
use crate::kernels::{ActuatorGeometry, RodAlignment};
use crate::real::Real;
use crate::state::{BaseMotion, PlatformState, Pose};

/// A hexapod: a model ([`models`](crate::models), or your own generated one) with checked, typed calls.
///
/// Every call takes the motion of the base and the state of the platform, whichever part of them it depends
/// on (each method says so), and returns its whole result by value or an [`Error`]; nothing is half-written.
/// Every call refuses
///
/// - models whose parameters give a leg no finite alignment, such as a rod without length or a point left at
///   NaN: [`Error::InvalidModel`];
/// - inputs that it depends on and that are not finite: [`Error::NonFinite`];
/// - matrices that are not rotations, beyond [`Real::MAX_ROTATION_DEVIATION`]:
///   [`Error::NotARotation`];
/// - poses out of a leg's reach: [`Error::OutOfReach`];
/// - rods perpendicular to their actuators, below [`Real::MIN_ROD_ALIGNMENT`]:
///   [`Error::RodPerpendicular`];
/// - results that are not finite: [`Error::NonFiniteResult`].
///
/// Calls that invert J_dp refuse [`Error::SingularJacobian`] as well: [`inverse_dynamics`](Self::inverse_dynamics),
/// [`passive_inverse_dynamics`](Self::passive_inverse_dynamics), [`control`](Self::control),
/// [`platform_velocity`](Self::platform_velocity) and [`forward_kinematics`](Self::forward_kinematics). Forward dynamics inverts
/// M_p, which is positive definite in every pose. Not checked: whether numbers are in SI units, and stroke, rate and force, which
/// [`monitor`](Self::monitor) compares with limits.
///
/// # What a model must contain
///
/// A model may be generated with some of the functions only. Every call checks reach, so all methods need
/// `rod_alignment` ([`RodAlignment`]). Most need the function of their own name besides ([`bias`](Self::bias)
/// needs [`Bias`](crate::kernels::Bias), and so on). The others:
///
/// | method | functions besides `rod_alignment` |
/// |-|-|
/// | [`inverse_dynamics`](Self::inverse_dynamics), [`passive_inverse_dynamics`](Self::passive_inverse_dynamics) | that of its name, `actuator_geometry` |
/// | [`forward_kinematics`](Self::forward_kinematics) | `actuator_geometry` |
/// | [`platform_velocity`](Self::platform_velocity) | `jacobian_dp`, `jacobian_db` |
/// | [`monitor`](Self::monitor) | `leg_kinematics`, `jacobian_dp` |
///
/// So forces alone take `rod_alignment,actuator_geometry,inverse_dynamics`. A function that is missing shows when
/// compiling, as a trait that is not implemented.
///
/// Unchecked, the same functions are the traits in [`kernels`](crate::kernels), on plain arrays. They refuse nothing, and
/// **what comes out where a call here would refuse may be finite**: see there.
///
/// # Precision
///
/// `T` is the number type of states and results, `f64` or `f32`. [`new`](Self::new) makes a hexapod in double precision,
/// [`single_precision`](Hexapod::single_precision) one in single precision, whose model must implement the
/// kernel traits for `f32`: the committed ones do, your own with `--scalar f32` (or both, `--scalar f64,f32`).
#[derive(Clone, Copy, Debug)]
pub struct Hexapod<M, T = f64> {
    /// The generated functions, with their parameters if those are given at run time.
    pub model: M,
    number: PhantomData<T>,
}

/// A body's pose and velocity as generated functions take them.
///
/// Made once and judged where it lies: an array that is copied just before it is read into registers has to be waited for,
/// which costs more than the judgement.
pub(crate) struct StateArrays<T> {
    pub position: [T; 3],
    pub rotation: [[T; 3]; 3],
    pub velocity: [T; 6],
}

impl<M> Hexapod<M> {
    /// A hexapod of this model, in double precision.
    pub fn new(model: M) -> Self {
        Self { model, number: PhantomData }
    }
}

impl<M> Hexapod<M, f32> {
    /// A hexapod of this model, in single precision.
    ///
    /// ```
    /// use dyn_runtime::{Acceleration, BaseMotion, Hexapod, PlatformState, Pose, Wrench};
    /// use dyn_runtime::{models::Uhp2016, nalgebra::Vector3};
    ///
    /// let hexapod = Hexapod::single_precision(Uhp2016);
    /// let base = BaseMotion::at_rest(Pose::identity());
    /// let home = Pose::from_paper_angles(Vector3::new(0.0, 0.0, 0.382), [0.0; 3]);
    /// let platform = PlatformState::at_rest(home);
    /// let forces = hexapod.inverse_dynamics(&base, &platform, &Acceleration::zero(), &Wrench::zero())?;
    /// let first: f32 = forces[0];
    /// assert!((first - 30.5).abs() < 0.1);
    /// # Ok::<(), dyn_runtime::Error>(())
    /// ```
    pub fn single_precision(model: M) -> Self {
        Self { model, number: PhantomData }
    }
}

impl<M: RodAlignment<T>, T: Real> Hexapod<M, T> {
    /// `(u.a)^2` at these poses, whatever its value.
    pub(crate) fn alignment_at(
        &self,
        base: &StateArrays<T>,
        platform: &StateArrays<T>,
    ) -> Result<[T; 6], Error> {
        let rod_alignment = unjudged_alignment(&self.model, base, platform);
        check::mechanism(&rod_alignment, &base.position, &platform.position)?;
        Ok(rod_alignment)
    }

    /// Poses of base and platform are finite, and in reach of every leg.
    #[inline(always)]
    pub(crate) fn check_poses(&self, base: &StateArrays<T>, platform: &StateArrays<T>) -> Result<(), Error> {
        check_poses_apart(base, platform)?;
        check::in_reach(&unjudged_alignment(&self.model, base, platform), &base.position, &platform.position)
    }

    /// Poses and velocities of base and platform are finite, and in reach of every leg.
    #[inline(always)]
    pub(crate) fn check_states(&self, base: &StateArrays<T>, platform: &StateArrays<T>) -> Result<(), Error> {
        check_velocities(base, platform)?;
        self.check_poses(base, platform)
    }

    /// [`check_states`](Self::check_states), and J_dp can be inverted.
    #[inline(always)]
    pub(crate) fn check_determinate(
        &self,
        base: &StateArrays<T>,
        platform: &StateArrays<T>,
    ) -> Result<(), Error>
    where
        M: ActuatorGeometry<T>,
    {
        check_velocities(base, platform)?;
        check_poses_apart(base, platform)?;
        let (mut rod_alignment, mut length) = ([T::zero(); 6], [T::zero(); 6]);
        let mut jacobian_dp = [[T::zero(); 6]; 6];
        self.model.actuator_geometry(
            &base.position,
            &base.rotation,
            &platform.position,
            &platform.rotation,
            &mut rod_alignment,
            &mut length,
            &mut jacobian_dp,
        );
        check::in_reach(&rod_alignment, &base.position, &platform.position)?;
        check::invertible(&jacobian_dp)
    }
}

/// `(u.a)^2` of a model at these poses, whatever its value.
#[inline]
pub(crate) fn unjudged_alignment<M: RodAlignment<T>, T: Real>(
    model: &M,
    base: &StateArrays<T>,
    platform: &StateArrays<T>,
) -> [T; 6] {
    let mut rod_alignment = [T::zero(); 6];
    model.rod_alignment(
        &base.position,
        &base.rotation,
        &platform.position,
        &platform.rotation,
        &mut rod_alignment,
    );
    rod_alignment
}

impl<T: Real> StateArrays<T> {
    /// At rest.
    #[inline(always)]
    pub fn at(pose: &Pose<T>) -> Self {
        Self {
            position: pose.position_m.into(),
            rotation: rotation_rows(&pose.rotation),
            velocity: [T::zero(); 6],
        }
    }
}

/// Poses and velocities of base and platform. Nothing is looked at.
#[inline(always)]
pub(crate) fn arrays<T: Real>(
    base: &BaseMotion<T>,
    platform: &PlatformState<T>,
) -> (StateArrays<T>, StateArrays<T>) {
    (
        StateArrays { velocity: base.velocity.to_array(), ..StateArrays::at(&base.pose) },
        StateArrays { velocity: platform.velocity.to_array(), ..StateArrays::at(&platform.pose) },
    )
}

#[inline(always)]
fn check_velocities<T: Real>(base: &StateArrays<T>, platform: &StateArrays<T>) -> Result<(), Error> {
    check::finite(Input::BaseVelocity, base.velocity)?;
    check::finite(Input::PlatformVelocity, platform.velocity)?;
    Ok(())
}

/// [`check_poses`] as a call: among the checks of a whole state it is faster apart.
#[inline(never)]
fn check_poses_apart<T: Real>(base: &StateArrays<T>, platform: &StateArrays<T>) -> Result<(), Error> {
    check_poses(base, platform)
}

/// Poses are finite and rotations are rotations; reach is not looked at.
#[inline(always)]
pub(crate) fn check_poses<T: Real>(base: &StateArrays<T>, platform: &StateArrays<T>) -> Result<(), Error> {
    // Both at once: one branch is faster than four. What is not finite is no number here, and no comparison holds for it.
    let doubt = check::rotation_doubt(&base.rotation)
        + check::rotation_doubt(&platform.rotation)
        + (base.position.vanishing() + platform.position.vanishing());
    if doubt <= check::most_doubt() {
        return Ok(());
    }
    examine(base, Input::BasePosition, Input::BaseRotation)?;
    examine(platform, Input::PlatformPosition, Input::PlatformRotation)
}

/// What is wrong with a pose, if anything is.
#[cold]
fn examine<T: Real>(pose: &StateArrays<T>, position: Input, rotation: Input) -> Result<(), Error> {
    check::finite(position, pose.position)?;
    match check::rotation_defect(&Matrix3::from(pose.rotation).transpose()) {
        None => Ok(()),
        Some(defect) => {
            check::finite(rotation, pose.rotation)?;
            Err(Error::NotARotation { input: rotation, defect })
        }
    }
}
