//! What a reader finds in a file on its way: refusals, and hints at units that are probably wrong.

use std::fmt;
use std::ops::Range;
use std::sync::Arc;

use miette::{Diagnostic, LabeledSpan, NamedSource, Severity, SourceCode};

use crate::refusal::Refusal;

/// Refusals and hints, noted rather than thrown, so that one look at a file finds every mistake.
#[derive(Default)]
pub(crate) struct Findings {
    refusals: Vec<Refusal>,
    /// A hint has the form of a refusal; its help begins with "if".
    hints: Vec<Refusal>,
    /// How many refusals there were before the platform was put together.
    before_assembly: Option<usize>,
}

impl Findings {
    /// A mistake.
    pub fn refuse(&mut self, refusal: Refusal) {
        self.refusals.push(refusal);
    }

    /// Some mistakes.
    pub fn refuse_all(&mut self, refusals: impl IntoIterator<Item = Refusal>) {
        self.refusals.extend(refusals);
    }

    /// Something that looks odd but may be meant; said once per place.
    pub fn hint(&mut self, hint: Refusal) {
        if self.hints.iter().all(|known| known.at != hint.at) {
            self.hints.push(hint);
        }
    }

    /// Single values have been read: mistakes from here on are about the platform as a whole.
    pub fn begin_assembly(&mut self) {
        self.before_assembly = Some(self.refusals.len());
    }

    /// Whether nothing was refused so far.
    pub fn is_clean(&self) -> bool {
        self.refusals.is_empty()
    }

    /// The hints, where nothing was refused.
    pub fn into_hints(mut self) -> Vec<Refusal> {
        self.hints.sort_by_key(|hint| hint.at.as_ref().map(|at| at.start));
        self.hints
    }

    /// The refusals. Hints become part of their help: a hint at the place of a refusal belongs to it, others explain the
    /// platform as a whole if that was refused, else they belong to the first refusal.
    pub fn into_refusals(mut self) -> Vec<Refusal> {
        let about_the_whole = self.before_assembly.filter(|before| *before < self.refusals.len());
        for hint in self.hints {
            let same_place = self.refusals.iter().position(|refusal| refusal.at == hint.at);
            let index = same_place.or(about_the_whole).unwrap_or(0);
            if let Some(refusal) = self.refusals.get_mut(index) {
                refusal.help = format!("{}; {}: {}", refusal.help, hint.what, hint.help);
            }
        }
        self.refusals
    }
}

/// Something in a platform file that looks odd but may be meant: most likely a wrong unit. Rendered by `miette`, it shows
/// file, line and caret, and what to write if it is a mistake.
#[derive(Debug, Clone)]
pub struct Warning {
    hint: Refusal,
    source_text: Arc<NamedSource<String>>,
}

impl Warning {
    /// The hints of the file called `source_name` with this text.
    pub(crate) fn all(source_name: &str, text: &str, hints: Vec<Refusal>) -> Vec<Self> {
        if hints.is_empty() {
            return Vec::new();
        }
        let source_text = Arc::new(NamedSource::new(source_name, text.to_owned()));
        hints.into_iter().map(|hint| Self { hint, source_text: source_text.clone() }).collect()
    }

    /// Bytes of the file that look odd.
    pub fn at(&self) -> Option<Range<usize>> {
        self.hint.at.clone()
    }
}

/// Where it was found does not matter.
impl PartialEq for Warning {
    fn eq(&self, other: &Self) -> bool {
        self.hint == other.hint
    }
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.hint.fmt(f)
    }
}

impl std::error::Error for Warning {}

impl Diagnostic for Warning {
    fn severity(&self) -> Option<Severity> {
        Some(Severity::Warning)
    }

    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.hint.help()
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        self.hint.labels()
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        Some(self.source_text.as_ref())
    }
}
