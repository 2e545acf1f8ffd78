//! Damaged graph files and files of states: a refusal or a result, no panic, no hang.
//!
//! Each test draws some ten thousand inputs. The long run, a million each:
//! `DYN_GEN_FUZZ=1000000 cargo test --release -p dyn-gen --test fuzz -- --nocapture`. With `cargo bolero test NAME` the same
//! tests run under a coverage-guided fuzzer.

use std::sync::atomic::{AtomicUsize, Ordering};

use bolero::{TypeGenerator, check};
use dyn_gen::graph::Program;
use dyn_gen::passes::{Context, run_passes};
use dyn_gen::vectors::read_states;

const GRAPH: &str = include_str!("common/small.json");
const STATES: &str = r#"{"version":1,"cases":[{"base":{"position":[0,0,0],"rotation":[[1,0,0],[0,1,0],[0,0,1]],
"velocity":[0,0,0,0,0,0],"acceleration":[0,0,0,0,0,0]},"platform":{"position":[0,0,0.4],"rotation":[[1,0,0],[0,1,0],[0,0,1]],
"velocity":[0,0,0,0,0,0],"acceleration":[0,0,0,0,0,0]},"actuator_force":[0,0,0,0,0,0],"external_wrench":[0,0,0,0,0,0]}]}"#;

/// Inputs drawn unless `DYN_GEN_FUZZ` says otherwise.
const INPUTS: usize = 20_000;

fn inputs() -> usize {
    std::env::var("DYN_GEN_FUZZ").map_or(INPUTS, |count| count.parse().expect("a number"))
}

/// A change of a text.
#[derive(Clone, Copy, Debug, TypeGenerator)]
enum Damage {
    /// A number of the text becomes another.
    Number { which: u16, to: Value },
    /// A quoted word becomes another one of the text.
    Word { which: u16, by: u16 },
    /// A byte becomes any other.
    Byte { place: u16, by: u8 },
    /// A piece is left out.
    Gap { place: u16, length: u8 },
    /// A piece comes twice.
    Again { place: u16, length: u8 },
    /// The rest is missing.
    End { place: u16 },
}

/// Numbers worth a try.
#[derive(Clone, Copy, Debug, TypeGenerator)]
enum Value {
    Small(u8),
    Negative(i8),
    Large(u64),
    Any(f64),
    Text,
    Nothing,
}

impl Value {
    fn text(self) -> String {
        match self {
            Value::Small(value) => (value % 12).to_string(),
            Value::Negative(value) => value.to_string(),
            Value::Large(value) => value.to_string(),
            Value::Any(value) => format!("{value:e}"),
            Value::Text => "\"x\"".into(),
            Value::Nothing => "null".into(),
        }
    }
}

/// Where each maximal run of bytes of a kind begins and ends.
fn runs(text: &str, is: impl Fn(char) -> bool) -> Vec<(usize, usize)> {
    let mut runs: Vec<(usize, usize)> = Vec::new();
    for (place, letter) in text.char_indices().filter(|(_, letter)| is(*letter)) {
        match runs.last_mut() {
            Some((_, end)) if *end == place => *end = place + letter.len_utf8(),
            _ => runs.push((place, place + letter.len_utf8())),
        }
    }
    runs
}

fn damaged(text: &str, damages: &[Damage]) -> String {
    let mut text = text.to_owned();
    for damage in damages {
        let boundary = |place: u16| {
            let mut place = usize::from(place) % (text.len() + 1);
            while !text.is_char_boundary(place) {
                place -= 1;
            }
            place
        };
        let piece = |place: u16, length: u8| {
            let start = boundary(place);
            let mut end = (start + usize::from(length)).min(text.len());
            while !text.is_char_boundary(end) {
                end += 1;
            }
            (start, end)
        };
        let pick =
            |runs: &[(usize, usize)], which: u16| runs.get(usize::from(which) % runs.len().max(1)).copied();
        match *damage {
            Damage::Number { which, to } => {
                let numbers = runs(&text, |letter| letter.is_ascii_digit() || letter == '.');
                if let Some((start, end)) = pick(&numbers, which) {
                    text.replace_range(start..end, &to.text());
                }
            }
            Damage::Word { which, by } => {
                let words = runs(&text, |letter| letter.is_ascii_alphabetic() || letter == '_');
                if let (Some((start, end)), Some((from, to))) = (pick(&words, which), pick(&words, by)) {
                    let word = text[from..to].to_owned();
                    text.replace_range(start..end, &word);
                }
            }
            Damage::Byte { place, by } => text.insert(boundary(place), char::from(by)),
            Damage::Gap { place, length } => {
                let (start, end) = piece(place, length);
                text.replace_range(start..end, "");
            }
            Damage::Again { place, length } => {
                let (start, end) = piece(place, length);
                let again = text[start..end].to_owned();
                text.insert_str(start, &again);
            }
            Damage::End { place } => text.truncate(boundary(place)),
        }
    }
    text
}

#[test]
fn damaged_graph_files_are_refused_or_work() {
    static ACCEPTED: AtomicUsize = AtomicUsize::new(0);
    check!().with_iterations(inputs()).with_type::<[Option<Damage>; 3]>().for_each(|damages| {
        let damages: Vec<Damage> = damages.iter().flatten().copied().collect();
        let Ok(program) = Program::from_json(&damaged(GRAPH, &damages)) else { return };
        ACCEPTED.fetch_add(1, Ordering::Relaxed);
        for function in &program.functions {
            let known =
                program.evaluate(function, &program.sample).expect("a checked program has its sample");
            assert!(function.outputs.iter().all(|output| known.contains_key(output)));
            let graph = program.flatten(function);
            let context = Context {
                parameters: program.sample.clone(),
                states: vec![program.sample.clone()],
                ..Context::default()
            };
            let (graph, _) = run_passes(&graph, &context);
            graph.evaluate(&program.sample).expect("passes need no more inputs than the function");
        }
    });
    let accepted = ACCEPTED.load(Ordering::Relaxed);
    println!("{accepted} of {} damaged graph files are still graph files", inputs());
    assert!(accepted > 0, "nothing but refusals were tested");
}

#[test]
fn damaged_states_are_refused_or_read() {
    static ACCEPTED: AtomicUsize = AtomicUsize::new(0);
    check!().with_iterations(inputs()).with_type::<[Option<Damage>; 3]>().for_each(|damages| {
        let damages: Vec<Damage> = damages.iter().flatten().copied().collect();
        match read_states(&damaged(STATES, &damages)) {
            Err(error) => {
                assert!(!error.place.is_empty() && !error.problem.is_empty() && !error.remedy.is_empty())
            }
            Ok(file) => {
                ACCEPTED.fetch_add(1, Ordering::Relaxed);
                assert!(
                    file.states.iter().all(|state| state.values().flatten().all(|value| value.is_finite()))
                );
            }
        }
    });
    let accepted = ACCEPTED.load(Ordering::Relaxed);
    println!("{accepted} of {} damaged files of states are still files of states", inputs());
    assert!(accepted > 0, "nothing but refusals were tested");
}
