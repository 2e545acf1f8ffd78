//! `contract`: what a machine without operating system gets. Builds `contract/`, a program of every call, optimised across crates so that
//! what is left can be reached, and looks at the symbols and the machine code.

use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;

use crate::runner::Failure;
use crate::workspace::{cargo, root};

/// Builds without and with a function that can panic: the first must have no way to panic, the second shows that one would be seen.
pub fn check() -> Result<(), Failure> {
    let object = build(&[])?;
    let found = ways_to_panic(&object)?;
    if !found.is_empty() {
        return Err(Failure::new(
            format!("a panic can be reached: {}", found.join(", ")),
            "look for what indexes or unwraps",
        ));
    }
    let functions = functions(&object)?;
    let control = ways_to_panic(&build(&["--features", "can_panic"])?)?;
    if control.is_empty() {
        return Err(Failure::new(
            "a function that can panic passed as one that cannot",
            "look at `ways_to_panic`",
        ));
    }
    println!("{:<36} {:>10} {:>12}", "function", "code bytes", "frame bytes");
    for (name, (size, frame)) in functions {
        println!("{name:<36} {size:>10} {frame:>12}");
    }
    println!("\nno way to panic; the control case has {}", control.join(", "));
    Ok(())
}

/// The object of the program alone, taken out of the library.
fn build(features: &[&str]) -> Result<std::path::PathBuf, Failure> {
    let folder = dyn_python::target_directory(&root()).join("contract");
    let manifest = root().join("contract/Cargo.toml");
    run(cargo()
        .args(["build", "--release", "--quiet", "--manifest-path"])
        .arg(&manifest)
        .args(features)
        .env("CARGO_TARGET_DIR", &folder))?;
    let library = folder.join("release/libcontract.a");
    let members = run(Command::new("ar").arg("t").arg(&library))?;
    let member = members
        .lines()
        .find(|member| member.starts_with("contract-"))
        .ok_or_else(|| Failure::new("the library has no object of the program", "build contract/ by hand"))?;
    run(Command::new("ar").arg("x").arg(&library).arg(member).current_dir(&folder))?;
    Ok(folder.join(member))
}

/// Symbols of panics, defined or wanted.
fn ways_to_panic(object: &Path) -> Result<Vec<String>, Failure> {
    let symbols = run(Command::new("nm").arg("--demangle").arg(object))?;
    let is_panic = |symbol: &&str| {
        ["core::panicking", "panic_fmt", "panic_bounds_check", "unwrap_failed"]
            .iter()
            .any(|sign| symbol.contains(sign))
    };
    let name = |line: &str| line.split_whitespace().last().unwrap_or(line).to_owned();
    Ok(symbols.lines().filter(|line| is_panic(line)).map(name).collect())
}

/// Bytes of code and of the stack frame of every function.
pub fn functions(object: &Path) -> Result<BTreeMap<String, (u64, u64)>, Failure> {
    let listing =
        run(Command::new("objdump").args(["--disassemble", "--demangle", "--no-show-raw-insn"]).arg(object))?;
    let mut functions = BTreeMap::new();
    let mut current: Option<(String, u64)> = None;
    for line in listing.lines() {
        if let Some((address, name)) = line.strip_suffix(">:").and_then(|line| line.split_once(" <")) {
            let start = u64::from_str_radix(address.trim(), 16).unwrap_or(0);
            current = Some((name.to_owned(), start));
            functions.insert(name.to_owned(), (0, 0));
        } else if let Some((name, start)) = &current {
            let entry: &mut (u64, u64) = functions.entry(name.clone()).or_default();
            let Some((address, instruction)) = line.split_once(":\t") else { continue };
            let here = u64::from_str_radix(address.trim(), 16).unwrap_or(*start);
            entry.0 = here - start + 1;
            if instruction.starts_with("push") {
                entry.1 += 8;
            } else if let Some(size) =
                instruction.strip_prefix("sub").and_then(|rest| rest.trim().strip_suffix(",%rsp"))
            {
                let digits = size.trim_start_matches("$0x");
                entry.1 += u64::from_str_radix(digits, 16).unwrap_or(0);
            }
        }
    }
    Ok(functions)
}

/// Standard output of a command that succeeds.
fn run(command: &mut Command) -> Result<String, Failure> {
    let program = command.get_program().to_string_lossy().into_owned();
    let output = command.output().map_err(|error| {
        Failure::new(format!("cannot start `{program}`: {error}"), "install the package binutils")
    })?;
    if !output.status.success() {
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        return Err(Failure::new(format!("`{program}` failed: {said}"), "see its message"));
    }
    Ok(String::from_utf8_lossy(&output.stdout).into_owned())
}
