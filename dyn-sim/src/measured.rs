//! Motion from measured accelerations: interpolated, integrated, turned into true rotations.
//!
//! Between samples each acceleration is a cubic (Hermite, slopes by fourth-order differences), so velocity and
//! displacement are its exact integrals. Three constants per component are free, and are chosen so that nothing
//! drifts: the acceleration's mean over the record is removed as the sensor's bias, and velocity and displacement have
//! zero mean. The rotation is integrated from the angular velocity, `R' = [w]x R`, by Magnus' expansion to fourth
//! order within each sample interval.

use dyn_runtime::nalgebra::{Rotation3, Vector3};
use dyn_runtime::rotation_vector::{self, orthonormalised};
use dyn_runtime::{Acceleration, Pose, Twist};

use crate::motion::BodyMotion;

/// Least number of samples: slopes need five, and a record of fewer is not one.
pub const LEAST_SAMPLES: usize = 16;

/// Accelerations at even times: `[r''; w']`, m/s^2 and rad/s^2.
#[derive(Clone, Debug, PartialEq)]
pub struct Record {
    /// Time between samples, s.
    pub spacing_s: f64,
    /// Samples, at least [`LEAST_SAMPLES`]; the first is at time 0.
    pub acceleration: Vec<[f64; 6]>,
}

/// A record with its integrals.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    mean: Pose,
    spacing_s: f64,
    components: [Component; 6],
    rotation: Vec<Rotation3<f64>>,
}

/// One component: per sample, the cubic up to the next sample and the integrals up to it.
#[derive(Clone, Debug, PartialEq)]
struct Component {
    bias: f64,
    /// Coefficients of s^0 to s^3, s from 0 to 1 within an interval.
    cubic: Vec<[f64; 4]>,
    velocity: Vec<f64>,
    displacement: Vec<f64>,
}

impl Record {
    /// Its length, s.
    pub fn duration_s(&self) -> f64 {
        self.spacing_s * (self.acceleration.len() - 1) as f64
    }
}

impl Measured {
    /// The motion of a body about its mean pose.
    ///
    /// # Panics
    /// With fewer than [`LEAST_SAMPLES`] samples.
    pub fn new(record: &Record, mean: Pose) -> Self {
        assert!(record.acceleration.len() >= LEAST_SAMPLES, "a record needs {LEAST_SAMPLES} samples");
        let h = record.spacing_s;
        let components = std::array::from_fn(|i| {
            let samples: Vec<f64> = record.acceleration.iter().map(|sample| sample[i]).collect();
            Component::new(&samples, h)
        });
        let mut measured = Self { mean, spacing_s: h, components, rotation: Vec::new() };
        let theta = measured.angular(0, 0.0, Component::displacement_at);
        let mut rotation = rotation_vector::rotation(&theta) * mean.rotation;
        measured.rotation.push(rotation);
        for k in 0..record.acceleration.len() - 1 {
            rotation = orthonormalised(&(rotation_vector::rotation(&measured.turn(k, 1.0)) * rotation));
            measured.rotation.push(rotation);
        }
        measured
    }

    /// What was removed from each component as bias, m/s^2 and rad/s^2.
    pub fn bias(&self) -> [f64; 6] {
        std::array::from_fn(|i| self.components[i].bias)
    }

    /// The motion at time t, s; outside the record, its first or last instant.
    pub fn at(&self, t: f64) -> BodyMotion {
        let intervals = self.components[0].cubic.len();
        let place = (t / self.spacing_s).clamp(0.0, intervals as f64);
        let k = (place as usize).min(intervals - 1);
        let s = place - k as f64;
        let linear = |f: At| Vector3::from_fn(|i, _| f(&self.components[i], k, s, self.spacing_s));
        BodyMotion {
            pose: Pose {
                position_m: self.mean.position_m + linear(Component::displacement_at),
                rotation: rotation_vector::rotation(&self.turn(k, s)) * self.rotation[k],
            },
            velocity: Twist {
                linear_m_s: linear(Component::velocity_at),
                angular_rad_s: self.angular(k, s, Component::velocity_at),
            },
            acceleration: Acceleration {
                linear_m_s2: linear(Component::acceleration_at),
                angular_rad_s2: self.angular(k, s, Component::acceleration_at),
            },
        }
    }

    fn angular(&self, k: usize, s: f64, f: At) -> Vector3<f64> {
        Vector3::from_fn(|i, _| f(&self.components[3 + i], k, s, self.spacing_s))
    }

    /// Rotation vector from sample k to s intervals later: the integral of w, and Magnus' second term by two Gauss
    /// points.
    fn turn(&self, k: usize, s: f64) -> Vector3<f64> {
        let integral =
            self.angular(k, s, Component::displacement_at) - self.angular(k, 0.0, Component::displacement_at);
        let offset = 3.0_f64.sqrt() / 6.0;
        let first = self.angular(k, s * (0.5 - offset), Component::velocity_at);
        let second = self.angular(k, s * (0.5 + offset), Component::velocity_at);
        let h = s * self.spacing_s;
        integral + second.cross(&first) * (3.0_f64.sqrt() / 12.0 * h * h)
    }
}

/// One of the functions of a component, at s in interval k of length h.
type At = fn(&Component, usize, f64, f64) -> f64;

impl Component {
    fn new(samples: &[f64], h: f64) -> Self {
        let slope: Vec<f64> = (0..samples.len()).map(|k| slope(samples, k)).collect();
        let cubic = samples
            .windows(2)
            .zip(slope.windows(2))
            .map(|(y, m)| {
                let rise = y[1] - y[0];
                [y[0], m[0], 3.0 * rise - 2.0 * m[0] - m[1], m[0] + m[1] - 2.0 * rise]
            })
            .collect();
        let mut component = Self { bias: 0.0, cubic, velocity: vec![0.0], displacement: vec![0.0] };
        let intervals = component.cubic.len();
        let duration = h * intervals as f64;
        component.integrate(h);
        component.bias = component.velocity[intervals] / duration;
        for cubic in &mut component.cubic {
            cubic[0] -= component.bias;
        }
        component.integrate(h);
        let drift = component.displacement[intervals] / duration;
        component.velocity[0] = -drift;
        component.integrate(h);
        component.displacement[0] = -component.mean_displacement(h);
        component.integrate(h);
        component
    }

    /// Velocity and displacement at every sample from those at the first.
    fn integrate(&mut self, h: f64) {
        let (mut velocity, mut displacement) = (vec![self.velocity[0]], vec![self.displacement[0]]);
        std::mem::swap(&mut self.velocity, &mut velocity);
        std::mem::swap(&mut self.displacement, &mut displacement);
        for k in 0..self.cubic.len() {
            let (v, x) = (self.velocity_at(k, 1.0, h), self.displacement_at(k, 1.0, h));
            self.velocity.push(v);
            self.displacement.push(x);
        }
    }

    fn mean_displacement(&self, h: f64) -> f64 {
        let of_interval = |k: usize| {
            let [a, b, c, d] = self.cubic[k];
            self.displacement[k]
                + 0.5 * h * self.velocity[k]
                + h * h * (a / 6.0 + b / 24.0 + c / 60.0 + d / 120.0)
        };
        (0..self.cubic.len()).map(of_interval).sum::<f64>() / self.cubic.len() as f64
    }

    fn acceleration_at(&self, k: usize, s: f64, _: f64) -> f64 {
        let [a, b, c, d] = self.cubic[k];
        a + s * (b + s * (c + s * d))
    }

    fn velocity_at(&self, k: usize, s: f64, h: f64) -> f64 {
        let [a, b, c, d] = self.cubic[k];
        self.velocity[k] + h * s * (a + s * (b / 2.0 + s * (c / 3.0 + s * d / 4.0)))
    }

    fn displacement_at(&self, k: usize, s: f64, h: f64) -> f64 {
        let [a, b, c, d] = self.cubic[k];
        let by_acceleration = a / 2.0 + s * (b / 6.0 + s * (c / 12.0 + s * d / 20.0));
        self.displacement[k] + h * s * (self.velocity[k] + h * s * by_acceleration)
    }
}

/// Slope per interval at sample k, by the five nearest samples.
fn slope(y: &[f64], k: usize) -> f64 {
    let first = k.saturating_sub(2).min(y.len() - 5);
    const WEIGHTS: [[f64; 5]; 5] = [
        [-25.0, 48.0, -36.0, 16.0, -3.0],
        [-3.0, -10.0, 18.0, -6.0, 1.0],
        [1.0, -8.0, 0.0, 8.0, -1.0],
        [-1.0, 6.0, -18.0, 10.0, 3.0],
        [3.0, -16.0, 36.0, -48.0, 25.0],
    ];
    WEIGHTS[k - first].iter().zip(&y[first..]).map(|(weight, y)| weight * y).sum::<f64>() / 12.0
}
