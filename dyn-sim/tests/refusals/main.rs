//! Every refusal of a scenario file or a measured motion, with its whole text: file, line, caret and remedy.
//!
//! The texts are snapshots; after a deliberate change, `UPDATE_EXPECT=1 cargo test -p dyn-sim` rewrites them.

use std::path::Path;

use dyn_sim::scenario::{Scenario, ScenarioError};
use expect_test::Expect;
use miette::{GraphicalReportHandler, GraphicalTheme};

mod keys;
mod measured;
mod values;

/// A valid scenario.
const VALID: &str = r#"version = 1
name = "bench"
platform = "uhp_2016.toml"
gravity = true
duration_s = 0.5
step_s = 1e-3

[base]
[[base.harmonic]]
frequency_hz = 5.0
linear_m_per_s2 = [0.1, 0.0, 0.0]
rotation_rad = [0.1, 0.0, 0.0]

[target]
relative_to = "base"
[[target.harmonic]]
frequency_hz = 2.0
linear_m = [0.01, 0.0, 0.0]

[limits]
actuator_length_m = [0.15, 0.25]

[spectrum]
frequencies_hz = [2.0, 5.0]
"#;

fn platforms() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../platforms"))
}

fn rendered(error: &ScenarioError) -> String {
    let handler = GraphicalReportHandler::new_themed(GraphicalTheme::unicode_nocolor()).with_width(110);
    let mut text = String::from("Error:\n");
    handler.render_report(&mut text, error).expect("a String takes any text");
    let folder = format!("{}/", platforms().display());
    text.lines().map(|line| line.trim_end().replace(&folder, "") + "\n").collect()
}

fn with(good: &str, bad: &str) -> String {
    assert!(VALID.contains(good), "{good:?} is not in the valid file");
    VALID.replacen(good, bad, 1)
}

fn check_text(text: &str, expected: Expect) {
    let error = Scenario::from_toml("bench.toml", text, platforms()).expect_err("the file should be refused");
    expected.assert_eq(&rendered(&error));
}

fn check(good: &str, bad: &str, expected: Expect) {
    check_text(&with(good, bad), expected);
}

#[test]
fn the_file_is_valid_before_it_is_spoilt() {
    Scenario::from_toml("bench.toml", VALID, platforms()).expect("a valid file");
}

/// Whatever happens to a file, the reader neither panics nor refuses without a reason that can be shown.
#[test]
fn every_spoilt_character() {
    for at in 0..VALID.len() {
        for with in ["", "-", "[", "\"", "9e9", "\n"] {
            let spoilt = format!("{}{with}{}", &VALID[..at], &VALID[at + 1..]);
            if let Err(error) = Scenario::from_toml("bench.toml", &spoilt, platforms()) {
                assert!(
                    rendered(&error).contains("bench.toml:"),
                    "no place for {spoilt}\n{}",
                    rendered(&error)
                );
            }
        }
    }
}
