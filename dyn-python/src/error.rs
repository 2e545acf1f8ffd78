//! What can prevent a Python environment, and what to do about each.

use std::io;
use std::path::PathBuf;

/// Why an environment could not be prepared.
///
/// `Display` is the fact in one line (two failures also quote the tool's last lines); [`Error::remedy`] says what to
/// do about it.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// No candidate ran.
    #[error("no Python was found (tried {tried})")]
    PythonNotFound {
        /// The commands tried.
        tried: String,
    },
    /// Interpreters ran, all of them too old.
    #[error("Python {needed} or later is needed, found only {found}")]
    PythonTooOld {
        /// Lowest accepted version.
        needed: String,
        /// Command and version of each interpreter found.
        found: String,
    },
    /// The interpreter named by `DYN_PYTHON` cannot be used.
    #[error("DYN_PYTHON names `{program}`, which {problem}")]
    RequestedPython {
        /// Value of `DYN_PYTHON`.
        program: String,
        /// Completes the sentence.
        problem: String,
    },
    /// The interpreter lacks the standard module `venv`.
    #[error("{python} has no module `venv`")]
    VenvMissing {
        /// The interpreter.
        python: String,
    },
    /// Neither `ensurepip` nor a recent pip belongs to the interpreter.
    #[error("{python} has neither `ensurepip` nor pip 22.3 or later")]
    PipMissing {
        /// The interpreter.
        python: String,
    },
    /// `python -m venv` failed for another reason.
    #[error("the virtual environment could not be made: {said}")]
    VenvFailed {
        /// Last lines of its output.
        said: String,
    },
    /// pip could not reach the package index.
    #[error("the Python package index cannot be reached: {reason}")]
    IndexUnreachable {
        /// The reason in a few words.
        reason: String,
    },
    /// The index has no wheel that this interpreter can use.
    #[error("no wheel of {package} fits {python} on this machine")]
    NoWheel {
        /// The requirement.
        package: String,
        /// The interpreter.
        python: String,
    },
    /// A downloaded file is not the one that the lock file names.
    #[error("{package} does not have the hash that {} asks for", lock_file.display())]
    HashMismatch {
        /// The requirement.
        package: String,
        /// The lock file.
        lock_file: PathBuf,
    },
    /// pip does not accept the lock file.
    #[error("{} is not a complete lock file: {said}", lock_file.display())]
    LockFileRefused {
        /// The lock file.
        lock_file: PathBuf,
        /// pip's complaint.
        said: String,
    },
    /// The lock file cannot be read.
    #[error("{} cannot be read: {source}", lock_file.display())]
    LockFileUnreadable {
        /// The lock file.
        lock_file: PathBuf,
        /// The system's reason.
        source: io::Error,
    },
    /// pip failed for another reason.
    #[error("pip failed: {said}")]
    InstallFailed {
        /// Last lines of its output.
        said: String,
    },
    /// The folder of the environment cannot be written.
    #[error("{} cannot be written: {reason}", path.display())]
    Unwritable {
        /// The file or folder.
        path: PathBuf,
        /// The system's reason.
        reason: String,
    },
    /// No space is left.
    #[error("the disk of {} is full", path.display())]
    DiskFull {
        /// The file or folder.
        path: PathBuf,
    },
}

impl Error {
    /// Whether this machine merely lacks Python, one of its standard parts, a wheel for it or the network: the cases
    /// in which a caller with something to fall back on may go on without the environment.
    ///
    /// `false` where something is wrong (hashes, lock file, disk, a mistaken `DYN_PYTHON`): those must be seen.
    #[must_use]
    pub fn is_environment_missing(&self) -> bool {
        match self {
            Self::PythonNotFound { .. }
            | Self::PythonTooOld { .. }
            | Self::VenvMissing { .. }
            | Self::PipMissing { .. }
            | Self::IndexUnreachable { .. }
            | Self::NoWheel { .. } => true,
            Self::RequestedPython { .. }
            | Self::VenvFailed { .. }
            | Self::HashMismatch { .. }
            | Self::LockFileRefused { .. }
            | Self::LockFileUnreadable { .. }
            | Self::InstallFailed { .. }
            | Self::Unwritable { .. }
            | Self::DiskFull { .. } => false,
        }
    }

    /// What to do about it, in one line.
    #[must_use]
    pub fn remedy(&self) -> &'static str {
        match self {
            Self::PythonNotFound { .. } => {
                "install Python 3.11 or later (Debian, Ubuntu: apt-get install python3 python3-venv; macOS: brew \
                 install python; Windows: winget install Python.Python.3.13), or set DYN_PYTHON to its path"
            }
            Self::PythonTooOld { .. } => {
                "install Python 3.11 or later beside it and set DYN_PYTHON to its path (DYN_PYTHON=/path/to/python3.13)"
            }
            Self::RequestedPython { .. } => {
                "set DYN_PYTHON to the path of a Python 3.11 or later, or unset it to search PATH"
            }
            Self::VenvMissing { .. } | Self::PipMissing { .. } => {
                "install what is missing (Debian, Ubuntu: apt-get install python3-venv; Fedora: dnf install \
                 python3-pip), or set DYN_PYTHON to a complete Python"
            }
            Self::VenvFailed { .. } => {
                "repair that Python, or set DYN_PYTHON to another one; `python3 -m venv FOLDER` shows the failure alone"
            }
            Self::IndexUnreachable { .. } => {
                "connect to the network and repeat; behind a proxy set HTTPS_PROXY, with a mirror PIP_INDEX_URL, with \
                 a certificate authority of your own PIP_CERT"
            }
            Self::NoWheel { .. } => {
                "set DYN_PYTHON to a 64-bit CPython from 3.11 to 3.13 (wheels: Linux with glibc, macOS, Windows)"
            }
            Self::HashMismatch { .. } => {
                "do not use that file: repeat without mirror or cache (PIP_NO_CACHE_DIR=1), and if it stays, report it"
            }
            Self::LockFileRefused { .. } => {
                "write it anew from its requirements.in with the command in its first lines"
            }
            Self::LockFileUnreadable { .. } => "restore it (git checkout) or give the right path",
            Self::InstallFailed { .. } => {
                "repeat; if it stays, the lines above are pip's own and name what it stumbled over"
            }
            Self::Unwritable { .. } => "make it writable, or set CARGO_TARGET_DIR to a folder that is",
            Self::DiskFull { .. } => {
                "free about 1 GB there (`cargo clean` empties the target folder), or set CARGO_TARGET_DIR to a folder \
                 on another disk"
            }
        }
    }
}
