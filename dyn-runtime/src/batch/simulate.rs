//! Simulations of a batch: the states stay in lanes from the first step to the last.

use super::column::all_lanes;
use super::models::Models;
use super::states::{PlatformLanes, finite, flat, lengths, rows};
use super::step::step;
use super::{BaseColumns, Column, ColumnMut, LengthError, PlatformColumns, States, Status, check};
use crate::error::{Error, Input};
use crate::float::{Scalar, mul_add};
use crate::kernels::{RodAlignment, generic};
use crate::lanes::{InLanes, Kernel, Lanes, Number};

/// What acts on many platforms at one time of a simulation.
#[derive(Clone, Copy, Debug)]
pub struct Instant<'a, S> {
    /// The base.
    pub base: BaseColumns<'a, S>,
    /// F, N.
    pub actuator_force: Column<'a, S, 6>,
    /// `[F_D; M_D]` at the payload's centre of mass, N and N m.
    pub external_wrench: Column<'a, S, 6>,
}

/// Platforms that are simulated, and what is found out about them.
#[derive(Debug)]
pub struct Simulated<'a, S> {
    /// Origin of P, m: where each begins, then where it ends.
    pub position: ColumnMut<'a, S, 3>,
    /// P to O, row by row: as it begins, then as it ends.
    pub rotation: ColumnMut<'a, S, 9>,
    /// `[r'; w]`, m/s and rad/s: as it begins, then as it ends.
    pub velocity: ColumnMut<'a, S, 6>,
    /// Root mean square of each component of v_p' over the beginnings of all steps made, m/s^2 and rad/s^2; 0 if none was.
    pub rms_acceleration: Option<ColumnMut<'a, S, 6>>,
    /// Largest magnitude of each component of v_p' at these times, m/s^2 and rad/s^2.
    pub peak_acceleration: Option<ColumnMut<'a, S, 6>>,
    /// Least length of each actuator at these times, m; infinite if no step was made.
    pub shortest_length: Option<ColumnMut<'a, S, 6>>,
    /// Largest length of each actuator at these times, m; minus infinity if no step was made.
    pub longest_length: Option<ColumnMut<'a, S, 6>>,
    /// How many steps were made.
    pub steps: &'a mut [usize],
}

impl<S: Number> Instant<'_, S> {
    pub(super) fn check(&self, states: usize) -> Result<(), LengthError> {
        self.base.check(states)?;
        self.actuator_force.check("actuator_force", states)?;
        self.external_wrench.check("external_wrench", states)
    }
}

impl<'a, S: Number> Simulated<'a, S> {
    pub(super) fn check(&self, states: usize) -> Result<(), LengthError> {
        self.position.check("position", states)?;
        self.rotation.check("rotation", states)?;
        self.velocity.check("velocity", states)?;
        for (argument, column) in [
            ("rms_acceleration", &self.rms_acceleration),
            ("peak_acceleration", &self.peak_acceleration),
            ("shortest_length", &self.shortest_length),
            ("longest_length", &self.longest_length),
        ] {
            if let Some(column) = column {
                column.check(argument, states)?;
            }
        }
        check("steps", states, [self.steps.len()])
    }

    #[cfg(feature = "rayon")]
    fn split(self, state: usize) -> (Self, Self) {
        let (position, position_after) = self.position.split(state);
        let (rotation, rotation_after) = self.rotation.split(state);
        let (velocity, velocity_after) = self.velocity.split(state);
        let split = |column: Option<ColumnMut<'a, S, 6>>| column.map(|column| column.split(state)).unzip();
        let (rms_acceleration, rms_after) = split(self.rms_acceleration);
        let (peak_acceleration, peak_after) = split(self.peak_acceleration);
        let (shortest_length, shortest_after) = split(self.shortest_length);
        let (longest_length, longest_after) = split(self.longest_length);
        let (steps, steps_after) = self.steps.split_at_mut(state);
        (
            Self {
                position,
                rotation,
                velocity,
                rms_acceleration,
                peak_acceleration,
                shortest_length,
                longest_length,
                steps,
            },
            Self {
                position: position_after,
                rotation: rotation_after,
                velocity: velocity_after,
                rms_acceleration: rms_after,
                peak_acceleration: peak_after,
                shortest_length: shortest_after,
                longest_length: longest_after,
                steps: steps_after,
            },
        )
    }
}

pub(super) struct Simulation<'a, M, S> {
    pub models: Models<'a, M>,
    pub step_s: S,
    pub instants: &'a [Instant<'a, S>],
    pub simulated: Simulated<'a, S>,
    pub status: &'a mut [Status],
    /// Index of the first state in the inputs.
    pub offset: usize,
}

/// One group of platforms on its way.
struct Group<T> {
    platform: PlatformLanes<T>,
    /// 1 where a platform still moves, 0 where it has stopped.
    moving: T,
    steps: T,
    squares: [T; 6],
    peaks: [T; 6],
    shortest: [T; 6],
    longest: [T; 6],
}

impl<M, S: Number> Kernel<S> for Simulation<'_, M, S>
where
    M: InLanes<S> + RodAlignment<S> + generic::ActuatorGeometry + generic::ForwardDynamics,
{
    type Output = ();

    #[inline(always)]
    fn run<T: Lanes<Number = S>>(self) {
        let Self { models, step_s, instants, mut simulated, status, offset } = self;
        if status.is_empty() {
            return;
        }
        let (zero, one) = (T::constant(0.0), T::constant(1.0));
        let mut parameters = models.load::<S, T>(offset);
        for first in (0..status.len()).step_by(T::COUNT) {
            let input = offset + first;
            models.reload::<S, T>(input, &mut parameters);
            let mut group = Group {
                platform: PlatformLanes {
                    position: simulated.position.load(first),
                    rotation: rows(simulated.rotation.load(first)),
                    velocity: simulated.velocity.load(first),
                },
                moving: one,
                steps: zero,
                squares: [zero; 6],
                peaks: [zero; 6],
                shortest: [T::constant(f64::INFINITY); 6],
                longest: [T::constant(f64::NEG_INFINITY); 6],
            };
            for instants in instants.windows(3).step_by(2) {
                let base = instants[0].base.load::<T>(input);
                let (lengths, reached) = lengths::<M, T>(&parameters, &base, &group.platform);
                let (end, acceleration, sound) =
                    step::<M, T>(&parameters, &group.platform, T::splat(step_s), instants, input);
                let sound = sound & reached & finite(&acceleration);
                group.advance(&end, &acceleration, &lengths, sound);
            }
            let all = all_lanes::<T>();
            simulated.position.store(first, &group.platform.position, all);
            simulated.rotation.store(first, &flat(group.platform.rotation), all);
            simulated.velocity.store(first, &group.platform.velocity, all);
            if let Some(column) = &mut simulated.rms_acceleration {
                let count = T::select(group.steps.less_than(one), one, group.steps);
                let mut rms = group.squares;
                for square in &mut rms {
                    *square = (*square / count).square_root();
                }
                column.store(first, &rms, all);
            }
            for (column, numbers) in [
                (&mut simulated.peak_acceleration, &group.peaks),
                (&mut simulated.shortest_length, &group.shortest),
                (&mut simulated.longest_length, &group.longest),
            ] {
                if let Some(column) = column {
                    column.store(first, numbers, all);
                }
            }
            let steps = &mut simulated.steps[first..];
            group.steps.for_each(|lane, made| {
                if let Some(steps) = steps.get_mut(lane) {
                    *steps = made.to_f64() as usize;
                }
            });
            let wanted = instants.len().saturating_sub(1) / 2;
            for (state, status) in status.iter_mut().enumerate().skip(first).take(T::COUNT) {
                *status = match instants.get(2 * simulated.steps[state]) {
                    Some(instant) if simulated.steps[state] < wanted => {
                        Err(why_stopped(models, instant, &simulated, state, offset + state))
                    }
                    _ => Ok(()),
                };
            }
        }
    }
}

impl<T: Lanes> Group<T> {
    /// The lanes in which the step was sound go on to `end`, the others stay.
    #[inline(always)]
    fn advance(&mut self, end: &PlatformLanes<T>, acceleration: &[T; 6], lengths: &[T; 6], sound: u32) {
        let (zero, half) = (T::constant(0.0), T::constant(0.5));
        if sound != all_lanes::<T>() {
            let sound =
                T::from_fn(|lane| T::Number::constant(if sound >> lane & 1 == 1 { 1.0 } else { 0.0 }));
            self.moving = T::select(half.less_than(sound), self.moving, zero);
        }
        let moving = half.less_than(self.moving);
        for k in 0..3 {
            self.platform.position[k] = T::select(moving, end.position[k], self.platform.position[k]);
            for j in 0..3 {
                self.platform.rotation[k][j] =
                    T::select(moving, end.rotation[k][j], self.platform.rotation[k][j]);
            }
        }
        for k in 0..6 {
            self.platform.velocity[k] = T::select(moving, end.velocity[k], self.platform.velocity[k]);
        }
        self.steps = self.steps + self.moving;
        for (k, component) in acceleration.iter().enumerate() {
            let size = T::select(moving, component.absolute(), zero);
            self.squares[k] = mul_add(size, size, self.squares[k]);
            self.peaks[k] = T::select(self.peaks[k].less_than(size), size, self.peaks[k]);
        }
        for (k, length) in lengths.iter().enumerate() {
            let shortest = T::select(moving, *length, self.shortest[k]);
            let longest = T::select(moving, *length, self.longest[k]);
            self.shortest[k] = T::select(shortest.less_than(self.shortest[k]), shortest, self.shortest[k]);
            self.longest[k] = T::select(self.longest[k].less_than(longest), longest, self.longest[k]);
        }
    }
}

/// What is wrong with a state from which no step could be made; `state` is its index in `simulated`, `input` in the inputs.
#[cold]
#[inline(never)]
fn why_stopped<M: RodAlignment<S>, S: Number>(
    models: Models<M>,
    instant: &Instant<S>,
    simulated: &Simulated<S>,
    state: usize,
    input: usize,
) -> Error {
    let platform = PlatformColumns {
        position: Column::same(simulated.position.at(state)),
        rotation: Column::same(simulated.rotation.at(state)),
        velocity: Column::same(simulated.velocity.at(state)),
    };
    let states = States { base: instant.base, platform };
    let others = [
        (Input::BaseAcceleration, instant.base.acceleration.at(input)),
        (Input::ActuatorForce, instant.actuator_force.at(input)),
        (Input::ExternalWrench, instant.external_wrench.at(input)),
    ];
    states.examined(models.of(input), input, &others).err().unwrap_or(Error::NonFiniteResult)
}

impl<M, S: Number> super::Job<S> for Simulation<'_, M, S>
where
    M: InLanes<S> + RodAlignment<S> + generic::ActuatorGeometry + generic::ForwardDynamics + Sync,
{
    fn count(&self) -> usize {
        self.status.len()
    }

    fn check(&self, count: usize) -> Result<(), LengthError> {
        self.models.check(count)?;
        for instant in self.instants {
            instant.check(count)?;
        }
        self.simulated.check(count)
    }

    #[cfg(feature = "rayon")]
    fn split(self, state: usize) -> (Self, Self) {
        let (simulated, simulated_after) = self.simulated.split(state);
        let (status, status_after) = self.status.split_at_mut(state);
        let offset = self.offset + state;
        (
            Self { simulated, status, ..self },
            Self { simulated: simulated_after, status: status_after, offset, ..self },
        )
    }
}
