//! `contract`: what a machine without operating system gets. Builds `contract/`, a program of every call, optimised across crates so that
//! what is left can be reached, and looks at the symbols and the machine code. Besides, compares debug with release.

mod machine_code;

use std::path::Path;
use std::process::Command;

pub use self::machine_code::MachineCode;
use self::machine_code::{Bounds, Unbounded};
use crate::runner::Failure;
use crate::workspace::{cargo, root};

/// The step of `cargo xtask test`.
pub fn if_possible() -> Result<String, Failure> {
    same_bits()?;
    let tools = ["ar", "objdump"];
    match tools.into_iter().find(|tool| Command::new(tool).arg("--version").output().is_err()) {
        Some(tool) => Ok(format!("symbols not looked at: no {tool} here (package binutils)")),
        None => bounded().map(|()| String::new()),
    }
}

/// Panics, code and stack, bits.
pub fn check() -> Result<(), Failure> {
    bounded()?;
    same_bits()
}

/// The machine code of an object or program, names as the linker has them.
pub fn machine_code(object: &Path) -> Result<MachineCode, Failure> {
    let arguments = ["--disassemble", "--reloc", "--no-show-raw-insn"];
    run(Command::new("objdump").args(arguments).arg(object)).map(|listing| MachineCode::read(&listing))
}

/// Every call of the C library for every test vector, by all its models, gives the same bits whether it is compiled for debugging or for
/// release.
fn same_bits() -> Result<(), Failure> {
    let outputs = |profile: &[&str]| {
        run(cargo()
            .args(["run", "--quiet", "--package", "dyn-capi", "--example", "native_outputs"])
            .args(profile))
    };
    let (debug, release) = (outputs(&[])?, outputs(&["--release"])?);
    if debug != release {
        return Err(Failure::new(
            "debug and release give different numbers",
            "compare `cargo run -p dyn-capi --example native_outputs` with and without --release",
        ));
    }
    println!("the same {} bytes of outputs in debug and release", debug.len());
    Ok(())
}

/// Nothing may reach a panic, itself, a loop without bound or a function that the code does not name, but the control cases; that these
/// are found must be seen.
fn bounded() -> Result<(), Failure> {
    let object = build()?;
    let code = machine_code(&object)?;
    let control = control_cases(&code)?;
    println!("{:<36} {:>10} {:>12} {:>14}", "call", "code bytes", "stack bytes", "instructions");
    let exported = code.names().filter(|name| !name.starts_with('_') && !name.starts_with(CONTROL));
    for name in exported {
        let found = ways_to_panic(&code, name);
        if !found.is_empty() {
            return Err(Failure::new(
                format!("{name} can reach a panic: {}", found.join(", ")),
                "look for what indexes or unwraps",
            ));
        }
        let worst = code.worst(name, &LOOPS).map_err(|reason| {
            Failure::new(
                format!("{name} has no bound: {reason}"),
                "make it straight, or a loop whose bound and reason stand in LOOPS of xtask/src/contract",
            )
        })?;
        println!("{name:<36} {:>10} {:>12} {:>14}", worst.code, worst.stack, worst.instructions);
    }
    println!("\nloops are only in");
    for Bounds { function, rounds, reason } in LOOPS {
        println!("  {function}, at most {rounds:?} rounds: {reason}");
    }
    println!(
        "no way to panic, no other loop, no call of what the code does not name; the control cases have\n  {control}"
    );
    Ok(())
}

/// Every function that may have loops.
const LOOPS: [Bounds; 10] = {
    const fn search(function: &'static str) -> Bounds {
        Bounds { function, rounds: &[30, 9, 6], reason: "30 steps, each tried 9 times, over legs" }
    }
    [
        search("forward_kinematics"),
        search("forward_kinematics_uhp"),
        search("forward_kinematics_ups"),
        search("forward_kinematics_f32"),
        search("forward_kinematics_prepared_uhp"),
        search("forward_kinematics_prepared_ups"),
        Bounds {
            function: "dyn_runtime::check::judged_with_care",
            rounds: &[6],
            reason: "columns, rows and elements of a matrix",
        },
        Bounds {
            function: "dyn_runtime::solve::by_elimination",
            rounds: &[6],
            reason: "columns, rows and elements of a matrix",
        },
        Bounds {
            function: "dyn_runtime::trigonometry::each_with_libm",
            rounds: &[16, 1],
            reason: "an angle for each of 16 lanes, which the compiler divides between two loops",
        },
        Bounds {
            function: "libm::math::rem_pio2_large::rem_pio2_large",
            rounds: &[20, 20, 3],
            reason: "remainders of huge angles: digits of 2/pi, 20 at most, every attempt with one more at least; 3 parts of a number",
        },
    ]
};

/// Names of the functions of `contract/` that do what none of the others may.
const CONTROL: &str = "can_";

/// What the search finds in the control cases, each of which must have its fault.
fn control_cases(code: &MachineCode) -> Result<String, Failure> {
    let missed = |what: &str| {
        Failure::new(
            format!("{what} passed as one that cannot"),
            "look at `ways_to_panic` and `MachineCode::worst`",
        )
    };
    let panics = ways_to_panic(code, "can_panic");
    if panics.is_empty() {
        return Err(missed("a function that can panic"));
    }
    let mut found = panics;
    for (function, is_found) in [
        ("can_run_on", (|reason| matches!(reason, Unbounded::Loop(_))) as fn(&Unbounded) -> bool),
        ("can_lead_anywhere", |reason| matches!(reason, Unbounded::UnknownCallee(..))),
    ] {
        match code.worst(function, &LOOPS) {
            Err(reason) if is_found(&reason) => found.push(reason.to_string()),
            _ => return Err(missed(&format!("a function that {}", function.replace('_', " ")))),
        }
    }
    Ok(found.join("\n  "))
}

/// What a panic would call.
const HANDLER: &str = "rust_begin_unwind";

/// Functions that only a panic calls, of those that `function` reaches.
fn ways_to_panic(code: &MachineCode, function: &str) -> Vec<String> {
    let is_panic = |name: &String| {
        ["panicking", "panic_fmt", "panic_bounds_check", "unwrap_failed", HANDLER]
            .iter()
            .any(|sign| name.contains(sign))
    };
    let reached = code.reached(function).into_iter().filter(is_panic);
    reached.map(|name| format!("{:#}", rustc_demangle::demangle(&name))).collect()
}

/// The object of the program alone, taken out of the library.
fn build() -> Result<std::path::PathBuf, Failure> {
    let folder = dyn_python::target_directory(&root()).join("contract");
    let manifest = root().join("contract/Cargo.toml");
    run(cargo()
        .args(["build", "--release", "--quiet", "--manifest-path"])
        .arg(&manifest)
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
