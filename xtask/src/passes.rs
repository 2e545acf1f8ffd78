//! `passes`: what each pass of the generator is worth, in operations and in time.

use std::path::{Path, PathBuf};
use std::{fs, io};

use clap::Args;

use crate::runner::{Failure, succeed};
use crate::workspace;

/// Of `cargo xtask passes`.
#[derive(Args)]
pub struct Options {
    /// Look at this platform instead of the paper's (legs of type uhp)
    #[arg(long, value_name = "FILE.toml")]
    platform: Option<PathBuf>,
}

/// Makes the models, measures them, prints and writes the table.
pub fn passes(options: &Options) -> Result<(), Failure> {
    let default = workspace::root().join("platforms/uhp_2016.toml");
    let file = options.platform.clone().unwrap_or(default);
    let file = fs::canonicalize(&file).map_err(|error| unusable(&file, &error))?;
    let target = dyn_python::target_directory(&workspace::root());
    let target = std::path::absolute(&target).unwrap_or(target);
    let folder = target.join("passes").join(file.file_stem().unwrap_or_default());
    let models = folder.join("models");
    // A pass that is no more would leave its models behind.
    let _ = fs::remove_dir_all(&models);
    fs::create_dir_all(&models).map_err(|error| unusable(&models, &error))?;
    let cargo = || {
        let mut cargo = workspace::cargo();
        cargo.env("CARGO_TARGET_DIR", target.join("bench/native")).env("RUSTFLAGS", "-C target-cpu=native");
        cargo.env("DYN_BENCHES_PLATFORM", &file);
        cargo.args(["bench", "--package", "dyn-benches"]);
        cargo
    };
    succeed(cargo().args(["--bench", "pass_models", "--"]).arg(&models))?;
    let mut measure = cargo();
    measure.env("DYN_BENCHES_VARIANTS", &models).args(["--features", "variants", "--bench", "passes", "--"]);
    succeed(measure.arg("--write").arg(&folder))
}

fn unusable(path: &Path, error: &io::Error) -> Failure {
    Failure::new(format!("{}: {error}", path.display()), "")
}
