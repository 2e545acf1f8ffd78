//! The model behind checked calls; the calls themselves stand in one file per service.

use crate::arrays::rotation_rows;
use crate::check;
use crate::error::{Error, Input};
use crate::kernels::RodAlignment;
use crate::state::{BaseMotion, PlatformState, Pose};

/// A hexapod: a model ([`models`](crate::models), or your own generated one) with checked, typed calls.
///
/// Every call takes the motion of the base and the state of the platform, whichever part of them it depends
/// on (each method says so), and returns its whole result by value or an [`Error`]; nothing is half-written.
/// Every call refuses
///
/// - inputs that it depends on and that are not finite: [`Error::NonFinite`];
/// - matrices that are not rotations, beyond [`MAX_ROTATION_DEVIATION`](crate::MAX_ROTATION_DEVIATION):
///   [`Error::NotARotation`];
/// - poses out of a leg's reach: [`Error::OutOfReach`];
/// - rods perpendicular to their actuators, below [`MIN_ROD_ALIGNMENT`](crate::MIN_ROD_ALIGNMENT):
///   [`Error::RodPerpendicular`];
/// - results that are not finite: [`Error::NonFiniteResult`].
///
/// [`inverse_dynamics`](Self::inverse_dynamics), the one call that inverts J_dp, refuses
/// [`Error::SingularJacobian`] as well; forward dynamics inverts M_p, which is positive definite in every
/// pose. Not checked: stroke, rate and force limits, and whether numbers are in SI units.
///
/// Unchecked, the same functions are the traits in [`kernels`](crate::kernels), on plain arrays: NaN or
/// infinities come out where a call here would refuse.
#[derive(Clone, Copy, Debug)]
pub struct Hexapod<M> {
    /// The generated functions, with their parameters if those are given at run time.
    pub model: M,
}

/// Poses as generated functions take them.
pub(crate) struct Poses {
    pub base_position: [f64; 3],
    pub base_rotation: [[f64; 3]; 3],
    pub platform_position: [f64; 3],
    pub platform_rotation: [[f64; 3]; 3],
}

/// Poses and velocities as generated functions take them.
pub(crate) struct States {
    pub base_position: [f64; 3],
    pub base_rotation: [[f64; 3]; 3],
    pub base_velocity: [f64; 6],
    pub platform_position: [f64; 3],
    pub platform_rotation: [[f64; 3]; 3],
    pub platform_velocity: [f64; 6],
}

impl<M> Hexapod<M> {
    /// A hexapod of this model.
    pub fn new(model: M) -> Self {
        Self { model }
    }
}

impl<M: RodAlignment> Hexapod<M> {
    /// `(u.a)^2` of the poses, whatever its value.
    pub(crate) fn alignment_at(&self, poses: &Poses) -> [f64; 6] {
        let mut rod_alignment = [0.0; 6];
        self.model.rod_alignment(
            &poses.base_position,
            &poses.base_rotation,
            &poses.platform_position,
            &poses.platform_rotation,
            &mut rod_alignment,
        );
        rod_alignment
    }

    /// Finite poses in reach of every leg.
    pub(crate) fn poses(&self, base: &BaseMotion, platform: &PlatformState) -> Result<Poses, Error> {
        let poses = Poses::checked(&base.pose, &platform.pose)?;
        check::reach(&self.alignment_at(&poses))?;
        Ok(poses)
    }

    /// Finite poses in reach of every leg, and finite velocities.
    pub(crate) fn states(&self, base: &BaseMotion, platform: &PlatformState) -> Result<States, Error> {
        let base_velocity = check::finite(Input::BaseVelocity, base.velocity.to_array())?;
        let platform_velocity = check::finite(Input::PlatformVelocity, platform.velocity.to_array())?;
        let Poses { base_position, base_rotation, platform_position, platform_rotation } =
            self.poses(base, platform)?;
        Ok(States {
            base_position,
            base_rotation,
            base_velocity,
            platform_position,
            platform_rotation,
            platform_velocity,
        })
    }
}

impl Poses {
    /// Finite, with rotations that are rotations; reach is not looked at.
    pub(crate) fn checked(base: &Pose, platform: &Pose) -> Result<Self, Error> {
        Ok(Self {
            base_position: check::finite(Input::BasePosition, base.position_m.into())?,
            base_rotation: checked_rotation(Input::BaseRotation, base)?,
            platform_position: check::finite(Input::PlatformPosition, platform.position_m.into())?,
            platform_rotation: checked_rotation(Input::PlatformRotation, platform)?,
        })
    }
}

fn checked_rotation(input: Input, pose: &Pose) -> Result<[[f64; 3]; 3], Error> {
    let rows = check::finite(input, rotation_rows(&pose.rotation))?;
    match check::rotation_defect(pose.rotation.matrix()) {
        None => Ok(rows),
        Some(defect) => Err(Error::NotARotation { input, defect }),
    }
}
