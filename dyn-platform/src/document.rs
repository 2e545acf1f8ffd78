//! Typed values out of a TOML document. Each value keeps its place in the text; what is wrong is noted, not thrown,
//! so that one look at a file finds every mistake.

use std::array;
use std::ops::Range;

use toml::Spanned;
use toml::de::{DeString, DeTable, DeValue};

use crate::checks::Fault;
use crate::findings::Findings;
use crate::keys::{self, Home, Key};
use crate::legs;
use crate::platform::LegType;
use crate::refusal::Refusal;
use crate::text::nearest;
use crate::units;

/// No quantity of a platform comes near this; products of a few such numbers still cannot overflow.
const LARGEST: f64 = 1e30;

/// What became of a key.
#[derive(Clone)]
pub(crate) enum Reading<T> {
    /// It is not in the table.
    Absent,
    /// It is there, but a refusal has been noted.
    Refused,
    /// It is there and passed its checks.
    Present(Spanned<T>),
}

impl<T> Reading<T> {
    /// The value, if there is a good one.
    pub fn present(self) -> Option<Spanned<T>> {
        match self {
            Self::Present(value) => Some(value),
            Self::Absent | Self::Refused => None,
        }
    }
}

/// A table of the file with its place and its name in messages.
pub(crate) struct Section<'d> {
    /// As in "`rod_mass_kg` is missing in {title}".
    pub title: String,
    /// The table's header.
    pub header: Range<usize>,
    table: &'d DeTable<'d>,
    allowed: Vec<&'static Key>,
    /// How the legs of this file are built, once that is known.
    leg_type: Option<LegType>,
}

impl<'d> Section<'d> {
    /// The file itself. Its unknown keys are refused by [`Section::of_leg_type`].
    pub fn file(header: Range<usize>, table: &'d DeTable<'d>) -> Self {
        Self { title: "the file".into(), header, table, allowed: keys::FILE.keys.to_vec(), leg_type: None }
    }

    /// The file whose legs are known to be of this type, or of no known one: tells where unknown keys belong.
    pub fn of_leg_type(mut self, leg_type: Option<LegType>, findings: &mut Findings) -> Self {
        self.leg_type = leg_type;
        self.refuse_unknown(findings);
        self
    }

    /// A table of this file in which the keys of `allowed` may stand; every other key is refused here.
    fn inner(
        &self,
        title: String,
        header: Range<usize>,
        table: &'d DeTable<'d>,
        allowed: &[&'static Key],
        findings: &mut Findings,
    ) -> Self {
        let section = Self { title, header, table, allowed: allowed.to_vec(), leg_type: self.leg_type };
        section.refuse_unknown(findings);
        section
    }

    /// How the legs of this file are built, if that is known.
    pub fn leg_type(&self) -> Option<LegType> {
        self.leg_type
    }

    /// Where the key itself stands.
    pub fn key_span(&self, key: &Key) -> Option<Range<usize>> {
        self.table.get_key_value(key.name).map(|(name, _)| name.span())
    }

    /// Refuses every key that is not allowed: it stands in the wrong table, is misspelt, or means nothing.
    fn refuse_unknown(&self, findings: &mut Findings) {
        findings.refuse_all(self.unknown().map(|name| self.unknown_key(name.span(), name.get_ref())));
    }

    fn unknown_key(&self, at: Range<usize>, written: &str) -> Refusal {
        let what = format!("unknown key `{written}` in {}", self.title);
        let help = match (keys::home_of(written, self.leg_type), self.meant_by(written)) {
            (Some(Home::Table(table)), _) => format!("`{written}` belongs in {table}"),
            (Some(Home::OtherLegType(other)), _) => return self.key_of_other_legs(at, written, other),
            (None, Some(nearest)) => format!("did you mean `{nearest}`?"),
            (None, None) => format!("keys known here: {}", listed(&self.allowed)),
        };
        Refusal::new(at, "unknown key", what, help)
    }

    fn key_of_other_legs(&self, at: Range<usize>, written: &str, other: LegType) -> Refusal {
        let these = self.leg_type.map_or("others", LegType::name);
        let what = format!(
            "`{written}` belongs to legs of type {:?}, but the legs of this file are {these:?}",
            other.name()
        );
        let own: Vec<&Key> =
            legs::kinds(self.leg_type).flat_map(|kind| kind.shared()).map(|property| &property.key).collect();
        let help = format!(
            "remove it, or write `leg_type = {:?}`; legs {these:?} have {}",
            other.name(),
            listed(&own)
        );
        Refusal::new(at, format!("of legs {:?}", other.name()), what, help)
    }

    fn unknown(&self) -> impl Iterator<Item = &'d Spanned<DeString<'d>>> {
        self.table.keys().filter(|name| self.allowed.iter().all(|key| key.name != name.get_ref().as_ref()))
    }

    /// The allowed key that an unknown one seems to stand for.
    fn meant_by(&self, written: &str) -> Option<&'static str> {
        nearest(written, self.allowed.iter().map(|key| key.name))
    }

    /// Whether an unknown key has already been taken for this one, so that its absence needs no second refusal.
    pub fn has_misspelt(&self, key: &Key) -> bool {
        self.unknown().any(|name| self.meant_by(name.get_ref()) == Some(key.name))
    }

    /// Reads a key that may be absent.
    pub fn read<T: FromToml, U>(
        &self,
        key: &Key,
        check: impl Fn(T, &Key) -> Result<U, Fault>,
        findings: &mut Findings,
    ) -> Reading<U> {
        let Some(value) = self.table.get(key.name) else {
            return Reading::Absent;
        };
        let checked = T::from_toml(value, key).and_then(|raw| {
            let hint = units::too_large(&raw.numbers(), value.span(), key);
            let fault = |fault: Fault| Refusal::new(value.span(), fault.label, fault.what, fault.help);
            check(raw, key).map(|good| (good, hint)).map_err(fault)
        });
        match checked {
            Ok((good, hint)) => {
                hint.into_iter().for_each(|hint| findings.hint(hint));
                Reading::Present(Spanned::new(value.span(), good))
            }
            Err(refusal) => {
                findings.refuse(refusal);
                Reading::Refused
            }
        }
    }

    /// Reads a key that must be there.
    pub fn require<T: FromToml, U>(
        &self,
        key: &Key,
        check: impl Fn(T, &Key) -> Result<U, Fault>,
        findings: &mut Findings,
    ) -> Option<Spanned<U>> {
        let reading = self.read(key, check, findings);
        if matches!(reading, Reading::Absent) && !self.has_misspelt(key) {
            findings.refuse(self.missing(key));
        }
        reading.present()
    }

    /// The refusal for an absent key.
    pub fn missing(&self, key: &Key) -> Refusal {
        let what = format!("`{}` is missing in {}", key.name, self.title);
        Refusal::new(self.header.clone(), format!("no `{}` here", key.name), what, key.remedy())
    }

    /// The table under `key`, if it is there.
    pub fn section(
        &self,
        key: &Key,
        allowed: &[&'static Key],
        findings: &mut Findings,
    ) -> Option<Section<'d>> {
        let value = self.table.get(key.name)?;
        match value.get_ref() {
            DeValue::Table(table) => {
                Some(self.inner(format!("[{}]", key.name), value.span(), table, allowed, findings))
            }
            other => {
                findings.refuse(wrong_type(value.span(), key, "a table", other));
                None
            }
        }
    }

    /// The table under `key`, which must be there.
    pub fn require_section(
        &self,
        key: &Key,
        allowed: &[&'static Key],
        findings: &mut Findings,
    ) -> Option<Section<'d>> {
        if self.key_span(key).is_none() && !self.has_misspelt(key) {
            findings.refuse(self.missing_section(key));
        }
        self.section(key, allowed, findings)
    }

    /// The refusal for an absent table.
    pub fn missing_section(&self, key: &Key) -> Refusal {
        Refusal::new(
            self.header.clone(),
            format!("no [{}] in this file", key.name),
            format!("[{}] is missing", key.name),
            format!("add the table [{}]; docs/platform-file.md lists its keys", key.name),
        )
    }

    /// The tables of the array of tables under `key`, if it is there, each with this title at first.
    pub fn sections(
        &self,
        title: &str,
        key: &Key,
        allowed: &[&'static Key],
        findings: &mut Findings,
    ) -> Option<Vec<Section<'d>>> {
        let value = self.table.get(key.name)?;
        let DeValue::Array(entries) = value.get_ref() else {
            findings.refuse(wrong_type(value.span(), key, "an array of tables", value.get_ref()));
            return None;
        };
        let mut sections = Vec::new();
        for entry in entries.iter() {
            match entry.get_ref() {
                DeValue::Table(table) => {
                    sections.push(self.inner(title.to_owned(), entry.span(), table, allowed, findings));
                }
                other => findings.refuse(wrong_type(entry.span(), key, "a table", other)),
            }
        }
        Some(sections)
    }
}

fn listed(keys: &[&Key]) -> String {
    let names: Vec<&str> = keys.iter().map(|key| key.name).collect();
    names.join(", ")
}

/// A type that can stand in the file.
pub(crate) trait FromToml: Sized {
    /// The numbers in it.
    fn numbers(&self) -> Vec<f64> {
        Vec::new()
    }
    /// One of it, in words.
    fn one() -> String;
    /// Several of it, in words.
    fn several() -> String;
    /// Reads it; a refusal points at the innermost value that is wrong.
    fn from_toml(value: &Spanned<DeValue<'_>>, key: &Key) -> Result<Self, Refusal>;
}

impl FromToml for String {
    fn one() -> String {
        "a text in quotes".into()
    }

    fn several() -> String {
        "texts in quotes".into()
    }

    fn from_toml(value: &Spanned<DeValue<'_>>, key: &Key) -> Result<Self, Refusal> {
        match value.get_ref() {
            DeValue::String(text) => Ok(text.to_string()),
            other => Err(wrong_type(value.span(), key, &Self::one(), other)),
        }
    }
}

impl FromToml for i64 {
    fn one() -> String {
        "a whole number".into()
    }

    fn several() -> String {
        "whole numbers".into()
    }

    fn from_toml(value: &Spanned<DeValue<'_>>, key: &Key) -> Result<Self, Refusal> {
        let DeValue::Integer(digits) = value.get_ref() else {
            return Err(wrong_type(value.span(), key, &Self::one(), value.get_ref()));
        };
        Self::from_str_radix(digits.as_str(), digits.radix()).map_err(|_| {
            let what = format!("`{}` needs a whole number of ordinary size", key.name);
            Refusal::new(value.span(), "too large", what, key.remedy())
        })
    }
}

impl FromToml for f64 {
    fn numbers(&self) -> Vec<f64> {
        vec![*self]
    }

    fn one() -> String {
        "a number".into()
    }

    fn several() -> String {
        "numbers".into()
    }

    fn from_toml(value: &Spanned<DeValue<'_>>, key: &Key) -> Result<Self, Refusal> {
        let number: Option<f64> = match value.get_ref() {
            DeValue::Float(digits) => digits.as_str().parse().ok(),
            DeValue::Integer(digits) if digits.radix() == 10 => digits.as_str().parse().ok(),
            DeValue::Integer(digits) => {
                i64::from_str_radix(digits.as_str(), digits.radix()).ok().map(|number| number as f64)
            }
            other => return Err(wrong_type(value.span(), key, &Self::one(), other)),
        };
        match number {
            Some(number) if number.abs() <= LARGEST => Ok(number),
            _ => {
                let what = format!("`{}` needs finite numbers, none beyond {LARGEST:e}", key.name);
                Err(Refusal::new(value.span(), "not such a number", what, key.remedy()))
            }
        }
    }
}

impl<T: FromToml, const N: usize> FromToml for [T; N] {
    fn numbers(&self) -> Vec<f64> {
        self.iter().flat_map(T::numbers).collect()
    }

    fn one() -> String {
        format!("an array of {N} {}", T::several())
    }

    fn several() -> String {
        format!("arrays of {N} {}", T::several())
    }

    fn from_toml(value: &Spanned<DeValue<'_>>, key: &Key) -> Result<Self, Refusal> {
        let DeValue::Array(entries) = value.get_ref() else {
            return Err(wrong_type(value.span(), key, &Self::one(), value.get_ref()));
        };
        if entries.len() != N {
            let found = format!("an array of {}", entries.len());
            return Err(unexpected(value.span(), key, &Self::one(), &found));
        }
        let read = entries.iter().map(|entry| T::from_toml(entry, key)).collect::<Result<Vec<T>, _>>()?;
        let mut read = read.into_iter();
        // The length was compared above, so no entry is short.
        Ok(array::from_fn(|_| read.next().expect("N entries")))
    }
}

fn wrong_type(at: Range<usize>, key: &Key, expected: &str, found: &DeValue<'_>) -> Refusal {
    let found = match found {
        DeValue::String(_) => "a text in quotes",
        DeValue::Integer(_) => "a whole number",
        DeValue::Float(_) => "a decimal number",
        DeValue::Boolean(_) => "true or false",
        DeValue::Datetime(_) => "a date or time",
        DeValue::Array(_) => "an array",
        DeValue::Table(_) => "a table",
    };
    unexpected(at, key, expected, found)
}

fn unexpected(at: Range<usize>, key: &Key, expected: &str, found: &str) -> Refusal {
    let what = format!("`{}` needs {expected}, found {found}", key.name);
    Refusal::new(at, format!("found {found}"), what, key.remedy())
}
