//! Texts of files: how they are read, where they begin, and which name a misspelt one stands for. Shared by every reader
//! of text files in this workspace.

use std::ops::Range;
use std::path::Path;

use crate::refusal::{FileError, Refusal};

/// The text of a file; `kind` stands in messages as in "cannot read the {kind} file", `help` is the remedy when there is
/// no such file.
///
/// # Errors
/// The file cannot be read or is not UTF-8; the latter with the place of the first wrong byte.
pub fn read_text(path: &Path, kind: &str, help: &str) -> Result<String, FileError> {
    let source_name = path.display().to_string();
    let bytes = std::fs::read(path).map_err(|error| {
        let what = format!("cannot read the {kind} file `{source_name}`: {error}");
        FileError::new(&source_name, "", vec![Refusal::without_place(what, help)])
    })?;
    utf8_text(&source_name, kind, bytes)
}

/// The text that these bytes of a file are.
///
/// # Errors
/// They are not UTF-8; with the place of the first wrong byte.
pub fn utf8_text(source_name: &str, kind: &str, bytes: Vec<u8>) -> Result<String, FileError> {
    String::from_utf8(bytes).map_err(|error| {
        let start = error.utf8_error().valid_up_to();
        let refusal = Refusal::new(
            start..start + char::REPLACEMENT_CHARACTER.len_utf8(),
            "not UTF-8 from here",
            format!("the {kind} file is not UTF-8 text"),
            "save it as UTF-8",
        );
        FileError::new(source_name, String::from_utf8_lossy(error.as_bytes()), vec![refusal])
    })
}

/// The first line, to point at a text as a whole.
pub fn first_line(text: &str) -> Range<usize> {
    0..text.find(['\r', '\n']).unwrap_or(text.len())
}

/// The name most like `written`, if one is near enough to be a slip of the hand.
pub fn nearest<'n>(written: &str, names: impl IntoIterator<Item = &'n str>) -> Option<&'n str> {
    names
        .into_iter()
        .map(|name| (strsim::jaro_winkler(&written.to_lowercase(), name), name))
        .filter(|(likeness, _)| *likeness > 0.85)
        .max_by(|one, other| one.0.total_cmp(&other.0))
        .map(|(_, name)| name)
}
