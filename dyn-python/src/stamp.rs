//! The stamp: a file written last, so that an environment without it is unfinished.
//!
//! Virtual environments hold absolute paths and cannot be built aside and moved, so the folder is built in place and
//! stamped. The stamp also names what the environment was made from; comparing it needs no process, which is what
//! keeps later calls fast.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::time::UNIX_EPOCH;

const FILE: &str = "complete.stamp";

/// Whether `folder` holds a finished environment of this lock file, made here, whose interpreter is still the same.
pub(crate) fn is_complete(folder: &Path, lock_hash: &str) -> bool {
    let Ok(text) = fs::read_to_string(folder.join(FILE)) else { return false };
    let Some(executable) = text.lines().find_map(|line| line.strip_prefix("interpreter ")) else {
        return false;
    };
    python(folder).exists() && stamp(folder, lock_hash, Path::new(executable)).is_ok_and(|now| now == text)
}

/// Marks `folder` as finished.
pub(crate) fn write(folder: &Path, lock_hash: &str, executable: &Path) -> io::Result<()> {
    let unfinished = folder.join("unfinished.stamp");
    fs::write(&unfinished, stamp(folder, lock_hash, executable)?)?;
    fs::rename(unfinished, folder.join(FILE))
}

/// The environment's own interpreter.
pub(crate) fn python(folder: &Path) -> PathBuf {
    folder.join(if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" })
}

/// An interpreter that was replaced (a system upgrade from 3.12 to 3.13, say) has another size or time of change, and
/// the environment's packages no longer belong to it.
fn stamp(folder: &Path, lock_hash: &str, executable: &Path) -> io::Result<String> {
    let file = fs::metadata(executable)?;
    let changed = file.modified()?.duration_since(UNIX_EPOCH).map_or(0, |time| time.as_nanos());
    Ok(format!(
        "dyn-python 1\nlock {lock_hash}\nfolder {}\ninterpreter {}\nsize {} changed {changed}\n",
        folder.display(),
        executable.display(),
        file.len(),
    ))
}
