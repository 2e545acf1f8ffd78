//! Batches against the same functions one state at a time: bits, tails, layouts, neighbours, wrong lengths.

use std::ops::{Add, Div, Mul, Neg, Sub};

use dyn_runtime::batch::{
    BaseColumns, Batch, Column, ColumnMut, Instant, LengthError, MatricesMut, PlatformColumns, Simulated,
    States, Status,
};
use dyn_runtime::float::Scalar;
use dyn_runtime::kernels::generic;
use dyn_runtime::lanes::{Generic, Instructions, Number};
use dyn_runtime::models::{Parameters, Uhp, Uhp2016, uhp_2016};
use dyn_runtime::nalgebra::Vector3;
use dyn_runtime::{BaseMotion, Error, Input, Pose, kernels};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

/// A single number whose multiply-adds are rounded once, whatever the test is compiled for.
#[derive(Clone, Copy)]
struct Fused<S>(S);

/// `std`'s fused multiply-add.
trait FusedMultiplyAdd: Number {
    fn fused(self, factor: Self, addend: Self) -> Self;
}

impl FusedMultiplyAdd for f64 {
    fn fused(self, factor: Self, addend: Self) -> Self {
        self.mul_add(factor, addend)
    }
}

impl FusedMultiplyAdd for f32 {
    fn fused(self, factor: Self, addend: Self) -> Self {
        self.mul_add(factor, addend)
    }
}

macro_rules! operators {
    ($($operator:ident $function:ident)*) => {$(
        impl<S: Number> $operator for Fused<S> {
            type Output = Self;
            fn $function(self, other: Self) -> Self {
                Self(self.0.$function(other.0))
            }
        }
    )*};
}
operators! { Add add Sub sub Mul mul Div div }

impl<S: Number> Neg for Fused<S> {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl<S: FusedMultiplyAdd> Scalar for Fused<S> {
    fn constant(value: f64) -> Self {
        Self(S::constant(value))
    }

    fn square_root(self) -> Self {
        Self(self.0.square_root())
    }

    fn multiply_add(self, factor: Self, addend: Self) -> Self {
        Self(self.0.fused(factor.0, addend.0))
    }

    fn solve_general<const N: usize>(matrix: &[[Self; N]; N], right_hand_side: &[Self; N]) -> [Self; N] {
        S::solve_general(&matrix.map(|row| row.map(|x| x.0)), &right_hand_side.map(|x| x.0)).map(Fused)
    }
}

/// Inputs of as many states as are wanted.
#[derive(Clone)]
struct Inputs<S> {
    positions: [Vec<[S; 3]>; 2],
    rotations: [Vec<[S; 9]>; 2],
    /// Velocity and acceleration of the base, velocity of the platform, acceleration or force, wrench.
    sixes: [Vec<[S; 6]>; 5],
}

impl<S: Number> Inputs<S> {
    fn new(count: usize) -> Self {
        let mut random = Pcg64::seed_from_u64(17);
        let mut number = |size: f64| S::constant(random.random_range(-size..size));
        let mut pose = |height: f64, size: f64| -> ([S; 3], [S; 9]) {
            let position = Vector3::from_fn(|_, _| number(0.01)) + Vector3::z() * S::constant(height);
            let rotation = Pose::from_paper_angles(position, std::array::from_fn(|_| number(size))).rotation;
            let rows: [[S; 3]; 3] = rotation.matrix().transpose().into();
            (position.into(), rows.as_flattened().try_into().expect("nine numbers"))
        };
        let bodies: [(Vec<_>, Vec<_>); 2] =
            [0.0, 0.382].map(|height| (0..count).map(|_| pose(height, 0.02)).unzip());
        let [(base, base_rotation), (platform, platform_rotation)] = bodies;
        Self {
            positions: [base, platform],
            rotations: [base_rotation, platform_rotation],
            sixes: [1.0, 5.0, 1.0, 5.0, 10.0]
                .map(|size| (0..count).map(|_| std::array::from_fn(|_| number(size))).collect()),
        }
    }

    fn count(&self) -> usize {
        self.positions[0].len()
    }

    fn states(&self) -> States<'_, S> {
        States {
            base: BaseColumns {
                position: Column::states(&self.positions[0]),
                rotation: Column::states(&self.rotations[0]),
                velocity: Column::states(&self.sixes[0]),
                acceleration: Column::states(&self.sixes[1]),
            },
            platform: PlatformColumns {
                position: Column::states(&self.positions[1]),
                rotation: Column::states(&self.rotations[1]),
                velocity: Column::states(&self.sixes[2]),
            },
        }
    }

    fn six(&self, k: usize) -> Column<'_, S, 6> {
        Column::states(&self.sixes[k])
    }
}

fn rows<S: Copy>(numbers: [S; 9]) -> [[S; 3]; 3] {
    let [a, b, c, d, e, f, g, h, i] = numbers;
    [[a, b, c], [d, e, f], [g, h, i]]
}

/// A generic function with three numbers of poses and five sixes, at one state, in numbers of type T.
macro_rules! alone {
    ($model:ty, $kernel:ident, $function:ident, $inputs:expr, $state:expr, $parameters:expr, $wrap:expr, $unwrap:expr) => {{
        let (inputs, state) = ($inputs, $state);
        let position = |k: usize| inputs.positions[k][state].map($wrap);
        let rotation = |k: usize| rows(inputs.rotations[k][state].map($wrap));
        let six = |k: usize| inputs.sixes[k][state].map($wrap);
        let mut result = [$wrap(Default::default()); 6];
        <$model as generic::$kernel>::$function(
            $parameters,
            &position(0),
            &rotation(0),
            &six(0),
            &six(1),
            &position(1),
            &rotation(1),
            &six(2),
            &six(3),
            &six(4),
            &mut result,
        );
        result.map($unwrap)
    }};
}

/// One state of the baked model, with the rounding of these instructions.
fn inverse_alone<S: FusedMultiplyAdd>(inputs: &Inputs<S>, state: usize, fused: bool) -> [S; 6] {
    match fused {
        true => {
            alone!(Uhp2016, InverseDynamics, inverse_dynamics, inputs, state, &(), Fused, |x: Fused<S>| x.0)
        }
        false => alone!(Uhp2016, InverseDynamics, inverse_dynamics, inputs, state, &(), |x: S| x, |x: S| x),
    }
}

fn inverse<M, S: Number>(batch: Batch<M>, inputs: &Inputs<S>) -> (Vec<[S; 6]>, Vec<Status>)
where
    M: dyn_runtime::lanes::InLanes<S>
        + kernels::RodAlignment<S>
        + generic::RodAlignment
        + generic::InverseDynamics
        + Sync,
{
    let mut forces = vec![[S::constant(-7.0); 6]; inputs.count()];
    let mut status = vec![Err(Error::NonFiniteResult); inputs.count()];
    let out = ColumnMut::states(&mut forces);
    batch
        .inverse_dynamics(&inputs.states(), inputs.six(3), inputs.six(4), out, &mut status)
        .expect("lengths");
    (forces, status)
}

fn every_lane_has_the_bits_of_a_single_number<S: FusedMultiplyAdd>()
where
    Uhp2016: kernels::RodAlignment<S>,
{
    // Two whole groups of the widest lanes and a tail.
    let inputs = Inputs::<S>::new(39);
    for instructions in Instructions::available() {
        let (forces, status) = inverse(Batch::new(&Uhp2016).with_instructions(instructions), &inputs);
        assert!(status.iter().all(Result::is_ok), "{status:?}");
        for (state, found) in forces.iter().enumerate() {
            let expected = inverse_alone(&inputs, state, instructions.fused());
            assert_eq!(found, &expected, "{} of {}", state, instructions.name());
        }
    }
}

#[test]
fn every_lane_has_the_bits_of_a_single_f64() {
    every_lane_has_the_bits_of_a_single_number::<f64>();
}

#[test]
fn every_lane_has_the_bits_of_a_single_f32() {
    every_lane_has_the_bits_of_a_single_number::<f32>();
}

#[test]
fn this_processor_s_instructions_are_in_order() {
    let names: Vec<_> = Instructions::available().map(Instructions::name).collect();
    assert_eq!(names.last(), Some(&"portable"));
    assert_eq!(names[0], Instructions::widest().name());
}

/// Platforms that differ in all parameters.
fn platforms(count: usize) -> Vec<Uhp> {
    let mut random = Pcg64::seed_from_u64(3);
    let circle = |radius: f64, half_angle: f64| {
        std::array::from_fn(|leg: usize| {
            let sign = if leg.is_multiple_of(2) { 1.0 } else { -1.0 };
            let angle = ((leg / 2) as f64 * 120.0 + sign * half_angle).to_radians();
            [radius * angle.cos(), radius * angle.sin(), 0.0]
        })
    };
    let mut near = |value: f64| value * random.random_range(0.95..1.05);
    (0..count)
        .map(|_| {
            let (base, platform) = (circle(near(0.18), 43.0), circle(near(0.12), 15.0));
            let parameters = Parameters {
                base_point: base,
                actuator_axis: [[0.0, 0.0, 1.0]; 6],
                platform_point: platform,
                rod_length: [near(0.206); 6],
                rod_mass: [near(1.024); 6],
                rod_inertia: [near(0.0036); 6],
                rod_com_fraction: [near(0.5); 6],
                mover_mass: [near(0.611); 6],
                mover_offset: [near(0.05); 6],
                rest_length: [near(0.198); 6],
                axial_stiffness: [near(21555.9); 6],
                axial_damping: [near(20.0); 6],
                payload_mass: near(6.092),
                payload_com: [0.0, near(0.001), near(0.031)],
                payload_inertia: [[near(0.025), 0.0, 0.0], [0.0, near(0.025), 0.0], [0.0, 0.0, near(0.035)]],
                gravity: [0.0, 0.0, -9.81],
            };
            Uhp { parameters }
        })
        .collect()
}

/// Covers the system that lanes solve with pivots of their own.
#[test]
fn every_lane_may_have_a_platform_of_its_own() {
    let inputs = Inputs::<f64>::new(21);
    let models = platforms(21);
    for instructions in Instructions::available() {
        let (forces, status) = inverse(Batch::of_models(&models).with_instructions(instructions), &inputs);
        assert!(status.iter().all(Result::is_ok), "{status:?}");
        for (state, (found, model)) in forces.iter().zip(&models).enumerate() {
            let expected = if instructions.fused() {
                let parameters = in_fused(&model.parameters);
                alone!(
                    Uhp,
                    InverseDynamics,
                    inverse_dynamics,
                    &inputs,
                    state,
                    &parameters,
                    Fused,
                    |x: Fused<f64>| x.0
                )
            } else {
                let plain = |x: f64| x;
                alone!(
                    Uhp,
                    InverseDynamics,
                    inverse_dynamics,
                    &inputs,
                    state,
                    &model.parameters,
                    plain,
                    plain
                )
            };
            assert_eq!(found, &expected, "{} of {}", state, instructions.name());
        }
        let (same, _) = inverse(Batch::new(&models[0]).with_instructions(instructions), &inputs);
        assert_eq!(same[0], forces[0]);
        assert_ne!(same[1], forces[1]);
    }
}

fn in_fused(p: &Parameters) -> <Uhp as Generic>::Parameters<Fused<f64>> {
    let vectors = |vectors: [[f64; 3]; 6]| vectors.map(|vector| vector.map(Fused));
    Parameters {
        base_point: vectors(p.base_point),
        actuator_axis: vectors(p.actuator_axis),
        platform_point: vectors(p.platform_point),
        rod_length: p.rod_length.map(Fused),
        rod_mass: p.rod_mass.map(Fused),
        rod_inertia: p.rod_inertia.map(Fused),
        rod_com_fraction: p.rod_com_fraction.map(Fused),
        mover_mass: p.mover_mass.map(Fused),
        mover_offset: p.mover_offset.map(Fused),
        rest_length: p.rest_length.map(Fused),
        axial_stiffness: p.axial_stiffness.map(Fused),
        axial_damping: p.axial_damping.map(Fused),
        payload_mass: Fused(p.payload_mass),
        payload_com: p.payload_com.map(Fused),
        payload_inertia: p.payload_inertia.map(|row| row.map(Fused)),
        gravity: p.gravity.map(Fused),
    }
}

#[test]
fn bad_states_are_named_and_leave_their_neighbours_alone() {
    let sound = Inputs::<f64>::new(30);
    let (expected, _) = inverse(Batch::new(&Uhp2016), &sound);
    let mut inputs = sound.clone();
    inputs.sixes[3][9][2] = f64::NAN;
    inputs.sixes[0][10][5] = f64::INFINITY;
    inputs.rotations[1][29][4] = f64::NAN;
    let refused = [
        (9, Error::NonFinite { input: Input::PlatformAcceleration }),
        (10, Error::NonFinite { input: Input::BaseVelocity }),
        (29, Error::NonFinite { input: Input::PlatformRotation }),
    ];
    inputs.positions[1][4][0] += 0.3;
    for instructions in Instructions::available() {
        let (forces, status) = inverse(Batch::new(&Uhp2016).with_instructions(instructions), &inputs);
        for (state, reason) in refused {
            assert_eq!(status[state], Err(reason), "{}", instructions.name());
        }
        assert!(matches!(status[4], Err(Error::OutOfReach { .. })), "{:?}", status[4]);
        for (state, found) in forces.iter().enumerate() {
            if status[state].is_err() {
                assert_eq!(found, &[-7.0; 6], "untouched");
            } else if instructions == Instructions::widest() {
                assert_eq!(found, &expected[state], "{state}");
            }
        }
        let refused = status.iter().filter(|status| status.is_err()).count();
        assert_eq!(refused, 4);
    }
}

#[test]
fn layouts_give_the_same() {
    let inputs = Inputs::<f64>::new(29);
    let (expected, _) = inverse(Batch::new(&Uhp2016), &inputs);
    let component_major = |states: &[[f64; 6]]| -> Vec<f64> {
        (0..6).flat_map(|k| states.iter().map(move |state| state[k])).collect()
    };
    let acceleration = component_major(&inputs.sixes[3]);
    let wrench = component_major(&inputs.sixes[4]);
    let mut forces = vec![0.0; 6 * 29];
    let mut status = vec![Ok(()); 29];
    let wrench: [&[f64]; 6] = std::array::from_fn(|k| &wrench[29 * k..29 * (k + 1)]);
    Batch::new(&Uhp2016)
        .inverse_dynamics(
            &inputs.states(),
            Column::component_major(&acceleration),
            Column::components(wrench),
            ColumnMut::component_major(&mut forces),
            &mut status,
        )
        .expect("lengths");
    assert_eq!(forces, component_major(&expected));
}

#[test]
fn an_argument_of_another_length_is_named() {
    let inputs = Inputs::<f64>::new(5);
    let forces = [[0.0; 6]; 4];
    let mut out = [[0.0; 6]; 5];
    let mut status = [Ok(()); 5];
    let batch = Batch::new(&Uhp2016);
    let refused = |argument, found| Err(LengthError { argument, expected: 5, found });

    let short = Column::states(&forces);
    let out = ColumnMut::states(&mut out);
    let said = batch.forward_dynamics(&inputs.states(), short, inputs.six(4), out, &mut status);
    assert_eq!(said, refused("actuator_force", 4));
    assert_eq!(
        said.unwrap_err().to_string(),
        "actuator_force holds 4 states, but status has room for 5; give every argument as many"
    );

    let mut states = inputs.states();
    states.platform.rotation = Column::states(&inputs.rotations[1][..3]);
    let mut few = [[0.0; 6]; 5];
    let mut call = |states, out: &mut [[f64; 6]]| {
        batch.inverse_dynamics(states, inputs.six(3), inputs.six(4), ColumnMut::states(out), &mut status)
    };
    assert_eq!(call(&states, &mut few), refused("platform.rotation", 3));
    assert_eq!(call(&inputs.states(), &mut few[..2]), refused("actuator_force", 2));

    let models = platforms(6);
    let said = Batch::of_models(&models).examine(&inputs.states(), &mut status);
    assert_eq!(said, refused("models", 6));
    let numbers = [0.0; 31];
    let odd = Column::component_major(&numbers);
    let mut out = [[0.0; 6]; 5];
    let out = ColumnMut::states(&mut out);
    let said = batch.inverse_dynamics(&inputs.states(), odd, inputs.six(4), out, &mut status);
    assert!(said.is_err(), "31 numbers are not five times six");
}

#[test]
fn no_states_are_no_work() {
    let (forces, status) = inverse(Batch::new(&Uhp2016), &Inputs::<f64>::new(0));
    assert!(forces.is_empty() && status.is_empty());
}

#[test]
fn examining_finds_what_a_hexapod_refuses() {
    let mut inputs = Inputs::<f64>::new(3);
    inputs.rotations[0][1][0] += 0.1;
    let mut status = [Ok(()); 3];
    Batch::new(&Uhp2016).examine(&inputs.states(), &mut status).expect("lengths");
    assert_eq!((status[0], status[2]), (Ok(()), Ok(())));
    assert!(
        matches!(status[1], Err(Error::NotARotation { input: Input::BaseRotation, .. })),
        "{:?}",
        status[1]
    );
}

#[test]
fn matrices_are_those_of_a_single_state() {
    let inputs = Inputs::<f64>::new(11);
    for instructions in Instructions::available() {
        let mut matrices: [Vec<[f64; 36]>; 6] = std::array::from_fn(|_| vec![[0.0; 36]; 11]);
        let mut status = vec![Ok(()); 11];
        let [a, b, c, d, e, f] = matrices.each_mut().map(|matrices| ColumnMut::states(matrices));
        let out = MatricesMut {
            mass_matrix_p: a,
            coriolis_matrix_p: b,
            jacobian_dp: c,
            mass_matrix_b: d,
            coriolis_matrix_b: e,
            jacobian_db: f,
        };
        let batch = Batch::new(&Uhp2016).with_instructions(instructions);
        batch.matrices(&inputs.states(), out, &mut status).expect("lengths");
        for state in 0..11 {
            let [mut a, mut b, mut c, mut d, mut e, mut f] = [[[0.0; 6]; 6]; 6];
            let (position, rotation) = (&inputs.positions, &inputs.rotations);
            uhp_2016::matrices(
                &position[0][state],
                &rows(rotation[0][state]),
                &inputs.sixes[0][state],
                &position[1][state],
                &rows(rotation[1][state]),
                &inputs.sixes[2][state],
                &mut a,
                &mut b,
                &mut c,
                &mut d,
                &mut e,
                &mut f,
            );
            for (found, expected) in matrices.iter().zip([a, b, c, d, e, f]) {
                let size = expected.as_flattened().iter().fold(0.0_f64, |size, x| size.max(x.abs()));
                for (found, expected) in found[state].iter().zip(expected.as_flattened()) {
                    assert!((found - expected).abs() <= 1e-14 * size, "{state}: {found} {expected}");
                }
            }
        }
    }
}

/// Starts, ends and what was found on the way.
struct Flight {
    position: Vec<[f64; 3]>,
    rotation: Vec<[f64; 9]>,
    velocity: Vec<[f64; 6]>,
    rms: Vec<[f64; 6]>,
    peak: Vec<[f64; 6]>,
    steps: Vec<usize>,
    status: Vec<Status>,
}

/// Platforms above a base at rest, each under forces of its own.
fn flight<M>(batch: Batch<M>, inputs: &Inputs<f64>, forces: &[[f64; 6]], steps: usize, step_s: f64) -> Flight
where
    M: dyn_runtime::lanes::InLanes<f64>
        + kernels::RodAlignment
        + generic::RodAlignment
        + generic::ForwardDynamics
        + Sync,
{
    let count = inputs.count();
    let mut flight = Flight {
        position: inputs.positions[1].clone(),
        rotation: inputs.rotations[1].clone(),
        velocity: vec![[0.0; 6]; count],
        rms: vec![[0.0; 6]; count],
        peak: vec![[0.0; 6]; count],
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
        assert_eq!((all.status[6], all.steps[6]), (Err(Error::NonFinite { input: Input::ActuatorForce }), 0));
        assert_eq!(all.position[6], inputs.positions[1][6], "as it began");
        assert_eq!(all.status.iter().filter(|status| status.is_err()).count(), 2);
        assert!(all.peak[4][2] >= all.rms[4][2] && all.rms[4][2] > 0.0);
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
