//! The WebAssembly module in Node, over the test vectors, against the native library.

use std::path::Path;
use std::process::{Command, Stdio};

use super::{announce, folder};
use crate::runner::{Failure, not_started, succeed};
use crate::workspace;

/// Runs both over all test vectors; says so where there is no Node.
pub fn compare(module: &Path) -> Result<(), Failure> {
    let size = std::fs::metadata(module).map_or(0, |metadata| metadata.len());
    println!("bare: {} bytes, {}", size, module.display());
    if Command::new("node").arg("--version").stdout(Stdio::null()).stderr(Stdio::null()).status().is_err() {
        println!("bare: comparison with WebAssembly skipped: no node here");
        return Ok(());
    }
    let done = announce("native outputs for the test vectors");
    let mut cargo = workspace::cargo();
    // As WebAssembly is: no function in lanes, whose products in sums are rounded once.
    cargo.args(["run", "--quiet", "--release", "--package", "dyn-capi", "--example", "native_outputs"]);
    cargo.args(["--no-default-features", "--features", "hosted,uhp,ups"]);
    let output = cargo.stderr(Stdio::inherit()).output().map_err(|error| not_started(&cargo, &error))?;
    if !output.status.success() {
        return Err(Failure::new("native_outputs failed", "its message stands above"));
    }
    done();
    let native = folder().join("native_outputs.json");
    std::fs::write(&native, &output.stdout)
        .map_err(|error| Failure::new(format!("{}: {error}", native.display()), ""))?;
    let script = workspace::root().join("dyn-capi/tests/wasm/compare.mjs");
    succeed(Command::new("node").arg(script).arg(module).arg(&native))
}
