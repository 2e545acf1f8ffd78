//! Code size, stack and compile time of what was measured.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Instant;

use super::peers::seconds_of;
use crate::contract::{MachineCode, machine_code};

/// The functions that peers have too.
const FUNCTIONS: [&str; 3] = ["inverse_dynamics", "forward_dynamics", "matrices"];

/// A table of code and stack bytes, calls included, and what the compilers take; nothing where binutils are missing.
pub fn text(release: &Path, model: &Path, peers: &Path, pinocchio: &Path) -> Option<String> {
    let program = newest(&release.join("deps"), "dynamics-")?;
    let code = machine_code(&program).ok()?;
    let mut text = row(["function", "implementation", "code bytes", "stack bytes", "seconds to compile"]);
    let mut names: Vec<_> = code.names().filter_map(|name| Some((implementation(name)?, name))).collect();
    names.sort_unstable();
    // Of several copies, made where rustc knew an argument, one stands for all.
    names.dedup_by_key(|(implementation, _)| *implementation);
    for ((function, implementation), name) in names {
        text += &footprint(&code, name, [FUNCTIONS[function], implementation], "");
    }
    for object in objects(peers) {
        let symbol = object.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let Some((function, implementation)) = peer(&symbol) else { continue };
        let Ok(code) = machine_code(&object) else { continue };
        let seconds = fs::read_to_string(seconds_of(&object)).unwrap_or_default();
        text += &footprint(&code, &symbol, [function, &implementation], &seconds);
    }
    if let Ok(code) = machine_code(pinocchio) {
        text += &footprint(&code, "pinocchio_forward_dynamics", ["forward_dynamics", "pinocchio"], "");
    }
    text += "Code and stack are those of a function and of all that it calls by name, panics and the C library left out.\n";
    match compile_seconds(release, model) {
        Some(seconds) => {
            text +=
                &format!("rustc takes {seconds:.1} s for the generated model, every function, f64 and f32\n")
        }
        None => text += "absent: compile time: rustc could not be started on the generated model\n",
    }
    Some(text)
}

/// A line of the table.
fn row([function, implementation, code, stack, seconds]: [&str; 5]) -> String {
    let line = format!("{function:<17}  {implementation:<32} {code:>11} {stack:>12} {seconds:>19}");
    line.trim_end().to_owned() + "\n"
}

fn footprint(code: &MachineCode, name: &str, [function, implementation]: [&str; 2], seconds: &str) -> String {
    let counted = |name: &str| !name.contains("4core") && !name.contains("panic");
    match code.footprint(name, counted) {
        Some((code, stack)) => {
            row([function, implementation, &code.to_string(), &stack.to_string(), seconds])
        }
        // What may call itself has no deepest chain.
        None => row([function, implementation, "unbounded", "unbounded", seconds]),
    }
}

/// Which of [`FUNCTIONS`] by which implementation a symbol of ours is, by its mangled path.
fn implementation(symbol: &str) -> Option<(usize, &'static str)> {
    let is = |function: &str| symbol.contains(&format!("{}{function}17h", function.len()));
    let function = FUNCTIONS.iter().position(|function| is(function))?;
    let implementation = match symbol {
        _ if symbol.starts_with("_ZN13dyn_reference") => "reference",
        _ if !symbol.contains("generated..kernels..") || symbol.contains("f32") => return None,
        _ if symbol.contains("..flat..Flat$LT$") => "generated",
        _ if symbol.contains("..uhp..PreparedUhp$") => "generated_runtime",
        _ if symbol.contains("dyn_benches..payload..") => "generated_payload",
        _ => "generated_lanes",
    };
    Some((function, implementation))
}

/// Which function by which implementation, compiler and flags, an object of a peer is: `casadi_c_same_matrices_0_gcc_fast`.
fn peer(symbol: &str) -> Option<(&'static str, String)> {
    let function = FUNCTIONS.iter().find(|&&function| symbol.contains(function))?;
    let (implementation, variant) = symbol.split_once(&format!("_{function}_"))?;
    Some((function, format!("{implementation} {}", variant.replace('_', " "))))
}

/// Objects of peers in a folder, by name.
fn objects(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).into_iter().flatten().filter_map(|entry| Some(entry.ok()?.path()));
    let mut objects: Vec<_> = entries.filter(|path| path.extension().is_some_and(|end| end == "o")).collect();
    objects.sort();
    objects
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

#[cfg(test)]
mod tests {
    use super::{implementation, peer};

    #[test]
    fn symbols_are_told_apart() {
        let kernel = "$u20$as$u20$dyn_runtime..generated..kernels..Matrices$GT$8matrices17h028ab976b4cbb4a1E";
        for (model, expected) in [
            ("_ZN103_$LT$dyn_runtime..generated..uhp_2016..Uhp2016", "generated_lanes"),
            ("_ZN102_$LT$dyn_runtime..generated..uhp..PreparedUhp", "generated_runtime"),
            ("_ZN98_$LT$dyn_benches..payload..generated..Uhp2016", "generated_payload"),
            (
                "_ZN94_$LT$dyn_benches..flat..Flat$LT$dyn_runtime..generated..uhp_2016..Uhp2016$GT$",
                "generated",
            ),
        ] {
            assert_eq!(implementation(&format!("{model}{kernel}")), Some((2, expected)));
        }
        let reference = "_ZN13dyn_reference8dynamics16inverse_dynamics17hf9726cbedb88e46cE";
        assert_eq!(implementation(reference), Some((0, "reference")));
        assert_eq!(implementation("_ZN13dyn_reference8matrices12leg_coriolis17hd36509dedde34dfaE"), None);
        let symbol = "casadi_c_same_forward_dynamics_1_clang_fast";
        assert_eq!(peer(symbol), Some(("forward_dynamics", "casadi_c_same 1 clang fast".into())));
    }
}
