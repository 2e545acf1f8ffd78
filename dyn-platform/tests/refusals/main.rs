//! Every refusal of a platform file, with its whole text: file, line, caret and remedy.
//!
//! The texts are snapshots; after a deliberate change, `UPDATE_EXPECT=1 cargo test -p dyn-platform` rewrites them.

use dyn_platform::Platform;
use expect_test::Expect;
use miette::{Diagnostic, GraphicalReportHandler, GraphicalTheme};

mod file;
mod keys;
mod leg_types;
mod legs;
mod limits;
mod loose;
mod missing;
mod names;
mod numbers;
mod payload;
mod tensors;
mod types;
mod versions;
mod warnings;

/// A valid file with a circular layout.
const CIRCULAR: &str = r#"version = 1
name = "bench"
leg_type = "uhp"
gravity_m_per_s2 = [0.0, 0.0, -9.81]

[home]
position_m = [0.0, 0.0, 0.4]
rotation = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]

[circular_layout]
base_radius_m = 0.2
platform_radius_m = 0.13
base_pair_angle_rad = 1.2
platform_pair_angle_rad = 0.5

[legs]
actuator_axis = [0.0, 0.0, 1.0]
rod_length_m = 0.25
rod_mass_kg = 1.0
rod_inertia_kg_m2 = 0.005
rod_com_fraction = 0.5
mover_mass_kg = 0.6
mover_offset_m = 0.05
rest_length_m = 0.2
axial_stiffness_n_per_m = 20000.0
axial_damping_n_s_per_m = 2.0

[payload]
mass_kg = 6.0
com_m = [0.0, 0.0, 0.03]
inertia_kg_m2 = [[0.02, 0.0, 0.0], [0.0, 0.02, 0.0], [0.0, 0.0, 0.03]]
"#;

/// A valid file with legs of type `ups`.
const UPS: &str = r#"version = 1
name = "bench"
leg_type = "ups"
gravity_m_per_s2 = [0.0, 0.0, -9.81]

[home]
position_m = [0.0, 0.0, 0.7]

[circular_layout]
base_radius_m = 0.45
platform_radius_m = 0.3
base_pair_angle_rad = 0.4
platform_pair_angle_rad = 1.7

[legs]
lower_mass_kg = 3.0
lower_com_distance_m = 0.2
lower_inertia_kg_m2 = 0.06
upper_mass_kg = 1.5
upper_com_distance_m = 0.18
upper_inertia_kg_m2 = 0.02
rest_length_m = 0.75
axial_stiffness_n_per_m = 0.0
axial_damping_n_s_per_m = 100.0

[payload]
mass_kg = 20.0
com_m = [0.0, 0.0, 0.05]
inertia_kg_m2 = [[0.9, 0.0, 0.0], [0.0, 0.9, 0.0], [0.0, 0.0, 1.5]]
"#;

const CIRCLES: &str = "
[circular_layout]
base_radius_m = 0.2
platform_radius_m = 0.13
base_pair_angle_rad = 1.2
platform_pair_angle_rad = 0.5
";

const LEG_TABLES: &str = "
[[leg]]
number = 1
base_point_m = [0.16, -0.11, 0.0]
platform_point_m = [0.12, -0.03, 0.0]
[[leg]]
number = 2
base_point_m = [0.16, 0.11, 0.0]
platform_point_m = [0.12, 0.03, 0.0]
[[leg]]
number = 3
base_point_m = [0.02, 0.19, 0.0]
platform_point_m = [-0.03, 0.12, 0.0]
[[leg]]
number = 4
base_point_m = [-0.18, 0.08, 0.0]
platform_point_m = [-0.09, 0.09, 0.0]
[[leg]]
number = 5
base_point_m = [-0.18, -0.08, 0.0]
platform_point_m = [-0.09, -0.09, 0.0]
[[leg]]
number = 6
base_point_m = [0.02, -0.19, 0.0]
platform_point_m = [-0.03, -0.12, 0.0]
";

/// The same platform in a free layout.
fn free() -> String {
    CIRCULAR.replace(CIRCLES, "") + LEG_TABLES
}

/// `text` with `good` replaced by `bad`; `good` must occur, lest the test test nothing.
fn with(text: &str, good: &str, bad: &str) -> String {
    assert!(text.contains(good), "{good:?} is not in the valid file");
    text.replacen(good, bad, 1)
}

fn rendered(error: &dyn Diagnostic) -> String {
    let handler = GraphicalReportHandler::new_themed(GraphicalTheme::unicode_nocolor()).with_width(110);
    let mut text = String::from("Error:\n");
    handler.render_report(&mut text, error).expect("a String takes any text");
    // Trailing blanks would not survive editors.
    text.lines().map(|line| line.trim_end().to_owned() + "\n").collect()
}

fn check_text(text: &str, expected: Expect) {
    let error = Platform::from_toml("bench.toml", text).expect_err("the file should be refused");
    assert!(!error.refusals().is_empty());
    expected.assert_eq(&rendered(&error));
}

/// One wrong place in the circular file.
fn check(good: &str, bad: &str, expected: Expect) {
    check_text(&with(CIRCULAR, good, bad), expected);
}

/// One wrong place in the file with legs of type `ups`.
fn check_ups(good: &str, bad: &str, expected: Expect) {
    check_text(&with(UPS, good, bad), expected);
}

/// One wrong place in the free file.
fn check_free(good: &str, bad: &str, expected: Expect) {
    check_text(&with(&free(), good, bad), expected);
}

#[test]
fn the_files_are_valid_before_they_are_spoilt() {
    for text in [CIRCULAR.to_owned(), free(), UPS.to_owned()] {
        Platform::from_toml("bench.toml", &text).expect("a valid file");
    }
}

/// Whatever happens to a file, the reader neither panics nor refuses without a reason that can be shown.
#[test]
fn every_spoilt_character() {
    let text = free();
    for at in text.char_indices().map(|(at, _)| at) {
        for with in ["", "-", "[", "]", "\"", "9e9", "\n"] {
            let spoilt = format!("{}{with}{}", &text[..at], &text[at + 1..]);
            if let Err(error) = Platform::from_toml("bench.toml", &spoilt) {
                assert!(!error.refusals().is_empty(), "no reason for {spoilt}");
                assert!(rendered(&error).contains("bench.toml:"), "no place for {spoilt}");
            }
        }
    }
}
