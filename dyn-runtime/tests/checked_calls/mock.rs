//! A model that computes nothing: it records what it was given and counts 1, 2, 3, ... through its outputs,
//! so that a test sees which number went where.

use std::cell::{Cell, RefCell};
use std::ops::Range;

use dyn_runtime::kernels;

type V3 = [f64; 3];
type V6 = [f64; 6];
type M3 = [[f64; 3]; 3];
type M36 = [[f64; 6]; 3];
type M6 = [[f64; 6]; 6];

/// Lengths of the actuators at any pose.
pub const ACTUATOR_LENGTH_M: V6 = [0.2; 6];

/// Where J_dp stands among the outputs of `control`.
pub const JACOBIAN_IN_CONTROL: Range<usize> = 12..48;

pub struct Mock {
    /// What `rod_alignment` gives.
    pub rod_alignment: V6,
    /// What `jacobian_dp` gives, if it shall not count.
    pub jacobian_dp: Option<M6>,
    /// Which of the counted outputs is NaN instead, from 0.
    pub poisoned: Option<usize>,
    /// All inputs of the last counting call, flat, in order.
    pub inputs: RefCell<Vec<f64>>,
    /// How many outputs the last counting call had.
    pub outputs: Cell<usize>,
    /// How many counting calls there were.
    pub calls: Cell<usize>,
}

impl Mock {
    /// All legs in reach, J_dp well conditioned.
    pub fn regular() -> Self {
        let jacobian_dp = std::array::from_fn(|r| std::array::from_fn(|c| f64::from(u8::from(c <= r))));
        Self { jacobian_dp: Some(jacobian_dp), ..Self::counting() }
    }

    /// All legs in reach, J_dp counted like every other output.
    pub fn counting() -> Self {
        Self {
            rod_alignment: [0.8; 6],
            jacobian_dp: None,
            poisoned: None,
            inputs: RefCell::default(),
            outputs: Cell::default(),
            calls: Cell::default(),
        }
    }

    fn count(&self, inputs: &[&dyn Flat], outputs: &mut [&mut dyn Flat]) {
        let mut flat = Vec::new();
        inputs.iter().for_each(|input| input.append_to(&mut flat));
        self.inputs.replace(flat);
        let mut counter = 0;
        outputs.iter_mut().for_each(|output| output.fill(&mut counter, self.poisoned));
        self.outputs.set(counter);
        self.calls.set(self.calls.get() + 1);
    }
}

/// Numbers and arrays of any depth.
trait Flat {
    fn append_to(&self, flat: &mut Vec<f64>);
    fn fill(&mut self, counter: &mut usize, poisoned: Option<usize>);
}

impl Flat for f64 {
    fn append_to(&self, flat: &mut Vec<f64>) {
        flat.push(*self);
    }

    fn fill(&mut self, counter: &mut usize, poisoned: Option<usize>) {
        *self = if poisoned == Some(*counter) { f64::NAN } else { (*counter + 1) as f64 };
        *counter += 1;
    }
}

impl<T: Flat, const N: usize> Flat for [T; N] {
    fn append_to(&self, flat: &mut Vec<f64>) {
        self.iter().for_each(|element| element.append_to(flat));
    }

    fn fill(&mut self, counter: &mut usize, poisoned: Option<usize>) {
        self.iter_mut().for_each(|element| element.fill(counter, poisoned));
    }
}

impl kernels::RodAlignment for Mock {
    fn rod_alignment(&self, _: &V3, _: &M3, _: &V3, _: &M3, rod_alignment: &mut V6) {
        *rod_alignment = self.rod_alignment;
    }
}

impl kernels::JacobianDp for Mock {
    fn jacobian_dp(&self, rb: &V3, b: &M3, rp: &V3, p: &M3, jacobian_dp: &mut M6) {
        match self.jacobian_dp {
            Some(given) => *jacobian_dp = given,
            None => self.count(&[rb, b, rp, p], &mut [jacobian_dp]),
        }
    }
}

impl kernels::ActuatorGeometry for Mock {
    fn actuator_geometry(
        &self,
        _: &V3,
        _: &M3,
        _: &V3,
        _: &M3,
        rod_alignment: &mut V6,
        actuator_length: &mut V6,
        jacobian_dp: &mut M6,
    ) {
        *rod_alignment = self.rod_alignment;
        *actuator_length = ACTUATOR_LENGTH_M;
        *jacobian_dp = self.jacobian_dp.unwrap_or([[1.0; 6]; 6]);
    }
}

/// Counts, but its J_dp is the one that `jacobian_dp` gives: it is judged.
impl kernels::Control for Mock {
    fn control(
        &self,
        rb: &V3,
        b: &M3,
        vb: &V6,
        ab: &V6,
        rp: &V3,
        p: &M3,
        vp: &V6,
        ap: &V6,
        wrench: &V6,
        actuator_length: &mut V6,
        actuator_velocity: &mut V6,
        jacobian_dp: &mut M6,
        mass_matrix_p: &mut M6,
        total_bias: &mut V6,
        forces: &mut V6,
    ) {
        let outputs: &mut [&mut dyn Flat] =
            &mut [actuator_length, actuator_velocity, jacobian_dp, mass_matrix_p, total_bias, forces];
        self.count(&[rb, b, vb, ab, rp, p, vp, ap, wrench], outputs);
        let is_poisoned = self.poisoned.is_some_and(|output| JACOBIAN_IN_CONTROL.contains(&output));
        if let Some(given) = self.jacobian_dp.filter(|_| !is_poisoned) {
            *jacobian_dp = given;
        }
    }
}

/// `Trait => function(inputs) -> (outputs)`; a digit keeps names apart.
macro_rules! counting {
    ($($($kernel:ident)::+ => $function:ident($($input:ident: $in:ty),*) -> ($($output:ident: $out:ty),*);)*) => {$(
        impl kernels::$($kernel)::+ for Mock {
            fn $function(&self, $($input: &$in,)* $($output: &mut $out),*) {
                self.count(&[$($input),*], &mut [$($output),*]);
            }
        }
    )*};
}

counting! {
    LegKinematics => leg_kinematics(i1: V3, i2: M3, i3: V6, i4: V6, i5: V3, i6: M3, i7: V6, i8: V6)
        -> (o1: V6, o2: V6, o3: V6, o4: [V3; 6], o5: [V3; 6], o6: [V3; 6], o7: [V3; 6]);
    uhp::BodyKinematics => body_kinematics(i1: V3, i2: M3, i3: V6, i4: V6, i5: V3, i6: M3, i7: V6, i8: V6)
        -> (o1: V3, o2: V3, o3: V3, o4: [V3; 6], o5: [V3; 6], o6: [V3; 6], o7: [V3; 6], o8: [V3; 6], o9: [V3; 6],
            o10: [V3; 6], o11: [V3; 6]);
    uhp::PartialVelocities => partial_velocities(i1: V3, i2: M3, i3: V3, i4: M3)
        -> (o1: M36, o2: M36, o3: [M36; 6], o4: [M36; 6], o5: [M36; 6]);
    uhp::GeneralisedForces => generalised_forces(
        i1: V3, i2: M3, i3: V6, i4: V6, i5: V3, i6: M3, i7: V6, i8: V6, i9: V6, i10: V6
    ) -> (o1: V6, o2: V6, o3: M6, o4: M6, o5: M6, o6: M6);
    ups::BodyKinematics => body_kinematics(i1: V3, i2: M3, i3: V6, i4: V6, i5: V3, i6: M3, i7: V6, i8: V6)
        -> (o1: V3, o2: V3, o3: V3, o4: [V3; 6], o5: [V3; 6], o6: [V3; 6], o7: [V3; 6], o8: [V3; 6], o9: [V3; 6],
            o10: [V3; 6], o11: [V3; 6]);
    ups::PartialVelocities => partial_velocities(i1: V3, i2: M3, i3: V3, i4: M3)
        -> (o1: M36, o2: M36, o3: [M36; 6], o4: [M36; 6], o5: [M36; 6]);
    ups::GeneralisedForces => generalised_forces(
        i1: V3, i2: M3, i3: V6, i4: V6, i5: V3, i6: M3, i7: V6, i8: V6, i9: V6, i10: V6
    ) -> (o1: V6, o2: V6, o3: M6, o4: M6, o5: M6, o6: M6);
    JacobianDb => jacobian_db(i1: V3, i2: M3, i3: V3, i4: M3) -> (o1: M6);
    MassMatrixP => mass_matrix_p(i1: V3, i2: M3, i3: V3, i4: M3) -> (o1: M6);
    MassMatrixB => mass_matrix_b(i1: V3, i2: M3, i3: V3, i4: M3) -> (o1: M6);
    CoriolisMatrices => coriolis_matrices(i1: V3, i2: M3, i3: V6, i4: V3, i5: M3, i6: V6) -> (o1: M6, o2: M6);
    StiffnessMatrices => stiffness_matrices(i1: V3, i2: M3, i3: V3, i4: M3) -> (o1: M6, o2: M6);
    Matrices => matrices(i1: V3, i2: M3, i3: V6, i4: V3, i5: M3, i6: V6)
        -> (o1: M6, o2: M6, o3: M6, o4: M6, o5: M6, o6: M6);
    PassiveForces => passive_forces(i1: V3, i2: M3, i3: V6, i4: V3, i5: M3, i6: V6) -> (o1: V6, o2: V6, o3: V6);
    Bias => bias(i1: V3, i2: M3, i3: V6, i4: V3, i5: M3, i6: V6) -> (o1: V6);
    EquationOfMotion => equation_of_motion(i1: V3, i2: M3, i3: V6, i4: V3, i5: M3, i6: V6)
        -> (o1: M6, o2: M6, o3: M6, o4: M6, o5: M6, o6: M6, o7: M6, o8: M6, o9: V6, o10: V6, o11: V6, o12: V6);
    InverseDynamics => inverse_dynamics(i1: V3, i2: M3, i3: V6, i4: V6, i5: V3, i6: M3, i7: V6, i8: V6, i9: V6)
        -> (o1: V6);
    PassiveInverseDynamics => passive_inverse_dynamics(
        i1: V3, i2: M3, i3: V6, i4: V6, i5: V3, i6: M3, i7: V6, i8: V6, i9: V6, i10: V6
    ) -> (o1: V6);
    BaseReaction => base_reaction(i1: V3, i2: M3, i3: V6, i4: V6, i5: V3, i6: M3, i7: V6, i8: V6, i9: V6)
        -> (o1: V6);
    ForwardDynamics => forward_dynamics(i1: V3, i2: M3, i3: V6, i4: V6, i5: V3, i6: M3, i7: V6, i8: V6, i9: V6)
        -> (o1: V6);
    Energy => energy(i1: V3, i2: M3, i3: V6, i4: V3, i5: M3, i6: V6) -> (o1: f64, o2: f64);
}
