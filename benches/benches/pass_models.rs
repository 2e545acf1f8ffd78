//! Writes models made without some passes, for `cargo xtask passes` to compile into `passes`.

use std::path::PathBuf;
use std::process::ExitCode;

use dyn_benches::pass_variants::write_models;
use dyn_benches::states::platform;

fn main() -> ExitCode {
    let Some(folder) = std::env::args_os().nth(1).map(PathBuf::from) else {
        eprintln!("error: no folder named\n help: cargo xtask passes");
        return ExitCode::FAILURE;
    };
    match write_models(&platform(), &folder) {
        Ok(()) => ExitCode::SUCCESS,
        Err(reason) => {
            eprintln!("error: {reason}");
            ExitCode::FAILURE
        }
    }
}
