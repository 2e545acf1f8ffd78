//! Payloads of several parts.

use expect_test::expect;

use crate::{CIRCULAR, check, check_text, with};

const BODY: &str = "mass_kg = 6.0\ncom_m = [0.0, 0.0, 0.03]\n\
                    inertia_kg_m2 = [[0.02, 0.0, 0.0], [0.0, 0.02, 0.0], [0.0, 0.0, 0.03]]\n";

const PARTS: &str = r#"[[payload.part]]
name = "plate"
mass_kg = 4.0
com_m = [0.0, 0.0, 0.0]
inertia_kg_m2 = [[0.01, 0.0, 0.0], [0.0, 0.01, 0.0], [0.0, 0.0, 0.02]]
[[payload.part]]
name = "camera"
mass_kg = 2.0
com_m = [0.0, 0.05, 0.08]
inertia_kg_m2 = [[0.002, 0.0, 0.0], [0.0, 0.003, 0.0], [0.0, 0.0, 0.004]]
rotation = [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]
"#;

/// The circular file with a payload of two parts, one of them spoilt.
fn spoilt(good: &str, bad: &str) -> String {
    with(&with(CIRCULAR, BODY, PARTS), good, bad)
}

#[test]
fn body_and_parts() {
    check_text(
        &(CIRCULAR.to_owned() + PARTS),
        expect![[r#"
        Error:
          × two payloads: [payload] has both `mass_kg` and [[payload.part]] tables
            ╭─[bench.toml:29:1]
         28 │ [payload]
         29 │ mass_kg = 6.0
            · ───┬───
            ·    ╰── of the payload as a whole
         30 │ com_m = [0.0, 0.0, 0.03]
            ╰────
          help: remove the parts, or turn these numbers into a part of their own
    "#]],
    );
}

#[test]
fn no_parts() {
    check(
        BODY,
        "part = []\n",
        expect![[r#"
        Error:
          × the payload has no parts
            ╭─[bench.toml:29:1]
         28 │ [payload]
         29 │ part = []
            · ──┬─
            ·   ╰── empty
            ╰────
          help: give `mass_kg`, `com_m` and `inertia_kg_m2`, or add [[payload.part]] tables
    "#]],
    );
}

#[test]
fn part_without_mass() {
    check_text(
        &spoilt("mass_kg = 2.0\n", ""),
        expect![[r#"
        Error:
          × `mass_kg` is missing in part 2 of the payload
            ╭─[bench.toml:34:1]
         33 │ inertia_kg_m2 = [[0.01, 0.0, 0.0], [0.0, 0.01, 0.0], [0.0, 0.0, 0.02]]
         34 │ [[payload.part]]
            · ────────┬───────
            ·         ╰── no `mass_kg` here
         35 │ name = "camera"
            ╰────
          help: give the mass of the part, kg, for example `mass_kg = 1.2`
    "#]],
    );
}

#[test]
fn part_of_negative_mass() {
    check_text(
        &spoilt("mass_kg = 2.0\n", "mass_kg = -2.0\n"),
        expect![[r#"
        Error:
          × `mass_kg` must be positive, but is -2
            ╭─[bench.toml:36:11]
         35 │ name = "camera"
         36 │ mass_kg = -2.0
            ·           ──┬─
            ·             ╰── must be positive
         37 │ com_m = [0.0, 0.05, 0.08]
            ╰────
          help: give the mass of the part, kg, for example `mass_kg = 1.2`
    "#]],
    );
}

#[test]
fn part_of_no_body() {
    check_text(
        &spoilt("[0.0, 0.0, 0.004]", "[0.0, 0.0, 0.04]"),
        expect![[r#"
        Error:
          × `inertia_kg_m2` belongs to no body: its principal moments are 2.0000e-3, 3.0000e-3 and 4.0000e-2 kg m^2,
          │ and the largest exceeds the sum of the others
            ╭─[bench.toml:38:17]
         37 │ com_m = [0.0, 0.05, 0.08]
         38 │ inertia_kg_m2 = [[0.002, 0.0, 0.0], [0.0, 0.003, 0.0], [0.0, 0.0, 0.04]]
            ·                 ────────────────────────────┬───────────────────────────
            ·                                             ╰── violates the triangle inequality
         39 │ rotation = [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]
            ╰────
          help: check the entries: in a body no principal moment exceeds the sum of the other two
    "#]],
    );
}

#[test]
fn part_turned_left_handed() {
    check_text(
        &spoilt("[1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]", "[1.0, 0.0, 0.0], [0.0, 0.0, -1.0]]"),
        expect![[r#"
            Error:
              × `rotation` is a reflection, not a rotation: its determinant is -1
                ╭─[bench.toml:39:12]
             38 │ inertia_kg_m2 = [[0.002, 0.0, 0.0], [0.0, 0.003, 0.0], [0.0, 0.0, 0.004]]
             39 │ rotation = [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, -1.0]]
                ·            ──────────────────────────┬──────────────────────────
                ·                                      ╰── left-handed
                ╰────
              help: make the axes right-handed: change the sign of one row
        "#]],
    );
}

#[test]
fn misspelt_parts() {
    check(
        BODY,
        &PARTS.replace("payload.part", "payload.parts"),
        expect![[r#"
        Error:
          × unknown key `parts` in [payload]
            ╭─[bench.toml:29:11]
         28 │ [payload]
         29 │ [[payload.parts]]
            ·           ──┬──
            ·             ╰── unknown key
         30 │ name = "plate"
            ╰────
          help: did you mean `part`?
    "#]],
    );
}

#[test]
fn unknown_key_of_a_part() {
    check_text(
        &spoilt("name = \"camera\"", "nmae = \"camera\""),
        expect![[r#"
        Error:
          × unknown key `nmae` in [[payload.part]]
            ╭─[bench.toml:35:1]
         34 │ [[payload.part]]
         35 │ nmae = "camera"
            · ──┬─
            ·   ╰── unknown key
         36 │ mass_kg = 2.0
            ╰────
          help: did you mean `name`?
    "#]],
    );
}
