//! Every result by name, as flat row-major numbers, so that comparisons need one loop. Outside the numeric
//! core: this may allocate.

use core::marker::PhantomData;

use nalgebra::SMatrix;

use crate::legs::LegType;
use crate::parameters::Parameters;
use crate::state::State;
use crate::{
    base_wrench, bias, body_kinematics, coriolis_matrices, energy, forward_dynamics, generalised_forces,
    inverse_dynamics, jacobian_db, jacobian_dp, leg_kinematics, mass_matrix_b, mass_matrix_p,
    partial_velocities, passive_forces, passive_inverse_dynamics, rod_alignment, stiffness_matrices,
    total_bias,
};

/// One named result for legs of type `L`.
#[derive(Clone, Copy, Debug)]
pub struct Output<L> {
    /// Name, that of the struct's field or of the function that gives it.
    pub name: &'static str,
    /// Shape; a leading 6 before other sizes counts the legs, an empty shape is a scalar.
    pub shape: &'static [usize],
    pub(crate) append: fn(&Parameters<L>, &State, &mut Vec<f64>),
}

impl<L: LegType> Output<L> {
    /// Number of entries, the product of the shape.
    pub fn entries(&self) -> usize {
        self.shape.iter().product()
    }

    /// Appends the value in row-major order. Results without a solution (a singular Jacobian) are NaN.
    pub fn append(&self, parameters: &Parameters<L>, state: &State, out: &mut Vec<f64>) {
        (self.append)(parameters, state, out);
    }
}

const VECTOR: &[usize] = &[3];
const SIX: &[usize] = &[6];
pub(crate) const SIX_VECTORS: &[usize] = &[6, 3];
pub(crate) const SQUARE: &[usize] = &[6, 6];
const PARTIAL: &[usize] = &[3, 6];
pub(crate) const SIX_PARTIALS: &[usize] = &[6, 3, 6];

/// The results that every leg type has.
struct Common<L>(PhantomData<L>);

#[rustfmt::skip]
impl<L: LegType> Common<L> {
    const OUTPUTS: &'static [Output<L>] = &[
        Output { name: "rod_alignment", shape: SIX, append: |p, s, out| put(&rod_alignment(p, s), out) },

        Output { name: "actuator_length", shape: SIX, append: |p, s, out| put(&leg_kinematics(p, s).actuator_length, out) },
        Output { name: "actuator_velocity", shape: SIX, append: |p, s, out| put(&leg_kinematics(p, s).actuator_velocity, out) },
        Output { name: "actuator_acceleration", shape: SIX, append: |p, s, out| put(&leg_kinematics(p, s).actuator_acceleration, out) },
        Output { name: "rod_direction", shape: SIX_VECTORS, append: |p, s, out| put_all(&leg_kinematics(p, s).rod_direction, out) },
        Output { name: "hooke_joint_position", shape: SIX_VECTORS, append: |p, s, out| put_all(&leg_kinematics(p, s).hooke_joint_position, out) },
        Output { name: "platform_joint_position", shape: SIX_VECTORS, append: |p, s, out| put_all(&leg_kinematics(p, s).platform_joint_position, out) },
        Output { name: "platform_joint_rate", shape: SIX_VECTORS, append: |p, s, out| put_all(&leg_kinematics(p, s).platform_joint_rate, out) },

        Output { name: "payload_com_position", shape: VECTOR, append: |p, s, out| put(&body_kinematics(p, s).payload_com_position, out) },
        Output { name: "payload_com_velocity", shape: VECTOR, append: |p, s, out| put(&body_kinematics(p, s).payload_com_velocity, out) },
        Output { name: "payload_com_acceleration", shape: VECTOR, append: |p, s, out| put(&body_kinematics(p, s).payload_com_acceleration, out) },

        Output { name: "payload_partial_velocity", shape: PARTIAL, append: |p, s, out| put(&partial_velocities(p, s).payload_partial_velocity, out) },
        Output { name: "payload_partial_angular_velocity", shape: PARTIAL, append: |p, s, out| put(&partial_velocities(p, s).payload_partial_angular_velocity, out) },

        Output { name: "payload_active_force", shape: SIX, append: |p, s, out| put(&generalised_forces(p, s).payload_active_force, out) },
        Output { name: "payload_inertia_force", shape: SIX, append: |p, s, out| put(&generalised_forces(p, s).payload_inertia_force, out) },

        Output { name: "jacobian_dp", shape: SQUARE, append: |p, s, out| put(&jacobian_dp(p, s), out) },
        Output { name: "jacobian_db", shape: SQUARE, append: |p, s, out| put(&jacobian_db(p, s), out) },
        Output { name: "mass_matrix_p", shape: SQUARE, append: |p, s, out| put(&mass_matrix_p(p, s), out) },
        Output { name: "mass_matrix_b", shape: SQUARE, append: |p, s, out| put(&mass_matrix_b(p, s), out) },
        Output { name: "coriolis_matrix_p", shape: SQUARE, append: |p, s, out| put(&coriolis_matrices(p, s).coriolis_matrix_p, out) },
        Output { name: "coriolis_matrix_b", shape: SQUARE, append: |p, s, out| put(&coriolis_matrices(p, s).coriolis_matrix_b, out) },
        Output { name: "stiffness_matrix_p", shape: SQUARE, append: |p, s, out| put(&stiffness_matrices(p, s).stiffness_matrix_p, out) },
        Output { name: "stiffness_matrix_b", shape: SQUARE, append: |p, s, out| put(&stiffness_matrices(p, s).stiffness_matrix_b, out) },

        Output { name: "gravity_force", shape: SIX, append: |p, s, out| put(&passive_forces(p, s).gravity_force, out) },
        Output { name: "spring_force", shape: SIX, append: |p, s, out| put(&passive_forces(p, s).spring_force, out) },
        Output { name: "damping_force", shape: SIX, append: |p, s, out| put(&passive_forces(p, s).damping_force, out) },
        Output { name: "bias", shape: SIX, append: |p, s, out| put(&bias(p, s), out) },

        Output { name: "inverse_dynamics", shape: SIX, append: |p, s, out| put_or_nan(inverse_dynamics(p, s), out) },
        Output { name: "passive_inverse_dynamics", shape: SIX, append: |p, s, out| put_or_nan(passive_inverse_dynamics(p, s), out) },
        Output { name: "total_bias", shape: SIX, append: |p, s, out| put(&total_bias(p, s), out) },
        Output { name: "base_wrench", shape: SIX, append: |p, s, out| put(&base_wrench(p, s), out) },
        Output { name: "forward_dynamics", shape: SIX, append: |p, s, out| put_or_nan(forward_dynamics(p, s), out) },
        Output { name: "kinetic_energy", shape: &[], append: |p, s, out| out.push(energy(p, s).kinetic_energy) },
        Output { name: "potential_energy", shape: &[], append: |p, s, out| out.push(energy(p, s).potential_energy) },
    ];
}

/// Every result there is for legs of type `L`, each once.
pub fn outputs<L: LegType>() -> impl Iterator<Item = &'static Output<L>> {
    Common::<L>::OUTPUTS.iter().chain(L::OUTPUTS)
}

/// Appends the result called `name`, row-major; `false` if there is none of that name. Results that do not exist
/// (a singular Jacobian, a leg out of reach) are NaN.
pub fn output<L: LegType>(parameters: &Parameters<L>, state: &State, name: &str, out: &mut Vec<f64>) -> bool {
    let found = outputs::<L>().find(|output| output.name == name);
    if let Some(output) = found {
        output.append(parameters, state, out);
    }
    found.is_some()
}

fn put<const ROWS: usize, const COLUMNS: usize>(matrix: &SMatrix<f64, ROWS, COLUMNS>, out: &mut Vec<f64>) {
    out.extend(matrix.transpose().iter());
}

pub(crate) fn put_all<const ROWS: usize, const COLUMNS: usize>(
    matrices: &[SMatrix<f64, ROWS, COLUMNS>; 6],
    out: &mut Vec<f64>,
) {
    for matrix in matrices {
        put(matrix, out);
    }
}

fn put_or_nan(solution: Option<SMatrix<f64, 6, 1>>, out: &mut Vec<f64>) {
    put(&solution.unwrap_or(SMatrix::repeat(f64::NAN)), out);
}

/// One of two bodies of every leg.
pub(crate) fn put_body<const ROWS: usize, const COLUMNS: usize>(
    matrices: &[[SMatrix<f64, ROWS, COLUMNS>; 2]; 6],
    body: usize,
    out: &mut Vec<f64>,
) {
    put_all(&matrices.map(|bodies| bodies[body]), out);
}
