//! A simulation step in lanes: Runge-Kutta of fourth order on the group of poses.
//!
//! Munthe-Kaas' method with the classical tableau: within a step the rotation is `exp([phi]x) R_0`, the stages live in
//! the vector space of phi, and R stays a rotation whatever the step.

use super::column::all_lanes;
use super::rotation::{MAX_TURN_RAD, dot, orthonormalised, rotation_vector_rate, turned};
use super::states::{BaseLanes, PlatformLanes, finite};
use crate::float::mul_add;
use crate::kernels::generic;
use crate::lanes::{InLanes, Lanes};

/// What acts on a platform at one instant of a step.
#[derive(Clone, Copy)]
pub(super) struct Load<T> {
    pub base: BaseLanes<T>,
    pub actuator_force: [T; 6],
    pub external_wrench: [T; 6],
}

/// v_p' under a load.
#[inline(always)]
pub(super) fn acceleration<M, T>(
    parameters: &M::Parameters<T>,
    load: &Load<T>,
    platform: &PlatformLanes<T>,
) -> [T; 6]
where
    M: InLanes<T::Number> + generic::ForwardDynamics,
    T: Lanes,
{
    let mut acceleration = [T::constant(0.0); 6];
    <M as generic::ForwardDynamics>::forward_dynamics(
        parameters,
        &load.base.position,
        &load.base.rotation,
        &load.base.velocity,
        &load.base.acceleration,
        &platform.position,
        &platform.rotation,
        &platform.velocity,
        &load.actuator_force,
        &load.external_wrench,
        &mut acceleration,
    );
    acceleration
}

/// The stages of a step: how far from its beginning their rates lead, and how much they weigh.
const STAGES: [(f64, f64); 4] = [(0.0, 1.0), (0.5, 2.0), (0.5, 2.0), (1.0, 1.0)];

/// The state after `step_s`, the acceleration at the beginning, and the lanes in which the state is finite and no stage
/// turned by more than [`MAX_TURN_RAD`]. `load(stage)` for stage 0 to 3 acts at the beginning, twice in the middle, at
/// the end.
#[inline(always)]
pub(super) fn step<M, T>(
    parameters: &M::Parameters<T>,
    start: &PlatformLanes<T>,
    step_s: T,
    load: impl Fn(usize) -> Load<T>,
) -> (PlatformLanes<T>, [T; 6], u32)
where
    M: InLanes<T::Number> + generic::ForwardDynamics,
    T: Lanes,
{
    let zero = T::constant(0.0);
    let mut first = [zero; 6];
    // Of r, phi and v: the rates of the stage before, and the weighted sum of all.
    let (mut before, mut sum) = ([zero; 12], [zero; 12]);
    let mut turned_far = zero;
    // A loop, so that the dynamics stand in the code once.
    for (stage, (reach, weight)) in STAGES.into_iter().enumerate() {
        let h = step_s * T::constant(reach);
        let increment = before.map(|rate| rate * h);
        let (moved, phi) = moved(start, &increment);
        turned_far = larger(turned_far, dot(phi, phi));
        let found = acceleration::<M, T>(parameters, &load(stage), &moved);
        let [vx, vy, vz, wx, wy, wz] = moved.velocity;
        let [px, py, pz] = rotation_vector_rate(phi, [wx, wy, wz]);
        let [a, b, c, d, e, f] = found;
        before = [vx, vy, vz, px, py, pz, a, b, c, d, e, f];
        let weight = T::constant(weight);
        sum = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11].map(|k| mul_add(before[k], weight, sum[k]));
        if stage == 0 {
            first = found;
        }
    }
    let h = step_s * T::constant(1.0 / 6.0);
    let (mut end, phi) = moved(start, &sum.map(|rate| rate * h));
    end.rotation = orthonormalised(&end.rotation);
    turned_far = larger(turned_far, dot(phi, phi));
    let limit = T::constant(MAX_TURN_RAD * MAX_TURN_RAD);
    let sound = finite(&end.position)
        & finite(end.rotation.as_flattened())
        & finite(&end.velocity)
        & T::bits(turned_far.less_than(limit))
        & all_lanes::<T>();
    (end, first, sound)
}

/// `start` with an increment of position, rotation and velocity, and that of rotation by itself.
#[inline(always)]
fn moved<T: Lanes>(start: &PlatformLanes<T>, increment: &[T; 12]) -> (PlatformLanes<T>, [T; 3]) {
    let [x, y, z, px, py, pz, v @ ..] = *increment;
    let by = [x, y, z];
    let phi = [px, py, pz];
    let moved = PlatformLanes {
        position: [0, 1, 2].map(|k| start.position[k] + by[k]),
        rotation: turned(phi, &start.rotation),
        velocity: [0, 1, 2, 3, 4, 5].map(|k| start.velocity[k] + v[k]),
    };
    (moved, phi)
}

#[inline(always)]
fn larger<T: Lanes>(a: T, b: T) -> T {
    T::select(b.less_than(a), a, b)
}
