//! The only reader of platform files: schema, layouts, units, checks, resolved plain numbers.
//!
//! ```
//! # fn main() -> Result<(), dyn_platform::FileError> {
//! let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../platforms/uhp_2016.toml");
//! let platform = dyn_platform::Platform::from_file(path)?;
//! assert_eq!(platform.parameters.legs("rod_length"), Some([0.206; 6]));
//! assert_eq!(platform.parameter("payload_mass"), Some(vec![6.092]));
//! # Ok(())
//! # }
//! ```
//!
//! The format is described for users in `docs/platform-file.md`. Inside:
//!
//! | module | holds |
//! |-|-|
//! | `reader` | the walk through a file, from text to resolved platform |
//! | `keys` | the tables of keys: spelling, value, meaning, example |
//! | `legs` | a module per leg type: what its legs are made of, what must hold at home |
//! | `leg_tables` | the tables about legs in a file: common values, overrides, defaults |
//! | `payload` | one body, or parts that are summed |
//! | `limits` | what actuators and joints may do |
//! | `document` | typed values out of TOML, each with its place in the text |
//! | `checks` | what single numbers, vectors and tensors may not be |
//! | `assembly` | the platform at home as a whole: six legs must hold it |
//! | `units` | hints at units that are probably wrong |
//! | `schema`, `starter` | JSON schema for editors, files to start from |
//! | `versions` | what to do with a file of another version |
//! | `findings` | refusals and hints on their way out of the reader |
//! | `layout` | from circles to joint points |
//! | `refusal`, `text` | what a mistake becomes; shared with other readers of text files |
//! | `parameters`, `platform`, `nested` | the resolved numbers and their JSON |

mod assembly;
mod checks;
mod document;
mod findings;
mod keys;
mod layout;
mod leg_tables;
mod legs;
mod limits;
mod nested;
mod parameters;
mod payload;
mod platform;
mod reader;
mod refusal;
mod schema;
mod starter;
mod text;
mod units;
mod versions;

pub use findings::Warning;
pub use limits::{Limit, Limits};
pub use parameters::{Matrix3, ParameterInfo, Parameters, Vector3};
pub use platform::{LegType, Platform, Pose, VERSION};
pub use refusal::{FileError, Refusal};
pub use schema::schema;
pub use starter::{Starter, starter};
pub use text::{first_line, nearest, read_text, utf8_text};
