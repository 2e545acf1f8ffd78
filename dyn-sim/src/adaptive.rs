//! The adaptive reference: Dormand-Prince 8(5,3) of the crate `ode_solvers` on position, unit quaternion and velocity.
//!
//! A method, a step control and a representation of rotations that the fixed-step integrator does not share.
//!
//! Two errors of ode_solvers 0.6 are kept away. Two stages of this method are evaluated at the wrong time (its nodes
//! `c_12` and `c_13` are 0 instead of 1; pull request 42 of srenevey/ode-solvers): so time is part of the state, `t' = 1`,
//! and the solver's own is not used. Dense output extrapolates to the last point as soon as that comes next: so the solver
//! runs from one output time to the next and its own steps are taken.

use std::cell::RefCell;

use dyn_runtime::nalgebra::{Quaternion, UnitQuaternion, Vector3};
use dyn_runtime::{Acceleration, PlatformState, Pose, Twist};
use ode_solvers::dop_shared::OutputType;
use ode_solvers::dop853::Dop853;
use ode_solvers::{SVector, System};

/// Position (3), quaternion w x y z (4), velocity (6), time (1).
type State = SVector<f64, 14>;

/// Index of time.
const TIME: usize = 13;

/// Why the reference stopped.
#[derive(Debug)]
pub enum AdaptiveError<E> {
    /// The acceleration could not be computed; at time, s.
    Dynamics(f64, E),
    /// Its steps became too small or too many.
    Solver(String),
}

/// States at the times `k step`, k = 0 to `steps`, from `start`; `acceleration(t, state)` drives it. Beside them, why
/// there are fewer, if there are. `progress` hears fractions.
///
/// `tolerance` is relative, and absolute in m, rad, m/s and rad/s.
pub fn integrate<E>(
    start: &PlatformState,
    step: f64,
    steps: usize,
    tolerance: f64,
    acceleration: impl Fn(f64, &PlatformState) -> Result<Acceleration, E>,
    mut progress: impl FnMut(f64),
) -> (Vec<PlatformState>, Option<AdaptiveError<E>>) {
    let failure = RefCell::new(None);
    let mut states = vec![*start];
    let mut y = to_state(start);
    for k in 0..steps {
        progress(k as f64 / steps as f64);
        y[TIME] = step * k as f64;
        let system = Driven { acceleration: &acceleration, failure: &failure };
        let (largest, first) = (step, 0.0);
        let mut solver = Dop853::from_param(
            system,
            0.0,
            step,
            step,
            y,
            tolerance,
            tolerance,
            SAFETY,
            BETA,
            FACTORS[0],
            FACTORS[1],
            largest,
            first,
            MOST_STEPS,
            STIFFNESS_TESTS,
            OutputType::Sparse,
        );
        let result = solver.integrate();
        if let Some((t, error)) = failure.take() {
            return (states, Some(AdaptiveError::Dynamics(t, error)));
        }
        if let Err(error) = result {
            return (states, Some(AdaptiveError::Solver(error.to_string())));
        }
        if let Some(end) = solver.y_out().last() {
            y = *end;
        }
        states.push(from_state(&y));
    }
    (states, None)
}

/// Step control: Hairer's values.
const SAFETY: f64 = 0.9;
const BETA: f64 = 0.0;
const FACTORS: [f64; 2] = [0.333, 6.0];
/// Steps between two outputs.
const MOST_STEPS: u32 = 100_000;
const STIFFNESS_TESTS: u32 = 1000;

struct Driven<'a, A, E> {
    acceleration: &'a A,
    failure: &'a RefCell<Option<(f64, E)>>,
}

impl<A, E> System<f64, State> for Driven<'_, A, E>
where
    A: Fn(f64, &PlatformState) -> Result<Acceleration, E>,
{
    fn system(&self, _: f64, y: &State, rates: &mut State) {
        let t = y[TIME];
        let state = from_state(y);
        let acceleration = match (self.acceleration)(t, &state) {
            Ok(acceleration) => acceleration,
            Err(error) => {
                // The solver has no way to be told of an error: it is kept, and the run ends by `solout`.
                self.failure.borrow_mut().get_or_insert((t, error));
                Acceleration::zero()
            }
        };
        let Twist { linear_m_s: v, angular_rad_s: w } = state.velocity;
        // q' = w q/2, w in O.
        let q = Quaternion::new(y[3], y[4], y[5], y[6]);
        let q_rate = Quaternion::from_imag(w) * q * 0.5;
        let values = [v.x, v.y, v.z, q_rate.w, q_rate.i, q_rate.j, q_rate.k];
        rates.as_mut_slice()[..7].copy_from_slice(&values);
        rates.as_mut_slice()[7..TIME].copy_from_slice(acceleration.to_vector().as_slice());
        rates[TIME] = 1.0;
    }

    fn solout(&mut self, _: f64, _: &State, _: &State) -> bool {
        self.failure.borrow().is_some()
    }
}

fn to_state(state: &PlatformState) -> State {
    let q = UnitQuaternion::from_rotation_matrix(&state.pose.rotation);
    let (r, v) = (state.pose.position_m, state.velocity.to_vector());
    let head = [r.x, r.y, r.z, q.w, q.i, q.j, q.k];
    State::from_iterator(head.into_iter().chain(v.iter().copied()).chain([0.0]))
}

fn from_state(y: &State) -> PlatformState {
    let q = UnitQuaternion::from_quaternion(Quaternion::new(y[3], y[4], y[5], y[6]));
    PlatformState {
        pose: Pose::from_unit_quaternion(Vector3::new(y[0], y[1], y[2]), &q),
        velocity: Twist {
            linear_m_s: Vector3::new(y[7], y[8], y[9]),
            angular_rad_s: Vector3::new(y[10], y[11], y[12]),
        },
    }
}
