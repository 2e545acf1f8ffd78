//! Subcommands: one file each.

mod check;
mod completions;
mod derive;
mod explain;
mod files;
mod generate;
mod init;
mod model;
mod progress;
mod regen;
mod resolve;
mod schema;
mod vectors;
mod words;

use clap::{Parser, Subcommand};

/// What a command has to say besides errors.
pub enum Outcome {
    /// It did what was asked.
    Done,
    /// It compared, and something differs.
    Differs,
}

/// Turns the derived equations of a parallel platform and the numbers of a platform file into flat Rust.
#[derive(Parser)]
#[command(version, after_help = EXAMPLES)]
pub struct Arguments {
    #[command(subcommand)]
    command: Command,
}

const EXAMPLES: &str = "\
Examples:
  dyn-gen init -o my_platform.toml                          a platform file to start from
  dyn-gen generate my_platform.toml -o src/my_platform.rs   a model of your own platform
  dyn-gen explain my_platform.toml                          the platform in figures
  dyn-gen check my_platform.toml src/my_platform.rs         is the model up to date?
  dyn-gen regen                                             the models of this repository, again
  dyn-gen regen --check                                     are they up to date?

Nothing is written when anything is refused; a file is replaced as a whole or not at all.
Exit codes: 0 done, 1 refused or different, 2 wrong usage.";

#[derive(Subcommand)]
enum Command {
    /// Write a commented platform file to start from
    Init(init::Init),
    /// Write the model of a platform: flat Rust for the crate dyn-runtime
    Generate(generate::Generate),
    /// Print a platform in figures: what it is, how it moves, what the generator makes of it
    Explain(explain::Explain),
    /// Write inputs and outputs of every function, to check a port against
    Vectors(vectors::Vectors),
    /// Print the JSON schema of platform files, for editors
    Schema(schema::Schema),
    /// Print a script that completes this tool's commands in a shell
    Completions(completions::Completions),
    /// Tell whether a file is what a platform gives
    Check(check::Check),
    /// Write the models committed in this repository (dyn-runtime/src/generated) again
    Regen(regen::Regen),
    /// Derive the equations with CasADi and write the graph files (codegen/graphs)
    Derive(derive::Derive),
    /// Print the resolved numbers of a platform as JSON
    Resolve(resolve::Resolve),
}

/// Does what the command line says.
pub fn run(arguments: Arguments) -> miette::Result<Outcome> {
    match arguments.command {
        Command::Init(init) => init.run(),
        Command::Schema(schema) => schema.run(),
        Command::Generate(generate) => generate.run(),
        Command::Check(check) => check.run(),
        Command::Regen(regen) => regen.run(),
        Command::Derive(derive) => derive.run(),
        Command::Resolve(resolve) => resolve.run(),
        Command::Explain(explain) => explain.run(),
        Command::Completions(completions) => completions.run(),
        Command::Vectors(vectors) => vectors.run(),
    }
}
