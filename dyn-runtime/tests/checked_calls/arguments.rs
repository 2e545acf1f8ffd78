//! Arguments for any call, which a test can spoil element by element.

use dyn_runtime::Input::{self, *};
use dyn_runtime::nalgebra::{Rotation3, SMatrix, Vector3, Vector6};
use dyn_runtime::{Acceleration, BaseMotion, PlatformState, Pose, Twist, Wrench};

use crate::mock::ACTUATOR_LENGTH_M;

/// Arguments for any call, all numbers different but those of the lengths, which are the mock's.
#[derive(Clone)]
pub struct Arguments {
    pub base: BaseMotion,
    pub platform: PlatformState,
    pub platform_acceleration: Acceleration,
    pub actuator_force_n: Vector6<f64>,
    pub external_wrench: Wrench,
    pub reference_velocity: Twist,
    pub actuator_length_m: Vector6<f64>,
    pub actuator_velocity_m_s: Vector6<f64>,
}

pub fn arguments() -> Arguments {
    let v = |x: f64| Vector3::new(x, x + 0.1, x + 0.2);
    Arguments {
        base: BaseMotion {
            pose: Pose::from_paper_angles(v(1.0), [0.1, 0.2, 0.3]),
            velocity: Twist { linear_m_s: v(2.0), angular_rad_s: v(3.0) },
            acceleration: Acceleration { linear_m_s2: v(4.0), angular_rad_s2: v(5.0) },
        },
        platform: PlatformState {
            pose: Pose::from_paper_angles(v(6.0), [-0.3, 0.1, -0.2]),
            velocity: Twist { linear_m_s: v(7.0), angular_rad_s: v(8.0) },
        },
        platform_acceleration: Acceleration { linear_m_s2: v(9.0), angular_rad_s2: v(10.0) },
        actuator_force_n: Vector6::new(11.0, 11.1, 11.2, 11.3, 11.4, 11.5),
        external_wrench: Wrench { force_n: v(12.0), moment_n_m: v(13.0) },
        reference_velocity: Twist { linear_m_s: v(14.0), angular_rad_s: v(15.0) },
        actuator_length_m: Vector6::from(ACTUATOR_LENGTH_M),
        actuator_velocity_m_s: Vector6::new(16.0, 16.1, 16.2, 16.3, 16.4, 16.5),
    }
}

impl Arguments {
    /// An input as the model's functions take it.
    pub fn flat(&self, input: Input) -> Vec<f64> {
        match input {
            BasePosition => flat(&[self.base.pose.position_m]),
            BaseRotation => flat(&[*self.base.pose.rotation.matrix()]),
            BaseVelocity => flat(&[self.base.velocity.to_vector()]),
            BaseAcceleration => flat(&[self.base.acceleration.to_vector()]),
            PlatformPosition => flat(&[self.platform.pose.position_m]),
            PlatformRotation => flat(&[*self.platform.pose.rotation.matrix()]),
            PlatformVelocity => flat(&[self.platform.velocity.to_vector()]),
            PlatformAcceleration => flat(&[self.platform_acceleration.to_vector()]),
            ActuatorForce => flat(&[self.actuator_force_n]),
            ExternalWrench => flat(&[self.external_wrench.to_vector()]),
            ReferenceVelocity => flat(&[self.reference_velocity.to_vector()]),
            ActuatorLength => flat(&[self.actuator_length_m]),
            ActuatorVelocity => flat(&[self.actuator_velocity_m_s]),
            _ => unreachable!("{input} is not in this table"),
        }
    }

    /// With one element of one input replaced.
    pub fn with(&self, input: Input, element: usize, value: f64) -> Self {
        let mut changed = self.clone();
        let six = |upper: &mut Vector3<f64>, lower: &mut Vector3<f64>| {
            *(if element < 3 { &mut upper[element] } else { &mut lower[element - 3] }) = value;
        };
        let nine = |rotation: &mut Rotation3<f64>| {
            let mut matrix = *rotation.matrix();
            matrix[(element / 3, element % 3)] = value;
            *rotation = Rotation3::from_matrix_unchecked(matrix);
        };
        let Self { base, platform, platform_acceleration, actuator_force_n, external_wrench, .. } =
            &mut changed;
        match input {
            BasePosition => base.pose.position_m[element] = value,
            BaseRotation => nine(&mut base.pose.rotation),
            BaseVelocity => six(&mut base.velocity.linear_m_s, &mut base.velocity.angular_rad_s),
            BaseAcceleration => {
                six(&mut base.acceleration.linear_m_s2, &mut base.acceleration.angular_rad_s2)
            }
            PlatformPosition => platform.pose.position_m[element] = value,
            PlatformRotation => nine(&mut platform.pose.rotation),
            PlatformVelocity => six(&mut platform.velocity.linear_m_s, &mut platform.velocity.angular_rad_s),
            PlatformAcceleration => {
                six(&mut platform_acceleration.linear_m_s2, &mut platform_acceleration.angular_rad_s2);
            }
            ActuatorForce => actuator_force_n[element] = value,
            ExternalWrench => six(&mut external_wrench.force_n, &mut external_wrench.moment_n_m),
            ReferenceVelocity => {
                let Twist { linear_m_s, angular_rad_s } = &mut changed.reference_velocity;
                six(linear_m_s, angular_rad_s);
            }
            ActuatorLength => changed.actuator_length_m[element] = value,
            ActuatorVelocity => changed.actuator_velocity_m_s[element] = value,
            _ => unreachable!("{input} is not in this table"),
        }
        changed
    }
}

/// Elements row by row.
pub fn flat<const R: usize, const C: usize>(matrices: &[SMatrix<f64, R, C>]) -> Vec<f64> {
    matrices.iter().flat_map(|matrix| matrix.transpose().iter().copied().collect::<Vec<_>>()).collect()
}
