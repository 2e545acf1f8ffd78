//! Writes `include/dyn_capi.h` anew from the sources: `cargo run -p dyn-capi --example write_header`.

use std::path::Path;
use std::process::ExitCode;

fn main() -> ExitCode {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let header = folder.join("include/dyn_capi.h");
    let result = header_text(folder).and_then(|text| {
        std::fs::write(&header, text).map_err(|error| format!("{}: {error}", header.display()))
    });
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(reason) => {
            eprintln!("error: {reason}");
            ExitCode::FAILURE
        }
    }
}

include!("../tests/support/header_text.rs");
