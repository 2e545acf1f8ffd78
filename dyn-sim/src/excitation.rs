//! Sums of harmonics: a vector function of time with its derivatives, integrated analytically.
//!
//! An amplitude A of an acceleration at `omega = 2 pi f` with phase p means
//!
//! ```text
//! acceleration  A sin(omega t + p)
//! velocity     -A cos(omega t + p)/omega
//! displacement -A sin(omega t + p)/omega^2
//! ```
//!
//! so velocity and displacement have zero mean: nothing drifts, and a simulation that starts on this motion has no
//! transient to wait for.

use std::f64::consts::TAU;

use dyn_runtime::nalgebra::Vector3;

/// One frequency of a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Harmonic {
    /// f, Hz, positive.
    pub frequency_hz: f64,
    /// Amplitude of the displacement, m or rad: `displacement sin(omega t + phase)`.
    pub displacement: [f64; 3],
    /// Phase of each component, rad.
    pub phase_rad: [f64; 3],
}

/// A vector function of time with two derivatives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jet {
    /// The function.
    pub value: Vector3<f64>,
    /// Its first time derivative.
    pub rate: Vector3<f64>,
    /// Its second time derivative.
    pub second: Vector3<f64>,
}

impl Jet {
    /// Zero for ever.
    pub fn zero() -> Self {
        Self { value: Vector3::zeros(), rate: Vector3::zeros(), second: Vector3::zeros() }
    }
}

impl Harmonic {
    /// By the amplitude of the acceleration, m/s^2 or rad/s^2: `acceleration sin(omega t + phase)`.
    pub fn from_acceleration(frequency_hz: f64, acceleration: [f64; 3], phase_rad: [f64; 3]) -> Self {
        let omega = TAU * frequency_hz;
        Self { frequency_hz, displacement: acceleration.map(|a| -a / (omega * omega)), phase_rad }
    }

    fn omega(&self) -> f64 {
        TAU * self.frequency_hz
    }

    fn add_to(&self, jet: &mut Jet, t: f64) {
        let omega = self.omega();
        for i in 0..3 {
            let (sin, cos) = (omega * t + self.phase_rad[i]).sin_cos();
            let x = self.displacement[i];
            jet.value[i] += x * sin;
            jet.rate[i] += x * omega * cos;
            jet.second[i] -= x * omega * omega * sin;
        }
    }
}

/// The sum of `harmonics` at time t (s).
pub fn sum(harmonics: &[Harmonic], t: f64) -> Jet {
    let mut jet = Jet::zero();
    for harmonic in harmonics {
        harmonic.add_to(&mut jet, t);
    }
    jet
}

/// The rotation vector (rad) whose angular **acceleration** is the sum of `harmonics` (their displacements being
/// theta, rad).
///
/// For small motion only: `phi = theta + phi_2`, `phi_2' = -theta x w/2`, with `w = theta'`. The rotation
/// `exp([phi]x)` then has angular velocity w up to third order in theta. Without `phi_2` second order would remain,
/// which at the published amplitudes is as large as the errors to be shown. `phi_2` contains the slow drift of coning
/// motion, which a body with these angular accelerations truly has.
pub fn small_rotation(harmonics: &[Harmonic], t: f64) -> Jet {
    let theta = sum(harmonics, t);
    let mut second_order = Vector3::zeros();
    for one in harmonics {
        for other in harmonics {
            second_order -= 0.5 * integrated_cross_product(one, other, t);
        }
    }
    Jet {
        value: theta.value + second_order,
        rate: theta.rate - 0.5 * theta.value.cross(&theta.rate),
        second: theta.second - 0.5 * theta.value.cross(&theta.second),
    }
}

/// An antiderivative of `x x y'` for harmonics x and y.
fn integrated_cross_product(x: &Harmonic, y: &Harmonic, t: f64) -> Vector3<f64> {
    // Antiderivative of x_i y_j' = X Y omega_y sin(omega_x t + p) cos(omega_y t + q).
    let product = |i: usize, j: usize| {
        let amplitude = x.displacement[i] * y.displacement[j] * y.omega();
        if amplitude == 0.0 {
            return 0.0;
        }
        let (p, q) = (x.phase_rad[i], y.phase_rad[j]);
        let (sum, difference) = (x.omega() + y.omega(), x.omega() - y.omega());
        let slow = if x.frequency_hz == y.frequency_hz {
            t * (p - q).sin()
        } else {
            -(difference * t + p - q).cos() / difference
        };
        0.5 * amplitude * (slow - (sum * t + p + q).cos() / sum)
    };
    Vector3::new(product(1, 2) - product(2, 1), product(2, 0) - product(0, 2), product(0, 1) - product(1, 0))
}
