//! Simulations in lanes.

use dyn_runtime::batch::{BaseColumns, Batch, Column, ColumnMut, Instant, Simulated, Status};
use dyn_runtime::kernels::{self, generic};
use dyn_runtime::lanes::Instructions;
use dyn_runtime::models::Uhp2016;
use dyn_runtime::nalgebra::{Matrix3, Rotation3};
use dyn_runtime::{Acceleration, BaseMotion, Error, Hexapod, Input, PlatformState, Pose};

use crate::inputs::{Inputs, rows};
#[cfg(feature = "rayon")]
use crate::{inputs::inverse, platforms::platforms};

/// Starts, ends and what was found on the way.
struct Flight {
    position: Vec<[f64; 3]>,
    rotation: Vec<[f64; 9]>,
    velocity: Vec<[f64; 6]>,
    rms: Vec<[f64; 6]>,
    peak: Vec<[f64; 6]>,
    shortest: Vec<[f64; 6]>,
    longest: Vec<[f64; 6]>,
    steps: Vec<usize>,
    status: Vec<Status>,
}

/// Platforms above a base at rest, each under forces of its own.
fn flight<M>(batch: Batch<M>, inputs: &Inputs<f64>, forces: &[[f64; 6]], steps: usize, step_s: f64) -> Flight
where
    M: dyn_runtime::lanes::InLanes<f64>
        + kernels::RodAlignment
        + generic::ActuatorGeometry
        + generic::ForwardDynamics
        + Sync,
{
    let count = inputs.count();
    let mut flight = Flight {
        position: inputs.positions[1].clone(),
        rotation: inputs.rotations[1].clone(),
        velocity: inputs.sixes[2].clone(),
        rms: vec![[0.0; 6]; count],
        peak: vec![[0.0; 6]; count],
        shortest: vec![[0.0; 6]; count],
        longest: vec![[0.0; 6]; count],
        steps: vec![0; count],
        status: vec![Ok(()); count],
    };
    let instant = Instant {
        base: BaseColumns::same(&BaseMotion::at_rest(Pose::identity())),
        actuator_force: Column::states(forces),
        external_wrench: Column::same([0.0; 6]),
    };
    let simulated = Simulated {
        position: ColumnMut::states(&mut flight.position),
        rotation: ColumnMut::states(&mut flight.rotation),
        velocity: ColumnMut::states(&mut flight.velocity),
        rms_acceleration: Some(ColumnMut::states(&mut flight.rms)),
        peak_acceleration: Some(ColumnMut::states(&mut flight.peak)),
        shortest_length: Some(ColumnMut::states(&mut flight.shortest)),
        longest_length: Some(ColumnMut::states(&mut flight.longest)),
        steps: &mut flight.steps,
    };
    batch.simulate(step_s, &vec![instant; 2 * steps + 1], simulated, &mut flight.status).expect("lengths");
    flight
}

#[test]
fn a_simulation_does_not_depend_on_the_lane_and_stops_alone() {
    let inputs = Inputs::<f64>::new(19);
    let mut forces = vec![[30.0; 6]; 19];
    forces[5][0] = 30000.0;
    forces[6][3] = f64::NAN;
    for instructions in Instructions::available() {
        let batch = Batch::new(&Uhp2016).with_instructions(instructions);
        let all = flight(batch, &inputs, &forces, 400, 1e-4);
        assert_eq!(all.steps[4], 400);
        assert!(all.status[5].is_err() && all.steps[5] > 10 && all.steps[5] < 400, "{:?}", all.status[5]);
        let of_leg_4 = Error::NonFinite { input: Input::ActuatorForce, element: 3 };
        assert_eq!((all.status[6], all.steps[6]), (Err(of_leg_4), 0));
        assert_eq!(all.position[6], inputs.positions[1][6], "as it began");
        assert_eq!(all.status.iter().filter(|status| status.is_err()).count(), 2);
        assert!(all.peak[4][2] >= all.rms[4][2] && all.rms[4][2] > 0.0);
        assert_eq!((all.shortest[6], all.longest[6]), ([f64::INFINITY; 6], [f64::NEG_INFINITY; 6]));
        // The platform is still one.
        for rotation in &all.rotation {
            let [a, b, c, ..] = *rotation;
            assert!((a * a + b * b + c * c - 1.0).abs() < 1e-14);
        }
        for state in [0, 5, 18] {
            let one = Inputs {
                positions: inputs.positions.clone().map(|all| vec![all[state]]),
                rotations: inputs.rotations.clone().map(|all| vec![all[state]]),
                sixes: inputs.sixes.clone().map(|all| vec![all[state]]),
            };
            let alone = flight(batch, &one, &forces[state..=state], 400, 1e-4);
            assert_eq!(alone.position[0], all.position[state]);
            assert_eq!(alone.rotation[0], all.rotation[state]);
            assert_eq!(alone.velocity[0], all.velocity[state]);
            assert_eq!((alone.steps[0], alone.status[0]), (all.steps[state], all.status[state]));
        }
    }
}

/// Lengths of the actuators on the way, against simulations of one step each.
#[test]
fn a_simulation_knows_how_long_actuators_were() {
    let hexapod = Hexapod::new(Uhp2016);
    let base = BaseMotion::at_rest(Pose::identity());
    let forces = vec![[20.0, 30.0, 40.0, 30.0, 20.0, 30.0]; 3];
    let mut inputs = Inputs::<f64>::new(3);
    let all = flight(Batch::new(&Uhp2016), &inputs, &forces, 30, 1e-3);
    let (mut shortest, mut longest) = ([f64::INFINITY; 6], [f64::NEG_INFINITY; 6]);
    for _ in 0..30 {
        let pose = Pose {
            position_m: inputs.positions[1][2].into(),
            rotation: Rotation3::from_matrix_unchecked(
                Matrix3::from(rows(inputs.rotations[1][2])).transpose(),
            ),
        };
        let legs = hexapod
            .leg_kinematics(&base, &PlatformState::at_rest(pose), &Acceleration::zero())
            .expect("in reach");
        for (leg, length) in legs.actuator_length_m.iter().enumerate() {
            shortest[leg] = length.min(shortest[leg]);
            longest[leg] = length.max(longest[leg]);
        }
        inputs = after_one_step(inputs, &forces);
    }
    for leg in 0..6 {
        assert!((all.shortest[2][leg] - shortest[leg]).abs() < 1e-14, "{:?} {shortest:?}", all.shortest[2]);
        assert!((all.longest[2][leg] - longest[leg]).abs() < 1e-14, "{:?} {longest:?}", all.longest[2]);
    }
    assert!((0..6).all(|leg| longest[leg] > shortest[leg] + 1e-5));
}

/// The states a millisecond later.
fn after_one_step(mut inputs: Inputs<f64>, forces: &[[f64; 6]]) -> Inputs<f64> {
    let moved = flight(Batch::new(&Uhp2016), &inputs, forces, 1, 1e-3);
    inputs.positions[1] = moved.position;
    inputs.rotations[1] = moved.rotation;
    inputs.sixes[2] = moved.velocity;
    inputs
}

#[test]
fn a_simulation_is_of_fourth_order() {
    let inputs = Inputs::<f64>::new(4);
    let forces = vec![[20.0, 30.0, 40.0, 30.0, 20.0, 30.0]; 4];
    let end = |steps: usize| flight(Batch::new(&Uhp2016), &inputs, &forces, steps, 0.02 / steps as f64);
    let exact = end(640);
    let error = |steps: usize| {
        let found = end(steps);
        let numbers = |flight: &Flight| flight.rotation.as_flattened().to_vec();
        numbers(&found).iter().zip(numbers(&exact)).fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()))
    };
    let (coarse, fine) = (error(40), error(80));
    let ratio = coarse / fine;
    assert!((12.0..20.0).contains(&ratio), "{coarse:e} {fine:e}: {ratio}");
}

#[cfg(feature = "rayon")]
#[test]
fn threads_change_no_bit() {
    let inputs = Inputs::<f64>::new(2000);
    let models = platforms(2000);
    let batch = Batch::of_models(&models);
    assert_eq!(inverse(batch, &inputs), inverse(batch.in_parallel(), &inputs));
    let forces = vec![[30.0; 6]; 2000];
    let (one, many) =
        (flight(batch, &inputs, &forces, 5, 1e-4), flight(batch.in_parallel(), &inputs, &forces, 5, 1e-4));
    assert_eq!((one.position, one.rms, one.steps), (many.position, many.rms, many.steps));
}
