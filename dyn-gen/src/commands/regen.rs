//! `dyn-gen regen`: everything generated in this repository.

use std::path::Path;

use clap::Args;
use dyn_gen::emit::{RuntimePath, Scalar};
use dyn_gen::evidence::{Sampling, gather};
use dyn_gen::output::{NewFile, write_all};
use dyn_gen::{GenerateError, GraphFile, Numbers, Options, generate, kernels, optimise};
use dyn_platform::{LegType, Platform, Starter, starter};
use miette::Result;

use super::Outcome;
use super::check::recorded;
use super::derive::{DeriveError, Derived, derive};
use super::files::{EXAMPLE, GENERATED, GRAPHS, PLATFORM, graph_name, read, read_graph, repository};

/// The command that the files name and that a failed check recommends.
const COMMAND: &str = "cargo regen";

/// Arguments of `regen`.
#[derive(Args)]
pub struct Regen {
    /// Derive the equations first (needs Python 3.11 or later; makes its own environment under target/)
    #[arg(long)]
    derive: bool,
    /// With --derive: where Python or the network is missing, say so and go on with the committed graphs
    #[arg(long, requires = "derive")]
    fallback: bool,
    /// Compare only: exit code 1 if a file is not up to date
    #[arg(long)]
    check: bool,
}

impl Regen {
    /// Generates everything, then writes or compares.
    pub fn run(self) -> Result<Outcome> {
        let root = repository()?;
        let mut files = Vec::new();
        let graphs = match self.derived(&root)? {
            Some(derived) => {
                let graphs = derived.iter().map(|derived| derived.graph.clone()).collect();
                files.extend(derived.into_iter().map(|derived| derived.file(&root)));
                graphs
            }
            None => LegType::ALL
                .into_iter()
                .map(|leg_type| read_graph(&root.join(GRAPHS).join(graph_name(leg_type))))
                .collect::<Result<Vec<GraphFile>>>()?,
        };
        files.extend(generated_files(&root, &graphs)?);
        files.retain(|file| !file.is_current());
        let shown =
            |file: &NewFile| file.path.strip_prefix(&root).unwrap_or(&file.path).display().to_string();
        let changed: Vec<String> = files.iter().map(shown).collect();
        if files.is_empty() {
            eprintln!("everything generated is up to date");
        } else if self.check {
            let command = if self.derive { format!("{COMMAND} --derive") } else { COMMAND.into() };
            eprintln!("not up to date: {}\nrun `{command}`", changed.join(", "));
            return Ok(Outcome::Differs);
        } else {
            write_all(&files)?;
            eprintln!("wrote {}", changed.join(", "));
        }
        Ok(Outcome::Done)
    }

    fn derived(&self, root: &Path) -> Result<Option<Vec<Derived>>> {
        if !self.derive {
            return Ok(None);
        }
        match derive(root) {
            Ok(derived) => Ok(Some(derived)),
            Err(report) => match report.downcast_ref::<DeriveError>() {
                Some(error) if self.fallback && error.is_environment_missing() => {
                    eprintln!("{error}: going on with the committed graphs");
                    Ok(None)
                }
                _ => Err(report),
            },
        }
    }
}

/// Every generated file of the runtime crate, its models examined: kernel traits, the default platform with its numbers baked in, and a model of
/// every leg type with its numbers given at run time.
fn generated_files(root: &Path, graphs: &[GraphFile]) -> Result<Vec<NewFile>> {
    let platform = Platform::from_file(root.join(PLATFORM))?;
    let model = |graph: &GraphFile, name: &str, numbers: &Numbers| -> Result<(String, String)> {
        let options = Options {
            model: name.into(),
            runtime: RuntimePath::inside(),
            scalars: vec![Scalar::F64, Scalar::F32],
            functions: None,
            command: COMMAND.into(),
            evidence: numbers.platform().map(|_| Sampling::default()),
            without: Vec::new(),
        };
        Ok((name.to_owned(), generate(graph, numbers, &options)?.source))
    };
    let mut texts = vec![("kernels".to_owned(), kernels(graphs, COMMAND)?)];
    for graph in graphs {
        let leg_type = graph.program.name.as_str();
        examine_with_numbers_at_run_time(graph)?;
        texts.push(model(graph, leg_type, &Numbers::at_run_time())?);
        if platform.leg_type.name() == leg_type {
            texts.push(model(graph, &platform.name, &Numbers::baked(&platform))?);
        }
    }
    let file = |(name, text): (String, String)| NewFile {
        path: root.join(GENERATED).join(format!("{name}.rs")),
        text,
    };
    let mut files: Vec<NewFile> = texts.into_iter().map(file).collect();
    files.extend(example(root, graphs)?);
    Ok(files)
}

/// Examines the model that has all its numbers at run time, with those of a platform of its leg type.
fn examine_with_numbers_at_run_time(graph: &GraphFile) -> Result<()> {
    for which in Starter::ALL {
        let platform = Platform::from_toml(which.name(), starter(which))?;
        if platform.leg_type.name() != graph.program.name {
            continue;
        }
        let functions = optimise(&graph.program, &Numbers::at_run_time(), None)?;
        let numbers = Numbers::with_run_time(&platform, ["all"]);
        let evidence = gather(&graph.program, &numbers, &functions, Sampling::default())?;
        if !evidence.holds() {
            return Err(GenerateError::Refused(Box::new(evidence)).into());
        }
        return Ok(());
    }
    miette::bail!("no starter platform has legs {:?}, with which to examine their model", graph.program.name)
}

/// The model of the example crate, with the options in its first lines; none in a repository without it.
fn example(root: &Path, graphs: &[GraphFile]) -> Result<Option<NewFile>> {
    let [platform_file, path] = EXAMPLE.map(|file| root.join(file));
    if !platform_file.is_file() {
        return Ok(None);
    }
    let platform = Platform::from_file(&platform_file)?;
    let model = recorded(&read(&path)?).map_err(|reason| miette::miette!("{}: {reason}", path.display()))?;
    let Some(graph) = graphs.iter().find(|graph| graph.program.name == platform.leg_type.name()) else {
        return Ok(None);
    };
    let text = model.generate_from(graph, &platform, &platform_file, &path)?.source;
    Ok(Some(NewFile { path, text }))
}
