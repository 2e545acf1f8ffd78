//! Free platforms, many at once: simulated in lanes.

use dyn_runtime::PlatformState;
use dyn_runtime::batch::{BaseColumns, Batch, Column, ColumnMut, Instant, Simulated};
use dyn_runtime::models::Uhp;
use dyn_runtime::nalgebra::{Rotation3, Vector6};

use super::designs::Design;
use super::file::Sweep;
use super::found::{Ending, Found};
use crate::motion::BodyMotion;
use crate::rotation::rows;
use crate::scenario::Steering;

/// Steps for which the motion of the base is kept.
const STEPS_AT_ONCE: usize = 64;

/// The base of every design at one time.
#[derive(Default)]
struct Bases {
    position: Vec<[f64; 3]>,
    rotation: Vec<[f64; 9]>,
    velocity: Vec<[f64; 6]>,
    acceleration: Vec<[f64; 6]>,
}

impl Bases {
    fn push(&mut self, motion: &BodyMotion) {
        self.position.push(motion.pose.position_m.into());
        self.rotation.push(flat(&motion.pose.rotation));
        self.velocity.push(motion.velocity.to_vector().into());
        self.acceleration.push(motion.acceleration.to_vector().into());
    }

    /// One base is that of all designs.
    fn columns(&self) -> BaseColumns<'_, f64> {
        match (
            self.position.as_slice(),
            self.rotation.as_slice(),
            self.velocity.as_slice(),
            self.acceleration.as_slice(),
        ) {
            ([position], [rotation], [velocity], [acceleration]) => BaseColumns {
                position: Column::same(*position),
                rotation: Column::same(*rotation),
                velocity: Column::same(*velocity),
                acceleration: Column::same(*acceleration),
            },
            (position, rotation, velocity, acceleration) => BaseColumns {
                position: Column::states(position),
                rotation: Column::states(rotation),
                velocity: Column::states(velocity),
                acceleration: Column::states(acceleration),
            },
        }
    }
}

/// Row by row.
pub(super) fn flat(rotation: &Rotation3<f64>) -> [f64; 9] {
    let [[a, b, c], [d, e, f], [g, h, i]] = rows(rotation);
    [a, b, c, d, e, f, g, h, i]
}

/// Simulates these designs.
pub(super) fn fly(sweep: &Sweep, designs: &[&Design]) -> Vec<Found> {
    let (grid, count) = (sweep.nominal.grid, designs.len());
    let models: Vec<Uhp> = designs.iter().map(|design| design.model).collect();
    let (starts, forces): (Vec<PlatformState>, Vec<[f64; 6]>) = designs
        .iter()
        .map(|design| match &design.steering {
            Steering::Free(start, force) => (*start, <[f64; 6]>::from(*force)),
            // A sweep's designs do what its scenario does.
            Steering::Target(motion) => (motion.at(0.0).as_platform(), Vector6::zeros().into()),
        })
        .unzip();
    let mut position: Vec<[f64; 3]> = starts.iter().map(|start| start.pose.position_m.into()).collect();
    let mut rotation: Vec<[f64; 9]> = starts.iter().map(|start| flat(&start.pose.rotation)).collect();
    let mut velocity: Vec<[f64; 6]> = starts.iter().map(|start| start.velocity.to_vector().into()).collect();
    let same_base = designs.iter().all(|design| design.base == designs[0].base);
    let different = if same_base { &designs[..1.min(count)] } else { designs };

    let mut flights = vec![Flight::default(); count];
    let (zeros, mut status, mut made) = (vec![[0.0; 6]; count], vec![Ok(()); count], vec![0; count]);
    let [mut rms, mut peak, mut shortest, mut longest] = [(); 4].map(|()| zeros.clone());
    let mut first = 0;
    while first < grid.steps && flights.iter().any(|flight| flight.ended.is_none()) {
        // Accelerations count from a step on: no stretch goes across it.
        let counted = sweep.nominal.spectrum.first_step;
        let end = if first < counted { counted } else { grid.steps };
        let steps = STEPS_AT_ONCE.min(end - first);
        let bases: Vec<Bases> = (0..=2 * steps)
            .map(|halves| {
                let mut bases = Bases::default();
                for design in different {
                    bases.push(&design.base.at(grid.half_step_time(2 * first + halves)));
                }
                bases
            })
            .collect();
        let instant = |bases| Instant {
            base: Bases::columns(bases),
            actuator_force: Column::states(&forces),
            external_wrench: Column::same([0.0; 6]),
        };
        let instants: Vec<Instant<f64>> = bases.iter().map(instant).collect();
        let simulated = Simulated {
            position: ColumnMut::states(&mut position),
            rotation: ColumnMut::states(&mut rotation),
            velocity: ColumnMut::states(&mut velocity),
            rms_acceleration: Some(ColumnMut::states(&mut rms)),
            peak_acceleration: Some(ColumnMut::states(&mut peak)),
            shortest_length: Some(ColumnMut::states(&mut shortest)),
            longest_length: Some(ColumnMut::states(&mut longest)),
            steps: &mut made,
        };
        Batch::of_models(&models)
            .simulate(grid.step_s, &instants, simulated, &mut status)
            .expect("every column has a place for each design");
        for (k, flight) in flights.iter_mut().enumerate().filter(|(_, flight)| flight.ended.is_none()) {
            let base = |halves: usize| {
                let bases: &Bases = &bases[halves];
                bases.acceleration[if same_base { 0 } else { k }]
            };
            flight.lengths(&shortest[k], &longest[k]);
            if first >= counted {
                flight.accelerations(made[k], &rms[k], &peak[k], (0..made[k]).map(|step| base(2 * step)));
            }
            if let Err(error) = status[k] {
                let time_s = grid.time(first + made[k]);
                flight.ended = Some(Ending { time_s, reason: error.to_string() });
            }
        }
        first += steps;
    }
    let found = flights.into_iter().zip(&forces).zip(designs);
    found.map(|((flight, force), design)| flight.found(force).judged(&design.limits)).collect()
}

/// What is known of one design on its way.
#[derive(Clone)]
struct Flight {
    ended: Option<Ending>,
    steps: usize,
    squares: [f64; 6],
    base_squares: [f64; 6],
    peak: [f64; 6],
    shortest: [f64; 6],
    longest: [f64; 6],
}

impl Default for Flight {
    fn default() -> Self {
        let Found { shortest_m: shortest, longest_m: longest, peak_acceleration: peak, .. } =
            Found::nothing();
        Self { ended: None, steps: 0, squares: [0.0; 6], base_squares: [0.0; 6], peak, shortest, longest }
    }
}

impl Flight {
    fn lengths(&mut self, shortest: &[f64; 6], longest: &[f64; 6]) {
        for leg in 0..6 {
            self.shortest[leg] = self.shortest[leg].min(shortest[leg]);
            self.longest[leg] = self.longest[leg].max(longest[leg]);
        }
    }

    fn accelerations(
        &mut self,
        steps: usize,
        rms: &[f64; 6],
        peak: &[f64; 6],
        bases: impl Iterator<Item = [f64; 6]>,
    ) {
        for k in 0..6 {
            self.squares[k] += steps as f64 * rms[k] * rms[k];
            self.peak[k] = self.peak[k].max(peak[k]);
        }
        for base in bases {
            for (square, acceleration) in self.base_squares.iter_mut().zip(base) {
                *square += acceleration * acceleration;
            }
        }
        self.steps += steps;
    }

    fn found(self, force: &[f64; 6]) -> Found {
        // No step that counts: 0/0, not a number.
        let rms = |squares: [f64; 6]| squares.map(|square| (square / self.steps as f64).sqrt());
        Found {
            ended: self.ended,
            force_n: force.map(f64::abs),
            shortest_m: self.shortest,
            longest_m: self.longest,
            rms_acceleration: rms(self.squares),
            peak_acceleration: self.peak,
            base_rms_acceleration: rms(self.base_squares),
            exceeded: None,
        }
    }
}
