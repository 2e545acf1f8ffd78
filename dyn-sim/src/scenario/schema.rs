//! The keys of a scenario file, as serde reads them. Meaning and checks are in [`checks`](super::checks).

use serde::Deserialize;
use toml::Spanned;

use crate::spectrum::Window;

/// A scenario file.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct File {
    pub version: Spanned<i64>,
    pub name: Spanned<String>,
    #[serde(default)]
    pub description: String,
    pub platform: Spanned<String>,
    pub gravity: bool,
    pub duration_s: Spanned<f64>,
    pub step_s: Spanned<f64>,
    #[serde(default)]
    pub integrator: Integrator,
    #[serde(default)]
    pub prototype: bool,
    #[serde(default)]
    pub prototype_half_steps: bool,
    pub base: Option<Spanned<Body>>,
    pub target: Option<Spanned<Target>>,
    pub free: Option<Spanned<Free>>,
    pub limits: Option<Limits>,
    pub spectrum: Option<Spectrum>,
    #[serde(default)]
    pub outputs: Outputs,
}

/// Which method simulates.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Integrator {
    /// Fixed steps on the group of poses, fourth order.
    #[default]
    LieRk4,
    /// Dormand-Prince 8(5,3) with step control, tolerance 1e-12.
    Adaptive,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Body {
    pub csv: Option<Spanned<String>>,
    #[serde(default)]
    pub harmonic: Vec<Spanned<RawHarmonic>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Target {
    #[serde(default)]
    pub relative_to: RelativeTo,
    pub position_m: Option<[Spanned<f64>; 3]>,
    pub csv: Option<Spanned<String>>,
    #[serde(default)]
    pub harmonic: Vec<Spanned<RawHarmonic>>,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum RelativeTo {
    #[default]
    Inertial,
    Base,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawHarmonic {
    pub frequency_hz: Spanned<f64>,
    pub linear_m_per_s2: Option<[Spanned<f64>; 3]>,
    pub linear_m: Option<[Spanned<f64>; 3]>,
    pub linear_phase_rad: Option<[Spanned<f64>; 3]>,
    pub angular_rad_per_s2: Option<[Spanned<f64>; 3]>,
    pub rotation_rad: Option<[Spanned<f64>; 3]>,
    pub angular_phase_rad: Option<[Spanned<f64>; 3]>,
}

/// A platform that nobody steers: where it starts, relative to home, and constant forces.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Free {
    pub position_m: Option<[Spanned<f64>; 3]>,
    pub rotation_rad: Option<[Spanned<f64>; 3]>,
    pub velocity_m_per_s: Option<[Spanned<f64>; 3]>,
    pub angular_velocity_rad_per_s: Option<[Spanned<f64>; 3]>,
    pub actuator_force_n: Option<[Spanned<f64>; 6]>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Limits {
    pub actuator_length_m: Spanned<[f64; 2]>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Spectrum {
    pub frequencies_hz: Spanned<Vec<Spanned<f64>>>,
    pub start_s: Option<Spanned<f64>>,
    pub window: Option<Window>,
    pub paper_error_percent: Option<Spanned<Vec<[f64; 6]>>>,
}

/// What a run writes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Outputs {
    /// Report with curves: `index.html`, SVG figures, CSV of every curve.
    #[serde(default = "yes")]
    pub report: bool,
    /// `tables.json` beside the report.
    #[serde(default)]
    pub json: bool,
}

impl Default for Outputs {
    fn default() -> Self {
        Self { report: true, json: false }
    }
}

fn yes() -> bool {
    true
}
