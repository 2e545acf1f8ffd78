//! States to be computed, and how one function computes them.

use dyn_runtime::batch::{BaseColumns, Batch, Column, ColumnMut, PlatformColumns, States, Status};
use dyn_runtime::kernels::generic;
use dyn_runtime::lanes::Number;
use dyn_runtime::nalgebra::Vector3;
use dyn_runtime::{Error, Pose, kernels};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

/// Inputs of as many states as are wanted.
#[derive(Clone)]
pub struct Inputs<S> {
    pub positions: [Vec<[S; 3]>; 2],
    pub rotations: [Vec<[S; 9]>; 2],
    /// Velocity and acceleration of the base, velocity of the platform, acceleration or force, wrench.
    pub sixes: [Vec<[S; 6]>; 5],
}

impl<S: Number> Inputs<S> {
    pub fn new(count: usize) -> Self {
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

    pub fn count(&self) -> usize {
        self.positions[0].len()
    }

    pub fn states(&self) -> States<'_, S> {
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

    pub fn six(&self, k: usize) -> Column<'_, S, 6> {
        Column::states(&self.sixes[k])
    }
}

pub fn rows<S: Copy>(numbers: [S; 9]) -> [[S; 3]; 3] {
    let [a, b, c, d, e, f, g, h, i] = numbers;
    [[a, b, c], [d, e, f], [g, h, i]]
}

pub fn inverse<M, S: Number>(batch: Batch<M>, inputs: &Inputs<S>) -> (Vec<[S; 6]>, Vec<Status>)
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
