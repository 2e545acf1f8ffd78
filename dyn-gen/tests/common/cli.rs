//! Running the command line tool.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

/// Runs the tool in `folder`.
pub fn dyn_gen(folder: &Path, arguments: &[&str]) -> Output {
    dyn_gen_with(folder, arguments, &[])
}

/// Runs the tool in `folder` with these environment variables.
pub fn dyn_gen_with(folder: &Path, arguments: &[&str], variables: &[(&str, &str)]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_dyn-gen"))
        .args(arguments)
        .current_dir(folder)
        .envs(variables.iter().copied())
        .output()
        .expect("dyn-gen runs")
}

/// Its exit code.
pub fn code(output: &Output) -> i32 {
    output.status.code().expect("an exit code")
}

/// What it wrote on standard error.
pub fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// The same on one line, without the frames and line breaks of messages.
pub fn words(output: &Output) -> String {
    said(output).replace(['│', '\n'], " ").split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Names of everything in a folder.
pub fn entries(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

/// A folder with what `regen` and `derive` read and an empty place for what it writes.
pub fn repository() -> tempfile::TempDir {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let copy = tempfile::tempdir().unwrap();
    for file in [
        "codegen/graphs/uhp.json",
        "codegen/graphs/ups.json",
        "codegen/requirements.lock",
        "platforms/uhp_2016.toml",
    ] {
        let target = copy.path().join(file);
        fs::create_dir_all(target.parent().unwrap()).unwrap();
        fs::copy(root.join(file), target).unwrap();
    }
    fs::create_dir_all(copy.path().join("dyn-runtime/src/generated")).unwrap();
    copy
}
