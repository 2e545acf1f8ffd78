//! `dyn-gen resolve`

use std::path::PathBuf;

use clap::Args;
use miette::{IntoDiagnostic, Result};

use super::Outcome;
use super::files::read_platform;

/// Arguments of `resolve`.
#[derive(Args)]
pub struct Resolve {
    /// Platform file
    #[arg(value_name = "PLATFORM.toml")]
    platform: PathBuf,
}

impl Resolve {
    /// Prints the JSON.
    pub fn run(self) -> Result<Outcome> {
        let platform = read_platform(&self.platform)?;
        println!("{}", serde_json::to_string_pretty(&platform).into_diagnostic()?);
        Ok(Outcome::Done)
    }
}
