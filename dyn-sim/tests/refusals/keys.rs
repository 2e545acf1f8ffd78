//! Mistakes in keys, types and files.

use dyn_sim::scenario::Scenario;
use expect_test::expect;

use crate::{check, check_text, rendered};

#[test]
fn empty() {
    check_text(
        "\n",
        expect![[r#"
        Error:
          × the scenario file is empty
           ╭─[bench.toml:1:1]
         1 │
           · ▲
           · ╰── no key in this file
           ╰────
          help: start from a copy of scenarios/published.toml; scenarios/README.md lists every key
    "#]],
    );
}

#[test]
fn no_toml() {
    check(
        "gravity = true",
        "gravity = ",
        expect![[r#"
        Error:
          × this is not TOML: string values must be quoted, expected literal string
           ╭─[bench.toml:4:11]
         3 │ platform = "uhp_2016.toml"
         4 │ gravity =
           ·           ▲
           ·           ╰── here
         5 │ duration_s = 0.5
           ╰────
          help: mend the syntax; https://toml.io describes it
    "#]],
    );
}

#[test]
fn unknown_key() {
    check(
        "duration_s",
        "duration",
        expect![[r#"
        Error:
          × unknown key `duration`
           ╭─[bench.toml:5:1]
         4 │ gravity = true
         5 │ duration = 0.5
           · ────┬───
           ·     ╰── unknown key
         6 │ step_s = 1e-3
           ╰────
          help: did you mean `duration_s`?
    "#]],
    );
}

#[test]
fn missing_key() {
    check(
        "step_s = 1e-3\n",
        "",
        expect![[r#"
        Error:
          × `step_s` is missing
           ╭─[bench.toml:1:1]
         1 │ version = 1
           · ─────┬─────
           ·      ╰── no `step_s` here
         2 │ name = "bench"
           ╰────
          help: for example `step_s = 1e-4`; scenarios/README.md lists every key
    "#]],
    );
}

#[test]
fn missing_key_of_a_harmonic() {
    check(
        "frequency_hz = 2.0\n",
        "",
        expect![[r#"
        Error:
          × `frequency_hz` is missing
            ╭─[bench.toml:16:1]
         15 │ relative_to = "base"
         16 │ [[target.harmonic]]
            · ─────────┬─────────
            ·          ╰── no `frequency_hz` here
         17 │ linear_m = [0.01, 0.0, 0.0]
            ╰────
          help: for example `frequency_hz = 40.0`; scenarios/README.md lists every key
    "#]],
    );
}

#[test]
fn wrong_type() {
    check(
        "gravity = true",
        "gravity = 9.81",
        expect![[r#"
        Error:
          × `gravity`: invalid type: floating point `9.81`, expected a boolean
           ╭─[bench.toml:4:11]
         3 │ platform = "uhp_2016.toml"
         4 │ gravity = 9.81
           ·           ──┬─
           ·             ╰── not so
         5 │ duration_s = 0.5
           ╰────
          help: for example `gravity = true`; scenarios/README.md lists every key
    "#]],
    );
}

#[test]
fn unknown_integrator() {
    check(
        "gravity = true",
        "gravity = true\nintegrator = \"rk4\"",
        expect![[r#"
        Error:
          × "rk4" is unknown here
           ╭─[bench.toml:5:14]
         4 │ gravity = true
         5 │ integrator = "rk4"
           ·              ──┬──
           ·                ╰── unknown
         6 │ duration_s = 0.5
           ╰────
          help: known here: lie_rk4, adaptive
    "#]],
    );
}

#[test]
fn other_version() {
    check(
        "version = 1",
        "version = 2",
        expect![[r#"
        Error:
          × the file has format version 2, this reader knows version 1 only
           ╭─[bench.toml:1:11]
         1 │ version = 2
           ·           ┬
           ·           ╰── must be 1
         2 │ name = "bench"
           ╰────
          help: write `version = 1` and bring the file into the form of scenarios/README.md
    "#]],
    );
}

#[test]
fn no_such_platform() {
    check(
        "uhp_2016.toml",
        "uhp_2017.toml",
        expect![[r#"
        Error:
          × there is no platform file uhp_2017.toml
           ╭─[bench.toml:3:12]
         2 │ name = "bench"
         3 │ platform = "uhp_2017.toml"
           ·            ───────┬───────
           ·                   ╰── no such file
         4 │ gravity = true
           ╰────
          help: give its path, counted from the folder of the scenario file
    "#]],
    );
}

#[test]
fn no_such_file() {
    let error = Scenario::from_file("nowhere.toml").expect_err("there is none");
    let text = rendered(&error);
    assert!(text.contains("cannot read the scenario file `nowhere.toml`"), "{text}");
    assert!(text.contains("scenarios/published.toml is an example"), "{text}");
}

#[test]
fn other_legs() {
    check(
        r#"platform = "uhp_2016.toml""#,
        r#"platform = "../tests/platforms/ups_regular.toml""#,
        expect![[r#"
            Error:
              × a platform with legs "ups" cannot be simulated
               ╭─[bench.toml:3:12]
             2 │ name = "bench"
             3 │ platform = "../tests/platforms/ups_regular.toml"
               ·            ──────────────────┬──────────────────
               ·                              ╰── other legs
             4 │ gravity = true
               ╰────
              help: give a platform with legs "uhp"
        "#]],
    );
}
