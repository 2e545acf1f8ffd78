//! `dyn-gen init`: a platform file to start from.

use std::path::{Path, PathBuf};

use clap::builder::PossibleValuesParser;
use clap::{Args, builder::TypedValueParser};
use dyn_gen::output::{NewFile, write_all};
use dyn_platform::{Starter, starter};
use miette::Result;

use super::Outcome;

/// Arguments of `init`.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub struct Init {
    /// What to start from: the paper's platform, the same with every joint written out, legs along the edges of a cube, or a
    /// Gough-Stewart platform with telescopic legs
    #[arg(long, default_value = "paper", value_parser = layouts())]
    layout: Starter,
    /// File to write; it must not exist [default: print it]
    #[arg(short, long, value_name = "FILE.toml")]
    output: Option<PathBuf>,
}

const EXAMPLES: &str = "\
Examples:
  dyn-gen init -o my_platform.toml
  dyn-gen init --layout cubic -o my_platform.toml

Every number in the file has a comment; docs/platform-file.md describes all keys.";

fn layouts() -> impl TypedValueParser<Value = Starter> {
    let names = PossibleValuesParser::new(Starter::ALL.map(Starter::name));
    names.try_map(|name| {
        Starter::ALL.into_iter().find(|starter| starter.name() == name).ok_or("no such layout")
    })
}

impl Init {
    /// Writes or prints the file.
    pub fn run(self) -> Result<Outcome> {
        let text = starter(self.layout);
        let Some(path) = self.output else {
            print!("{text}");
            return Ok(Outcome::Done);
        };
        miette::ensure!(
            !path.exists(),
            help = "choose another name, or remove it first",
            "{} exists already and stays as it is",
            path.display()
        );
        write_all(&[NewFile { path: path.clone(), text: text.to_owned() }])?;
        let file = path.display();
        let model = if Path::new("src").is_dir() { "src/my_platform.rs" } else { "my_platform.rs" };
        eprintln!(
            "wrote {file}\nnext: change its numbers, then\n  dyn-gen explain {file}\n  dyn-gen generate {file} -o {model}"
        );
        Ok(Outcome::Done)
    }
}
