//! The resolved platform: plain numbers, and how they come from a file and go to JSON.

use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::parameters::{Matrix3, PARAMETERS, Parameters, Vector3};
use crate::refusal::{PlatformError, Refusal};
use crate::schema;

/// Version of the platform file format and of the resolved JSON.
pub const VERSION: u32 = 1;

/// How a leg is built.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum LegType {
    /// Actuator fixed to the base (P), Hooke joint (H), rod, universal joint (U) on the platform.
    Uhp,
}

impl LegType {
    /// Every leg type.
    pub const ALL: [Self; 1] = [Self::Uhp];

    /// Its name in platform files and in the JSON.
    pub fn name(self) -> &'static str {
        match self {
            Self::Uhp => "uhp",
        }
    }
}

/// A pose of the platform relative to the base.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Pose {
    /// Origin of P, m, B.
    pub position: Vector3,
    /// P -> B, row by row.
    pub rotation: Matrix3,
}

/// A platform file after all checks: layouts expanded, defaults filled in, per-leg values in place.
///
/// Its JSON (through serde) is `{"version":1,"name":..,"leg_type":"uhp","home":{..},"parameters":{..}}`, with each
/// parameter under its name in [`PARAMETERS`] and in its natural nesting.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(into = "Versioned", try_from = "Versioned")]
pub struct Platform {
    /// Short name, an identifier in lower case: generated modules are called so.
    pub name: String,
    /// How every leg is built.
    pub leg_type: LegType,
    /// The pose in which the platform was designed to stand.
    pub home: Pose,
    /// Every physical number.
    pub parameters: Parameters,
}

impl Platform {
    /// Reads and checks a platform file.
    ///
    /// # Errors
    /// The file cannot be read, is not UTF-8, or holds mistakes; each mistake comes with line, caret and remedy.
    pub fn from_file(path: impl AsRef<Path>) -> Result<Self, PlatformError> {
        let path = path.as_ref();
        let source_name = path.display().to_string();
        let bytes = std::fs::read(path).map_err(|error| {
            let refusal = Refusal {
                what: format!("cannot read the platform file `{source_name}`: {error}"),
                at: None,
                label: String::new(),
                help: "check the path and its permissions; platforms/uhp_2016.toml is an example".into(),
            };
            PlatformError::new(&source_name, "", vec![refusal])
        })?;
        let text = std::str::from_utf8(&bytes).map_err(|error| {
            let start = error.valid_up_to();
            let refusal = Refusal::new(
                start..start + char::REPLACEMENT_CHARACTER.len_utf8(),
                "not UTF-8 from here",
                "the platform file is not UTF-8 text",
                "save it as UTF-8, the only encoding TOML allows",
            );
            PlatformError::new(&source_name, String::from_utf8_lossy(&bytes), vec![refusal])
        })?;
        Self::from_toml(&source_name, text)
    }

    /// Checks the text of a platform file; `source_name` stands for the file in messages.
    ///
    /// # Errors
    /// As [`Platform::from_file`].
    pub fn from_toml(source_name: &str, text: &str) -> Result<Self, PlatformError> {
        schema::read(text).map_err(|refusals| PlatformError::new(source_name, text, refusals))
    }

    /// The parameter called `name`, flat and row-major; `None` for a name that is not in [`PARAMETERS`].
    pub fn parameter(&self, name: &str) -> Option<Vec<f64>> {
        self.parameters.get(name)
    }

    /// The names of all parameters, in their fixed order.
    pub fn parameter_names() -> impl ExactSizeIterator<Item = &'static str> {
        PARAMETERS.iter().map(|info| info.name)
    }
}

/// The JSON form: a [`Platform`] behind its version.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Versioned {
    version: u32,
    name: String,
    leg_type: LegType,
    home: Pose,
    parameters: Parameters,
}

impl From<Platform> for Versioned {
    fn from(platform: Platform) -> Self {
        let Platform { name, leg_type, home, parameters } = platform;
        Self { version: VERSION, name, leg_type, home, parameters }
    }
}

impl TryFrom<Versioned> for Platform {
    type Error = String;

    fn try_from(versioned: Versioned) -> Result<Self, String> {
        let Versioned { version, name, leg_type, home, parameters } = versioned;
        if version != VERSION {
            return Err(format!(
                "resolved platform has version {version}, this reader knows version {VERSION}"
            ));
        }
        Ok(Self { name, leg_type, home, parameters })
    }
}
