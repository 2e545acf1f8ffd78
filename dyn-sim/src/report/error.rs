//! Why a report could not be written: each error names the path and a remedy.

use std::io;
use std::path::PathBuf;

use miette::Diagnostic;

/// A report that could not be written. Nothing of it stays on disk, and an earlier report is left as it was.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// The path ends in `..` or is the root: there is no name for a folder in it.
    #[error("`{path}` does not name a folder that could be created")]
    NoName {
        /// The path as given.
        path: PathBuf,
    },
    /// Something that is not a report stands where the report is to go.
    #[error("`{path}` is in the way: it exists and is not a report of dyn-sim (it has `{found}`)")]
    Occupied {
        /// Where the report was to go.
        path: PathBuf,
        /// What gives it away.
        found: PathBuf,
    },
    /// A folder cannot be created or read.
    #[error("cannot create the folder `{path}`")]
    Folder {
        /// The folder.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// A file cannot be written to its end.
    #[error("cannot write `{path}`")]
    File {
        /// The file, under the report's final name.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// The finished report cannot be given its name.
    #[error("cannot move the finished report to `{path}`")]
    Publish {
        /// The final name.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
}

impl Diagnostic for ReportError {
    fn help<'a>(&'a self) -> Option<Box<dyn std::fmt::Display + 'a>> {
        let remedy = match self {
            Self::NoName { .. } => "give the report a folder of its own, such as `report/published`",
            Self::Occupied { .. } => "choose another folder, or move that one away",
            Self::Folder { source, .. } | Self::File { source, .. } | Self::Publish { source, .. } => {
                match source.kind() {
                    io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => {
                        "the disk is full: free some space or choose a folder on another disk"
                    }
                    io::ErrorKind::FileTooLarge => {
                        "files may not become that large here: raise the limit (`ulimit -f`) or choose another disk"
                    }
                    io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem => {
                        "choose a folder that you may write to"
                    }
                    _ => "check that the path leads through folders only, and choose another one if need be",
                }
            }
        };
        Some(Box::new(remedy))
    }
}
