//! The states of a batch in lanes, and what is wrong with one.

use super::{Column, LengthError, Status};
use crate::arrays::rotation_rows;
use crate::check;
use crate::error::{Error, Input};
use crate::hexapod::{StateArrays, check_poses, unjudged_alignment};
use crate::kernels::{JacobianDp, RodAlignment, generic};
use crate::lanes::{InLanes, Lanes, Number};
use crate::real::Real;
use crate::state::BaseMotion;

use super::column::all_lanes;

/// Motion of the base and state of the platform, of many states.
#[derive(Clone, Copy, Debug)]
pub struct States<'a, S> {
    /// The base.
    pub base: BaseColumns<'a, S>,
    /// The platform.
    pub platform: PlatformColumns<'a, S>,
}

/// Motion of the base of many states, SI units, O axes; see [`BaseMotion`](crate::BaseMotion).
#[derive(Clone, Copy, Debug)]
pub struct BaseColumns<'a, S> {
    /// Origin of B, m.
    pub position: Column<'a, S, 3>,
    /// B to O, row by row.
    pub rotation: Column<'a, S, 9>,
    /// `[r'; w]`, m/s and rad/s.
    pub velocity: Column<'a, S, 6>,
    /// `[r''; w']`, m/s^2 and rad/s^2.
    pub acceleration: Column<'a, S, 6>,
}

/// Platforms of many states, SI units, O axes; see [`PlatformState`](crate::PlatformState).
#[derive(Clone, Copy, Debug)]
pub struct PlatformColumns<'a, S> {
    /// Origin of P, m.
    pub position: Column<'a, S, 3>,
    /// P to O, row by row.
    pub rotation: Column<'a, S, 9>,
    /// `[r'; w]`, m/s and rad/s.
    pub velocity: Column<'a, S, 6>,
}

/// A base in lanes.
#[derive(Clone, Copy)]
pub(super) struct BaseLanes<T> {
    pub position: [T; 3],
    pub rotation: [[T; 3]; 3],
    pub velocity: [T; 6],
    pub acceleration: [T; 6],
}

/// A platform in lanes.
#[derive(Clone, Copy)]
pub(super) struct PlatformLanes<T> {
    pub position: [T; 3],
    pub rotation: [[T; 3]; 3],
    pub velocity: [T; 6],
}

impl<S: Number> BaseColumns<'_, S> {
    /// The same for every state.
    pub fn same(base: &BaseMotion<S>) -> Self {
        Self {
            position: Column::same(base.pose.position_m.into()),
            rotation: Column::same(flat(rotation_rows(&base.pose.rotation))),
            velocity: Column::same(base.velocity.to_array()),
            acceleration: Column::same(base.acceleration.to_array()),
        }
    }

    pub(super) fn check(&self, states: usize) -> Result<(), LengthError> {
        self.position.check("base.position", states)?;
        self.rotation.check("base.rotation", states)?;
        self.velocity.check("base.velocity", states)?;
        self.acceleration.check("base.acceleration", states)
    }

    #[inline(always)]
    pub(super) fn load<T: Lanes<Number = S>>(&self, first: usize) -> BaseLanes<T> {
        BaseLanes {
            position: self.position.load(first),
            rotation: rows(self.rotation.load(first)),
            velocity: self.velocity.load(first),
            acceleration: self.acceleration.load(first),
        }
    }
}

impl<S: Number> PlatformColumns<'_, S> {
    pub(super) fn check(&self, states: usize) -> Result<(), LengthError> {
        self.position.check("platform.position", states)?;
        self.rotation.check("platform.rotation", states)?;
        self.velocity.check("platform.velocity", states)
    }

    #[inline(always)]
    pub(super) fn load<T: Lanes<Number = S>>(&self, first: usize) -> PlatformLanes<T> {
        PlatformLanes {
            position: self.position.load(first),
            rotation: rows(self.rotation.load(first)),
            velocity: self.velocity.load(first),
        }
    }
}

impl<S: Number> States<'_, S> {
    pub(super) fn check(&self, states: usize) -> Result<(), LengthError> {
        self.base.check(states)?;
        self.platform.check(states)
    }

    #[inline(always)]
    pub(super) fn load<T: Lanes<Number = S>>(&self, first: usize) -> (BaseLanes<T>, PlatformLanes<T>) {
        (self.base.load(first), self.platform.load(first))
    }

    /// What [`Hexapod`](crate::Hexapod) refuses in a state and in these other inputs, conditioning of J_dp aside.
    pub(super) fn examined<M: RodAlignment<S>>(
        &self,
        model: &M,
        state: usize,
        others: &[(Input, [S; 6])],
    ) -> Status {
        let velocities = [
            (Input::BaseVelocity, self.base.velocity.at(state)),
            (Input::PlatformVelocity, self.platform.velocity.at(state)),
        ];
        for (input, numbers) in others.iter().chain(&velocities) {
            check::finite(*input, *numbers)?;
        }
        let (base, platform) = self.poses(state)?;
        check::in_reach(&unjudged_alignment(model, &base, &platform), &base.position, &platform.position)
    }

    /// Whether J_dp of a state can be inverted.
    pub(super) fn invertible<M: JacobianDp<S>>(&self, model: &M, state: usize) -> Status {
        let (base, platform) = self.poses(state)?;
        let mut jacobian = [[S::zero(); 6]; 6];
        model.jacobian_dp(
            &base.position,
            &base.rotation,
            &platform.position,
            &platform.rotation,
            &mut jacobian,
        );
        check::invertible(&jacobian)
    }

    fn poses(&self, state: usize) -> Result<(StateArrays<S>, StateArrays<S>), Error> {
        let at_rest = |position: &Column<S, 3>, rotation: &Column<S, 9>| StateArrays {
            position: position.at(state),
            rotation: rows(rotation.at(state)),
            velocity: [S::zero(); 6],
        };
        let base = at_rest(&self.base.position, &self.base.rotation);
        let platform = at_rest(&self.platform.position, &self.platform.rotation);
        check_poses(&base, &platform)?;
        Ok((base, platform))
    }
}

/// Nine numbers as three rows.
#[inline(always)]
pub(super) fn rows<T: Copy>(numbers: [T; 9]) -> [[T; 3]; 3] {
    let [a, b, c, d, e, f, g, h, i] = numbers;
    [[a, b, c], [d, e, f], [g, h, i]]
}

/// Three rows as nine numbers.
#[inline(always)]
pub(super) fn flat<T: Copy>(rows: [[T; 3]; 3]) -> [T; 9] {
    let [[a, b, c], [d, e, f], [g, h, i]] = rows;
    [a, b, c, d, e, f, g, h, i]
}

/// The lanes in which every number is finite; some others, of huge numbers, may be missing.
#[inline(always)]
pub(super) fn finite<T: Lanes>(numbers: &[T]) -> u32 {
    let mut sum = T::constant(0.0);
    for number in numbers {
        sum = sum + *number;
    }
    T::bits(sum.absolute().less_than(T::constant(f64::INFINITY)))
}

/// The lanes in which every leg reaches the platform and can be driven; some at the limit may be missing.
#[inline(always)]
pub(super) fn reached<M, T>(
    parameters: &M::Parameters<T>,
    base: &BaseLanes<T>,
    platform: &PlatformLanes<T>,
) -> u32
where
    M: InLanes<T::Number> + generic::RodAlignment,
    T: Lanes,
{
    let mut alignment = [T::constant(0.0); 6];
    M::rod_alignment(
        parameters,
        &base.position,
        &base.rotation,
        &platform.position,
        &platform.rotation,
        &mut alignment,
    );
    aligned(&alignment)
}

/// Lengths of the actuators, m, and the same lanes as [`reached`].
#[inline(always)]
pub(super) fn lengths<M, T>(
    parameters: &M::Parameters<T>,
    base: &BaseLanes<T>,
    platform: &PlatformLanes<T>,
) -> ([T; 6], u32)
where
    M: InLanes<T::Number> + generic::ActuatorGeometry,
    T: Lanes,
{
    let zeros = [T::constant(0.0); 6];
    let (mut alignment, mut lengths, mut jacobian) = (zeros, zeros, [zeros; 6]);
    M::actuator_geometry(
        parameters,
        &base.position,
        &base.rotation,
        &platform.position,
        &platform.rotation,
        &mut alignment,
        &mut lengths,
        &mut jacobian,
    );
    (lengths, aligned(&alignment))
}

/// The lanes in which no `(u.a)^2` is too small.
#[inline(always)]
fn aligned<T: Lanes>(alignment: &[T; 6]) -> u32 {
    let least = T::splat(T::Number::MIN_ROD_ALIGNMENT);
    let mut lanes = all_lanes::<T>();
    for leg in alignment {
        lanes &= T::bits(least.less_than(*leg));
    }
    lanes
}

/// Writes the status of the states of a group; gives the lanes whose results are to be kept. `sound` are those in
/// which nothing looks wrong, `finite` those with finite results; `refusal` looks at one of the others closely.
#[inline(always)]
pub(super) fn settle<T: Lanes>(
    status: &mut [Status],
    sound: u32,
    finite: u32,
    refusal: impl Fn(usize) -> Option<Error>,
) -> u32 {
    let here = status.len().min(T::COUNT);
    let status = &mut status[..here];
    if sound == all_lanes::<T>() {
        status.fill(Ok(()));
        return sound;
    }
    closely(status, sound, finite, &refusal)
}

#[cold]
#[inline(never)]
fn closely(status: &mut [Status], sound: u32, finite: u32, refusal: &dyn Fn(usize) -> Option<Error>) -> u32 {
    let mut kept = 0;
    for (lane, status) in status.iter_mut().enumerate() {
        let reason = if sound >> lane & 1 == 1 { None } else { refusal(lane) };
        *status = match reason {
            Some(error) => Err(error),
            None if finite >> lane & 1 == 0 => Err(Error::NonFiniteResult),
            None => Ok(()),
        };
        if status.is_ok() {
            kept |= 1 << lane;
        }
    }
    kept
}
