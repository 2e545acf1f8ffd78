//! Platforms along a target, many at once: the forces that this takes, and how long actuators become.

use dyn_runtime::kernels::generic::{ActuatorGeometry, InverseDynamics};
use dyn_runtime::lanes::{self, InLanes, Kernel, Lanes};
use dyn_runtime::models::Uhp;
use dyn_runtime::{Error, Hexapod, MIN_ROD_ALIGNMENT, Wrench};

use super::designs::Design;
use super::file::Sweep;
use super::flight::flat;
use super::found::{Ending, Found};
use crate::motion::{BodyMotion, Motion};
use crate::scenario::Steering;

/// Largest number of lanes of `f64`.
const MOST_LANES: usize = 8;

/// Base and platform at one time: positions, rotations row by row, velocities, accelerations.
#[derive(Clone, Copy)]
struct State {
    positions: [[f64; 3]; 2],
    rotations: [[f64; 9]; 2],
    velocities: [[f64; 6]; 2],
    accelerations: [[f64; 6]; 2],
}

impl State {
    fn of(design: &Design, t: f64) -> Self {
        let both = motions(design, t);
        Self {
            positions: both.map(|body| body.pose.position_m.into()),
            rotations: both.map(|body| flat(&body.pose.rotation)),
            velocities: both.map(|body| body.velocity.to_vector().into()),
            accelerations: both.map(|body| body.acceleration.to_vector().into()),
        }
    }
}

/// The motions of base and platform.
fn motions(design: &Design, t: f64) -> [BodyMotion; 2] {
    [design.base.at(t), target(design).at(t)]
}

/// What the platform follows: in a sweep along a target, each design has one.
fn target(design: &Design) -> &Motion {
    match &design.steering {
        Steering::Target(motion) => motion,
        Steering::Free(..) => &design.base,
    }
}

/// Forces and lengths of these designs along their targets.
pub(super) fn pursue(sweep: &Sweep, designs: &[&Design]) -> Vec<Found> {
    let grid = sweep.nominal.grid;
    let Some(first) = designs.first() else { return Vec::new() };
    let alike = |design: &&Design| design.base == first.base && target(design) == target(first);
    let same = designs.iter().all(alike);
    let along = |design: &&Design| -> Vec<State> {
        (0..=grid.steps).map(|step| State::of(design, grid.time(step))).collect()
    };
    let states_of_all = if same { vec![along(first)] } else { Vec::new() };
    let mut found = Vec::with_capacity(designs.len());
    for members in designs.chunks(MOST_LANES) {
        let own: Vec<Vec<State>> = if same { Vec::new() } else { members.iter().map(along).collect() };
        let models: Vec<Uhp> = members.iter().map(|design| design.model).collect();
        let states = if same { &states_of_all } else { &own };
        let followed = lanes::run(Pursuit { models: &models, states });
        for (design, (mut of_design, ended)) in members.iter().zip(followed) {
            of_design.ended = ended.map(|step| {
                let time_s = grid.time(step);
                Ending { time_s, reason: why(design, time_s) }
            });
            found.push(of_design.judged(&design.limits));
        }
    }
    found
}

/// Why a design cannot be where its target is.
fn why(design: &Design, t: f64) -> String {
    let [base, platform] = motions(design, t);
    let (hexapod, wrench) = (Hexapod::new(design.model), Wrench::zero());
    match hexapod.inverse_dynamics(&base.as_base(), &platform.as_platform(), &platform.acceleration, &wrench)
    {
        Err(error) => error.to_string(),
        Ok(_) => Error::NonFiniteResult.to_string(),
    }
}

/// Some designs, not more than there are lanes, along the states that are theirs, or all along the only ones.
struct Pursuit<'a> {
    models: &'a [Uhp],
    states: &'a [Vec<State>],
}

impl Kernel<f64> for Pursuit<'_> {
    /// What is found out about each, and the step at which it cannot go on.
    type Output = Vec<(Found, Option<usize>)>;

    // Loops, not closures: those are not always inlined, and then not compiled for the lanes.
    #[inline(always)]
    fn run<T: Lanes<Number = f64>>(self) -> Self::Output {
        let mut found = vec![(Found::nothing(), None); self.models.len()];
        let last = self.models.len() - 1;
        for first in (0..self.models.len()).step_by(T::COUNT) {
            let parameters = Uhp::in_lanes(|lane| &self.models[last.min(first + lane)]);
            for step in 0..self.states[0].len() {
                let mut of_lanes = [&self.states[0][step]; MOST_LANES];
                if self.states.len() > 1 {
                    for (lane, state) in of_lanes.iter_mut().enumerate() {
                        *state = &self.states[last.min(first + lane)][step];
                    }
                }
                let (forces, lengths, sound) = at_state::<T>(&parameters, &of_lanes);
                for (leg, (force, length)) in forces.iter().zip(&lengths).enumerate() {
                    let mut numbers = [[0.0; 2]; MOST_LANES];
                    force.for_each(|lane, force| numbers[lane][0] = force.abs());
                    length.for_each(|lane, length| numbers[lane][1] = length);
                    for (lane, (found, ended)) in found.iter_mut().skip(first).take(T::COUNT).enumerate() {
                        if ended.is_none() && sound >> lane & 1 == 1 {
                            let [force, length] = numbers[lane];
                            found.force_n[leg] = found.force_n[leg].max(force);
                            found.shortest_m[leg] = found.shortest_m[leg].min(length);
                            found.longest_m[leg] = found.longest_m[leg].max(length);
                        }
                    }
                }
                for (lane, (_, ended)) in found.iter_mut().skip(first).take(T::COUNT).enumerate() {
                    if ended.is_none() && sound >> lane & 1 == 0 {
                        *ended = Some(step);
                    }
                }
            }
        }
        found
    }
}

/// Forces, lengths, and the lanes in which both mean something.
#[inline(always)]
fn at_state<T: Lanes<Number = f64>>(
    parameters: &<Uhp as lanes::Generic>::Parameters<T>,
    states: &[&State; MOST_LANES],
) -> ([T; 6], [T; 6], u32) {
    let zeros = [T::constant(0.0); 6];
    let (mut forces, mut alignment, mut lengths, mut jacobian) = (zeros, zeros, zeros, [zeros; 6]);
    let base_position = gathered(&states.map(|state| &state.positions[0]));
    let base_rotation = rows_of(gathered(&states.map(|state| &state.rotations[0])));
    let platform_position = gathered(&states.map(|state| &state.positions[1]));
    let platform_rotation = rows_of(gathered(&states.map(|state| &state.rotations[1])));
    <Uhp as InverseDynamics>::inverse_dynamics(
        parameters,
        &base_position,
        &base_rotation,
        &gathered(&states.map(|state| &state.velocities[0])),
        &gathered(&states.map(|state| &state.accelerations[0])),
        &platform_position,
        &platform_rotation,
        &gathered(&states.map(|state| &state.velocities[1])),
        &gathered(&states.map(|state| &state.accelerations[1])),
        &zeros,
        &mut forces,
    );
    <Uhp as ActuatorGeometry>::actuator_geometry(
        parameters,
        &base_position,
        &base_rotation,
        &platform_position,
        &platform_rotation,
        &mut alignment,
        &mut lengths,
        &mut jacobian,
    );
    let mut sum = zeros[0];
    let mut sound = u32::MAX;
    for leg in 0..6 {
        sum = sum + forces[leg];
        sound &= T::bits(T::constant(MIN_ROD_ALIGNMENT).less_than(alignment[leg]));
    }
    (forces, lengths, sound & T::bits(sum.absolute().less_than(T::constant(f64::INFINITY))))
}

/// One state in each lane.
#[inline(always)]
fn gathered<T: Lanes<Number = f64>, const N: usize>(states: &[&[f64; N]; MOST_LANES]) -> [T; N] {
    let mut numbers = [T::constant(0.0); N];
    for (k, number) in numbers.iter_mut().enumerate() {
        *number = T::from_fn(|lane| states[lane][k]);
    }
    numbers
}

#[inline(always)]
fn rows_of<T: Copy>([a, b, c, d, e, f, g, h, i]: [T; 9]) -> [[T; 3]; 3] {
    [[a, b, c], [d, e, f], [g, h, i]]
}
