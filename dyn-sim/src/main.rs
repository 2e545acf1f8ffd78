//! The command line tool: everything that talks to people.

mod commands;

use std::process::ExitCode;

use clap::Parser;

fn main() -> ExitCode {
    match commands::run(commands::Arguments::parse()) {
        Ok(ending) => ending.exit_code(),
        Err(report) => {
            eprintln!("{report:?}");
            commands::Ending::Refused.exit_code()
        }
    }
}
