//! The page about platform files against the reader: every key is on it, and every refusal on it has its test.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use dyn_platform::schema;
use serde_json::Value;

fn page() -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/platform-file.md");
    fs::read_to_string(path).expect("the page about platform files")
}

/// Keys of every "properties" in a schema.
fn keys(schema: &Value, found: &mut BTreeSet<String>) {
    match schema {
        Value::Object(entries) => {
            if let Some(properties) = entries.get("properties").and_then(Value::as_object) {
                found.extend(properties.keys().cloned());
            }
            entries.values().for_each(|entry| keys(entry, found));
        }
        Value::Array(entries) => entries.iter().for_each(|entry| keys(entry, found)),
        _ => {}
    }
}

#[test]
fn every_key_is_described() {
    let (page, mut found) = (page(), BTreeSet::new());
    keys(&schema(), &mut found);
    assert!(found.len() > 40, "{found:?}");
    for key in found {
        let written = [format!("`{key}`"), format!("[{key}]"), format!(".{key}]")]
            .iter()
            .any(|form| page.contains(form));
        assert!(written, "`{key}` is not on the page");
    }
}

/// Messages of the snapshots as running text.
fn snapshots() -> Vec<String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/refusals");
    let mut messages = Vec::new();
    for entry in fs::read_dir(folder).expect("the tests of refusals") {
        let text = fs::read_to_string(entry.expect("a folder entry").path()).expect("a test file");
        for message in text.split('×').skip(1) {
            // Below the message comes the place in the file, or, where there is none, the remedy.
            let end = ["╭─", "help:"].iter().filter_map(|mark| message.find(mark)).min();
            let end = end.unwrap_or(message.len());
            let words: Vec<&str> = message[..end].split_whitespace().filter(|word| *word != "│").collect();
            messages.push(words.join(" "));
        }
    }
    messages
}

/// Whether the parts of a documented message, between what a file fills in, follow one another in a shown one; for "leg …"
/// there may stand several legs.
fn follows(shown: &str, documented: &str) -> bool {
    let mut rest = shown;
    documented.replace("leg …", "leg…").split('…').all(|part| match rest.find(part) {
        Some(at) => {
            rest = &rest[at + part.len()..];
            true
        }
        None => false,
    })
}

#[test]
fn every_documented_refusal_is_tested() {
    let (page, snapshots) = (page(), snapshots());
    let table = page.split("## Refusals").nth(1).expect("the table of refusals");
    let mut count = 0;
    for row in table.lines().filter(|line| line.starts_with("| ") && !line.starts_with("| |")) {
        let cells: Vec<&str> = row.trim_matches('|').split(" | ").map(str::trim).collect();
        let [number, mistake, message, _remedy] = cells.as_slice() else { panic!("four cells: {row}") };
        count += 1;
        assert_eq!(number.parse(), Ok(count), "{row}");
        assert!(
            snapshots.iter().any(|shown| follows(shown, message)),
            "no test shows the message about: {mistake}\n{message}"
        );
    }
    assert!(count >= 40, "{count} refusals");
    println!("{count} distinct refusals documented, {} shown in tests", snapshots.len());
}
