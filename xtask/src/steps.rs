//! The steps of `run` and `test`: what, why, and the command. A new step is a new row.

use crate::runner::Failure;

/// One row.
pub struct Step {
    /// For `--only` and `--from`.
    pub name: &'static str,
    /// What one knows after it.
    pub why: &'static str,
    /// What does it.
    pub action: Action,
}

/// What does a step.
#[derive(Clone, Copy)]
pub enum Action {
    /// `cargo ARGUMENTS`.
    Cargo(&'static [&'static str]),
    /// The same, with a rustup component that not every machine has.
    CargoWith {
        /// Arguments of cargo.
        arguments: &'static [&'static str],
        /// The component.
        component: &'static str,
    },
    /// `cargo ARGUMENTS` whose tests are counted; none at all is a failure.
    CargoTests(&'static [&'static str]),
    /// `cargo ARGUMENTS` with warnings of rustdoc denied.
    Documentation(&'static [&'static str]),
    /// `cargo ARGUMENTS`, for a machine without operating system where the toolchain has that target.
    NoStd(&'static [&'static str]),
    /// What `cargo xtask bare` does, where its toolchain is there already.
    Bare,
    /// What `cargo xtask contract` does, where binutils are.
    Contract,
    /// `python ARGUMENTS` in a folder, in a Python environment of its own.
    Python {
        /// Where and with which packages.
        program: &'static PythonProgram,
        /// Arguments of python.
        arguments: &'static [&'static str],
    },
}

/// A Python program of this workspace.
pub struct PythonProgram {
    /// Name of its environment under `target/python/`.
    pub environment: &'static str,
    /// Folder to be in, from the root.
    pub folder: &'static str,
    /// Its pinned packages, from the root.
    pub lock_file: &'static str,
}

/// The derivation by CasADi.
const DERIVATION: PythonProgram =
    PythonProgram { environment: "derivation", folder: "codegen", lock_file: "codegen/requirements.lock" };

/// The mechanism in Exudyn.
const PROTOTYPE: PythonProgram = PythonProgram {
    environment: "prototype",
    folder: "dyn-sim",
    lock_file: "dyn-sim/prototype/requirements.lock",
};

/// The README's `Run`.
pub const RUN: &[Step] = &[
    Step {
        name: "generate",
        why: "CasADi derives the equations, dyn-gen turns them into Rust",
        action: Action::Cargo(&[
            "run",
            "--release",
            "--package",
            "dyn-gen",
            "--",
            "regen",
            "--derive",
            "--fallback",
        ]),
    },
    Step {
        name: "explain",
        why: "the paper's platform in figures, checked against independent numerics",
        action: Action::Cargo(&[
            "run",
            "--release",
            "--package",
            "dyn-gen",
            "--",
            "explain",
            "platforms/uhp_2016.toml",
        ]),
    },
    Step {
        name: "first-call",
        why: "the generated functions, called from a program of 40 lines",
        action: Action::Cargo(&["run", "--release", "--package", "dyn-runtime", "--example", "first_call"]),
    },
    Step {
        name: "experiment",
        why: "the paper's experiment: our errors beside its Table 4, and a report with every curve",
        action: Action::Cargo(&["run", "--release", "--package", "dyn-sim", "--", "reproduce"]),
    },
];

/// The README's `Test`. Quick checks first; the tests last, so that their figures stand at the end of the output.
pub const TEST: &[Step] = &[
    Step {
        name: "format",
        why: "the sources are formatted",
        action: Action::CargoWith { arguments: &["fmt", "--all", "--check"], component: "rustfmt" },
    },
    Step {
        name: "lints",
        why: "no warning of rustc or clippy, in benchmarks and examples neither",
        action: Action::CargoWith {
            arguments: &["clippy", "--workspace", "--all-targets", "--", "--deny", "warnings"],
            component: "clippy",
        },
    },
    Step {
        name: "derivation",
        why: "the committed graph is what CasADi derives today, byte for byte",
        action: Action::Cargo(&["run", "--package", "dyn-gen", "--", "derive", "--check"]),
    },
    Step {
        name: "regeneration",
        why: "the committed Rust is what dyn-gen makes of graph and platform, byte for byte",
        action: Action::Cargo(&["run", "--package", "dyn-gen", "--", "regen", "--check"]),
    },
    Step {
        name: "python-tests",
        why: "the derivation's own tests",
        action: Action::Python {
            program: &DERIVATION,
            arguments: &["-m", "pytest", "tests", "--quiet", "-p", "no:cacheprovider"],
        },
    },
    Step {
        name: "prototype-tests",
        why: "the mechanism in Exudyn is the paper's: against other engines and hand calculation",
        action: Action::Python {
            program: &PROTOTYPE,
            arguments: &["-m", "pytest", "prototype/tests", "--quiet", "-p", "no:cacheprovider"],
        },
    },
    Step {
        name: "no-std",
        why: "dyn-runtime needs neither operating system nor allocator",
        action: Action::NoStd(&["build", "--package", "dyn-runtime", "--no-default-features"]),
    },
    Step {
        name: "bare",
        why: "the C library for machines without operating system: no panic, no recursion, WebAssembly as native",
        action: Action::Bare,
    },
    Step {
        name: "contract",
        why: "no call of the runtime crate can panic or run on; the same bits in debug and release (needs binutils, else says so)",
        action: Action::Contract,
    },
    Step {
        name: "single-precision",
        why: "the C programs with the library in single precision",
        action: Action::CargoTests(&[
            "test",
            "--package",
            "dyn-capi",
            "--features",
            "f32",
            "--test",
            "c_programs",
        ]),
    },
    Step {
        name: "documentation",
        why: "every link in the documentation leads somewhere",
        action: Action::Documentation(&["doc", "--workspace", "--no-deps"]),
    },
    Step {
        name: "instruction-counts",
        why: "no function executes more instructions than its budget (needs valgrind, else says so)",
        action: Action::Cargo(&[
            "run",
            "--release",
            "--package",
            "dyn-benches",
            "--bin",
            "instruction_counts",
            "--",
            "--check",
        ]),
    },
    Step {
        name: "documented-examples",
        why: "what the documentation shows compiles, runs and is right",
        action: Action::CargoTests(&["test", "--workspace", "--doc"]),
    },
    // Without the examples, which this command would build otherwise and nothing runs: the lints have compiled them.
    Step {
        name: "tests",
        why: "agreement with reference and engines, physics, passes, printer, bad input",
        action: Action::CargoTests(&["test", "--workspace", "--lib", "--bins", "--tests"]),
    },
];

/// The steps that `--from` or `--only` leave.
pub fn select<'a>(steps: &'a [Step], from: Option<&str>, only: Option<&str>) -> Result<&'a [Step], Failure> {
    let position = |name: &str| {
        steps.iter().position(|step| step.name == name).ok_or_else(|| {
            let names: Vec<_> = steps.iter().map(|step| step.name).collect();
            Failure::new(format!("no step is called `{name}`"), format!("steps: {}", names.join(", ")))
        })
    };
    match (from, only) {
        (_, Some(name)) => position(name).map(|index| &steps[index..=index]),
        (Some(name), None) => position(name).map(|index| &steps[index..]),
        (None, None) => Ok(steps),
    }
}
