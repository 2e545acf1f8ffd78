//! `dyn-gen generate`

use std::path::PathBuf;

use clap::Args;
use dyn_gen::GenerateError;
use dyn_gen::output::{NewFile, write_all};
use miette::{IntoDiagnostic, Result, ensure};

use super::Outcome;
use super::check::is_ours;
use super::files::{keeps_input, read};
use super::model::ModelArguments;

/// Arguments of `generate`.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub struct Generate {
    /// Platform file
    #[arg(value_name = "PLATFORM.toml")]
    platform: PathBuf,
    /// File to write
    #[arg(short, long, value_name = "FILE.rs")]
    output: PathBuf,
    #[command(flatten)]
    pub model: ModelArguments,
    /// Write everything that was found about the model as JSON too
    #[arg(long, value_name = "FILE.json", conflicts_with = "no_evidence")]
    evidence: Option<PathBuf>,
    /// Print how long each stage took
    #[arg(long)]
    timings: bool,
}

const EXAMPLES: &str = "\
Examples:
  dyn-gen generate my_platform.toml -o src/my_platform.rs
  dyn-gen generate my_platform.toml -o src/control.rs --functions inverse_dynamics,forward_dynamics
  dyn-gen generate my_platform.toml -o src/my_platform.rs --runtime payload,gravity,legs.k_e
  dyn-gen generate my_platform.toml -o src/my_platform.rs --evidence evidence.json

The file needs the crate dyn-runtime and nothing else: add `mod my_platform;`, with
`#[rustfmt::skip]` before it, and call `dyn_runtime::Hexapod::new(my_platform::MyPlatform)`. With
--runtime the model has parameters: `my_platform::MyPlatform::default()` has the platform file's.

Before it writes, generate compares the model with the equations as derived and with dynamics
written by hand, at sampled states, and asks laws of mechanics of it. If anything is beyond its
tolerance it writes nothing and ends with code 1. A file that it did not write is left alone.";

impl Generate {
    /// Writes the model, if nothing stands against it.
    pub fn run(self) -> Result<Outcome> {
        keeps_input(&self.platform, &self.output)?;
        if let Some(evidence) = &self.evidence {
            keeps_input(&self.platform, evidence)?;
        }
        ensure!(
            !self.output.is_file() || read(&self.output).is_ok_and(|text| is_ours(&text)),
            help = "choose another name, or remove it first",
            "{} was not written by dyn-gen and stays as it is",
            self.output.display()
        );
        let generated = match self.model.generate(&self.platform, &self.output) {
            Ok(generated) => generated,
            Err(report) => {
                if let Some(GenerateError::Refused(evidence)) = report.downcast_ref() {
                    eprint!("{}", evidence.text());
                }
                return Err(report);
            }
        };
        let mut files = vec![NewFile { path: self.output, text: generated.source }];
        if let Some(evidence) = &generated.evidence {
            print!("{}", evidence.text());
            if let Some(path) = self.evidence {
                let text = serde_json::to_string_pretty(evidence).into_diagnostic()? + "\n";
                files.push(NewFile { path, text });
            }
        }
        let started = std::time::Instant::now();
        write_all(&files)?;
        let wrote = ("write", started.elapsed());
        if self.timings {
            for (stage, time) in generated.timings.into_iter().chain([wrote]) {
                println!("{stage:<10} {:>7.1} ms", 1e3 * time.as_secs_f64());
            }
        }
        let path = files[0].path.display();
        eprintln!("wrote {path}: {} functions", generated.functions.len());
        Ok(Outcome::Done)
    }
}
