//! Environments: where they live, when they are made, how they are run.

use std::env;
use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};
use std::process::Command;

use sha2::{Digest, Sha256};

use crate::error::Error;
use crate::install;
use crate::interpreter::Search;
use crate::process;
use crate::progress::Progress;
use crate::stamp;

/// What an environment is made from.
#[derive(Clone, Copy, Debug)]
pub struct Recipe<'a> {
    /// Short name, part of the folder's name and of messages.
    pub name: &'a str,
    /// pip requirements with exact versions and hashes, complete: what it does not list is not installed.
    pub lock_file: &'a Path,
    /// Environments live in its subfolder `python`; see [`target_directory`].
    pub target_directory: &'a Path,
}

/// A Python environment, ready to run.
#[derive(Clone, Debug)]
pub struct Environment {
    folder: PathBuf,
}

impl Environment {
    /// The environment of `recipe`, made now if there is none for this lock file yet.
    ///
    /// It lies in `<target directory>/python/<name>-<hash>`, the hash being that of the lock file and of
    /// `DYN_PYTHON`. It is made again where its making was interrupted, where its interpreter has changed since and
    /// where the folder was moved. Two processes may call at once: one works, the other waits. Prints progress on
    /// standard error while it works, nothing when there is nothing to do.
    ///
    /// The interpreter is `DYN_PYTHON` where that is set, otherwise the first of `python3`, `python3.13` to
    /// `python3.11`, `python` (Windows: also `py -3`) that is at least 3.11.
    ///
    /// # Errors
    /// See [`Error`]; each has a [`remedy`](Error::remedy). A failure leaves no environment behind.
    pub fn prepare(recipe: &Recipe<'_>) -> Result<Self, Error> {
        Self::prepare_with(recipe, &Search::from_environment())
    }

    pub(crate) fn prepare_with(recipe: &Recipe<'_>, search: &Search) -> Result<Self, Error> {
        let lock_hash = lock_hash(recipe.lock_file, search)?;
        let parent = recipe.target_directory.join("python");
        let parent = std::path::absolute(&parent).map_err(|error| unwritable(&parent, &error))?;
        let folder = parent.join(format!("{}-{}", recipe.name, &lock_hash[..12]));
        let environment = Self { folder };
        let folder = &environment.folder;
        if stamp::is_complete(folder, &lock_hash) {
            return Ok(environment);
        }

        fs::create_dir_all(&parent).map_err(|error| unwritable(&parent, &error))?;
        let _guard = wait_for_lock(&folder.with_extension("lock"), recipe.name)?;
        // The process that held the lock may have made it.
        if stamp::is_complete(folder, &lock_hash) {
            return Ok(environment);
        }
        let python = search.find()?;
        remove(folder).map_err(|error| unwritable(folder, &error))?;
        let progress = Progress::start(&format!("Python environment `{}`: {python}, once", recipe.name));
        let made = install::create(folder, &python)
            .and_then(|installer| {
                install::fill(folder, recipe.lock_file, &python, &installer, |line| progress.detail(line))
            })
            .and_then(|()| {
                stamp::write(folder, &lock_hash, &python.executable)
                    .map_err(|error| unwritable(folder, &error))
            });
        if let Err(error) = made {
            // The failure is what matters; what cannot be removed now is removed by the next attempt.
            let _ = remove(folder);
            return Err(error);
        }
        progress.finish(&format!("Python environment `{}` is ready", recipe.name));
        Ok(environment)
    }

    /// The environment's interpreter.
    #[must_use]
    pub fn python(&self) -> PathBuf {
        stamp::python(&self.folder)
    }

    /// The environment's folder.
    #[must_use]
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// A command that runs the interpreter: the caller's `PYTHON*` variables are gone, hashes have a fixed order, text
    /// is UTF-8, and no `__pycache__` is left in source folders. The working folder is importable (`-m package`).
    #[must_use]
    pub fn command(&self) -> Command {
        let mut command = Command::new(self.python());
        process::isolate(&mut command);
        command.env("PYTHONDONTWRITEBYTECODE", "1");
        command
    }
}

/// Cargo's target folder: `CARGO_TARGET_DIR`, or `target` in the workspace.
#[must_use]
pub fn target_directory(workspace: &Path) -> PathBuf {
    match env::var_os("CARGO_TARGET_DIR").filter(|value| !value.is_empty()) {
        Some(folder) => folder.into(),
        None => workspace.join("target"),
    }
}

/// Identity of an environment. Line ends do not count: git may change them on checkout.
fn lock_hash(lock_file: &Path, search: &Search) -> Result<String, Error> {
    let text = fs::read_to_string(lock_file)
        .map_err(|source| Error::LockFileUnreadable { lock_file: lock_file.to_owned(), source })?;
    let mut hash = Sha256::new();
    hash.update(text.replace("\r\n", "\n"));
    if let Some(requested) = &search.requested {
        hash.update(requested.as_encoded_bytes());
    }
    Ok(hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect())
}

/// Held until dropped; the system releases it when a process dies.
fn wait_for_lock(path: &Path, name: &str) -> Result<File, Error> {
    let file = File::create(path).map_err(|error| unwritable(path, &error))?;
    let result = match file.try_lock() {
        Err(TryLockError::WouldBlock) => {
            eprintln!("Python environment `{name}`: another process is making it, waiting ...");
            file.lock()
        }
        Err(TryLockError::Error(error)) => Err(error),
        Ok(()) => Ok(()),
    };
    match result {
        // Some network file systems have no locks: then there is nothing to wait for.
        Err(error) if error.kind() != io::ErrorKind::Unsupported => Err(unwritable(path, &error)),
        _ => Ok(file),
    }
}

fn remove(folder: &Path) -> io::Result<()> {
    match fs::remove_dir_all(folder) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(()),
        result => result,
    }
}

fn unwritable(path: &Path, error: &io::Error) -> Error {
    let path = path.to_owned();
    if error.kind() == io::ErrorKind::StorageFull {
        Error::DiskFull { path }
    } else {
        Error::Unwritable { path, reason: error.to_string() }
    }
}
