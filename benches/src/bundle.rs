//! Everything that a controller asks of the model in a cycle: d, d', J_dp, M_p, bias less `M_b v_b'`, forces.

use dyn_runtime::models::Uhp2016;
use dyn_runtime::{Acceleration, BaseMotion, Control, Error, Hexapod, PlatformState, Pose, Twist, Wrench};
use nalgebra::{Matrix3, Rotation3, Vector3, Vector6};

use crate::states::{Inputs, States};

/// A state as checked calls take it.
#[derive(Clone)]
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
/// As the call.
pub fn generated(state: &TypedState) -> Result<Control, Error> {
    let TypedState { base, platform, platform_acceleration, external_wrench } = state;
    Hexapod::new(Uhp2016).control(base, platform, platform_acceleration, external_wrench)
}

/// By the reference; forces are NaN where it finds none.
pub fn reference(parameters: &dyn_reference::Parameters, state: &dyn_reference::State) -> Control {
    let legs = dyn_reference::leg_kinematics(parameters, state);
    Control {
        actuator_length_m: legs.actuator_length,
        actuator_velocity_m_s: legs.actuator_velocity,
        jacobian_dp: dyn_reference::jacobian_dp(parameters, state),
        mass_matrix_p: dyn_reference::mass_matrix_p(parameters, state),
        total_bias: dyn_reference::total_bias(parameters, state),
        inverse_dynamics_n: dyn_reference::inverse_dynamics(parameters, state)
            .unwrap_or(Vector6::repeat(f64::NAN)),
    }
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
            let found = generated(typed).unwrap();
            let expected = reference(&parameters, state);
            let close = |found: Vector6<f64>, expected: Vector6<f64>| {
                assert!((found - expected).amax() <= 1e-11 * expected.amax().max(1.0));
            };
            close(found.actuator_length_m, expected.actuator_length_m);
            close(found.actuator_velocity_m_s, expected.actuator_velocity_m_s);
            close(found.total_bias, expected.total_bias);
            close(found.inverse_dynamics_n, expected.inverse_dynamics_n);
            for column in 0..6 {
                close(found.jacobian_dp.column(column).into(), expected.jacobian_dp.column(column).into());
                close(
                    found.mass_matrix_p.column(column).into(),
                    expected.mass_matrix_p.column(column).into(),
                );
            }
        }
    }
}
