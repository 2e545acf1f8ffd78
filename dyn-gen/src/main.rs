//! The command line tool: everything that reads or writes files.

mod commands;

use std::process::ExitCode;

use clap::Parser;

/// Exit code of a refusal, and of a comparison that found a difference. Wrong usage is 2, by clap.
const REFUSED: u8 = 1;

fn main() -> ExitCode {
    match commands::run(commands::Arguments::parse()) {
        Ok(commands::Outcome::Done) => ExitCode::SUCCESS,
        Ok(commands::Outcome::Differs) => ExitCode::from(REFUSED),
        Err(report) => {
            eprintln!("{report:?}");
            ExitCode::from(REFUSED)
        }
    }
}
