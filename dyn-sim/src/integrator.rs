//! A fixed-step Runge-Kutta method of fourth order on the group of poses.
//!
//! The state is a pose (r, R) and a velocity `[r'; w]`, all in O coordinates. Munthe-Kaas' method with the classical
//! tableau: within a step the rotation is `exp([phi]x) R_0`, the stages live in the vector space of phi, and R stays a
//! rotation whatever the step. [`rate_within_step`] keeps the two commutators that order 4 needs.

use dyn_runtime::nalgebra::Vector3;
use dyn_runtime::rotation_vector::{self, orthonormalised, rate_within_step};
use dyn_runtime::{Acceleration, PlatformState, Pose, Twist};

/// Where in a step the acceleration is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// In its middle.
    Middle,
    /// At its end.
    End,
}

/// One step of `h` seconds from `start`, where the acceleration is `first`; `acceleration` gives it elsewhere.
///
/// # Errors
/// Those of `acceleration`.
pub fn step<E>(
    start: &PlatformState,
    first: &Acceleration,
    h: f64,
    mut acceleration: impl FnMut(Stage, &PlatformState) -> Result<Acceleration, E>,
) -> Result<PlatformState, E> {
    let first = Rates {
        position: start.velocity.linear_m_s,
        rotation: start.velocity.angular_rad_s,
        velocity: *first,
    };
    let second = rates(start, 0.5 * h, &first, |state| acceleration(Stage::Middle, state))?;
    let third = rates(start, 0.5 * h, &second, |state| acceleration(Stage::Middle, state))?;
    let fourth = rates(start, h, &third, |state| acceleration(Stage::End, state))?;
    let weighted = [(h / 6.0, &first), (h / 3.0, &second), (h / 3.0, &third), (h / 6.0, &fourth)];
    let mut end = Increment::of(&weighted).applied_to(start);
    end.pose.rotation = orthonormalised(&end.pose.rotation);
    Ok(end)
}

/// The rates of change where `before`, held for a time `h` (s), leads from `start`.
#[inline(always)]
fn rates<E>(
    start: &PlatformState,
    h: f64,
    before: &Rates,
    acceleration: impl FnOnce(&PlatformState) -> Result<Acceleration, E>,
) -> Result<Rates, E> {
    let increment = Increment::of(&[(h, before)]);
    let moved = increment.applied_to(start);
    let velocity = acceleration(&moved)?;
    let Twist { linear_m_s, angular_rad_s } = moved.velocity;
    let rotation = rate_within_step(&increment.rotation, &angular_rad_s);
    Ok(Rates { position: linear_m_s, rotation, velocity })
}

/// Rates of change within a step, rotation as a rotation vector.
struct Rates {
    position: Vector3<f64>,
    rotation: Vector3<f64>,
    velocity: Acceleration,
}

/// What has been added to the state at the beginning of a step. Its functions are inlined because an increment that
/// goes through memory, written by single numbers and read by pairs, stalls the processor: a tenth of a step's time.
struct Increment {
    position: Vector3<f64>,
    rotation: Vector3<f64>,
    linear: Vector3<f64>,
    angular: Vector3<f64>,
}

impl Increment {
    #[inline(always)]
    fn of(weighted: &[(f64, &Rates)]) -> Self {
        let mut sum = Self {
            position: Vector3::zeros(),
            rotation: Vector3::zeros(),
            linear: Vector3::zeros(),
            angular: Vector3::zeros(),
        };
        for (weight, rates) in weighted {
            sum.position += rates.position * *weight;
            sum.rotation += rates.rotation * *weight;
            sum.linear += rates.velocity.linear_m_s2 * *weight;
            sum.angular += rates.velocity.angular_rad_s2 * *weight;
        }
        sum
    }

    #[inline(always)]
    fn applied_to(&self, start: &PlatformState) -> PlatformState {
        PlatformState {
            pose: Pose {
                position_m: start.pose.position_m + self.position,
                rotation: rotation_vector::rotation(&self.rotation) * start.pose.rotation,
            },
            velocity: Twist {
                linear_m_s: start.velocity.linear_m_s + self.linear,
                angular_rad_s: start.velocity.angular_rad_s + self.angular,
            },
        }
    }
}
