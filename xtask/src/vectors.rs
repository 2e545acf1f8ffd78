//! The engines' test vectors: recomputed and compared with the committed ones, or written.

use std::ffi::OsStr;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use clap::Args;

use crate::runner::{Failure, not_started, succeed};
use crate::workspace;

/// Folders of the platform files that have vectors.
const PLATFORM_FOLDERS: [&str; 2] = ["platforms", "tests/platforms"];

/// Of `cargo xtask vectors`.
#[derive(Args)]
pub struct Options {
    /// Write the vectors anew instead of comparing
    #[arg(long)]
    write: bool,
    /// Instead: compare the two engines with each other at this many states per platform, write nothing
    #[arg(long, value_name = "N", conflicts_with = "write")]
    states: Option<u32>,
    /// Only this platform (name of its file without .toml); may be repeated
    #[arg(long, value_name = "NAME")]
    platform: Vec<String>,
}

/// Resolves the platform files and hands them to the engines' script.
pub fn compare_or_write(options: &Options) -> Result<(), Failure> {
    let root = workspace::root();
    let files = platform_files(&root, &options.platform)?;
    let environment = workspace::environment("engines", "tests/engines/requirements.lock")?;
    let folder = dyn_python::target_directory(&root).join("resolved-platforms");
    fs::create_dir_all(&folder).map_err(|error| unusable(&folder, &error))?;
    let folder = std::path::absolute(&folder).map_err(|error| unusable(&folder, &error))?;
    let mut resolved = Vec::new();
    for file in &files {
        resolved.push(resolve(file, &folder)?);
    }

    let mut python = environment.command();
    python.current_dir(&root).arg("tests/engines/vectors.py").args(&resolved);
    match options.states {
        Some(states) => python.args(["--dry-run", "--states", &states.to_string()]),
        None => python.args(["--out-dir", "tests/vectors"]),
    };
    if !options.write && options.states.is_none() {
        python.arg("--check");
    }
    succeed(&mut python)
}

/// Sorted, so that every run takes them in the same order.
fn platform_files(root: &Path, wanted: &[String]) -> Result<Vec<PathBuf>, Failure> {
    let mut files = Vec::new();
    for folder in PLATFORM_FOLDERS {
        let folder = root.join(folder);
        for entry in fs::read_dir(&folder).map_err(|error| unusable(&folder, &error))? {
            let path = entry.map_err(|error| unusable(&folder, &error))?.path();
            if path.extension() == Some(OsStr::new("toml")) {
                files.push(path);
            }
        }
    }
    files.sort();
    let name = |file: &PathBuf| file.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    if let Some(absent) = wanted.iter().find(|wanted| !files.iter().any(|file| name(file) == **wanted)) {
        let names: Vec<_> = files.iter().map(name).collect();
        return Err(Failure::new(
            format!("no platform file `{absent}.toml` in {}", PLATFORM_FOLDERS.join(" or ")),
            format!("platforms: {}", names.join(", ")),
        ));
    }
    files.retain(|file| wanted.is_empty() || wanted.contains(&name(file)));
    Ok(files)
}

/// The resolved numbers of a platform file, as JSON in `folder`.
fn resolve(file: &Path, folder: &Path) -> Result<PathBuf, Failure> {
    let mut cargo = workspace::cargo();
    cargo.args(["run", "--quiet", "--package", "dyn-platform", "--example", "resolve", "--"]).arg(file);
    // Its messages are for the reader; only what it prints is kept.
    let output =
        cargo.stderr(std::process::Stdio::inherit()).output().map_err(|error| not_started(&cargo, &error))?;
    if !output.status.success() {
        return Err(Failure::new(
            format!("{} cannot be resolved", file.display()),
            "its message stands above",
        ));
    }
    let path = folder.join(file.file_stem().unwrap_or_default()).with_extension("json");
    fs::write(&path, output.stdout).map_err(|error| unusable(&path, &error))?;
    Ok(path)
}

fn unusable(path: &Path, error: &io::Error) -> Failure {
    Failure::new(format!("{}: {error}", path.display()), "")
}
