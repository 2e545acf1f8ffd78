//! Where things lie, and the two programs everything is done with.

use std::env;
use std::path::{Path, PathBuf};
use std::process::Command;

use dyn_python::{Environment, Recipe};

use crate::runner::Failure;

/// Root of the workspace; every path in the table of steps is relative to it.
pub fn root() -> PathBuf {
    // Set anew by `cargo run`; the compiled-in one serves a binary that is started by hand.
    let manifest = env::var_os("CARGO_MANIFEST_DIR").unwrap_or_else(|| env!("CARGO_MANIFEST_DIR").into());
    Path::new(&manifest).parent().map_or_else(|| ".".into(), Path::to_owned)
}

/// The cargo that runs this program.
pub fn cargo() -> Command {
    let mut command = Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    command.current_dir(root());
    command
}

/// The Python environment of a lock file given relative to the root.
pub fn environment(name: &str, lock_file: &str) -> Result<Environment, Failure> {
    let root = root();
    Environment::prepare(&Recipe {
        name,
        lock_file: &root.join(lock_file),
        target_directory: &dyn_python::target_directory(&root),
    })
    .map_err(|error| Failure::new(error.to_string(), error.remedy().to_owned()))
}
