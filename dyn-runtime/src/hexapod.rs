//! The model behind checked calls; the calls themselves stand in one file per service.

use core::marker::PhantomData;

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
/// [`inverse_dynamics`](Self::inverse_dynamics), the one call that inverts J_dp, refuses
/// [`Error::SingularJacobian`] as well; forward dynamics inverts M_p, which is positive definite in every
/// pose. Not checked: stroke, rate and force limits, and whether numbers are in SI units.
///
/// # What a model must contain
///
/// A model may be generated with some of the functions only. Every call checks reach, so all methods need
/// `rod_alignment` ([`RodAlignment`]). Each needs the function of its own name besides ([`bias`](Self::bias)
/// needs [`Bias`](crate::kernels::Bias), and so on), and [`inverse_dynamics`](Self::inverse_dynamics) also
/// `actuator_geometry`. So a controller by inverse dynamics takes `rod_alignment,actuator_geometry,inverse_dynamics`. A
/// function that is missing shows when compiling, as a trait that is not implemented.
///
/// Unchecked, the same functions are the traits in [`kernels`](crate::kernels), on plain arrays: NaN or
/// infinities come out where a call here would refuse.
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

/// A body's pose as generated functions take it.
pub(crate) struct PoseArrays<T> {
    pub position: [T; 3],
    pub rotation: [[T; 3]; 3],
}

/// A body's pose and velocity as generated functions take them.
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
        base: &PoseArrays<T>,
        platform: &PoseArrays<T>,
    ) -> Result<[T; 6], Error> {
        let rod_alignment = unjudged_alignment(&self.model, base, platform);
        check::mechanism(&rod_alignment, &base.position, &platform.position)?;
        Ok(rod_alignment)
    }

    /// Finite poses of base and platform, in reach of every leg.
    #[inline(always)]
    pub(crate) fn poses(
        &self,
        base: &BaseMotion<T>,
        platform: &PlatformState<T>,
    ) -> Result<(PoseArrays<T>, PoseArrays<T>), Error> {
        let (base, platform) = checked_poses(&base.pose, &platform.pose)?;
        check::in_reach(
            &unjudged_alignment(&self.model, &base, &platform),
            &base.position,
            &platform.position,
        )?;
        Ok((base, platform))
    }

    /// Finite poses and velocities of base and platform, in reach of every leg.
    #[inline(always)]
    pub(crate) fn states(
        &self,
        base: &BaseMotion<T>,
        platform: &PlatformState<T>,
    ) -> Result<(StateArrays<T>, StateArrays<T>), Error> {
        let base_velocity = check::finite(Input::BaseVelocity, base.velocity.to_array())?;
        let platform_velocity = check::finite(Input::PlatformVelocity, platform.velocity.to_array())?;
        let (base, platform) = self.poses(base, platform)?;
        Ok((base.moving(base_velocity), platform.moving(platform_velocity)))
    }

    /// [`states`](Self::states) in which J_dp can be inverted.
    #[inline(always)]
    pub(crate) fn determinate_states(
        &self,
        base: &BaseMotion<T>,
        platform: &PlatformState<T>,
    ) -> Result<(StateArrays<T>, StateArrays<T>), Error>
    where
        M: ActuatorGeometry<T>,
    {
        let base_velocity = check::finite(Input::BaseVelocity, base.velocity.to_array())?;
        let platform_velocity = check::finite(Input::PlatformVelocity, platform.velocity.to_array())?;
        let (base, platform) = checked_poses(&base.pose, &platform.pose)?;
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
        check::invertible(&jacobian_dp)?;
        Ok((base.moving(base_velocity), platform.moving(platform_velocity)))
    }
}

/// `(u.a)^2` of a model at these poses, whatever its value.
#[inline]
pub(crate) fn unjudged_alignment<M: RodAlignment<T>, T: Real>(
    model: &M,
    base: &PoseArrays<T>,
    platform: &PoseArrays<T>,
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

impl<T: Real> PoseArrays<T> {
    #[inline(always)]
    pub fn of(pose: &Pose<T>) -> Self {
        Self { position: pose.position_m.into(), rotation: rotation_rows(&pose.rotation) }
    }

    #[inline(always)]
    fn moving(self, velocity: [T; 6]) -> StateArrays<T> {
        StateArrays { position: self.position, rotation: self.rotation, velocity }
    }
}

/// Finite poses of base and platform, with rotations that are rotations; reach is not looked at.
#[inline(always)]
pub(crate) fn checked_poses<T: Real>(
    base: &Pose<T>,
    platform: &Pose<T>,
) -> Result<(PoseArrays<T>, PoseArrays<T>), Error> {
    check_poses(base, platform)?;
    Ok((PoseArrays::of(base), PoseArrays::of(platform)))
}

/// Judges without copying: arrays that are handed from call to call cost more than the judgement.
fn check_poses<T: Real>(base: &Pose<T>, platform: &Pose<T>) -> Result<(), Error> {
    // Both at once: one branch is faster than four. What is not finite is no number here, and no comparison holds for it.
    let [[p, q, r]]: [[T; 3]; 1] = base.position_m.into();
    let [[s, t, u]]: [[T; 3]; 1] = platform.position_m.into();
    let doubt = check::rotation_doubt(base.rotation.matrix())
        + check::rotation_doubt(platform.rotation.matrix())
        + [p, q, r, s, t, u].vanishing();
    if doubt <= check::most_doubt() {
        return Ok(());
    }
    examine(base, Input::BasePosition, Input::BaseRotation)?;
    examine(platform, Input::PlatformPosition, Input::PlatformRotation)
}

/// What is wrong with a pose, if anything is.
#[cold]
fn examine<T: Real>(pose: &Pose<T>, position: Input, rotation: Input) -> Result<(), Error> {
    let arrays = PoseArrays::of(pose);
    check::finite(position, arrays.position)?;
    match check::rotation_defect(pose.rotation.matrix()) {
        None => Ok(()),
        Some(defect) => {
            check::finite(rotation, arrays.rotation)?;
            Err(Error::NotARotation { input: rotation, defect })
        }
    }
}
