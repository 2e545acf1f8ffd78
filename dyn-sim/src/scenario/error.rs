//! Why a scenario file or a measured motion was refused: what, where (file, line, caret), remedy.

use std::fmt;
use std::ops::Range;

use dyn_platform::{PlatformError, Refusal};
use miette::{Diagnostic, NamedSource, SourceCode};

/// A refused file: every mistake found in it.
///
/// Rendered by `miette`, each mistake shows its file, line and caret, and the remedy as help.
#[derive(Debug, thiserror::Error)]
pub struct FileError {
    source_text: NamedSource<String>,
    refusals: Vec<Refusal>,
}

impl FileError {
    /// Of the file called `source_name`; `refusals` must not be empty.
    pub(crate) fn new(source_name: &str, text: impl Into<String>, mut refusals: Vec<Refusal>) -> Self {
        refusals.sort_by_key(|refusal| refusal.at.as_ref().map(|at| (at.start, at.end)));
        Self { source_text: NamedSource::new(source_name, text.into()), refusals }
    }

    /// The mistakes, in the order of the file; never empty.
    pub fn refusals(&self) -> &[Refusal] {
        &self.refusals
    }

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

    fn labels(&self) -> Option<Box<dyn Iterator<Item = miette::LabeledSpan> + '_>> {
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

/// Why there is no scenario.
#[derive(Debug, thiserror::Error, Diagnostic)]
pub enum ScenarioError {
    /// The scenario file itself, or a measured motion.
    #[error(transparent)]
    #[diagnostic(transparent)]
    File(#[from] FileError),
    /// Its platform file.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Platform(#[from] PlatformError),
}

pub(crate) fn refusal(
    at: Range<usize>,
    label: impl Into<String>,
    what: impl Into<String>,
    help: impl Into<String>,
) -> Refusal {
    Refusal { what: what.into(), at: Some(at), label: label.into(), help: help.into() }
}
