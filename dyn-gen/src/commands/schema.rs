//! `dyn-gen schema`: what editors need to know of platform files.

use std::path::PathBuf;

use clap::Args;
use dyn_gen::output::{NewFile, write_all};
use miette::{IntoDiagnostic, Result};

use super::Outcome;

/// Arguments of `schema`.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub struct Schema {
    /// File to write [default: print it]
    #[arg(short, long, value_name = "FILE.json")]
    output: Option<PathBuf>,
}

const EXAMPLES: &str = "\
Examples:
  dyn-gen schema -o platform.schema.json

Editors with Taplo (Even Better TOML) complete and check platform files whose first line is
  #:schema ./platform.schema.json";

impl Schema {
    /// Writes or prints the schema.
    pub fn run(self) -> Result<Outcome> {
        let text = serde_json::to_string_pretty(&dyn_platform::schema()).into_diagnostic()? + "\n";
        match self.output {
            None => print!("{text}"),
            Some(path) => {
                write_all(&[NewFile { path: path.clone(), text }])?;
                eprintln!("wrote {}", path.display());
            }
        }
        Ok(Outcome::Done)
    }
}
