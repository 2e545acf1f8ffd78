//! A simulation step in lanes: Runge-Kutta of fourth order on the group of poses.
//!
//! Munthe-Kaas' method with the classical tableau: within a step the rotation is `exp([phi]x) R_0`, the stages live in
//! the vector space of phi, and R stays a rotation whatever the step.

use super::Instant;
use super::states::{PlatformLanes, finite};
use crate::float::mul_add;
use crate::kernels::generic;
use crate::lanes::{InLanes, Lanes};
use crate::rotation_vector::arrays::{MAX_TURN_RAD, dot, orthonormalised, rate_within_step, turned};

/// v_p' at an instant.
#[inline(always)]
fn acceleration<M, T>(
    parameters: &M::Parameters<T>,
    instant: &Instant<T::Number>,
    first: usize,
    platform: &PlatformLanes<T>,
) -> [T; 6]
where
    M: InLanes<T::Number> + generic::ForwardDynamics,
    T: Lanes,
{
    let base = instant.base.load::<T>(first);
    let mut acceleration = [T::constant(0.0); 6];
    <M as generic::ForwardDynamics>::forward_dynamics(
        parameters,
        &base.position,
        &base.rotation,
        &base.velocity,
        &base.acceleration,
        &platform.position,
        &platform.rotation,
        &platform.velocity,
        &instant.actuator_force.load(first),
        &instant.external_wrench.load(first),
        &mut acceleration,
    );
    acceleration
}

/// The stages of a step: their instant, how far from its beginning the rates before them lead, and how much theirs weigh.
const STAGES: [(usize, f64, f64); 4] = [(0, 0.0, 1.0), (1, 0.5, 2.0), (1, 0.5, 2.0), (2, 1.0, 1.0)];

/// The state after `step_s`, the acceleration at the beginning, and the lanes in which the state is finite and no stage
/// turned by more than [`MAX_TURN_RAD`]. `instants` are the beginning, the middle and the end of the step, `first` the
/// state in lane 0.
#[inline(always)]
pub(super) fn step<M, T>(
    parameters: &M::Parameters<T>,
    start: &PlatformLanes<T>,
    step_s: T,
    instants: &[Instant<T::Number>],
    first: usize,
) -> (PlatformLanes<T>, [T; 6], u32)
where
    M: InLanes<T::Number> + generic::ForwardDynamics,
    T: Lanes,
{
    let zero = T::constant(0.0);
    let mut at_start = [zero; 6];
    // Of r, phi and v: what the stage before leads to, and the weighted sum of all rates.
    let (mut rates, mut sum) = ([zero; 12], [zero; 12]);
    let mut turned_far = zero;
    // A loop, so that the dynamics stand in the code once.
    for (stage, (instant, reach, weight)) in STAGES.into_iter().enumerate() {
        let (moved, phi) = moved(start, &rates, step_s * T::constant(reach));
        turned_far = larger(turned_far, dot(phi, phi));
        let found = acceleration::<M, T>(parameters, &instants[instant], first, &moved);
        let [vx, vy, vz, wx, wy, wz] = moved.velocity;
        let [px, py, pz] = rate_within_step(phi, [wx, wy, wz]);
        let [a, b, c, d, e, f] = found;
        rates = [vx, vy, vz, px, py, pz, a, b, c, d, e, f];
        let weight = T::constant(weight);
        for k in 0..12 {
            sum[k] = mul_add(rates[k], weight, sum[k]);
        }
        if stage == 0 {
            at_start = found;
        }
    }
    let (mut end, phi) = moved(start, &sum, step_s * T::constant(1.0 / 6.0));
    end.rotation = orthonormalised(&end.rotation);
    turned_far = larger(turned_far, dot(phi, phi));
    let limit = T::constant(MAX_TURN_RAD * MAX_TURN_RAD);
    let sound = finite(&end.position)
        & finite(end.rotation.as_flattened())
        & finite(&end.velocity)
        & T::bits(turned_far.less_than(limit));
    (end, at_start, sound)
}

/// Where rates, held for a time `h`, lead from `start`, and the turn by itself.
#[inline(always)]
fn moved<T: Lanes>(start: &PlatformLanes<T>, rates: &[T; 12], h: T) -> (PlatformLanes<T>, [T; 3]) {
    let phi = [rates[3] * h, rates[4] * h, rates[5] * h];
    let mut moved = *start;
    for (position, rate) in moved.position.iter_mut().zip(rates) {
        *position = mul_add(*rate, h, *position);
    }
    for (velocity, rate) in moved.velocity.iter_mut().zip(&rates[6..]) {
        *velocity = mul_add(*rate, h, *velocity);
    }
    moved.rotation = turned(phi, &start.rotation);
    (moved, phi)
}

#[inline(always)]
fn larger<T: Lanes>(a: T, b: T) -> T {
    T::select(b.less_than(a), a, b)
}
