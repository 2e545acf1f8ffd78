//! Whatever stands in a file, the reader neither panics nor hangs: it gives a platform of finite numbers, or mistakes that
//! can be shown.
//!
//! `cargo test` takes a few thousand inputs. The longer run, whose figures are in `docs/platform-file.md`:
//!
//! ```text
//! BOLERO_RANDOM_ITERATIONS=1000000 cargo test --release -p dyn-platform --test fuzz -- --nocapture
//! ```

use std::time::{Duration, Instant};

use bolero::{TypeGenerator, check};
use dyn_platform::{FileError, Platform, Starter, starter, utf8_text};
use miette::{Diagnostic, GraphicalReportHandler, GraphicalTheme};

/// Inputs of each kind in an ordinary run.
const FEW: usize = 3000;

/// Longest time for one input; the slowest so far took 0.08 s.
const PATIENCE: Duration = Duration::from_secs(2);

/// Files to spoil: with the starters every table and both leg types occur, with the last one every optional key.
fn files() -> Vec<String> {
    let everything = starter(Starter::Paper).replace("#~ ", "");
    let payload = everything.find("\n[payload]").expect("a payload");
    let parts = everything.find("\n[[payload.part]]").expect("a part");
    let with_parts = everything[..payload].to_owned() + &everything[parts..];
    Starter::ALL.map(|which| starter(which).to_owned()).into_iter().chain([with_parts]).collect()
}

/// Values that break arithmetic, types or syntax.
const VALUES: [&str; 20] = [
    "0",
    "-0.0",
    "-1",
    "1e-300",
    "1e30",
    "1e31",
    "1e300",
    "nan",
    "inf",
    "0x10",
    "true",
    "\"text\"",
    "[]",
    "{}",
    "2016-11-01",
    "[0, 0, 0]",
    "[1e30, -1e30, 1e30]",
    "[[0, 0, 0], [0, 0, 0], [0, 0, 0]]",
    "180.0",
    "\"ups\"",
];

/// One change of a file; numbers are taken modulo what there is.
#[derive(Debug, TypeGenerator)]
enum Edit {
    /// Another value behind the key of a line.
    Value { line: u16, value: u8 },
    /// A number instead of one that stands somewhere.
    Number { number: u16, value: i16, exponent: i8 },
    /// A line less.
    Without { line: u16 },
    /// A line of this file at another place.
    Copy { from: u16, to: u16 },
    /// The end cut off.
    Cut { at: u16 },
    /// A byte changed.
    Byte { at: u16, byte: u8 },
}

impl Edit {
    fn apply(&self, text: &[u8]) -> Vec<u8> {
        let mut lines: Vec<Vec<u8>> = text.split(|byte| *byte == b'\n').map(<[u8]>::to_vec).collect();
        let count = lines.len();
        match *self {
            Self::Value { line, value } => {
                let line = &mut lines[usize::from(line) % count];
                if let Some(equals) = line.iter().position(|byte| *byte == b'=') {
                    line.truncate(equals + 1);
                    line.extend_from_slice(VALUES[usize::from(value) % VALUES.len()].as_bytes());
                }
            }
            Self::Number { number, value, exponent } => {
                let is_part = |byte: &u8| byte.is_ascii_digit() || *byte == b'.';
                let starts: Vec<usize> =
                    (1..text.len()).filter(|&at| is_part(&text[at]) && !is_part(&text[at - 1])).collect();
                if !starts.is_empty() {
                    let start = starts[usize::from(number) % starts.len()];
                    let length = text[start..].iter().take_while(|byte| is_part(byte)).count();
                    let other = format!("{value}e{}", exponent % 16);
                    return [&text[..start], other.as_bytes(), &text[start + length..]].concat();
                }
            }
            Self::Without { line } => drop(lines.remove(usize::from(line) % count)),
            Self::Copy { from, to } => {
                let line = lines[usize::from(from) % count].clone();
                lines.insert(usize::from(to) % count, line);
            }
            Self::Cut { at } => return text[..usize::from(at) % (text.len() + 1)].to_vec(),
            Self::Byte { at, byte } => {
                let mut text = text.to_vec();
                if !text.is_empty() {
                    let at = usize::from(at) % text.len();
                    text[at] = byte;
                }
                return text;
            }
        }
        lines.join(&b'\n')
    }
}

/// What became of the inputs.
#[derive(Default)]
struct Tally {
    accepted: usize,
    refused: usize,
    warned: usize,
    slowest: Duration,
}

impl Tally {
    fn take(&mut self, bytes: Vec<u8>) {
        let start = Instant::now();
        let text = utf8_text("fuzz.toml", "platform", bytes);
        let read = text.and_then(|text| Platform::from_toml("fuzz.toml", &text));
        let time = start.elapsed();
        assert!(time < PATIENCE, "{time:?}");
        self.slowest = self.slowest.max(time);
        match read {
            Ok(platform) => {
                self.accepted += 1;
                self.warned += usize::from(!platform.warnings.is_empty());
                sound(&platform);
            }
            Err(error) => {
                self.refused += 1;
                shown(&error);
            }
        }
    }

    fn report(&self, what: &str) {
        let Self { accepted, refused, warned, slowest } = self;
        let all = accepted + refused;
        println!(
            "{what}: {all} inputs, {accepted} accepted ({warned} with a warning), {refused} refused, slowest {slowest:?}"
        );
    }
}

/// Finite numbers that survive JSON, and warnings that can be shown.
fn sound(platform: &Platform) {
    for name in platform.parameter_names() {
        let numbers = platform.parameter(name).expect("a name from the list");
        assert!(numbers.iter().all(|number| number.is_finite()), "{name}: {numbers:?}");
    }
    let json = serde_json::to_string(platform).expect("plain numbers");
    let mut again: Platform = serde_json::from_str(&json).expect("its own JSON");
    again.warnings.clone_from(&platform.warnings);
    assert_eq!(again, *platform);
    platform.warnings.iter().for_each(|warning| rendered(warning));
}

fn shown(error: &FileError) {
    assert!(!error.refusals().is_empty());
    rendered(error);
}

fn rendered(diagnostic: &dyn Diagnostic) {
    let mut text = String::new();
    GraphicalReportHandler::new_themed(GraphicalTheme::unicode_nocolor())
        .render_report(&mut text, diagnostic)
        .expect("a String takes any text");
    assert!(text.contains("fuzz.toml:"), "no place in {text}");
}

#[test]
fn arbitrary_bytes() {
    let mut tally = Tally::default();
    check!().with_iterations(FEW).with_type::<Vec<u8>>().for_each(|bytes| tally.take(bytes.clone()));
    tally.report("arbitrary bytes");
}

#[test]
fn spoilt_files() {
    let (files, mut tally) = (files(), Tally::default());
    check!().with_iterations(FEW).with_type::<(u8, Vec<Edit>)>().for_each(|(file, edits)| {
        let text = files[usize::from(*file) % files.len()].as_bytes().to_vec();
        // Of many edits nothing is left but a syntax error.
        let spoilt = edits.iter().take(4).fold(text, |text, edit| edit.apply(&text));
        tally.take(spoilt);
    });
    tally.report("spoilt files");
    assert!(tally.accepted > 0 && tally.refused > 0 && tally.warned > 0, "one-sided inputs");
}
