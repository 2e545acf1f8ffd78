//! Why a file was refused: what is wrong, where (file, line, caret), and what to do about it. Shared by every reader of
//! text files in this workspace.

use std::fmt;
use std::ops::Range;

use miette::{Diagnostic, LabeledSpan, NamedSource, SourceCode};

/// One mistake in a file.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{what}")]
pub struct Refusal {
    /// What is wrong, in one sentence.
    pub what: String,
    /// Bytes of the file that are wrong; absent when the file could not be read at all.
    pub at: Option<Range<usize>>,
    /// The few words under the caret.
    pub label: String,
    /// What to do about it.
    pub help: String,
}

impl Refusal {
    /// A mistake at some bytes of the file.
    pub fn new(
        at: Range<usize>,
        label: impl Into<String>,
        what: impl Into<String>,
        help: impl Into<String>,
    ) -> Self {
        Self { what: what.into(), at: Some(at), label: label.into(), help: help.into() }
    }

    /// A mistake that has no place in a text: there is none to be read.
    pub fn without_place(what: impl Into<String>, help: impl Into<String>) -> Self {
        Self { what: what.into(), at: None, label: String::new(), help: help.into() }
    }
}

impl Diagnostic for Refusal {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        Some(Box::new(&self.help))
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let at = self.at.clone()?;
        Some(Box::new(std::iter::once(LabeledSpan::new_primary_with_span(Some(self.label.clone()), at))))
    }
}

/// A refused file: every mistake found in it, in the order of the file.
///
/// Rendered by `miette`, each mistake shows its file, line and caret, and the remedy as help.
#[derive(Debug, thiserror::Error)]
pub struct FileError {
    source_text: NamedSource<String>,
    refusals: Vec<Refusal>,
}

impl FileError {
    /// Of the file called `source_name` with this text; `refusals` must not be empty.
    pub fn new(source_name: &str, text: impl Into<String>, mut refusals: Vec<Refusal>) -> Self {
        refusals.sort_by_key(|refusal| refusal.at.as_ref().map(|at| (at.start, at.end)));
        Self { source_text: NamedSource::new(source_name, text.into()), refusals }
    }

    /// The mistakes, in the order of the file; never empty.
    pub fn refusals(&self) -> &[Refusal] {
        &self.refusals
    }

    /// The mistake itself when there is exactly one.
    fn only(&self) -> Option<&Refusal> {
        match self.refusals.as_slice() {
            [refusal] => Some(refusal),
            _ => None,
        }
    }
}

impl fmt::Display for FileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.only() {
            Some(refusal) => refusal.fmt(f),
            None => write!(f, "{}: {} mistakes", self.source_text.name(), self.refusals.len()),
        }
    }
}

impl Diagnostic for FileError {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.only().and_then(Diagnostic::help)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        self.only().and_then(Diagnostic::labels)
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        Some(&self.source_text)
    }

    fn related<'a>(&'a self) -> Option<Box<dyn Iterator<Item = &'a dyn Diagnostic> + 'a>> {
        match self.only() {
            Some(_) => None,
            None => Some(Box::new(self.refusals.iter().map(|refusal| refusal as &dyn Diagnostic))),
        }
    }
}
