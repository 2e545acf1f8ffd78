//! `dyn-gen generate`

use std::path::PathBuf;

use clap::Args;
use dyn_gen::emit::{RuntimePath, Scalar};
use dyn_gen::{GraphFile, Numbers, Options};
use dyn_platform::Platform;
use miette::Result;

use super::Outcome;
use super::files::{NewFile, read_graph, write_all};

/// Arguments of `generate`.
#[derive(Args)]
pub struct Generate {
    /// Platform file
    #[arg(value_name = "PLATFORM.toml")]
    platform: PathBuf,
    /// File to write
    #[arg(short, long, value_name = "FILE.rs")]
    output: PathBuf,
    /// Name of the model, whose type is its CamelCase [default: the platform's name]
    #[arg(long)]
    model: Option<String>,
    /// Where the generated code finds the runtime crate
    #[arg(long, value_name = "PATH", default_value = "::dyn_runtime")]
    runtime_path: String,
    /// Functions to generate, separated by commas [default: all]
    #[arg(long, value_delimiter = ',', value_name = "NAME,...")]
    functions: Option<Vec<String>>,
    /// Graph file [default: the one this tool was built with]
    #[arg(long, value_name = "FILE.json")]
    graph: Option<PathBuf>,
}

impl Generate {
    /// Writes the model, if nothing stands against it.
    pub fn run(self) -> Result<Outcome> {
        let platform = Platform::from_file(&self.platform)?;
        let graph = match &self.graph {
            Some(path) => read_graph(path)?,
            None => GraphFile::uhp()?,
        };
        let options = Options {
            command: self.command(),
            model: self.model.unwrap_or_else(|| platform.name.clone()),
            runtime: RuntimePath::new(&self.runtime_path).map_err(dyn_gen::GenerateError::from)?,
            scalars: vec![Scalar::F64],
            functions: self.functions,
        };
        let generated = dyn_gen::generate(&graph, Numbers::Baked(&platform), &options)?;
        let file = NewFile { path: self.output, text: generated.source };
        write_all(std::slice::from_ref(&file))?;
        eprintln!("wrote {}: {} functions", file.path.display(), generated.functions.len());
        Ok(Outcome::Done)
    }

    /// The command as the file's first lines show it: names without folders, so that every machine writes the same.
    fn command(&self) -> String {
        let name = |path: &PathBuf| path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let mut command = format!("dyn-gen generate {} -o {}", name(&self.platform), name(&self.output));
        if let Some(model) = &self.model {
            command += &format!(" --model {model}");
        }
        if self.runtime_path != "::dyn_runtime" {
            command += &format!(" --runtime-path {}", self.runtime_path);
        }
        if let Some(functions) = &self.functions {
            command += &format!(" --functions {}", functions.join(","));
        }
        if let Some(graph) = &self.graph {
            command += &format!(" --graph {}", name(graph));
        }
        command
    }
}
