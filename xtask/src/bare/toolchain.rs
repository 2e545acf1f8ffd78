//! A compiler that can build `core` for any target: Debian's, whose packages carry the sources, unpacked under `target/`
//! without being installed.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use super::{announce, folder};
use crate::runner::Failure;
use crate::workspace;

/// Compiler, sources of the standard library.
const PACKAGES: [&str; 3] = ["rustc-web", "rust-web-src", "libstd-rust-web-dev"];

/// Which compiler.
#[derive(Clone, Debug)]
pub enum Toolchain {
    /// The one this workspace is built with; its `core` is compiled already.
    Own,
    /// Debian's, unpacked in this folder.
    Unpacked(PathBuf),
}

/// Whether there is one.
pub enum Found {
    /// Yes.
    Ready(Toolchain),
    /// No, and why.
    Absent(String),
}

/// The toolchain that an earlier run has unpacked.
pub fn ready() -> Option<Toolchain> {
    let root = root();
    root.join("complete.stamp").is_file().then_some(Toolchain::Unpacked(root))
}

/// The toolchain, unpacked now if it was not. Absent where Debian's packages cannot be had; a failure only where they can.
pub fn fetch() -> Result<Found, Failure> {
    if let Some(toolchain) = ready() {
        return Ok(Found::Ready(toolchain));
    }
    for program in ["apt-get", "apt-cache", "dpkg-deb", "dpkg-query"] {
        if Command::new(program)
            .arg("--version")
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .status()
            .is_err()
        {
            return Ok(Found::Absent(format!(
                "no {program} here: Debian's packages of rustc-web are needed"
            )));
        }
    }
    let Some(packages) = packages() else {
        return Ok(Found::Absent("apt offers no package rustc-web (apt-get update?)".into()));
    };

    let partial = folder().join("toolchain.partial");
    let failed = |error: std::io::Error| Failure::new(format!("{}: {error}", partial.display()), "");
    if partial.exists() {
        fs::remove_dir_all(&partial).map_err(failed)?;
    }
    fs::create_dir_all(&partial).map_err(failed)?;
    for (number, package) in packages.iter().enumerate() {
        let done = announce(&format!("package {} of {}: {package}", number + 1, packages.len()));
        if let Err(reason) = unpack(package, &partial) {
            fs::remove_dir_all(&partial).map_err(failed)?;
            return Ok(Found::Absent(reason));
        }
        done();
    }
    let version = Toolchain::Unpacked(partial.clone()).rustc().arg("--version").output();
    match version {
        Ok(output) if output.status.success() => {
            println!("bare: {}", String::from_utf8_lossy(&output.stdout).trim());
        }
        Ok(output) => {
            let said = String::from_utf8_lossy(&output.stderr);
            return Ok(Found::Absent(format!("the unpacked rustc does not start: {}", said.trim())));
        }
        Err(error) => return Ok(Found::Absent(format!("the unpacked rustc does not start: {error}"))),
    }
    fs::write(partial.join("complete.stamp"), "").map_err(failed)?;
    let root = root();
    if root.exists() {
        fs::remove_dir_all(&root).map_err(failed)?;
    }
    fs::rename(&partial, &root).map_err(failed)?;
    Ok(Found::Ready(Toolchain::Unpacked(root)))
}

fn root() -> PathBuf {
    folder().join("toolchain")
}

/// What must be unpacked: the compiler, a linker of the same LLVM, and of the libraries they need those that this machine
/// does not have.
fn packages() -> Option<Vec<String>> {
    let mut packages: Vec<String> = PACKAGES.map(String::from).to_vec();
    let options = ["recommends", "suggests", "conflicts", "breaks", "replaces", "enhances"];
    let output = Command::new("apt-cache")
        .args(["depends", "--recurse"])
        .args(options.map(|option| format!("--no-{option}")))
        .arg("libstd-rust-web-dev")
        .stderr(Stdio::null())
        .output()
        .ok()?;
    // Packages begin a line, what is said about them is indented; `<...>` are virtual.
    let text = String::from_utf8_lossy(&output.stdout);
    let libraries = text.lines().filter(|line| line.starts_with(|first: char| first.is_ascii_lowercase()));
    for library in libraries {
        if !packages.iter().any(|package| package == library) && !is_installed(library) {
            packages.push(library.to_owned());
        }
    }
    let llvm = text.lines().find_map(|line| line.strip_prefix("libllvm"))?;
    packages.push(format!("lld-{llvm}"));
    Some(packages)
}

fn is_installed(package: &str) -> bool {
    let output = Command::new("dpkg-query").args(["--show", "--showformat=${Status}", package]).output();
    output.is_ok_and(|output| String::from_utf8_lossy(&output.stdout).ends_with(" installed"))
}

/// Downloads a package and unpacks it into `folder`.
fn unpack(package: &str, folder: &Path) -> Result<(), String> {
    let downloads = folder.join("downloads");
    fs::create_dir_all(&downloads).map_err(|error| format!("{}: {error}", downloads.display()))?;
    quietly(Command::new("apt-get").args(["download", package]).current_dir(&downloads))?;
    let entries = fs::read_dir(&downloads).map_err(|error| format!("{}: {error}", downloads.display()))?;
    for entry in entries.flatten() {
        quietly(Command::new("dpkg-deb").arg("--extract").arg(entry.path()).arg(folder))?;
    }
    fs::remove_dir_all(&downloads).map_err(|error| format!("{}: {error}", downloads.display()))
}

/// Runs a program; if it fails, the last line that it said.
fn quietly(command: &mut Command) -> Result<(), String> {
    let program = command.get_program().to_string_lossy().into_owned();
    let output = command.output().map_err(|error| format!("{program}: {error}"))?;
    if output.status.success() {
        return Ok(());
    }
    let said = String::from_utf8_lossy(&output.stderr);
    Err(format!("{program}: {}", said.trim().lines().last().unwrap_or("failed")))
}

impl Toolchain {
    fn rustc_path(&self) -> Option<PathBuf> {
        match self {
            Self::Own => None,
            Self::Unpacked(root) => Some(root.join("usr/bin/rustc")),
        }
    }

    fn rustc(&self) -> Command {
        let mut command = Command::new(self.rustc_path().unwrap_or_else(|| "rustc".into()));
        self.set_libraries(&mut command);
        command
    }

    fn set_libraries(&self, command: &mut Command) {
        if let Self::Unpacked(root) = self {
            let own = root.join("usr/lib/x86_64-linux-gnu");
            let given = std::env::var_os("LD_LIBRARY_PATH").unwrap_or_default();
            let paths = [own].into_iter().chain(std::env::split_paths(&given));
            if let Ok(paths) = std::env::join_paths(paths) {
                command.env("LD_LIBRARY_PATH", paths);
            }
        }
    }

    /// The workspace's cargo with this compiler; it builds `core` itself unless that is compiled already.
    pub fn cargo(&self) -> Command {
        let mut command = workspace::cargo();
        // Measuring stacks and building `core` are unstable options.
        command.env("RUSTC_BOOTSTRAP", "1");
        self.set_libraries(&mut command);
        if let Some(rustc) = self.rustc_path() {
            command.env("RUSTC", rustc);
        }
        command
    }

    /// Options of cargo that a build with this compiler needs.
    pub fn options(&self) -> &'static [&'static str] {
        match self {
            Self::Own => &[],
            Self::Unpacked(_) => &["-Zbuild-std=core"],
        }
    }

    /// The linker for WebAssembly, if it is not the compiler's own.
    pub fn wasm_linker(&self) -> Option<PathBuf> {
        match self {
            Self::Own => None,
            Self::Unpacked(root) => {
                let folder = root.join("usr/bin");
                let entries = fs::read_dir(folder).ok()?;
                entries.flatten().map(|entry| entry.path()).find(|path| {
                    path.file_name().is_some_and(|name| name.to_string_lossy().starts_with("wasm-ld"))
                })
            }
        }
    }
}
