//! `dyn-gen completions`

use clap::{Args, CommandFactory};
use clap_complete::Shell;
use miette::Result;

use super::{Arguments, Outcome};

/// Arguments of `completions`.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub struct Completions {
    /// The shell
    shell: Shell,
}

const EXAMPLES: &str = "\
Examples:
  dyn-gen completions bash > ~/.local/share/bash-completion/completions/dyn-gen
  dyn-gen completions zsh > ~/.zfunc/_dyn-gen
  dyn-gen completions fish > ~/.config/fish/completions/dyn-gen.fish";

impl Completions {
    /// Prints the script.
    pub fn run(self) -> Result<Outcome> {
        clap_complete::generate(self.shell, &mut Arguments::command(), "dyn-gen", &mut std::io::stdout());
        Ok(Outcome::Done)
    }
}
