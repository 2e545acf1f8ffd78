//! Many states in one call: batches, computed in [lanes](crate::lanes).
//!
//! A [`Batch`] evaluates inverse dynamics, forward dynamics, the matrices or a simulation step for any number of states,
//! as many at once as the processor has lanes, optionally in several threads. Numbers lie as structure of arrays or as
//! array of structures, each argument for itself, see [`Column`].
//!
//! ```
//! use dyn_runtime::batch::{BaseColumns, Batch, Column, ColumnMut, PlatformColumns, States};
//! use dyn_runtime::{BaseMotion, Pose, models::Uhp2016};
//!
//! // 1000 platforms, 0.37 m to 0.39 m above a base at rest; one is far aside.
//! let heights: Vec<f64> = (0..1000).map(|k| 0.37 + 2e-5 * k as f64).collect();
//! let zeros = vec![0.0; 1000];
//! let mut aside = zeros.clone();
//! aside[700] = 0.5;
//! let states = States {
//!     base: BaseColumns::same(&BaseMotion::at_rest(Pose::identity())),
//!     platform: PlatformColumns {
//!         position: Column::components([&aside, &zeros, &heights]),
//!         rotation: Column::same([1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]),
//!         velocity: Column::same([0.0; 6]),
//!     },
//! };
//! let mut forces = vec![[0.0; 6]; 1000];
//! let mut status = vec![Ok(()); 1000];
//! Batch::new(&Uhp2016).inverse_dynamics(
//!     &states,
//!     Column::same([0.0; 6]),
//!     Column::same([0.0; 6]),
//!     ColumnMut::states(&mut forces),
//!     &mut status,
//! )?;
//! assert!(forces[600][0] > 30.0 && status[600].is_ok());
//! assert_eq!(status[700], Err(dyn_runtime::Error::OutOfReach { leg: 0 }));
//! assert_eq!(forces[700], [0.0; 6], "untouched");
//! # Ok::<(), dyn_runtime::batch::LengthError>(())
//! ```
//!
//! # What is checked
//!
//! Lengths, before anything is computed: [`LengthError`] names the argument. Then each state for itself: its place in
//! `status` says `Ok`, or why it has no result; its outputs then keep what they held, and no other state notices.
//! Refused are results and inputs that are not finite, legs out of reach and rods perpendicular to their actuators,
//! with the errors of [`Hexapod`](crate::Hexapod). What a hexapod refuses besides costs more than a batch is to cost:
//! that rotations are rotations, and that J_dp can be inverted. [`Batch::examine`] does it, one state after the other.

mod column;
mod dynamics;
mod matrices;
mod models;
mod simulate;
mod states;
mod step;

pub use column::{Column, ColumnMut};
pub use matrices::MatricesMut;
pub use simulate::{Instant, Simulated};
pub use states::{BaseColumns, PlatformColumns, States};

use core::error;
use core::fmt;

use crate::error::Error;
use crate::kernels::{self, RodAlignment, generic};
use crate::lanes::{InLanes, Instructions, Kernel, Number};
use dynamics::{ForwardDynamics, InverseDynamics};
use matrices::Matrices;
use models::Models;
use simulate::Simulation;

/// Whether a state has a result, or why not.
pub type Status = Result<(), Error>;

/// An argument of a batch that holds another number of states than `status` does.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct LengthError {
    /// Its name.
    pub argument: &'static str,
    /// Number of states in `status`.
    pub expected: usize,
    /// Number of states in the argument.
    pub found: usize,
}

impl fmt::Display for LengthError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { argument, expected, found } = self;
        write!(
            f,
            "{argument} holds {found} states, but status has room for {expected}; give every argument as many"
        )
    }
}

impl error::Error for LengthError {}

/// Whether every length of an argument is the one expected.
fn check<const K: usize>(
    argument: &'static str,
    expected: usize,
    lengths: [usize; K],
) -> Result<(), LengthError> {
    match lengths.into_iter().find(|length| *length != expected) {
        None => Ok(()),
        Some(found) => Err(LengthError { argument, expected, found }),
    }
}

/// A model whose functions are evaluated for many states at once.
#[derive(Debug)]
pub struct Batch<'a, M> {
    models: Models<'a, M>,
    instructions: Instructions,
    #[cfg(feature = "rayon")]
    parallel: bool,
}

impl<M> Clone for Batch<'_, M> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<M> Copy for Batch<'_, M> {}

impl<'a, M> Batch<'a, M> {
    /// All states are of this model.
    pub fn new(model: &'a M) -> Self {
        Self::of(Models::One(model))
    }

    /// Each state is of a model of its own, which has its parameters at run time: as many models as states.
    pub fn of_models(models: &'a [M]) -> Self {
        Self::of(Models::Each(models))
    }

    fn of(models: Models<'a, M>) -> Self {
        Self {
            models,
            instructions: Instructions::widest(),
            #[cfg(feature = "rayon")]
            parallel: false,
        }
    }

    /// With other instructions than the widest of this processor.
    pub fn with_instructions(self, instructions: Instructions) -> Self {
        Self { instructions, ..self }
    }

    /// In the threads of rayon's pool. Results keep their bits.
    #[cfg(feature = "rayon")]
    pub fn in_parallel(self) -> Self {
        Self { parallel: true, ..self }
    }

    /// Actuator forces F, N, that give each platform its `platform_acceleration` (`[r''; w']`, m/s^2 and rad/s^2) under
    /// its `external_wrench` (N and N m), equation (49); see [`Hexapod::inverse_dynamics`](crate::Hexapod::inverse_dynamics).
    ///
    /// # Errors
    /// An argument of another length than `status`.
    pub fn inverse_dynamics<S: Number>(
        &self,
        states: &States<S>,
        platform_acceleration: Column<S, 6>,
        external_wrench: Column<S, 6>,
        actuator_force: ColumnMut<S, 6>,
        status: &mut [Status],
    ) -> Result<(), LengthError>
    where
        M: InLanes<S> + RodAlignment<S> + generic::RodAlignment + generic::InverseDynamics + Sync,
    {
        let (models, states) = (self.models, *states);
        self.run(InverseDynamics {
            models,
            states,
            platform_acceleration,
            external_wrench,
            actuator_force,
            status,
            offset: 0,
        })
    }

    /// Platform acceleration, `[r''; w']`, m/s^2 and rad/s^2, under each state's `actuator_force` (N) and `external_wrench`
    /// (N and N m), equation (49); see [`Hexapod::forward_dynamics`](crate::Hexapod::forward_dynamics).
    ///
    /// # Errors
    /// An argument of another length than `status`.
    pub fn forward_dynamics<S: Number>(
        &self,
        states: &States<S>,
        actuator_force: Column<S, 6>,
        external_wrench: Column<S, 6>,
        platform_acceleration: ColumnMut<S, 6>,
        status: &mut [Status],
    ) -> Result<(), LengthError>
    where
        M: InLanes<S> + RodAlignment<S> + generic::RodAlignment + generic::ForwardDynamics + Sync,
    {
        let (models, states) = (self.models, *states);
        self.run(ForwardDynamics {
            models,
            states,
            actuator_force,
            external_wrench,
            platform_acceleration,
            status,
            offset: 0,
        })
    }

    /// M_p, C_p, J_dp, M_b, C_b, J_db of each state, equations (31), (32), (49); see
    /// [`Hexapod::matrices`](crate::Hexapod::matrices).
    ///
    /// # Errors
    /// An argument of another length than `status`.
    pub fn matrices<S: Number>(
        &self,
        states: &States<S>,
        matrices: MatricesMut<S>,
        status: &mut [Status],
    ) -> Result<(), LengthError>
    where
        M: InLanes<S> + RodAlignment<S> + generic::RodAlignment + generic::Matrices + Sync,
    {
        self.run(Matrices { models: self.models, states: *states, matrices, status, offset: 0 })
    }

    /// Simulates every platform from where `simulated.platform` says, in fixed steps of `step_s` (s), by a Runge-Kutta method of
    /// fourth order on the group of poses, and leaves it where it ends: initial conditions, loads or (with
    /// [`of_models`](Self::of_models)) whole platforms by the thousand.
    ///
    /// `instants` says what acts at k times half a step, k = 0 to 2 n for n steps; a last instant without a partner is
    /// not looked at. So one step takes three of them. A platform whose legs do not reach, whose numbers become
    /// infinite or that turns by more than 1 rad within a step stays in the state before that step; `status` says why
    /// ([`Error::NonFiniteResult`] for the last two), `simulated.steps` how far it came.
    ///
    /// ```
    /// use dyn_runtime::batch::{BaseColumns, Batch, Column, ColumnMut, Instant, Simulated};
    /// use dyn_runtime::{BaseMotion, Pose, models::Uhp2016};
    ///
    /// // Thirty platforms fall from home, with forces that nearly hold them. 10 ms in steps of 0.1 ms.
    /// let forces: Vec<[f64; 6]> = (0..30).map(|k| [30.0 + 0.02 * f64::from(k); 6]).collect();
    /// let instant = Instant {
    ///     base: BaseColumns::same(&BaseMotion::at_rest(Pose::identity())),
    ///     actuator_force: Column::states(&forces),
    ///     external_wrench: Column::same([0.0; 6]),
    /// };
    /// let mut position = vec![[0.0, 0.0, 0.382]; 30];
    /// let mut rotation = vec![[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]; 30];
    /// let mut velocity = vec![[0.0; 6]; 30];
    /// let (mut rms, mut steps, mut status) = (vec![[0.0; 6]; 30], vec![0; 30], vec![Ok(()); 30]);
    /// let simulated = Simulated {
    ///     position: ColumnMut::states(&mut position),
    ///     rotation: ColumnMut::states(&mut rotation),
    ///     velocity: ColumnMut::states(&mut velocity),
    ///     rms_acceleration: Some(ColumnMut::states(&mut rms)),
    ///     peak_acceleration: None,
    ///     shortest_length: None,
    ///     longest_length: None,
    ///     steps: &mut steps,
    /// };
    /// Batch::new(&Uhp2016).simulate(1e-4, &[instant; 201], simulated, &mut status)?;
    /// assert_eq!(steps, [100; 30]);
    /// // The more force, the higher.
    /// assert!(position.is_sorted_by(|a, b| a[2] < b[2]));
    /// assert!(rms[0][2] > rms[20][2]);
    /// # Ok::<(), dyn_runtime::batch::LengthError>(())
    /// ```
    ///
    /// # Errors
    /// An argument of another length than `status`.
    pub fn simulate<S: Number>(
        &self,
        step_s: S,
        instants: &[Instant<S>],
        simulated: Simulated<S>,
        status: &mut [Status],
    ) -> Result<(), LengthError>
    where
        M: InLanes<S> + RodAlignment<S> + generic::ActuatorGeometry + generic::ForwardDynamics + Sync,
    {
        self.run(Simulation { models: self.models, step_s, instants, simulated, status, offset: 0 })
    }

    /// All that [`Hexapod`](crate::Hexapod) refuses in poses and velocities, conditioning of J_dp included. One state
    /// after the other, at several times the price of a function in lanes.
    ///
    /// # Errors
    /// An argument of another length than `status`.
    pub fn examine<S: Number>(&self, states: &States<S>, status: &mut [Status]) -> Result<(), LengthError>
    where
        M: RodAlignment<S> + kernels::JacobianDp<S>,
    {
        self.models.check(status.len())?;
        states.check(status.len())?;
        for (state, status) in status.iter_mut().enumerate() {
            *status = states
                .examined(self.models.of(state), state, &[])
                .and_then(|()| states.invertible(self.models.of(state), state));
        }
        Ok(())
    }

    fn run<S: Number, J: Job<S>>(&self, job: J) -> Result<(), LengthError> {
        job.check(job.count())?;
        #[cfg(feature = "rayon")]
        if self.parallel {
            in_parallel(self.instructions, job);
            return Ok(());
        }
        self.instructions.run(job);
        Ok(())
    }
}

/// A batch with all its arguments, which can be divided among threads.
trait Job<S: Number>: Kernel<S, Output = ()> + Send + Sized {
    /// Number of states.
    fn count(&self) -> usize;

    /// Whether every argument holds as many.
    fn check(&self, count: usize) -> Result<(), LengthError>;

    /// The states before `state`, and the others. Inputs stay whole: each part knows where its states begin in them.
    #[cfg(feature = "rayon")]
    fn split(self, state: usize) -> (Self, Self);
}

/// States that one thread takes at a time: enough to make its start cheap, a multiple of all numbers of lanes.
#[cfg(feature = "rayon")]
const STATES_OF_A_THREAD: usize = 512;

#[cfg(feature = "rayon")]
fn in_parallel<S: Number, J: Job<S>>(instructions: Instructions, job: J) {
    let parts = job.count().div_ceil(STATES_OF_A_THREAD);
    if parts < 2 {
        return instructions.run(job);
    }
    let (before, after) = job.split(parts / 2 * STATES_OF_A_THREAD);
    rayon::join(|| in_parallel(instructions, before), || in_parallel(instructions, after));
}
