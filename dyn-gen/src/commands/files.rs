//! Where things are in the repository, and what is read from files.

use std::fs;
use std::path::{Path, PathBuf};

use dyn_gen::GraphFile;
use dyn_platform::{LegType, Platform};
use miette::{Diagnostic, IntoDiagnostic, Result, WrapErr};

/// Folder of the graph files, seen from the root.
pub const GRAPHS: &str = "codegen/graphs";
/// Folder of the derivation.
pub const DERIVATION: &str = "codegen";
/// Its pinned packages.
pub const LOCK_FILE: &str = "codegen/requirements.lock";
/// The platform whose model is committed.
pub const PLATFORM: &str = "platforms/uhp_2016.toml";
/// Platform and model of the example crate whose model is committed.
pub const EXAMPLE: [&str; 2] =
    ["examples/committed_model/my_platform.toml", "examples/committed_model/src/my_platform.rs"];
/// Folder of the committed models.
pub const GENERATED: &str = "dyn-runtime/src/generated";

/// No repository around.
#[derive(Debug, thiserror::Error, Diagnostic)]
#[error("this is not inside the repository: no folder from {} upwards has {GRAPHS}", start.display())]
#[diagnostic(help(
    "change into the repository; a model of your own platform needs none: `dyn-gen generate`"
))]
struct NoRepository {
    start: PathBuf,
}

/// The root of the repository: the folder that holds the graph files, searched upwards from the current folder and then
/// from where this tool was built.
pub fn repository() -> Result<PathBuf> {
    let start = std::env::current_dir().into_diagnostic().wrap_err("cannot tell the current folder")?;
    let built_in = Path::new(env!("CARGO_MANIFEST_DIR"));
    start
        .ancestors()
        .chain(built_in.ancestors())
        .find(|folder| folder.join(GRAPHS).is_dir() && folder.join(GENERATED).is_dir())
        .map(Path::to_owned)
        .ok_or_else(|| NoRepository { start }.into())
}

/// The text of a file.
pub fn read(path: &Path) -> Result<String> {
    fs::read_to_string(path).into_diagnostic().wrap_err_with(|| format!("cannot read {}", path.display()))
}

/// Refuses to write over the platform file.
pub fn keeps_input(platform: &Path, output: &Path) -> Result<()> {
    let same = matches!((platform.canonicalize(), output.canonicalize()), (Ok(a), Ok(b)) if a == b);
    miette::ensure!(
        !same,
        help = "choose another name for what is written",
        "{} is the platform file and stays as it is",
        output.display()
    );
    Ok(())
}

/// The platform file at `path`. Hints at what may be wrong with it are printed.
pub fn read_platform(path: &Path) -> Result<Platform> {
    let platform = Platform::from_file(path)?;
    for warning in &platform.warnings {
        eprintln!("{:?}", miette::Report::new(warning.clone()));
    }
    Ok(platform)
}

/// The graph file of a leg type, in the folder [`GRAPHS`].
pub fn graph_name(leg_type: LegType) -> String {
    format!("{}.json", leg_type.name())
}

/// The graph file at `path`.
pub fn read_graph(path: &Path) -> Result<GraphFile> {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    GraphFile::from_json(&name, &read(path)?)
        .map_err(miette::Report::from)
        .wrap_err_with(|| format!("{} is refused", path.display()))
}
