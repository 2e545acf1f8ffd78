//! What goes into a call, and the runtime's states made of it.

use dyn_runtime::nalgebra::{Matrix3, Rotation3, Vector3, Vector6};
use dyn_runtime::{Acceleration, BaseMotion, PlatformState, Pose, Twist, Wrench};

use crate::real::Real;

/// Motion of base and platform, and loads. SI units, axes of the inertial frame O, arrays row-major.
///
/// One struct for all calls: each says what it depends on and does not look at the rest. Zero it, then set the two
/// rotations, which are never zero.
#[repr(C)]
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Inputs {
    /// Set to sizeof(dyn_inputs).
    pub struct_size: usize,
    /// Origin of the base frame B, m, O. Let O's origin lie near the base: a base far away costs digits, in single precision soon.
    pub base_position: [Real; 3],
    /// Rotation of the base: B coordinates to O coordinates; its columns are the axes of B in O.
    pub base_rotation: [[Real; 3]; 3],
    /// Velocity of B [r_b'; w_b]: m/s, then angular velocity, rad/s; O. Not rates of Euler angles.
    pub base_velocity: [Real; 6],
    /// Acceleration of B [r_b''; w_b']: m/s^2 (an accelerometer's reading, turned into O, plus gravity), then rad/s^2; O.
    pub base_acceleration: [Real; 6],
    /// Origin of the platform frame P, the centre of the circle of platform joints, m, O (not relative to the base).
    pub platform_position: [Real; 3],
    /// Rotation of the platform: P coordinates to O coordinates.
    pub platform_rotation: [[Real; 3]; 3],
    /// Velocity of P [r_p'; w_p]: m/s, rad/s; O.
    pub platform_velocity: [Real; 6],
    /// Acceleration of P [r_p''; w_p']: m/s^2, rad/s^2; O. For dynamics: the wanted one.
    pub platform_acceleration: [Real; 6],
    /// Reference velocity [r_r'; w_r]: m/s, rad/s; O. For dyn_passive_inverse_dynamics only.
    pub reference_velocity: [Real; 6],
    /// Forces of the six actuators, N, positive away from the base. For dyn_forward_dynamics, and for dyn_monitor and
    /// dyn_check_limits, which judge them; no call fills them in.
    pub actuator_force: [Real; 6],
    /// External force and moment on the payload at its centre of mass [F_D; M_D]: N, N m; O.
    pub external_wrench: [Real; 6],
}

/// [`Inputs`] as the runtime takes them.
pub(crate) struct States {
    pub base: BaseMotion<Real>,
    pub platform: PlatformState<Real>,
    pub platform_acceleration: Acceleration<Real>,
    pub reference_velocity: Twist<Real>,
    pub actuator_force: Vector6<Real>,
    pub external_wrench: Wrench<Real>,
}

impl From<&Inputs> for States {
    fn from(inputs: &Inputs) -> Self {
        Self {
            base: BaseMotion {
                pose: pose(&inputs.base_position, &inputs.base_rotation),
                velocity: twist(&inputs.base_velocity),
                acceleration: acceleration(&inputs.base_acceleration),
            },
            platform: PlatformState {
                pose: pose(&inputs.platform_position, &inputs.platform_rotation),
                velocity: twist(&inputs.platform_velocity),
            },
            platform_acceleration: acceleration(&inputs.platform_acceleration),
            reference_velocity: twist(&inputs.reference_velocity),
            actuator_force: Vector6::from(inputs.actuator_force),
            external_wrench: wrench(&inputs.external_wrench),
        }
    }
}

fn pose(position: &[Real; 3], rotation: &[[Real; 3]; 3]) -> Pose<Real> {
    // Rows in, columns inside. Whether it is a rotation is for the runtime to check, which names the input.
    let matrix = Matrix3::from(*rotation).transpose();
    Pose { position_m: Vector3::from(*position), rotation: Rotation3::from_matrix_unchecked(matrix) }
}

fn halves([a, b, c, d, e, f]: &[Real; 6]) -> (Vector3<Real>, Vector3<Real>) {
    (Vector3::new(*a, *b, *c), Vector3::new(*d, *e, *f))
}

fn twist(stacked: &[Real; 6]) -> Twist<Real> {
    let (linear_m_s, angular_rad_s) = halves(stacked);
    Twist { linear_m_s, angular_rad_s }
}

fn acceleration(stacked: &[Real; 6]) -> Acceleration<Real> {
    let (linear_m_s2, angular_rad_s2) = halves(stacked);
    Acceleration { linear_m_s2, angular_rad_s2 }
}

fn wrench(stacked: &[Real; 6]) -> Wrench<Real> {
    let (force_n, moment_n_m) = halves(stacked);
    Wrench { force_n, moment_n_m }
}
