//! What a simulation, or a whole reproduction, leaves behind: plain numbers for tables, curves and the report.
//!
//! SI units, O coordinates. Six-vectors are `[linear; angular]`, the angular part being angular velocity or
//! angular acceleration, never rates of angles.

/// Motion of a body sampled at `time_s`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Series {
    /// Who moved it: "target", "dyn-gen", "Exudyn 1.13.8", ...
    pub label: String,
    /// Sample times, s; every other field has as many entries.
    pub time_s: Vec<f64>,
    /// Position of the body's origin, m, O.
    pub position_m: Vec<[f64; 3]>,
    /// Body to O, row by row.
    pub rotation: Vec<[[f64; 3]; 3]>,
    /// `[r'; w]`, m/s, rad/s, O.
    pub velocity: Vec<[f64; 6]>,
    /// `[r''; w']`, m/s^2, rad/s^2, O.
    pub acceleration: Vec<[f64; 6]>,
}

/// Errors of simulated complex amplitudes, frequencies x 6 components, as in the paper's Table 4.
#[derive(Clone, Debug, PartialEq)]
pub struct AmplitudeTable {
    /// Which simulation.
    pub label: String,
    /// The rows' frequencies, Hz.
    pub frequencies_hz: Vec<f64>,
    /// `100 |A - A_target| / |A_target|` of complex amplitudes, so that phase counts; NaN where the target is zero.
    pub error_percent: Vec<[f64; 6]>,
    /// `|A|` of the simulated acceleration, m/s^2, rad/s^2.
    pub amplitude: Vec<[f64; 6]>,
    /// `|A|` of the target acceleration, m/s^2, rad/s^2.
    pub target_amplitude: Vec<[f64; 6]>,
    /// The paper's Table 4, where the scenario is the paper's.
    pub paper_percent: Option<Vec<[f64; 6]>>,
}

/// How far a simulation strays in the time domain from the target or, without one, from dyn-gen's own simulation.
#[derive(Clone, Debug, PartialEq)]
pub struct TimeErrors {
    /// Which simulation.
    pub label: String,
    /// What it is measured against: "target" or another simulation's label.
    pub reference: String,
    /// Largest error of the acceleration relative to the reference's largest acceleration; the larger of the linear and
    /// the angular part, each relative to its own. A part that the reference does not have does not count; NaN where it
    /// has neither.
    pub acceleration_relative: f64,
    /// Largest error of the linear acceleration, m/s^2.
    pub linear_m_s2: f64,
    /// Largest error of the angular acceleration, rad/s^2.
    pub angular_rad_s2: f64,
    /// Largest distance between both positions, m.
    pub position_m: f64,
}

/// Everything that tables, figures and the report show.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// `name` of the scenario.
    pub scenario_name: String,
    /// What the scenario file says of itself; may be empty.
    pub description: String,
    /// The scenario file as read.
    pub scenario_text: String,
    /// The platform that was simulated.
    pub platform: dyn_platform::Platform,
    /// Step of the simulations, s.
    pub step_s: f64,
    /// Motion of the base.
    pub base: Series,
    /// The wanted motion of the platform; empty where the platform is free.
    pub target: Series,
    /// F at each sample, N, along the actuators' axes, on the movers.
    pub actuator_force_n: Vec<[f64; 6]>,
    /// d at each sample, m.
    pub actuator_length_m: Vec<[f64; 6]>,
    /// What came out: dyn-gen's own simulation first, then the prototype's.
    pub simulations: Vec<Series>,
    /// One per simulation with a target of harmonics.
    pub amplitude_tables: Vec<AmplitudeTable>,
    /// One per simulation with a target.
    pub time_errors: Vec<TimeErrors>,
    /// Tool and version.
    pub versions: Vec<(String, String)>,
    /// Step and its wall time, s.
    pub seconds: Vec<(String, f64)>,
    /// What a reader must know to judge the numbers.
    pub warnings: Vec<String>,
    /// The command that repeats it.
    pub command: String,
}
