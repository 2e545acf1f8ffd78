//! A folder that appears under its name only when it is complete.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use super::error::ReportError;

/// The file that marks a folder as a report, and the text in it that does so.
pub(super) const MARKER_FILE: &str = "index.html";
pub(super) const MARKER: &str = "<meta name=\"generator\" content=\"dyn-sim\">";
/// What a report holds at its top; anything else is the user's and is not overwritten.
const OWN_ENTRIES: [&str; 4] = [MARKER_FILE, "csv", "svg", TABLES];
/// The tables for programs, which a scenario may ask for without a report.
pub(super) const TABLES: &str = "tables.json";

/// A folder under construction beside its destination. Dropped before [`StagedFolder::publish`], it is removed.
pub(super) struct StagedFolder {
    destination: PathBuf,
    staging: PathBuf,
}

impl StagedFolder {
    /// Creates the folder beside `destination`, and the folders that lead there.
    pub(super) fn new(destination: &Path) -> Result<Self, ReportError> {
        let no_name = || ReportError::NoName { path: destination.to_owned() };
        let destination = std::path::absolute(destination).map_err(|_| no_name())?;
        let (Some(parent), Some(name)) = (destination.parent(), destination.file_name()) else {
            return Err(no_name());
        };
        refuse_foreign(&destination)?;
        create(parent)?;
        let staging = sibling(parent, name, "partial");
        if staging.exists() {
            // Left by a killed process that had the same number.
            fs::remove_dir_all(&staging)
                .map_err(|source| ReportError::Folder { path: staging.clone(), source })?;
        }
        // The user asked for the destination: the message names that.
        fs::create_dir(&staging)
            .map_err(|source| ReportError::Folder { path: destination.clone(), source })?;
        Ok(Self { destination, staging })
    }

    /// Writes the file `relative`, for instance `csv/base.csv`.
    pub(super) fn write(
        &self,
        relative: &str,
        contents: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<PathBuf, ReportError> {
        let path = self.staging.join(relative);
        if let Some(folder) = path.parent() {
            create(folder)?;
        }
        let final_path = self.destination.join(relative);
        match write_file(&path, contents) {
            Ok(()) => Ok(final_path),
            Err(source) => Err(ReportError::File { path: final_path, source }),
        }
    }

    /// Gives the folder its name; an earlier report of that name is replaced, or kept if that fails.
    pub(super) fn publish(self) -> Result<PathBuf, ReportError> {
        let destination = self.destination.clone();
        let failed = |source| ReportError::Publish { path: destination.clone(), source };
        refuse_foreign(&destination)?;
        if !destination.exists() {
            fs::rename(&self.staging, &destination).map_err(failed)?;
            return Ok(destination);
        }
        let (Some(parent), Some(name)) = (destination.parent(), destination.file_name()) else {
            return Err(ReportError::NoName { path: destination.clone() });
        };
        let previous = sibling(parent, name, "previous");
        fs::rename(&destination, &previous).map_err(failed)?;
        if let Err(source) = fs::rename(&self.staging, &destination) {
            fs::rename(&previous, &destination).map_err(failed)?;
            return Err(failed(source));
        }
        // The new report stands; a previous one that cannot be removed takes room but does no harm.
        let _ = fs::remove_dir_all(&previous);
        Ok(destination)
    }
}

impl Drop for StagedFolder {
    fn drop(&mut self) {
        // Gone already after publishing; otherwise nothing half-written stays.
        let _ = fs::remove_dir_all(&self.staging);
    }
}

/// Writes a file to its end, so that a full disk shows here and not later.
fn write_file(path: &Path, contents: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    let mut file = BufWriter::with_capacity(1 << 16, File::create(path)?);
    contents(&mut file)?;
    file.flush()
}

fn create(folder: &Path) -> Result<(), ReportError> {
    fs::create_dir_all(folder).map_err(|source| ReportError::Folder { path: folder.to_owned(), source })
}

/// `.name.kind-process` in `parent`: hidden, and another one for each process.
fn sibling(parent: &Path, name: &std::ffi::OsStr, kind: &str) -> PathBuf {
    let mut hidden = std::ffi::OsString::from(".");
    hidden.push(name);
    hidden.push(format!(".{kind}-{}", std::process::id()));
    parent.join(hidden)
}

/// Refuses a destination that holds anything but an earlier report.
fn refuse_foreign(destination: &Path) -> Result<(), ReportError> {
    let occupied = |found: PathBuf| ReportError::Occupied { path: destination.to_owned(), found };
    if !destination.exists() {
        return Ok(());
    }
    if !destination.is_dir() {
        return Err(occupied(destination.to_owned()));
    }
    let unreadable = |source| ReportError::Folder { path: destination.to_owned(), source };
    let mut may_be_foreign = false;
    for entry in fs::read_dir(destination).map_err(unreadable)? {
        let entry = entry.map_err(unreadable)?;
        may_be_foreign |= entry.file_name() != TABLES;
        if !OWN_ENTRIES.iter().any(|&own| entry.file_name() == own) {
            return Err(occupied(entry.path()));
        }
    }
    let marker = destination.join(MARKER_FILE);
    let is_report = || fs::read_to_string(&marker).is_ok_and(|page| page.contains(MARKER));
    if may_be_foreign && !is_report() { Err(occupied(marker)) } else { Ok(()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_full_disk_is_noticed_while_writing() {
        let device = Path::new("/dev/full");
        if !device.exists() {
            return;
        }
        let error = write_file(device, |out| out.write_all(b"one line\n")).expect_err("the device is full");
        assert_eq!(error.kind(), io::ErrorKind::StorageFull);
    }

    #[test]
    fn a_failure_half_way_leaves_nothing() {
        let parent = tempfile::tempdir().expect("temporary folder");
        let destination = parent.path().join("report");
        let staged = StagedFolder::new(&destination).expect("writable");
        staged.write("csv/base.csv", |out| out.write_all(b"time_s\n")).expect("writable");
        let error = staged
            .write("csv/target.csv", |_| Err(io::ErrorKind::StorageFull.into()))
            .expect_err("the writer failed");
        assert!(matches!(&error, ReportError::File { path, .. } if path.ends_with("report/csv/target.csv")));
        let help = miette::Diagnostic::help(&error).expect("a remedy").to_string();
        assert!(help.contains("disk is full"), "{help}");
        drop(staged);
        assert_eq!(fs::read_dir(parent.path()).expect("readable").count(), 0);
    }

    #[test]
    fn only_an_earlier_report_is_replaced() {
        let parent = tempfile::tempdir().expect("temporary folder");
        let destination = parent.path().join("report");
        for text in ["first", "second"] {
            let staged = StagedFolder::new(&destination).expect("writable");
            staged.write(MARKER_FILE, |out| write!(out, "{MARKER}{text}")).expect("writable");
            staged.publish().expect("published");
            fs::write(destination.join(TABLES), "{}").expect("writable");
        }
        let page = fs::read_to_string(destination.join(MARKER_FILE)).expect("readable");
        assert!(page.ends_with("second"));
        assert_eq!(fs::read_dir(parent.path()).expect("readable").count(), 1);

        fs::write(destination.join("notes.txt"), "mine").expect("writable");
        let error = StagedFolder::new(&destination).err().expect("notes are in the way");
        assert!(matches!(error, ReportError::Occupied { found, .. } if found.ends_with("notes.txt")));

        let foreign = parent.path().join("foreign");
        fs::create_dir(&foreign).expect("writable");
        fs::write(foreign.join(MARKER_FILE), "<html>my page</html>").expect("writable");
        assert!(matches!(StagedFolder::new(&foreign), Err(ReportError::Occupied { .. })));
    }

    #[test]
    fn a_path_without_a_name_is_refused() {
        assert!(matches!(StagedFolder::new(Path::new("/")), Err(ReportError::NoName { .. })));
    }
}
