//! The C library for machines without operating system: built, searched for panics, measured, and as WebAssembly run
//! against the native one.
//!
//! | module | holds |
//! |-|-|
//! | `toolchain` | a compiler that can build `core` for any target, unpacked under `target/` |
//! | `build` | the library for one target |
//! | `archive` | compiled functions, and what each refers to |
//! | `thumb` | calls in the microcontroller's code |
//! | `reach` | what a function can reach: code, stack, panics, recursion |
//! | `wasm` | Node runs the module over the test vectors |

mod archive;
mod build;
mod reach;
#[cfg(test)]
mod tests;
mod thumb;
mod toolchain;
mod wasm;

use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::Args;

use crate::runner::Failure;
use crate::workspace;
use archive::Archive;
use build::{Library, Precision};
use toolchain::{Found, Toolchain};

pub use toolchain::fetch;

/// A common microcontroller with a floating-point unit.
const CORTEX_M: &str = "thumbv7em-none-eabihf";
/// WebAssembly without a host.
const WASM: &str = "wasm32-unknown-unknown";

/// Of `cargo xtask bare`.
#[derive(Args)]
pub struct Options {
    /// Search and measure the library of this machine only; downloads nothing
    #[arg(long)]
    host_only: bool,
    /// Print the measurements as JSON too, after the tables
    #[arg(long)]
    json: bool,
}

/// Everything; where the toolchain cannot be had, what goes without it.
pub fn bare(options: &Options) -> Result<(), Failure> {
    let mut measured = vec![host()?];
    if !options.host_only {
        match fetch()? {
            Found::Ready(toolchain) => measured.extend(targets(&toolchain)?),
            Found::Absent(reason) => println!("bare: {CORTEX_M} and {WASM} skipped: {reason}"),
        }
    }
    if options.json {
        println!("{}", reach::json(&measured));
    }
    Ok(())
}

/// The step of `cargo xtask test`: everything if the toolchain is there already, else nothing.
pub fn if_ready() -> Result<String, Failure> {
    let Some(toolchain) = toolchain::ready() else {
        return Ok("skipped: no toolchain under target/ (cargo xtask bare, or --bare, fetches it)".into());
    };
    host()?;
    targets(&toolchain)?;
    Ok(format!("this machine, {CORTEX_M}, {WASM}"))
}

/// Builds, searches and measures the library for this machine, without its operating system.
fn host() -> Result<reach::Measured, Failure> {
    accept(&Library { toolchain: &Toolchain::Own, target: None, precision: Precision::Double })
}

/// The same for a microcontroller, and WebAssembly against the native library.
fn targets(toolchain: &Toolchain) -> Result<Vec<reach::Measured>, Failure> {
    let mut measured = Vec::new();
    for precision in Precision::ALL {
        measured.push(accept(&Library { toolchain, target: Some(CORTEX_M), precision })?);
    }
    let library = Library { toolchain, target: Some(WASM), precision: Precision::Double };
    wasm::compare(&library.module()?)?;
    Ok(measured)
}

/// Prints what the functions of a library reach, and fails for what they must not. The search must first find what there
/// is to find in a library that has it.
fn accept(library: &Library<'_>) -> Result<reach::Measured, Failure> {
    let title = library.title();
    let control = reach::measure(&title, &read(&library.archive(&["control-case"])?)?)?;
    let found = control.functions.iter().find(|function| function.name == "dyn_control_case");
    if !found.is_some_and(|function| function.panic.is_some()) {
        return Err(Failure::new(
            format!("{title}: the search does not find the panic of dyn_control_case"),
            "",
        ));
    }
    if library.calls_are_relocations() && !found.is_some_and(|function| function.recursion.is_some()) {
        return Err(Failure::new(
            format!("{title}: the search does not find the recursion of dyn_control_case"),
            "",
        ));
    }

    let mut measured = reach::measure(&title, &read(&library.archive(&[])?)?)?;
    if !library.calls_are_relocations() {
        measured.forget_recursion();
    }
    print!("{}", measured.text());
    match measured.defects() {
        defects if defects.is_empty() => Ok(measured),
        defects => Err(Failure::new(format!("{title}:\n{}", defects.join("\n")), "")),
    }
}

fn read(path: &Path) -> Result<Archive, Failure> {
    let bytes =
        std::fs::read(path).map_err(|error| Failure::new(format!("{}: {error}", path.display()), ""))?;
    Archive::parse(&bytes).map_err(|error| Failure::new(format!("{}: {error}", path.display()), ""))
}

/// Folder of everything here.
fn folder() -> PathBuf {
    dyn_python::target_directory(&workspace::root()).join("bare")
}

/// Says that something long begins; the returned function says how long it took.
fn announce(what: &str) -> impl FnOnce() + use<> {
    println!("bare: {what} ...");
    let (started, what) = (Instant::now(), what.to_owned());
    move || println!("bare: {what}: {:.0} s", started.elapsed().as_secs_f64())
}
