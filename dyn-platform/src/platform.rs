//! The resolved platform: plain numbers, and how they come from a file and go to JSON.

use std::collections::BTreeMap;
use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::findings::Warning;
use crate::limits::Limits;
use crate::nested::Nested;
use crate::parameters::{Matrix3, Parameters, Vector3};
use crate::reader;
use crate::refusal::FileError;
use crate::text::read_text;

/// Version of the platform file format and of the resolved JSON.
pub const VERSION: u32 = 1;

/// How a leg is built.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum LegType {
    /// Actuator fixed to the base (P), Hooke joint (H), rod, universal joint (U) on the platform.
    Uhp,
    /// Universal joint (U) on the base, telescopic actuator (P), spherical joint (S) on the platform: the classical
    /// Gough-Stewart leg.
    Ups,
}

impl LegType {
    /// Every leg type.
    pub const ALL: [Self; 2] = [Self::Uhp, Self::Ups];

    /// Its name in platform files and in the JSON.
    pub fn name(self) -> &'static str {
        match self {
            Self::Uhp => "uhp",
            Self::Ups => "ups",
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
/// parameter of the leg type under its name ([`LegType::parameters`]) and in its natural nesting; where the file has
/// limits, `"limits":{..}` follows.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(into = "Versioned<Parameters>", try_from = "Versioned<BTreeMap<String, Nested>>")]
pub struct Platform {
    /// Short name, an identifier in lower case: generated modules are called so.
    pub name: String,
    /// How every leg is built.
    pub leg_type: LegType,
    /// The pose in which the platform was designed to stand.
    pub home: Pose,
    /// Every physical number.
    pub parameters: Parameters,
    /// What actuators and joints may do, as far as the file tells.
    pub limits: Limits,
    /// What looks odd in the file but may be meant, for people to read; not part of the JSON.
    pub warnings: Vec<Warning>,
}

impl Platform {
    /// Reads and checks a platform file.
    ///
    /// # Errors
    /// The file cannot be read, is not UTF-8, or holds mistakes; each mistake comes with line, caret and remedy.
    pub fn from_file(path: impl AsRef<Path>) -> Result<Self, FileError> {
        let path = path.as_ref();
        let help = "check the path and its permissions; `dyn-gen init` prints an example";
        let text = read_text(path, "platform", help)?;
        Self::from_toml(&path.display().to_string(), &text)
    }

    /// Checks the text of a platform file; `source_name` stands for the file in messages.
    ///
    /// # Errors
    /// As [`Platform::from_file`].
    pub fn from_toml(source_name: &str, text: &str) -> Result<Self, FileError> {
        let (mut platform, hints) =
            reader::read(text).map_err(|refusals| FileError::new(source_name, text, refusals))?;
        platform.warnings = Warning::all(source_name, text, hints);
        Ok(platform)
    }

    /// The parameter called `name`, flat and row-major; `None` if legs of this type have none of this name.
    pub fn parameter(&self, name: &str) -> Option<Vec<f64>> {
        self.parameters.get(name).map(<[f64]>::to_vec)
    }

    /// The names of all parameters, in their fixed order.
    pub fn parameter_names(&self) -> impl Iterator<Item = &'static str> {
        self.leg_type.parameters().map(|info| info.name)
    }
}

/// The JSON form of a [`Platform`], behind its version. `P` is the form of its parameters.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Versioned<P> {
    version: u32,
    name: String,
    leg_type: LegType,
    home: Pose,
    parameters: P,
    #[serde(default, skip_serializing_if = "Limits::is_empty")]
    limits: Limits,
}

impl From<Platform> for Versioned<Parameters> {
    fn from(platform: Platform) -> Self {
        let Platform { name, leg_type, home, parameters, limits, warnings: _ } = platform;
        Self { version: VERSION, name, leg_type, home, parameters, limits }
    }
}

impl TryFrom<Versioned<BTreeMap<String, Nested>>> for Platform {
    type Error = String;

    fn try_from(versioned: Versioned<BTreeMap<String, Nested>>) -> Result<Self, String> {
        let Versioned { version, name, leg_type, home, parameters, limits } = versioned;
        if version != VERSION {
            return Err(format!(
                "resolved platform has version {version}, this reader knows version {VERSION}"
            ));
        }
        let parameters = Parameters::from_nested(leg_type, parameters)?;
        Ok(Self { name, leg_type, home, parameters, limits, warnings: Vec::new() })
    }
}
