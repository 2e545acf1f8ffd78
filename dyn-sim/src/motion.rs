//! Prescribed motion of a body: pose, velocity and acceleration at any time.

use dyn_runtime::nalgebra::Vector3;
use dyn_runtime::{Acceleration, BaseMotion, PlatformState, Pose, Twist, rotation_vector};

use crate::excitation::{self, Harmonic, Jet};
use crate::measured::Measured;
use crate::rotation::{from_rows, rows};

/// A body's motion at one time; O coordinates unless a motion is said to be relative.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyMotion {
    /// Position (m) and rotation of the body's frame.
    pub pose: Pose,
    /// `[r'; w]`, m/s and rad/s.
    pub velocity: Twist,
    /// `[r''; w']`, m/s^2 and rad/s^2.
    pub acceleration: Acceleration,
}

/// How a body's angular motion is given.
#[derive(Clone, Debug, PartialEq)]
pub enum Angular {
    /// Harmonics of the angular acceleration w', small: see [`excitation::small_rotation`].
    Small(Vec<Harmonic>),
    /// Harmonics of the rotation vector, of any size; w and w' follow exactly.
    RotationVector(Vec<Harmonic>),
}

/// A prescribed motion about a mean pose.
#[derive(Clone, Debug, PartialEq)]
pub enum Motion {
    /// Sums of harmonics in the axes of the frame in which the mean pose is given. The rotation at time t is
    /// `exp([phi(t)]x) R_mean`.
    Harmonic {
        /// Where the body is without excitation.
        mean: Pose,
        /// Linear displacement, m.
        linear: Vec<Harmonic>,
        /// Angular motion, rad.
        angular: Angular,
    },
    /// Measured accelerations.
    Measured(Box<Measured>),
    /// A motion given in the coordinates of another moving body.
    Relative {
        /// Motion of the other body in O.
        carrier: Box<Motion>,
        /// Motion in its coordinates.
        relative: Box<Motion>,
    },
}

impl Motion {
    /// A body that stands still.
    pub fn still(mean: Pose) -> Self {
        Self::Harmonic { mean, linear: Vec::new(), angular: Angular::RotationVector(Vec::new()) }
    }

    /// The motion at time t, s.
    pub fn at(&self, t: f64) -> BodyMotion {
        match self {
            Self::Harmonic { mean, linear, angular } => {
                let phi = match angular {
                    Angular::Small(harmonics) => excitation::small_rotation(harmonics, t),
                    Angular::RotationVector(harmonics) => excitation::sum(harmonics, t),
                };
                about(mean, &excitation::sum(linear, t), &phi)
            }
            Self::Measured(measured) => measured.at(t),
            Self::Relative { carrier, relative } => composed(&carrier.at(t), &relative.at(t)),
        }
    }

    /// The distinct frequencies in it, Hz, ascending; none for measured motion.
    pub fn frequencies_hz(&self) -> Vec<f64> {
        let mut frequencies: Vec<f64> = match self {
            Self::Harmonic { linear, angular: Angular::Small(angular), .. }
            | Self::Harmonic { linear, angular: Angular::RotationVector(angular), .. } => {
                linear.iter().chain(angular).map(|harmonic| harmonic.frequency_hz).collect()
            }
            Self::Measured(_) => Vec::new(),
            Self::Relative { carrier, relative } => {
                [carrier.frequencies_hz(), relative.frequencies_hz()].concat()
            }
        };
        frequencies.sort_by(f64::total_cmp);
        frequencies.dedup();
        frequencies
    }
}

/// Motion about a mean pose by displacement (m) and rotation vector (rad).
fn about(mean: &Pose, linear: &Jet, phi: &Jet) -> BodyMotion {
    let (angular_rad_s, angular_rad_s2) = rotation_vector::angular_motion(&phi.value, &phi.rate, &phi.second);
    BodyMotion {
        pose: Pose {
            position_m: mean.position_m + linear.value,
            rotation: rotation_vector::rotation(&phi.value) * mean.rotation,
        },
        velocity: Twist { linear_m_s: linear.rate, angular_rad_s },
        acceleration: Acceleration { linear_m_s2: linear.second, angular_rad_s2 },
    }
}

/// The motion in O of a body that moves by `relative` in the coordinates of `carrier`.
fn composed(carrier: &BodyMotion, relative: &BodyMotion) -> BodyMotion {
    let turned = |v: &Vector3<f64>| carrier.pose.rotation * v;
    let (w, w_rate) = (carrier.velocity.angular_rad_s, carrier.acceleration.angular_rad_s2);
    let arm = turned(&relative.pose.position_m);
    let arm_rate = turned(&relative.velocity.linear_m_s);
    let relative_w = turned(&relative.velocity.angular_rad_s);
    BodyMotion {
        pose: carrier.pose.compose(&relative.pose),
        velocity: Twist {
            linear_m_s: carrier.velocity.linear_m_s + w.cross(&arm) + arm_rate,
            angular_rad_s: w + relative_w,
        },
        acceleration: Acceleration {
            linear_m_s2: carrier.acceleration.linear_m_s2
                + w_rate.cross(&arm)
                + w.cross(&w.cross(&arm))
                + 2.0 * w.cross(&arm_rate)
                + turned(&relative.acceleration.linear_m_s2),
            angular_rad_s2: w_rate + w.cross(&relative_w) + turned(&relative.acceleration.angular_rad_s2),
        },
    }
}

impl BodyMotion {
    /// As the base's motion.
    pub fn as_base(&self) -> BaseMotion {
        BaseMotion { pose: self.pose, velocity: self.velocity, acceleration: self.acceleration }
    }

    /// As the platform's state.
    pub fn as_platform(&self) -> PlatformState {
        PlatformState { pose: self.pose, velocity: self.velocity }
    }
}

impl crate::outcome::Series {
    /// No samples yet.
    pub fn empty(label: impl Into<String>) -> Self {
        Self { label: label.into(), ..Self::default() }
    }

    /// Appends the motion at time t, s.
    pub fn push(&mut self, t: f64, motion: &BodyMotion) {
        self.time_s.push(t);
        self.position_m.push(motion.pose.position_m.into());
        self.rotation.push(rows(&motion.pose.rotation));
        self.velocity.push(motion.velocity.to_vector().into());
        self.acceleration.push(motion.acceleration.to_vector().into());
    }

    /// Pose and velocity of sample k.
    ///
    /// # Panics
    /// Beyond the last sample.
    pub fn state(&self, k: usize) -> PlatformState {
        let [x, y, z, wx, wy, wz] = self.velocity[k];
        PlatformState {
            pose: Pose { position_m: self.position_m[k].into(), rotation: from_rows(&self.rotation[k]) },
            velocity: Twist { linear_m_s: Vector3::new(x, y, z), angular_rad_s: Vector3::new(wx, wy, wz) },
        }
    }

    /// Number of samples.
    pub fn len(&self) -> usize {
        self.time_s.len()
    }

    /// Whether there are no samples.
    pub fn is_empty(&self) -> bool {
        self.time_s.is_empty()
    }
}
