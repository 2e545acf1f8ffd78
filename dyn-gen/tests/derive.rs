//! `dyn-gen derive` with a stand-in for Python: whatever goes wrong, the committed graph stays as it was.
#![cfg(unix)]

mod common;

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use common::cli::{code, dyn_gen_with, entries, repository, said};

/// A repository, and a Python whose derivation is the shell code `derivation` with the output folder in `$last`.
struct Place {
    repository: tempfile::TempDir,
}

impl Place {
    fn new(derivation: &str) -> Place {
        let repository = repository();
        let script = format!(
            r#"#!/bin/sh
for last; do :; done
case "$*" in
    -c*) echo "dyn-python 3 12 1 $0" ;;
    *"venv "*) mkdir -p "$last/bin" && cp "$0" "$last/bin/python" ;;
    *"-m derivation "*) {derivation} ;;
esac
"#
        );
        let path = repository.path().join("python");
        // Written by another process: while this one has the file open, none it starts meanwhile could run it.
        let written = Command::new("sh")
            .args(["-c", r#"printf '%s' "$1" > "$2" && chmod 755 "$2""#, "sh", &script])
            .arg(&path)
            .status()
            .unwrap();
        assert!(written.success());
        Place { repository }
    }

    fn path(&self) -> &Path {
        self.repository.path()
    }

    fn run(&self, arguments: &[&str]) -> Output {
        let (python, target) = (self.path().join("python"), self.path().join("target"));
        let variables =
            [("DYN_PYTHON", python.to_str().unwrap()), ("CARGO_TARGET_DIR", target.to_str().unwrap())];
        dyn_gen_with(self.path(), arguments, &variables)
    }

    /// Every command that derives fails, says all of `mentions`, and changes nothing.
    fn assert_refused(&self, mentions: &[&str]) {
        let graph = self.path().join("codegen/graphs/uhp.json");
        let before = fs::read(&graph).unwrap();
        for arguments in [
            &["derive"][..],
            &["derive", "--check"],
            &["regen", "--derive"],
            &["regen", "--derive", "--fallback"],
        ] {
            let result = self.run(arguments);
            assert_eq!(code(&result), 1, "{arguments:?}: {}", said(&result));
            // Long lines are wrapped.
            let words = said(&result).replace(['│', '\n'], " ");
            let words = words.split_whitespace().collect::<Vec<_>>().join(" ");
            for mention in mentions {
                assert!(words.contains(mention), "{arguments:?} does not say {mention}: {words}");
            }
            assert_eq!(fs::read(&graph).unwrap(), before, "{arguments:?} changed the graph");
            assert_eq!(entries(graph.parent().unwrap()), ["uhp.json", "ups.json"]);
            assert!(entries(&self.path().join("dyn-runtime/src/generated")).is_empty());
        }
    }
}

/// Shell code that writes the committed graphs with one text of the first replaced; the derivation runs in `codegen`.
fn altered(from: &str, to: &str) -> String {
    format!("cp graphs/*.json \"$last\"; sed 's/{from}/{to}/' graphs/uhp.json > \"$last/uhp.json\"")
}

#[test]
fn a_derivation_that_fails_is_shown_and_changes_nothing() {
    let place = Place::new("echo '{' > \"$last/uhp.json\"; echo 'no such leg type' >&2; exit 3");
    place.assert_refused(&[
        "the derivation failed (exit status: 3); the committed graphs are unchanged",
        "no such leg type",
        "-m derivation --folder graphs",
    ]);
}

#[test]
fn a_derivation_without_a_graph_changes_nothing() {
    Place::new("exit 0").assert_refused(&["the derivation wrote no uhp.json"]);
}

#[test]
fn a_derived_graph_that_is_refused_changes_nothing() {
    let place = Place::new(&altered("\"leg_count\": *6", "\"leg_count\": 0"));
    place.assert_refused(&[
        "the derived uhp.json is refused; the committed graphs are unchanged",
        "leg_count is 0, expected 1 to 64",
    ]);
    Place::new("cp graphs/*.json \"$last\"; head -c 1000 graphs/uhp.json > \"$last/uhp.json\"")
        .assert_refused(&["the derived uhp.json is refused", "EOF"]);
}

#[test]
fn a_derived_graph_that_misses_its_own_sample_changes_nothing() {
    let place = Place::new(&altered("\"sub\"", "\"add\""));
    place.assert_refused(&[
        "does not give the derivation's own sample outputs",
        "committed graphs are unchanged",
    ]);
}

#[test]
fn a_sound_derivation_replaces_the_graph() {
    let place = Place::new(&altered("\"casadi\": *\"[^\"]*\"", "\"casadi\": \"0.0.0\""));
    let graph = place.path().join("codegen/graphs/uhp.json");
    let check = place.run(&["derive", "--check"]);
    assert_eq!(code(&check), 1, "{}", said(&check));
    assert!(
        said(&check).contains("not what the derivation gives: codegen/graphs/uhp.json"),
        "{}",
        said(&check)
    );
    let derive = place.run(&["derive"]);
    assert_eq!(code(&derive), 0, "{}", said(&derive));
    assert!(fs::read_to_string(&graph).unwrap().contains("0.0.0"));
    assert_eq!(code(&place.run(&["derive", "--check"])), 0);
}
