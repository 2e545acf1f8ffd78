//! The library for one target.

use std::path::PathBuf;

use super::toolchain::Toolchain;
use super::{announce, folder};
use crate::runner::{Failure, succeed};

/// Number type of the library.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Precision {
    /// `f64`
    Double,
    /// `f32`
    Single,
}

impl Precision {
    /// Every one that the library has.
    pub const ALL: [Self; 2] = [Self::Double, Self::Single];

    /// As Rust calls it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Double => "f64",
            Self::Single => "f32",
        }
    }

    fn features(self) -> &'static [&'static str] {
        match self {
            Self::Double => &[],
            Self::Single => &["f32"],
        }
    }
}

/// The C library without `std`.
pub struct Library<'a> {
    /// By which compiler.
    pub toolchain: &'a Toolchain,
    /// For which target; none is this machine.
    pub target: Option<&'static str>,
    /// Its number type.
    pub precision: Precision,
}

impl Library<'_> {
    /// Target and number type.
    pub fn title(&self) -> String {
        format!("{}, {}", self.target.unwrap_or("this machine"), self.precision.name())
    }

    /// Whether every call is a relocation, also one within a section, so that recursion shows. On x86-64 calls within a
    /// section are not, and jumps through tables look like calls.
    pub fn calls_are_relocations(&self) -> bool {
        self.target == Some(super::CORTEX_M)
    }

    /// The static library, with the sizes of its functions' stack frames.
    pub fn archive(&self, features: &[&str]) -> Result<PathBuf, Failure> {
        self.build("staticlib", features, &["-Zemit-stack-sizes"])?;
        Ok(self.output().join("libdyn_capi.a"))
    }

    /// The WebAssembly module.
    pub fn module(&self) -> Result<PathBuf, Failure> {
        let linker = self.toolchain.wasm_linker().map(|path| format!("-Clinker={}", path.display()));
        let flags: Vec<&str> =
            linker.iter().map(String::as_str).chain(["-Clink-arg=--export=__heap_base"]).collect();
        self.build("cdylib", &[], &flags)?;
        Ok(self.output().join("dyn_capi.wasm"))
    }

    fn build(&self, kind: &str, features: &[&str], flags: &[&str]) -> Result<(), Failure> {
        let extra = features.iter().map(|feature| format!(", {feature}")).collect::<String>();
        let done = announce(&format!("library for {}{extra}", self.title()));
        let features: Vec<&str> = ["uhp", "ups", "panic-handler"]
            .into_iter()
            .chain(self.precision.features().iter().chain(features).copied())
            .collect();
        let mut cargo = self.toolchain.cargo();
        cargo
            .args([
                "rustc",
                "--quiet",
                "--package",
                "dyn-capi",
                "--lib",
                "--release",
                "--no-default-features",
            ])
            .args(["--crate-type", kind, "--features", &features.join(",")])
            .args(self.toolchain.options())
            .env("CARGO_TARGET_DIR", self.target_directory())
            // Without `std` nothing can unwind.
            .env("CARGO_PROFILE_RELEASE_PANIC", "abort")
            .env("CARGO_PROFILE_RELEASE_DEBUG", "false")
            .env("CARGO_ENCODED_RUSTFLAGS", flags.join("\u{1f}"));
        if let Some(target) = self.target {
            cargo.args(["--target", target]);
        }
        succeed(&mut cargo)?;
        done();
        Ok(())
    }

    fn target_directory(&self) -> PathBuf {
        let compiler = match self.toolchain {
            Toolchain::Own => "own",
            Toolchain::Unpacked(_) => "unpacked",
        };
        folder().join(format!("build-{compiler}-{}", self.precision.name()))
    }

    fn output(&self) -> PathBuf {
        let folder = self.target_directory();
        self.target.map_or(folder.clone(), |target| folder.join(target)).join("release")
    }
}
