//! A baked model without lanes: flat code for one number per operation, as batches and processors without suitable registers
//! run it. The model's own methods take lanes where the processor has them.

use std::marker::PhantomData;

use dyn_runtime::kernels::{self, generic};
use dyn_runtime::lanes::Generic;

/// A baked model by its functions for any type of number, called with `f64`.
pub struct Flat<M>(PhantomData<M>);

impl<M> Default for Flat<M> {
    fn default() -> Self {
        Self(PhantomData)
    }
}

/// Implements a kernel trait of [`Flat`] by the same function in [`generic`], as one function that is called.
macro_rules! by_the_generic_function {
    ($kernel:ident, $function:ident; $($input:ident: $input_type:ty),*; $($output:ident: $output_type:ty),*) => {
        impl<M: generic::$kernel + Generic<Parameters<f64> = ()>> kernels::$kernel for Flat<M> {
            #[inline(never)]
            fn $function(&self, $($input: &$input_type,)* $($output: &mut $output_type),*) {
                <M as generic::$kernel>::$function(&(), $($input,)* $($output),*);
            }
        }
    };
}

type Vector = [f64; 3];
type Rotation = [[f64; 3]; 3];
type Six = [f64; 6];
type Matrix = [[f64; 6]; 6];

by_the_generic_function!(InverseDynamics, inverse_dynamics; base_position: Vector, base_rotation: Rotation,
    base_velocity: Six, base_acceleration: Six, platform_position: Vector, platform_rotation: Rotation,
    platform_velocity: Six, platform_acceleration: Six, external_wrench: Six; inverse_dynamics: Six);
by_the_generic_function!(ForwardDynamics, forward_dynamics; base_position: Vector, base_rotation: Rotation,
    base_velocity: Six, base_acceleration: Six, platform_position: Vector, platform_rotation: Rotation,
    platform_velocity: Six, actuator_force: Six, external_wrench: Six; forward_dynamics: Six);
by_the_generic_function!(Matrices, matrices; base_position: Vector, base_rotation: Rotation, base_velocity: Six,
    platform_position: Vector, platform_rotation: Rotation, platform_velocity: Six; mass_matrix_p: Matrix,
    coriolis_matrix_p: Matrix, jacobian_dp: Matrix, mass_matrix_b: Matrix, coriolis_matrix_b: Matrix,
    jacobian_db: Matrix);
by_the_generic_function!(MassMatrixP, mass_matrix_p; base_position: Vector, base_rotation: Rotation,
    platform_position: Vector, platform_rotation: Rotation; mass_matrix_p: Matrix);
by_the_generic_function!(CoriolisMatrices, coriolis_matrices; base_position: Vector, base_rotation: Rotation,
    base_velocity: Six, platform_position: Vector, platform_rotation: Rotation, platform_velocity: Six;
    coriolis_matrix_p: Matrix, coriolis_matrix_b: Matrix);
by_the_generic_function!(JacobianDp, jacobian_dp; base_position: Vector, base_rotation: Rotation,
    platform_position: Vector, platform_rotation: Rotation; jacobian_dp: Matrix);
