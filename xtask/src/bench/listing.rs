//! Code size, stack and compile time of what was measured.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Instant;

use crate::contract::sizes;

/// The functions that peers have too.
const FUNCTIONS: [&str; 3] = ["inverse_dynamics", "forward_dynamics", "matrices"];

/// A table of code and frame bytes, and what rustc takes for the generated model; nothing where binutils are missing.
pub fn text(release: &Path, model: &Path, peers: &Path) -> Option<String> {
    let program = newest(&release.join("deps"), "dynamics-")?;
    let mut text = format!("{:<58} {:>10} {:>12}\n", "function", "code bytes", "frame bytes");
    let own = sizes(&program).ok()?;
    let rows = own.iter().filter(|(name, ..)| {
        let of = |function: &str| {
            name.ends_with(&format!("::{function}"))
                && (name.contains("generated") || name.contains("reference"))
        };
        FUNCTIONS.iter().any(|function| of(function))
    });
    for (name, size, frame) in rows {
        text += &format!("{name:<58} {size:>10} {frame:>12}\n");
    }
    for (name, size, frame) in sizes(&peers.join("libpeers.a")).unwrap_or_default() {
        if name.starts_with("casadi_c") && (name.ends_with("_strict") || name.ends_with("_fast")) {
            text += &format!("{name:<58} {size:>10} {frame:>12}\n");
        }
    }
    text += "The frame is that of the function alone, as its prologue reserves it.\n";
    match compile_seconds(release, model) {
        Some(seconds) => {
            text += &format!("rustc takes {seconds:.1} s for the generated model, every function, f64\n")
        }
        None => text += "absent: compile time: rustc could not be started on the generated model\n",
    }
    Some(text)
}

/// Seconds of rustc for a generated model alone, optimised for this processor.
fn compile_seconds(release: &Path, model: &Path) -> Option<f64> {
    let runtime = newest(&release.join("deps"), "libdyn_runtime-")?;
    let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let mut compile = Command::new(rustc);
    compile.args(["--edition=2024", "--crate-type=lib", "--crate-name=model", "--emit=obj", "-O"]);
    compile.args(["-C", "target-cpu=native", "-C", "codegen-units=16", "--cap-lints=allow"]);
    compile.arg("--extern").arg(format!("dyn_runtime={}", runtime.display()));
    compile.arg("-L").arg(release.join("deps")).arg("-o").arg(model.with_extension("o")).arg(model);
    let started = Instant::now();
    let status = compile.stdout(Stdio::null()).stderr(Stdio::null()).status().ok()?;
    status.success().then(|| started.elapsed().as_secs_f64())
}

/// The youngest file of a folder that begins so and is a program or an rlib.
fn newest(folder: &Path, prefix: &str) -> Option<PathBuf> {
    let entries = fs::read_dir(folder).ok()?.filter_map(|entry| Some(entry.ok()?.path()));
    let fits = |path: &PathBuf| {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        name.starts_with(prefix)
            && matches!(path.extension().and_then(|end| end.to_str()), None | Some("rlib"))
    };
    entries.filter(fits).max_by_key(|path| fs::metadata(path).and_then(|file| file.modified()).ok())
}
