//! Files written as a whole or not at all.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// A file to be written.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct NewFile {
    /// Where.
    pub path: PathBuf,
    /// What.
    pub text: String,
}

/// Why files were not written.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
#[error("cannot write {}: {error}; the file is as it was", .path.display())]
#[diagnostic(help("{}", remedy(.path, .error)))]
pub struct WriteError {
    /// The file.
    pub path: PathBuf,
    /// What the system says.
    pub error: io::Error,
}

fn remedy(path: &Path, error: &io::Error) -> String {
    let folder = folder_of(path).display();
    match error.kind() {
        io::ErrorKind::NotFound => format!("make the folder first: mkdir -p {folder}"),
        io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem => {
            format!("choose another file, or make the folder {folder} writable")
        }
        io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => {
            format!("make room on the device of {folder}, and repeat the command")
        }
        io::ErrorKind::IsADirectory => "give the name of a file, not of a folder".into(),
        _ => format!("a new file is made beside the old one first, so the folder {folder} must be writable"),
    }
}

impl NewFile {
    /// Whether the file is already what it will be. An unreadable file is not.
    pub fn is_current(&self) -> bool {
        fs::read(&self.path).is_ok_and(|bytes| bytes == self.text.as_bytes())
    }
}

/// Replaces every file by its new text: all texts are on disk before the first file is replaced, and each is replaced in
/// one step, so an interruption leaves every file old or new and none half.
///
/// # Errors
/// The first file that cannot be written; then every file is as it was, unless it is the replacing itself that fails.
pub fn write_all(files: &[NewFile]) -> Result<(), WriteError> {
    let refused = |file: &NewFile, error: io::Error| WriteError { path: file.path.clone(), error };
    let prepare = |file| prepare(file).map_err(|error| refused(file, error));
    let prepared = files.iter().map(prepare).collect::<Result<Vec<_>, _>>()?;
    for (temporary, file) in prepared.into_iter().zip(files) {
        temporary.persist(&file.path).map_err(|error| refused(file, error.error))?;
    }
    Ok(())
}

fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    }
}

/// The text on disk, beside the file that it will replace.
fn prepare(file: &NewFile) -> io::Result<tempfile::NamedTempFile> {
    if file.path.is_dir() {
        return Err(io::Error::from(io::ErrorKind::IsADirectory));
    }
    let mut temporary = tempfile::Builder::new().prefix(".dyn-gen-").tempfile_in(folder_of(&file.path))?;
    temporary.write_all(file.text.as_bytes())?;
    temporary.as_file().sync_all()?;
    // A temporary file is private; a source file is as readable as the one it replaces, or as any new one.
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        let mode = fs::metadata(&file.path).map_or(0o644, |old| old.permissions().mode());
        fs::set_permissions(temporary.path(), fs::Permissions::from_mode(mode))?;
    }
    Ok(temporary)
}
