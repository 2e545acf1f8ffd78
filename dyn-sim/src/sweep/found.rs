//! What is found out about a design.

use dyn_platform::Limits;

use crate::scenario::Steering;

/// What is found out about a design. Lengths, forces and accelerations are those at the beginnings of steps.
#[derive(Clone, Debug, PartialEq)]
pub struct Found {
    /// Why and when its motion ended early; the rest is about the time before.
    pub ended: Option<Ending>,
    /// Largest force of each actuator, either way, N.
    pub force_n: [f64; 6],
    /// Least length of each actuator, m.
    pub shortest_m: [f64; 6],
    /// Largest length of each actuator, m.
    pub longest_m: [f64; 6],
    /// Root mean square of the platform's acceleration, m/s^2 and rad/s^2, O axes.
    pub rms_acceleration: [f64; 6],
    /// Its largest magnitude, component by component.
    pub peak_acceleration: [f64; 6],
    /// Root mean square of the base's acceleration, m/s^2 and rad/s^2, O axes.
    pub base_rms_acceleration: [f64; 6],
    /// Limit of the platform file that is exceeded first, by leg: "length of leg 3".
    pub exceeded: Option<String>,
}

/// An end before the time.
#[derive(Clone, Debug, PartialEq)]
pub struct Ending {
    /// When, s.
    pub time_s: f64,
    /// Why.
    pub reason: String,
}

/// A number that is found out.
#[derive(Clone, Copy)]
pub struct Measure {
    /// Column of the table.
    pub name: &'static str,
    /// In words.
    pub heading: &'static str,
    /// SI.
    pub unit: &'static str,
    /// Whether it is drawn.
    pub drawn: bool,
    /// The number.
    pub of: fn(&Found) -> f64,
}

impl std::fmt::Debug for Measure {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name)
    }
}

macro_rules! measure {
    ($name:literal, $heading:literal, $unit:literal, $drawn:literal, $of:expr) => {
        Measure { name: $name, heading: $heading, unit: $unit, drawn: $drawn, of: $of }
    };
}

fn largest(numbers: &[f64]) -> f64 {
    numbers.iter().copied().fold(f64::NEG_INFINITY, f64::max)
}

fn norm(numbers: &[f64]) -> f64 {
    numbers.iter().map(|x| x * x).sum::<f64>().sqrt()
}

const OF_ALL: [Measure; 4] = [
    measure!("peak_force_n", "largest actuator force", "N", true, |found| largest(&found.force_n)),
    measure!("shortest_length_m", "shortest actuator", "m", false, |found| -largest(
        &found.shortest_m.map(|x| -x)
    )),
    measure!("longest_length_m", "longest actuator", "m", false, |found| largest(&found.longest_m)),
    measure!("travel_m", "travel of an actuator", "m", true, |found| {
        (0..6).map(|leg| found.longest_m[leg] - found.shortest_m[leg]).fold(f64::NEG_INFINITY, f64::max)
    }),
];

const OF_FREE: [Measure; 16] = [
    measure!("rms_linear_m_per_s2", "acceleration, rms", "m/s²", true, |found| norm(
        &found.rms_acceleration[..3]
    )),
    measure!("rms_angular_rad_per_s2", "angular acceleration, rms", "rad/s²", false, |found| norm(
        &found.rms_acceleration[3..]
    )),
    measure!("transmissibility_percent", "platform over base, rms", "%", true, |found| {
        100.0 * norm(&found.rms_acceleration[..3]) / norm(&found.base_rms_acceleration[..3])
    }),
    measure!("angular_transmissibility_percent", "platform over base, angular, rms", "%", false, |found| {
        100.0 * norm(&found.rms_acceleration[3..]) / norm(&found.base_rms_acceleration[3..])
    }),
    measure!("rms_x_m_per_s2", "rms, x", "m/s²", false, |found| found.rms_acceleration[0]),
    measure!("rms_y_m_per_s2", "rms, y", "m/s²", false, |found| found.rms_acceleration[1]),
    measure!("rms_z_m_per_s2", "rms, z", "m/s²", false, |found| found.rms_acceleration[2]),
    measure!("rms_rx_rad_per_s2", "rms, about x", "rad/s²", false, |found| found.rms_acceleration[3]),
    measure!("rms_ry_rad_per_s2", "rms, about y", "rad/s²", false, |found| found.rms_acceleration[4]),
    measure!("rms_rz_rad_per_s2", "rms, about z", "rad/s²", false, |found| found.rms_acceleration[5]),
    measure!("peak_x_m_per_s2", "peak, x", "m/s²", false, |found| found.peak_acceleration[0]),
    measure!("peak_y_m_per_s2", "peak, y", "m/s²", false, |found| found.peak_acceleration[1]),
    measure!("peak_z_m_per_s2", "peak, z", "m/s²", false, |found| found.peak_acceleration[2]),
    measure!("peak_rx_rad_per_s2", "peak, about x", "rad/s²", false, |found| found.peak_acceleration[3]),
    measure!("peak_ry_rad_per_s2", "peak, about y", "rad/s²", false, |found| found.peak_acceleration[4]),
    measure!("peak_rz_rad_per_s2", "peak, about z", "rad/s²", false, |found| found.peak_acceleration[5]),
];

/// What is found out in a scenario.
pub fn measures(steering: &Steering) -> Vec<Measure> {
    let mut measures = OF_ALL.to_vec();
    if let Steering::Free(..) = steering {
        measures.extend(OF_FREE);
    }
    measures
}

impl Found {
    /// Nothing yet.
    pub(super) fn nothing() -> Self {
        Self {
            ended: None,
            force_n: [0.0; 6],
            shortest_m: [f64::INFINITY; 6],
            longest_m: [f64::NEG_INFINITY; 6],
            rms_acceleration: [0.0; 6],
            peak_acceleration: [0.0; 6],
            base_rms_acceleration: [0.0; 6],
            exceeded: None,
        }
    }

    /// With the limits that it exceeds.
    pub(super) fn judged(mut self, limits: &Limits) -> Self {
        let beyond = |leg: usize| {
            let below = limits.minimum_length[leg].is_some_and(|least| self.shortest_m[leg] < least);
            let above = limits.maximum_length[leg].is_some_and(|most| self.longest_m[leg] > most);
            let strong = limits.maximum_force[leg].is_some_and(|most| self.force_n[leg] > most);
            match (below || above, strong) {
                (true, _) => Some(format!("length of leg {}", leg + 1)),
                (_, true) => Some(format!("force of leg {}", leg + 1)),
                _ => None,
            }
        };
        self.exceeded = (0..6).find_map(beyond);
        self
    }
}
