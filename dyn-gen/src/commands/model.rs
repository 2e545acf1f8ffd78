//! What decides the text of a model's file, as arguments: `generate` takes them, the file's first lines record them, `check`
//! reads them there.

use std::path::{Path, PathBuf};

use clap::Args;
use dyn_gen::emit::{RuntimePath, Scalar};
use dyn_gen::evidence::Sampling;
use dyn_gen::{Generated, GraphFile, Numbers, Options, generate};
use dyn_platform::Platform;
use miette::Result;

use super::files::{read_graph, read_platform};
use super::words::joined;

/// Where generated code finds the runtime crate unless told otherwise.
const RUNTIME_PATH: &str = "::dyn_runtime";

/// Arguments that decide what a model's file says.
#[derive(Args, Clone)]
pub struct ModelArguments {
    /// Name of the model, whose type is its CamelCase [default: the platform's name]
    #[arg(long)]
    model: Option<String>,
    /// Functions to generate, separated by commas; one with some of its outputs only as `control:jacobian_dp:total_bias`
    /// [default: all; `dyn-gen explain` lists them]
    #[arg(long, value_delimiter = ',', value_parser = trimmed, value_name = "NAME,...")]
    functions: Option<Vec<String>>,
    /// Numbers given at run time, separated by commas, all others baked in: parameters (`axial_stiffness`, `legs.k_e`) or
    /// the groups payload, legs, gravity, all [default: none]
    #[arg(long, value_delimiter = ',', value_parser = trimmed, value_name = "NAME,...")]
    runtime: Vec<String>,
    /// Numbers that the model computes with, f64 or f32 or both; the first is compiled with the file, others where they are
    /// called
    #[arg(long, value_delimiter = ',', value_name = "NUMBER,...", default_value = "f64")]
    scalar: Vec<Scalar>,
    /// Where the generated code finds the runtime crate
    #[arg(long, value_name = "PATH", default_value = RUNTIME_PATH)]
    runtime_path: String,
    /// States at which the model is examined before it is written
    #[arg(long, value_name = "N", default_value_t = Sampling::default().states, value_parser = states)]
    states: usize,
    /// Seed of those states
    #[arg(long, value_name = "S", default_value_t = Sampling::default().seed)]
    seed: u64,
    /// Do not examine the model
    #[arg(long, conflicts_with_all = ["states", "seed"])]
    no_evidence: bool,
    /// Graph file [default: the one this tool was built with]
    #[arg(long, value_name = "FILE.json")]
    pub graph: Option<PathBuf>,
}

impl ModelArguments {
    /// The text of the file `output`, whose first lines name it.
    pub fn generate(&self, platform_file: &Path, output: &Path) -> Result<Generated> {
        let platform = read_platform(platform_file)?;
        let graph = match &self.graph {
            Some(path) => read_graph(path)?,
            None => GraphFile::of(platform.leg_type)?,
        };
        self.generate_from(&graph, &platform, platform_file, output)
    }

    /// The same with this graph file and this platform.
    pub fn generate_from(
        &self,
        graph: &GraphFile,
        platform: &Platform,
        platform_file: &Path,
        output: &Path,
    ) -> Result<Generated> {
        let options = Options {
            command: joined(&self.command(&file_name(platform_file), &file_name(output), file_name)),
            model: self.model.clone().unwrap_or_else(|| platform.name.clone()),
            runtime: RuntimePath::new(&self.runtime_path).map_err(dyn_gen::GenerateError::from)?,
            scalars: self.scalar.clone(),
            functions: self.functions.clone(),
            evidence: (!self.no_evidence).then_some(Sampling { states: self.states, seed: self.seed }),
            without: Vec::new(),
        };
        Ok(generate(graph, &Numbers::with_run_time(platform, &self.runtime), &options)?)
    }

    /// The command that makes `output` from `platform`, word by word.
    pub fn command(&self, platform: &str, output: &str, show: fn(&Path) -> String) -> Vec<String> {
        let mut words: Vec<String> =
            ["dyn-gen", "generate", platform, "-o", output].map(str::to_owned).into();
        let mut option = |name: &str, value: Option<String>| {
            words.extend(value.into_iter().flat_map(|value| [format!("--{name}"), value]));
        };
        let sampling = Sampling::default();
        option("model", self.model.clone());
        option("functions", self.functions.as_ref().map(|names| names.join(",")));
        option("runtime", (!self.runtime.is_empty()).then(|| self.runtime.join(",")));
        let scalars: Vec<&str> = self.scalar.iter().map(|scalar| scalar.name()).collect();
        option("scalar", (self.scalar != [Scalar::F64]).then(|| scalars.join(",")));
        option("runtime-path", (self.runtime_path != RUNTIME_PATH).then(|| self.runtime_path.clone()));
        option("states", (self.states != sampling.states).then(|| self.states.to_string()));
        option("seed", (self.seed != sampling.seed).then(|| self.seed.to_string()));
        option("graph", self.graph.as_deref().map(show));
        if self.no_evidence {
            words.push("--no-evidence".into());
        }
        words
    }
}

/// A name of a list, without the blanks that may follow its comma.
pub fn trimmed(text: &str) -> std::result::Result<String, std::convert::Infallible> {
    Ok(text.trim().to_owned())
}

/// Number of states to look at: all kinds of them, or figures could come from home alone, where much is zero.
pub fn states(text: &str) -> std::result::Result<usize, String> {
    const LEAST: usize = 4;
    match text.parse() {
        Ok(states) if states >= LEAST => Ok(states),
        Ok(_) => Err(format!("give at least {LEAST}, one of each kind; `generate` has --no-evidence")),
        Err(error) => Err(error.to_string()),
    }
}

/// The name without folders, so that every machine writes the same.
pub fn file_name(path: &Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().into_owned()
}
