//! Time per state of batches: functions, models, numbers, layouts, instructions, threads.
//!
//! ```sh
//! cargo run --release -p dyn-runtime --features rayon --example batch_speed
//! ```

use std::hint::black_box;
use std::time;

use dyn_runtime::batch::{
    BaseColumns, Batch, Column, ColumnMut, Instant, PlatformColumns, Simulated, States, Status,
};
use dyn_runtime::float::mul_add;
use dyn_runtime::kernels::{RodAlignment, generic};
use dyn_runtime::lanes::{InLanes, Instructions, Kernel, Lanes, Number};
use dyn_runtime::models::{Parameters, Uhp, Uhp2016};
use dyn_runtime::nalgebra::Vector3;
use dyn_runtime::{BaseMotion, Pose};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

/// No power of two: components of such a length would lie in the same lines of a cache.
const STATES: usize = 1080;
const BATCHES: usize = 100;

/// The inputs of many states as arrays of structures, and the same by components.
struct Inputs<S> {
    positions: [Vec<[S; 3]>; 2],
    rotations: [Vec<[S; 9]>; 2],
    sixes: [Vec<[S; 6]>; 5],
    positions_by_component: [Vec<S>; 2],
    rotations_by_component: [Vec<S>; 2],
    sixes_by_component: [Vec<S>; 5],
}

fn by_component<S: Copy, const N: usize>(states: &[[S; N]]) -> Vec<S> {
    (0..N).flat_map(|k| states.iter().map(move |state| state[k])).collect()
}

impl<S: Number> Inputs<S> {
    fn new() -> Self {
        let mut random = Pcg64::seed_from_u64(5);
        let mut numbers = |size: f64| S::constant(random.random_range(-size..size));
        let mut pose = |height: f64| -> ([S; 3], [S; 9]) {
            let position = Vector3::from_fn(|_, _| numbers(0.01)) + Vector3::z() * S::constant(height);
            let pose = Pose::from_paper_angles(position, std::array::from_fn(|_| numbers(0.03)));
            let rows: [[S; 3]; 3] = pose.rotation.matrix().transpose().into();
            (pose.position_m.into(), rows.as_flattened().try_into().expect("nine"))
        };
        let mut body = |height| (0..STATES).map(|_| pose(height)).unzip();
        let (base_positions, base_rotations): (Vec<_>, Vec<_>) = body(0.0);
        let (platform_positions, platform_rotations): (Vec<_>, Vec<_>) = body(0.382);
        let sixes = [1.0, 5.0, 1.0, 5.0, 10.0]
            .map(|size| (0..STATES).map(|_| std::array::from_fn(|_| numbers(size))).collect::<Vec<_>>());
        let (positions, rotations) =
            ([base_positions, platform_positions], [base_rotations, platform_rotations]);
        Self {
            positions_by_component: positions.each_ref().map(|states: &Vec<_>| by_component(states)),
            rotations_by_component: rotations.each_ref().map(|states: &Vec<_>| by_component(states)),
            sixes_by_component: sixes.each_ref().map(|states| by_component(states)),
            positions,
            rotations,
            sixes,
        }
    }

    fn states(&self, by_component: bool) -> States<'_, S> {
        let position = |k: usize| match by_component {
            true => Column::component_major(&self.positions_by_component[k]),
            false => Column::states(&self.positions[k]),
        };
        let rotation = |k: usize| match by_component {
            true => Column::component_major(&self.rotations_by_component[k]),
            false => Column::states(&self.rotations[k]),
        };
        States {
            base: BaseColumns {
                position: position(0),
                rotation: rotation(0),
                velocity: self.six(0, by_component),
                acceleration: self.six(1, by_component),
            },
            platform: PlatformColumns {
                position: position(1),
                rotation: rotation(1),
                velocity: self.six(2, by_component),
            },
        }
    }

    fn six(&self, k: usize, by_component: bool) -> Column<'_, S, 6> {
        match by_component {
            true => Column::component_major(&self.sixes_by_component[k]),
            false => Column::states(&self.sixes[k]),
        }
    }
}

/// The least time per state in nanoseconds.
fn time(mut run: impl FnMut()) -> f64 {
    let least = (0..BATCHES)
        .map(|_| {
            let start = time::Instant::now();
            run();
            start.elapsed().as_secs_f64()
        })
        .fold(f64::INFINITY, f64::min);
    least * 1e9 / STATES as f64
}

/// Multiply-adds in lanes that do not wait for one another: what no batch can be faster than.
struct MultiplyAdds;

impl MultiplyAdds {
    /// Enough to hide the latency of each.
    const CHAINS: usize = 12;
    const ROUNDS: usize = 10_000;
}

impl<S: Number> Kernel<S> for MultiplyAdds {
    /// Nanoseconds per multiply-add and lane.
    type Output = f64;

    #[inline(always)]
    fn run<T: Lanes<Number = S>>(self) -> f64 {
        let mut least = f64::INFINITY;
        for _ in 0..BATCHES {
            let (factor, addend) =
                (T::splat(black_box(S::constant(0.5))), T::splat(black_box(S::constant(1.0))));
            let mut sums = [addend; Self::CHAINS];
            let start = time::Instant::now();
            for _ in 0..Self::ROUNDS {
                for sum in &mut sums {
                    *sum = mul_add(*sum, factor, addend);
                }
            }
            for sum in sums {
                let mut last = S::zero();
                sum.for_each(|_, number| last = number);
                black_box(last);
            }
            least = least.min(start.elapsed().as_secs_f64());
        }
        least * 1e9 / (Self::ROUNDS * Self::CHAINS * T::COUNT) as f64
    }
}

/// Inverse and forward dynamics, by component and by state.
fn dynamics<S: Number, M>(model: &M, name: &str, instructions: Instructions)
where
    M: InLanes<S>
        + RodAlignment<S>
        + generic::RodAlignment
        + generic::InverseDynamics
        + generic::ForwardDynamics
        + Sync,
{
    let inputs = Inputs::<S>::new();
    let mut six = vec![[S::zero(); 6]; STATES];
    let mut status: Vec<Status> = vec![Ok(()); STATES];
    let batch = Batch::new(model).with_instructions(instructions);
    for (layout, by_component) in [("by component", true), ("by state", false)] {
        let states = inputs.states(by_component);
        let acceleration = inputs.six(3, by_component);
        let wrench = inputs.six(4, by_component);
        let inverse = time(|| {
            let out = output(&mut six, by_component);
            black_box(&batch)
                .inverse_dynamics(&states, acceleration, wrench, out, &mut status)
                .expect("lengths");
        });
        let forward = time(|| {
            let out = output(&mut six, by_component);
            black_box(&batch)
                .forward_dynamics(&states, acceleration, wrench, out, &mut status)
                .expect("lengths");
        });
        assert!(status.iter().all(Result::is_ok));
        println!(
            "{:8} {name:16} {layout:12} inverse {inverse:6.1}  forward {forward:6.1}",
            instructions.name()
        );
    }
}

/// The matrices of the baked model.
fn matrices(instructions: Instructions) {
    let inputs = Inputs::<f64>::new();
    let mut matrices: [Vec<[f64; 36]>; 6] = std::array::from_fn(|_| vec![[0.0; 36]; STATES]);
    let mut status: Vec<Status> = vec![Ok(()); STATES];
    let batch = Batch::new(&Uhp2016).with_instructions(instructions);
    for (layout, by_component) in [("by component", true), ("by state", false)] {
        let states = inputs.states(by_component);
        let time = time(|| {
            let out = matrices.each_mut().map(|matrices| output(matrices, by_component)).into();
            black_box(&batch).matrices(&states, out, &mut status).expect("lengths");
        });
        println!("{:8} baked, f64       {layout:12} matrices {time:6.1}", instructions.name());
    }
}

/// A step of a simulation in which the base and the forces are the same for all platforms.
fn steps<M>(model: &M, name: &str, instructions: Instructions)
where
    M: InLanes<f64> + RodAlignment + generic::ActuatorGeometry + generic::ForwardDynamics + Sync,
{
    const STEPS: usize = 10;
    let inputs = Inputs::<f64>::new();
    let instant = Instant {
        base: BaseColumns::same(&BaseMotion::at_rest(Pose::identity())),
        actuator_force: Column::same([30.5; 6]),
        external_wrench: Column::same([0.0; 6]),
    };
    let instants = [instant; 2 * STEPS + 1];
    let mut status: Vec<Status> = vec![Ok(()); STATES];
    let mut made = vec![0; STATES];
    let mut times = Vec::new();
    let batch = Batch::new(model).with_instructions(instructions);
    for batch in [batch, batch.in_parallel()] {
        times.push(time(|| {
            let mut position = inputs.positions[1].clone();
            let mut rotation = inputs.rotations[1].clone();
            let mut velocity = inputs.sixes[2].clone();
            let simulated = Simulated {
                position: ColumnMut::states(&mut position),
                rotation: ColumnMut::states(&mut rotation),
                velocity: ColumnMut::states(&mut velocity),
                rms_acceleration: None,
                peak_acceleration: None,
                shortest_length: None,
                longest_length: None,
                steps: &mut made,
            };
            black_box(&batch).simulate(1e-4, &instants, simulated, &mut status).expect("lengths");
        }));
    }
    assert!(made.iter().all(|made| *made == STEPS), "{:?}", status.iter().find(|status| status.is_err()));
    let [one, all] = times[..] else { unreachable!("two batches") };
    println!(
        "{:8} {name:16} step {:6.1}  in all threads {:6.1}",
        instructions.name(),
        one / STEPS as f64,
        all / STEPS as f64
    );
}

fn output<S: Number, const N: usize>(states: &mut [[S; N]], by_component: bool) -> ColumnMut<'_, S, N> {
    match by_component {
        true => ColumnMut::component_major(states.as_flattened_mut()),
        false => ColumnMut::states(states),
    }
}

fn parameters<S: Number>() -> Parameters<S> {
    // The default platform's numbers, by name.
    let platform = numbers_of_a_platform();
    Parameters::from_fn(|name, values| {
        let (_, numbers) = platform.iter().find(|(known, _)| *known == name).expect("every parameter");
        for (value, number) in values.iter_mut().zip(numbers.iter().cycle()) {
            *value = S::constant(*number);
        }
    })
}

/// A platform like the default one; only its cost matters here.
fn numbers_of_a_platform() -> Vec<(&'static str, Vec<f64>)> {
    let circle = |radius: f64, half_angle: f64| {
        let point = move |leg: u32| {
            let centre = f64::from(leg / 2) * 120.0;
            let sign = if leg.is_multiple_of(2) { 1.0 } else { -1.0 };
            let angle = (centre + sign * half_angle).to_radians();
            [radius * angle.cos(), radius * angle.sin(), 0.0]
        };
        (0..6).flat_map(point).collect::<Vec<_>>()
    };
    vec![
        ("base_point", circle(0.18, 43.0)),
        ("actuator_axis", vec![0.0, 0.0, 1.0]),
        ("platform_point", circle(0.12, 15.0)),
        ("rod_length", vec![0.206]),
        ("rod_mass", vec![1.024]),
        ("rod_inertia", vec![0.0036]),
        ("rod_com_fraction", vec![0.5]),
        ("mover_mass", vec![0.611]),
        ("mover_offset", vec![0.05]),
        ("rest_length", vec![0.198]),
        ("axial_stiffness", vec![21555.9]),
        ("axial_damping", vec![0.0]),
        ("payload_mass", vec![6.092]),
        ("payload_com", vec![0.0, 0.0, 0.031]),
        ("payload_inertia", vec![0.025, 0.0, 0.0, 0.0, 0.025, 0.0, 0.0, 0.0, 0.035]),
        ("gravity", vec![0.0, 0.0, -9.81]),
    ]
}

fn main() {
    println!("nanoseconds per state, least of {BATCHES} batches of {STATES} states");
    for instructions in Instructions::available() {
        let [double, single] =
            [instructions.run::<f64, _>(MultiplyAdds), instructions.run::<f32, _>(MultiplyAdds)];
        println!(
            "{:8} a multiply-add        f64 {double:.4}  f32 {single:.4}, each without waiting for others",
            instructions.name()
        );
        dynamics::<f64, _>(&Uhp2016, "baked, f64", instructions);
        matrices(instructions);
        dynamics::<f32, _>(&Uhp2016, "baked, f32", instructions);
        steps(&Uhp2016, "baked, f64", instructions);
        dynamics::<f64, _>(&Uhp { parameters: parameters() }, "at run time, f64", instructions);
    }
}
