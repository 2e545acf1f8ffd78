//! Everything that a controller asks of the model in a cycle: d, d', J_dp, M_p, bias, forces.

use dyn_runtime::models::Uhp2016;
use dyn_runtime::{Acceleration, BaseMotion, Error, Hexapod, PlatformState, Pose, Twist, Wrench};
use nalgebra::{Matrix3, Matrix6, Rotation3, Vector3, Vector6};

use crate::states::{Inputs, States};

/// The outputs, in this order: d, d', J_dp, M_p, bias, forces.
pub type Bundle = (Vector6<f64>, Vector6<f64>, Matrix6<f64>, Matrix6<f64>, Vector6<f64>, Vector6<f64>);

/// A state as checked calls take it.
pub struct TypedState {
    base: BaseMotion,
    platform: PlatformState,
    platform_acceleration: Acceleration,
    external_wrench: Wrench,
}

/// All states.
pub fn typed_states(states: &States) -> Vec<TypedState> {
    states.inputs.iter().map(typed).collect()
}

/// By generated code, with all checks.
///
/// # Errors
/// As the calls.
pub fn generated(state: &TypedState) -> Result<Bundle, Error> {
    let hexapod = Hexapod::new(Uhp2016);
    let TypedState { base, platform, platform_acceleration, external_wrench } = state;
    let legs = hexapod.leg_kinematics(base, platform, platform_acceleration)?;
    Ok((
        legs.actuator_length_m,
        legs.actuator_velocity_m_s,
        hexapod.jacobian_dp(base, platform)?,
        hexapod.mass_matrix_p(base, platform)?,
        hexapod.bias(base, platform)?,
        hexapod.inverse_dynamics(base, platform, platform_acceleration, external_wrench)?,
    ))
}

/// By the reference; forces are NaN where it finds none.
pub fn reference(parameters: &dyn_reference::Parameters, state: &dyn_reference::State) -> Bundle {
    let legs = dyn_reference::leg_kinematics(parameters, state);
    (
        legs.actuator_length,
        legs.actuator_velocity,
        dyn_reference::jacobian_dp(parameters, state),
        dyn_reference::mass_matrix_p(parameters, state),
        dyn_reference::bias(parameters, state),
        dyn_reference::inverse_dynamics(parameters, state).unwrap_or(Vector6::repeat(f64::NAN)),
    )
}

fn typed(inputs: &Inputs) -> TypedState {
    let (linear_m_s2, angular_rad_s2) = halves(&inputs.base_acceleration);
    let acceleration = Acceleration { linear_m_s2, angular_rad_s2 };
    let (linear_m_s2, angular_rad_s2) = halves(&inputs.platform_acceleration);
    let platform_acceleration = Acceleration { linear_m_s2, angular_rad_s2 };
    let (force_n, moment_n_m) = halves(&inputs.external_wrench);
    TypedState {
        base: BaseMotion {
            pose: pose(&inputs.base_position, &inputs.base_rotation),
            velocity: twist(&inputs.base_velocity),
            acceleration,
        },
        platform: PlatformState {
            pose: pose(&inputs.platform_position, &inputs.platform_rotation),
            velocity: twist(&inputs.platform_velocity),
        },
        platform_acceleration,
        external_wrench: Wrench { force_n, moment_n_m },
    }
}

fn pose(position: &[f64; 3], rows: &[[f64; 3]; 3]) -> Pose {
    let rotation = Rotation3::from_matrix_unchecked(Matrix3::from(*rows).transpose());
    Pose { position_m: Vector3::from(*position), rotation }
}

fn twist(stacked: &[f64; 6]) -> Twist {
    let (linear_m_s, angular_rad_s) = halves(stacked);
    Twist { linear_m_s, angular_rad_s }
}

fn halves([a, b, c, d, e, f]: &[f64; 6]) -> (Vector3<f64>, Vector3<f64>) {
    (Vector3::new(*a, *b, *c), Vector3::new(*d, *e, *f))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::states::{platform, reference_parameters, sampled};

    #[test]
    fn both_compute_the_same() {
        let platform = platform();
        let states = States::new(&sampled(&platform));
        let parameters = reference_parameters(&platform);
        for (typed, state) in typed_states(&states).iter().zip(states.reference.iter()) {
            let (length, velocity, jacobian, mass, bias, forces) = generated(typed).unwrap();
            let expected = reference(&parameters, state);
            assert!((length - expected.0).amax() < 1e-12);
            assert!((velocity - expected.1).amax() < 1e-12 * expected.1.amax().max(1.0));
            assert!((jacobian - expected.2).amax() < 1e-12 * expected.2.amax());
            assert!((mass - expected.3).amax() < 1e-12 * expected.3.amax());
            assert!((bias - expected.4).amax() < 1e-12 * expected.4.amax());
            assert!((forces - expected.5).amax() < 1e-10 * expected.5.amax());
        }
    }
}
