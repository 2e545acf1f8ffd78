//! Python environments from pinned lock files, made on first use.
//!
//! The derivation and the multibody engines behind the test vectors are Python programs. Nobody should have to set
//! up Python for them: [`Environment::prepare`] finds an interpreter, makes a virtual environment under Cargo's
//! target folder, installs exactly what the lock file names (every file checked against its hash) and returns a
//! way to run it. The first call takes as long as the download; later calls read two small files.
//!
//! ```no_run
//! use dyn_python::{Environment, Recipe, target_directory};
//! use std::path::Path;
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let workspace = Path::new(".");
//! let environment = Environment::prepare(&Recipe {
//!     name: "derivation",
//!     lock_file: &workspace.join("codegen/requirements.lock"),
//!     target_directory: &target_directory(workspace),
//! })?;
//! let status = environment.command().args(["-m", "derivation"]).current_dir(workspace.join("codegen")).status()?;
//! # Ok(())
//! # }
//! ```
//!
//! Where Python may be missing and there is something to fall back on:
//!
//! ```no_run
//! # use dyn_python::{Environment, Error, Recipe};
//! # fn derive(_: Environment) {}
//! # fn example(recipe: &Recipe) -> Result<(), Error> {
//! match Environment::prepare(recipe) {
//!     Ok(environment) => derive(environment),
//!     Err(error) if error.is_environment_missing() => eprintln!("{error}: the committed graph is used instead"),
//!     Err(error) => return Err(error),
//! }
//! # Ok(())
//! # }
//! ```

mod diagnosis;
mod environment;
mod error;
mod install;
mod interpreter;
mod process;
mod progress;
mod stamp;
#[cfg(test)]
mod tests;

pub use environment::{Environment, Recipe, target_directory};
pub use error::Error;
