//! Prints the resolved numbers of a platform file as JSON: `cargo run -p dyn-platform --example resolve -- FILE.toml`.

use dyn_platform::Platform;
use miette::{IntoDiagnostic, miette};

fn main() -> miette::Result<()> {
    let path = std::env::args_os().nth(1).ok_or_else(|| miette!("usage: resolve FILE.toml"))?;
    let platform = Platform::from_file(path)?;
    for warning in &platform.warnings {
        eprintln!("{:?}", miette::Report::new(warning.clone()));
    }
    println!("{}", serde_json::to_string_pretty(&platform).into_diagnostic()?);
    Ok(())
}
