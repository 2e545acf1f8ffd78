//! Legs: missing, repeated, with two layouts or none, out of reach.

use expect_test::expect;

use crate::{CIRCLES, CIRCULAR, LEG_TABLES, check, check_free, check_text, free, with};

#[test]
fn no_layout() {
    check_text(
        &with(CIRCULAR, CIRCLES, ""),
        expect![[r#"
        Error:
          × there is no layout: nothing says where the joints are
           ╭─[bench.toml:1:1]
         1 │ version = 1
           · ─────┬─────
           ·      ╰── no joint points in this file
         2 │ name = "bench"
           ╰────
          help: give [circular_layout], or six [[leg]] tables with `base_point_m` and `platform_point_m`
    "#]],
    );
}

#[test]
fn both_layouts() {
    check_text(
        &(CIRCULAR.to_owned() + LEG_TABLES),
        expect![[r#"
        Error:
          × two layouts: both [circular_layout] and a [[leg]] say where joints are
            ╭─[bench.toml:35:1]
         34 │ number = 1
         35 │ base_point_m = [0.16, -0.11, 0.0]
            · ──────┬─────
            ·       ╰── a point, although [circular_layout] is given
         36 │ platform_point_m = [0.12, -0.03, 0.0]
            ╰────
          help: remove [circular_layout] and give the points of all six legs, or remove the points
    "#]],
    );
}

#[test]
fn one_leg_missing() {
    check_free(
        "[[leg]]\nnumber = 4\nbase_point_m = [-0.18, 0.08, 0.0]\nplatform_point_m = [-0.09, 0.09, 0.0]\n",
        "",
        expect![[r#"
            Error:
              × leg 4 is missing: a platform has six legs
                ╭─[bench.toml:43:1]
             42 │ platform_point_m = [-0.09, -0.09, 0.0]
             43 │ [[leg]]
                · ───┬───
                ·    ╰── 5 of 6 legs are given, the last one here
             44 │ number = 6
                ╰────
              help: add a [[leg]] table with `number`, `base_point_m` and `platform_point_m`
        "#]],
    );
}

#[test]
fn four_legs_missing() {
    let text = free();
    let third = text.find("[[leg]]\nnumber = 3").expect("a third leg");
    check_text(
        &text[..third],
        expect![[r#"
        Error:
          × legs 3, 4, 5 and 6 are missing: a platform has six legs
            ╭─[bench.toml:31:1]
         30 │ platform_point_m = [0.12, -0.03, 0.0]
         31 │ [[leg]]
            · ───┬───
            ·    ╰── 2 of 6 legs are given, the last one here
         32 │ number = 2
            ╰────
          help: add [[leg]] tables with `number`, `base_point_m` and `platform_point_m`
    "#]],
    );
}

#[test]
fn seventh_leg() {
    check_free(
        "number = 6",
        "number = 7",
        expect![[r#"
        Error:
          × `number` of a leg must be 1 to 6, but is 7
            ╭─[bench.toml:48:10]
         47 │ [[leg]]
         48 │ number = 7
            ·          ┬
            ·          ╰── must be 1 to 6
         49 │ base_point_m = [0.02, -0.19, 0.0]
            ╰────
          help: a platform has six legs: renumber this one or remove it
    "#]],
    );
}

#[test]
fn seven_legs() {
    check_text(
        &(free()
            + "[[leg]]\nnumber = 7\nbase_point_m = [0.0, 0.0, 0.0]\nplatform_point_m = [0.0, 0.0, 0.0]\n"),
        expect![[r#"
            Error:
              × `number` of a leg must be 1 to 6, but is 7
                ╭─[bench.toml:52:10]
             51 │ [[leg]]
             52 │ number = 7
                ·          ┬
                ·          ╰── must be 1 to 6
             53 │ base_point_m = [0.0, 0.0, 0.0]
                ╰────
              help: a platform has six legs: renumber this one or remove it
        "#]],
    );
}

#[test]
fn leg_given_twice() {
    check_free(
        "number = 4",
        "number = 3",
        expect![[r#"
        Error:
          × leg 3 is given twice
            ╭─[bench.toml:40:10]
         39 │ [[leg]]
         40 │ number = 3
            ·          ┬
            ·          ╰── given a second time
         41 │ base_point_m = [-0.18, 0.08, 0.0]
            ╰────
          help: give each of the numbers 1 to 6 to one [[leg]] only
    "#]],
    );
}

#[test]
fn leg_without_number() {
    check_free(
        "number = 4\n",
        "",
        expect![[r#"
        Error:
          × `number` is missing in [[leg]]
            ╭─[bench.toml:39:1]
         38 │ platform_point_m = [-0.03, 0.12, 0.0]
         39 │ [[leg]]
            · ───┬───
            ·    ╰── no `number` here
         40 │ base_point_m = [-0.18, 0.08, 0.0]
            ╰────
          help: give the number of the leg, 1 to 6, for example `number = 1`
    "#]],
    );
}

#[test]
fn no_legs_at_all() {
    let start = CIRCULAR.find("[legs]").expect("legs");
    let end = CIRCULAR.find("[payload]").expect("a payload");
    check(
        &CIRCULAR[start..end],
        "",
        expect![[r#"
        Error:
          × [legs] is missing
           ╭─[bench.toml:1:1]
         1 │ version = 1
           · ─────┬─────
           ·      ╰── no [legs] in this file
         2 │ name = "bench"
           ╰────
          help: add the table [legs]; docs/platform-file.md lists its keys
    "#]],
    );
}

#[test]
fn rod_too_short() {
    check(
        "rod_length_m = 0.25",
        "rod_length_m = 0.07",
        expect![[r#"
        Error:
          × the rod is too short to reach at home (legs 1, 2, 3, 4, 5 and 6): the platform joint of leg 6 is
          │ 0.089736 m off its actuator's axis, the rod is 0.07 m long
            ╭─[bench.toml:18:16]
         17 │ actuator_axis = [0.0, 0.0, 1.0]
         18 │ rod_length_m = 0.07
            ·                ──┬─
            ·                  ╰── too short
         19 │ rod_mass_kg = 1.0
            ╰────
          help: make it longer than 0.089741 m, or move the joints, the axis or the home pose
    "#]],
    );
}

#[test]
fn rod_of_one_leg_too_short() {
    check_free(
        "number = 2\n",
        "number = 2\nrod_length_m = 0.05\n",
        expect![[r#"
        Error:
          × the rod is too short to reach at home (leg 2): the platform joint of leg 2 is 0.089443 m off its
          │ actuator's axis, the rod is 0.05 m long
            ╭─[bench.toml:33:16]
         32 │ number = 2
         33 │ rod_length_m = 0.05
            ·                ──┬─
            ·                  ╰── too short
         34 │ base_point_m = [0.16, 0.11, 0.0]
            ╰────
          help: make it longer than 0.089448 m, or move the joints, the axis or the home pose
    "#]],
    );
}

#[test]
fn rod_perpendicular() {
    check_free(
        "number = 2\n",
        "number = 2\nrod_length_m = 0.0894428\n",
        expect![[r#"
        Error:
          × the rod is perpendicular to its actuator at home (leg 2): the platform joint of leg 2 is 0.089443 m off
          │ its actuator's axis, the rod is 0.0894428 m long, so the actuator cannot push it
            ╭─[bench.toml:33:16]
         32 │ number = 2
         33 │ rod_length_m = 0.0894428
            ·                ────┬────
            ·                    ╰── only just reaches
         34 │ base_point_m = [0.16, 0.11, 0.0]
            ╰────
          help: make it longer than 0.089448 m, or move the joints, the axis or the home pose
    "#]],
    );
}
