//! Versions of the format: what to do with a file of another one.

use crate::checks::Fault;
use crate::keys::Key;
use crate::platform::VERSION;

/// A version before today's.
struct Older {
    version: i64,
    /// What is different since.
    changed: &'static str,
    /// How a file is brought into today's form.
    migrate: &'static str,
}

/// Every version before today's, the latest first. A change of the format that breaks files adds a row.
const OLDER: [Older; 1] = [Older {
    version: 0,
    changed: "drafts from before the format was fixed, without settled names and units",
    migrate: "bring the keys into the form of docs/platform-file.md, in SI units",
}];

/// Refuses every version but today's.
pub(crate) fn today(version: i64, key: &Key) -> Result<i64, Fault> {
    if version == i64::from(VERSION) {
        return Ok(version);
    }
    let label = format!("must be {VERSION}");
    if version > i64::from(VERSION) {
        let what = format!(
            "the file has format version {version}, newer than version {VERSION}, the newest that this program knows"
        );
        return Err(Fault::new(label, what, "install a newer dyn-gen"));
    }
    match OLDER.iter().find(|older| older.version == version) {
        Some(Older { changed, migrate, .. }) => {
            let what =
                format!("the file has format version {version}, older than version {VERSION} ({changed})");
            Err(Fault::new(label, what, format!("{migrate}, then write `{}`", key.example)))
        }
        None => {
            let what = format!("there is no format version {version}");
            Err(Fault::new(label, what, key.remedy()))
        }
    }
}
