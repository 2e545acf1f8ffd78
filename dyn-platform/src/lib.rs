//! The only reader of platform files: schema, layouts, units, checks, resolved plain numbers.
//!
//! ```
//! # fn main() -> Result<(), dyn_platform::PlatformError> {
//! let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../platforms/uhp_2016.toml");
//! let platform = dyn_platform::Platform::from_file(path)?;
//! assert_eq!(platform.parameters.rod_length, [0.206; 6]);
//! assert_eq!(platform.parameter("payload_mass"), Some(vec![6.092]));
//! # Ok(())
//! # }
//! ```
//!
//! The format is described for users in `docs/platform-file.md`. Inside:
//!
//! | module | holds |
//! |-|-|
//! | `schema` | the walk through a file, from text to resolved platform |
//! | `legs` | the part of that walk about legs: common values, overrides, the default |
//! | `keys` | the table of keys: spelling, meaning, example |
//! | `document` | typed values out of TOML, each with its place in the text |
//! | `checks` | the physics that a file may not violate |
//! | `layout` | from circles to joint points |
//! | `refusal` | what a mistake becomes |
//! | `parameters`, `platform` | the resolved numbers |

mod checks;
mod document;
mod keys;
mod layout;
mod legs;
mod parameters;
mod platform;
mod refusal;
mod schema;

pub use parameters::{Matrix3, PARAMETERS, ParameterInfo, Parameters, Vector3};
pub use platform::{LegType, Platform, Pose, VERSION};
pub use refusal::{PlatformError, Refusal};
