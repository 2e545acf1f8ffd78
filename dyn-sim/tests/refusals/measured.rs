//! Measured motions.

use std::fs;

use dyn_sim::scenario::Scenario;
use expect_test::{Expect, expect};

use crate::{platforms, rendered, with};

/// A measured motion of the base in a CSV file.
fn check_csv(csv: &str, expected: Expect) {
    let error = measured(csv).expect_err("the motion should be refused");
    expected.assert_eq(&error);
}

fn measured(csv: &str) -> Result<Scenario, String> {
    let folder = tempfile::tempdir().expect("a temporary folder");
    fs::copy(platforms().join("uhp_2016.toml"), folder.path().join("uhp_2016.toml")).expect("a copy");
    fs::write(folder.path().join("base.csv"), csv).expect("a file");
    let harmonic = "[[base.harmonic]]\nfrequency_hz = 5.0\nlinear_m_per_s2 = [0.1, 0.0, 0.0]\nrotation_rad = [0.1, 0.0, 0.0]\n";
    let text = with(harmonic, "csv = \"base.csv\"\n");
    Scenario::from_toml("bench.toml", &text, folder.path())
        .map_err(|error| rendered(&error).replace(&format!("{}/", folder.path().display()), ""))
}

fn lines(count: usize) -> Vec<String> {
    (0..count).map(|k| format!("{:.3}, 0.1, 0, 0, 0, 0, {}", 0.01 * k as f64, (k % 7) as f64 - 3.0)).collect()
}

#[test]
fn measured_motion_is_read() {
    let header = "time_s, x, y, z, rx, ry, rz\n# a comment\n";
    let scenario = measured(&(header.to_owned() + &lines(60).join("\n"))).expect("a good record");
    assert_eq!(scenario.notes.len(), 1, "{:?}", scenario.notes);
    assert!(
        scenario.notes[0].starts_with("[base]: the means of base.csv were removed"),
        "{:?}",
        scenario.notes
    );
}

#[test]
fn columns() {
    let mut lines = lines(60);
    lines[3] = "0.03, 1, 2, 3".into();
    check_csv(
        &lines.join("\n"),
        expect![[r#"
        Error:
          × a line has 4 columns instead of 7
           ╭─[base.csv:4:1]
         3 │ 0.020, 0.1, 0, 0, 0, 0, -1
         4 │ 0.03, 1, 2, 3
           · ──────┬──────
           ·       ╰── 4 columns
         5 │ 0.040, 0.1, 0, 0, 0, 0, 1
           ╰────
          help: each line has time (s), three accelerations (m/s^2) and three angular accelerations (rad/s^2),
                separated by commas
    "#]],
    );
}

#[test]
fn not_finite() {
    let mut lines = lines(60);
    lines[3] = "0.03, 1, 2, nan, 0, 0, 0".into();
    lines[5] = "0.05, 1, two, 0, 0, 0, 0".into();
    check_csv(
        &lines.join("\n"),
        expect![[r#"
        Error:
          × base.csv: 2 mistakes

        Error:
          × `nan` is not a finite number
           ╭─[base.csv:4:1]
         3 │ 0.020, 0.1, 0, 0, 0, 0, -1
         4 │ 0.03, 1, 2, nan, 0, 0, 0
           · ────────────┬───────────
           ·             ╰── not finite
         5 │ 0.040, 0.1, 0, 0, 0, 0, 1
           ╰────
          help: repair or cut the record there; missing samples cannot be guessed

        Error:
          × `two` is not a number
           ╭─[base.csv:6:1]
         5 │ 0.040, 0.1, 0, 0, 0, 0, 1
         6 │ 0.05, 1, two, 0, 0, 0, 0
           · ────────────┬───────────
           ·             ╰── not a number
         7 │ 0.060, 0.1, 0, 0, 0, 0, 3
           ╰────
          help: each line has time (s), three accelerations (m/s^2) and three angular accelerations (rad/s^2),
                separated by commas
    "#]],
    );
}

#[test]
fn gap_and_uneven_time() {
    let mut lines = lines(60);
    lines.remove(9);
    lines[20] = lines[20].replace("0.210", "0.213");
    check_csv(
        &lines.join("\n"),
        expect![[r#"
        Error:
          × base.csv: 3 mistakes

        Error:
          × a gap of 0.020000 s where samples usually follow after 0.010000 s
            ╭─[base.csv:10:1]
          9 │ 0.080, 0.1, 0, 0, 0, 0, -2
         10 │ 0.100, 0.1, 0, 0, 0, 0, 0
            · ────────────┬────────────
            ·             ╰── after a gap
         11 │ 0.110, 0.1, 0, 0, 0, 0, 1
            ╰────
          help: cut the record there, or fill the gap with what was measured

        Error:
          × uneven time: 1.300000e-2 s after the line before, usually 1.000000e-2 s
            ╭─[base.csv:21:1]
         20 │ 0.200, 0.1, 0, 0, 0, 0, 3
         21 │ 0.213, 0.1, 0, 0, 0, 0, -3
            · ─────────────┬────────────
            ·              ╰── uneven
         22 │ 0.220, 0.1, 0, 0, 0, 0, -2
            ╰────
          help: resample to even times, and print them with enough digits

        Error:
          × uneven time: 7.000000e-3 s after the line before, usually 1.000000e-2 s
            ╭─[base.csv:22:1]
         21 │ 0.213, 0.1, 0, 0, 0, 0, -3
         22 │ 0.220, 0.1, 0, 0, 0, 0, -2
            · ─────────────┬────────────
            ·              ╰── uneven
         23 │ 0.230, 0.1, 0, 0, 0, 0, -1
            ╰────
          help: resample to even times, and print them with enough digits
    "#]],
    );
}

#[test]
fn time_that_goes_back() {
    let mut lines = lines(60);
    lines.swap(4, 5);
    check_csv(
        &lines.join("\n"),
        expect![[r#"
        Error:
          × the time 0.04 s does not come after 0.05 s
           ╭─[base.csv:6:1]
         5 │ 0.050, 0.1, 0, 0, 0, 0, 2
         6 │ 0.040, 0.1, 0, 0, 0, 0, 1
           · ────────────┬────────────
           ·             ╰── not later
         7 │ 0.060, 0.1, 0, 0, 0, 0, 3
           ╰────
          help: order the lines by time and remove repetitions
    "#]],
    );
}

#[test]
fn too_few() {
    check_csv(
        &lines(5).join("\n"),
        expect![[r#"
        Error:
          × 5 samples are too few for a motion
           ╭─[base.csv:5:26]
         4 │ 0.030, 0.1, 0, 0, 0, 0, 0
         5 │ 0.040, 0.1, 0, 0, 0, 0, 1
           ╰────
          help: give at least 16
    "#]],
    );
}

#[test]
fn too_short() {
    check_csv(
        &lines(40).join("\n"),
        expect![[r#"
        Error:
          × the measured motion ends after 0.390000 s, the scenario after 0.5 s
            ╭─[bench.toml:9:7]
          8 │ [base]
          9 │ csv = "base.csv"
            ·       ─────┬────
            ·            ╰── too short
         10 │
            ╰────
          help: shorten `duration_s`, or measure longer
    "#]],
    );
}
