//! Many states at once: the row `generated_batch`, time per state.

use std::hint::black_box;

use dyn_runtime::batch::{BaseColumns, Batch, Column, ColumnMut, PlatformColumns, States as Columns, Status};

use crate::model::Baked;
use crate::states::{Inputs, States};

/// States of a batch: the benchmark's, again and again. No power of two, see `dyn_runtime::batch`.
pub const STATES: usize = 1080;

/// One input of all states, component after component.
fn column<const N: usize>(states: &States, numbers: impl Fn(&Inputs) -> [f64; N]) -> Vec<f64> {
    let inputs = || states.inputs.iter().cycle().take(STATES);
    (0..N).flat_map(|k| inputs().map(move |state| (k, state))).map(|(k, state)| numbers(state)[k]).collect()
}

fn flat(rows: &[[f64; 3]; 3]) -> [f64; 9] {
    rows.as_flattened().try_into().expect("nine numbers")
}

/// Calls `with` with a function that computes [`STATES`] states by this one of the generated functions, if batches have it.
///
/// # Panics
/// If the batch refuses a state.
pub fn visit(function: &str, states: &States, with: impl FnOnce(&mut dyn FnMut())) {
    let base_position = column(states, |state| state.base_position);
    let base_rotation = column(states, |state| flat(&state.base_rotation));
    let base_velocity = column(states, |state| state.base_velocity);
    let base_acceleration = column(states, |state| state.base_acceleration);
    let platform_position = column(states, |state| state.platform_position);
    let platform_rotation = column(states, |state| flat(&state.platform_rotation));
    let platform_velocity = column(states, |state| state.platform_velocity);
    let acceleration = column(states, |state| state.platform_acceleration);
    let force = column(states, |state| state.actuator_force);
    let wrench = column(states, |state| state.external_wrench);
    let columns = Columns {
        base: BaseColumns {
            position: Column::component_major(&base_position),
            rotation: Column::component_major(&base_rotation),
            velocity: Column::component_major(&base_velocity),
            acceleration: Column::component_major(&base_acceleration),
        },
        platform: PlatformColumns {
            position: Column::component_major(&platform_position),
            rotation: Column::component_major(&platform_rotation),
            velocity: Column::component_major(&platform_velocity),
        },
    };
    let (acceleration, force) = (Column::component_major(&acceleration), Column::component_major(&force));
    let wrench = Column::component_major(&wrench);
    let mut six = vec![0.0; 6 * STATES];
    let mut matrices: [Vec<f64>; 6] = std::array::from_fn(|_| vec![0.0; 36 * STATES]);
    let mut status: Vec<Status> = vec![Ok(()); STATES];
    let batch = Batch::new(&Baked);
    const LENGTHS: &str = "as many of everything";
    match function {
        "inverse_dynamics" => with(&mut || {
            let out = ColumnMut::component_major(&mut six);
            let batch = black_box(&batch);
            batch.inverse_dynamics(&columns, acceleration, wrench, out, &mut status).expect(LENGTHS);
            black_box(&mut six);
        }),
        "forward_dynamics" => with(&mut || {
            let out = ColumnMut::component_major(&mut six);
            let batch = black_box(&batch);
            batch.forward_dynamics(&columns, force, wrench, out, &mut status).expect(LENGTHS);
            black_box(&mut six);
        }),
        "matrices" => with(&mut || {
            let out = matrices.each_mut().map(|numbers| ColumnMut::component_major(numbers)).into();
            black_box(&batch).matrices(&columns, out, &mut status).expect(LENGTHS);
            black_box(&mut matrices);
        }),
        _ => {}
    }
    assert!(status.iter().all(Result::is_ok), "a state was refused");
}
