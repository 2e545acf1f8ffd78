//! The angle front door: inverse dynamics where base and platform are turned by the paper's angles, six sines and cosines
//! before the dynamics.

use std::hint::black_box;

use dyn_runtime::Pose;
use dyn_runtime::kernels::InverseDynamics;
use nalgebra::{Matrix3, Rotation3, Vector3, Vector6};

use crate::call::Call;
use crate::cases;
use crate::states::{COUNT, Inputs, States};

/// A state whose rotations are given by angles, `R = Rz(c3) Ry(c2) Rx(c1)`.
#[derive(Clone, Copy)]
pub struct AngleState {
    base_rad: [f64; 3],
    platform_rad: [f64; 3],
    inputs: Inputs,
    reference: dyn_reference::State,
}

/// The states with their rotations as angles.
pub fn states(states: &States) -> Box<[AngleState; COUNT]> {
    Box::new(std::array::from_fn(|index| {
        let inputs = states.inputs[index];
        AngleState {
            base_rad: angles(&inputs.base_rotation),
            platform_rad: angles(&inputs.platform_rotation),
            inputs,
            reference: states.reference[index],
        }
    }))
}

/// The paper's angles of a rotation (2).
fn angles(r: &[[f64; 3]; 3]) -> [f64; 3] {
    let across = r[0][0].hypot(r[1][0]);
    [r[2][1].atan2(r[2][2]), (-r[2][0]).atan2(across), r[1][0].atan2(r[0][0])]
}

/// By a generated model and the runtime crate's rotations.
pub struct Generated<M> {
    /// The model.
    pub model: M,
    /// Where the result goes.
    pub output: [f64; 6],
}

impl<M: InverseDynamics> Call for Generated<M> {
    type State = AngleState;
    type Output = [f64; 6];

    #[inline(always)]
    fn call<R>(&mut self, state: &AngleState, read: impl FnOnce(&[f64; 6]) -> R) -> R {
        let rotation = |angles_rad| -> [[f64; 3]; 3] {
            let columns = Pose::from_paper_angles(Vector3::zeros(), angles_rad).rotation;
            columns.matrix().transpose().into()
        };
        let inputs = Inputs {
            base_rotation: rotation(state.base_rad),
            platform_rotation: rotation(state.platform_rad),
            ..state.inputs
        };
        cases::inverse_dynamics(black_box(&self.model), &inputs, &mut self.output);
        read(&self.output)
    }
}

/// By the reference and nalgebra's rotations.
pub struct Reference {
    /// The platform.
    pub parameters: dyn_reference::Parameters,
}

impl Call for Reference {
    type State = AngleState;
    type Output = Option<Vector6<f64>>;

    #[inline(always)]
    fn call<R>(&mut self, state: &AngleState, read: impl FnOnce(&Option<Vector6<f64>>) -> R) -> R {
        let rotation =
            |[x, y, z]: [f64; 3]| -> Matrix3<f64> { Rotation3::from_euler_angles(x, y, z).into_inner() };
        let mut turned = state.reference;
        turned.base.rotation = rotation(state.base_rad);
        turned.platform.rotation = rotation(state.platform_rad);
        let output = dyn_reference::inverse_dynamics(black_box(&self.parameters), &turned);
        read(&output)
    }
}
