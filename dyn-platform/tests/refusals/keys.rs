//! Keys: unknown, misspelt, misplaced.

use expect_test::expect;

use crate::{check, check_free};

#[test]
fn misspelt_key() {
    check(
        "rod_length_m",
        "rod_lenght_m",
        expect![[r#"
        Error:
          × unknown key `rod_lenght_m` in [legs]
            ╭─[bench.toml:18:1]
         17 │ actuator_axis = [0.0, 0.0, 1.0]
         18 │ rod_lenght_m = 0.25
            · ──────┬─────
            ·       ╰── unknown key
         19 │ rod_mass_kg = 1.0
            ╰────
          help: did you mean `rod_length_m`?
    "#]],
    );
}

#[test]
fn misspelt_table() {
    check(
        "[payload]",
        "[playload]",
        expect![[r#"
        Error:
          × unknown key `playload` in the file
            ╭─[bench.toml:28:2]
         27 │
         28 │ [playload]
            ·  ────┬───
            ·      ╰── unknown key
         29 │ mass_kg = 6.0
            ╰────
          help: did you mean `payload`?
    "#]],
    );
}

#[test]
fn misspelt_key_of_the_file() {
    check(
        "gravity_m_per_s2",
        "gravity_m_per_s",
        expect![[r#"
        Error:
          × unknown key `gravity_m_per_s` in the file
           ╭─[bench.toml:4:1]
         3 │ leg_type = "uhp"
         4 │ gravity_m_per_s = [0.0, 0.0, -9.81]
           · ───────┬───────
           ·        ╰── unknown key
         5 │
           ╰────
          help: did you mean `gravity_m_per_s2`?
    "#]],
    );
}

#[test]
fn unit_missing_in_key() {
    check(
        "base_radius_m =",
        "base_radius =",
        expect![[r#"
        Error:
          × unknown key `base_radius` in [circular_layout]
            ╭─[bench.toml:11:1]
         10 │ [circular_layout]
         11 │ base_radius = 0.2
            · ─────┬─────
            ·      ╰── unknown key
         12 │ platform_radius_m = 0.13
            ╰────
          help: did you mean `base_radius_m`?
    "#]],
    );
}

#[test]
fn key_in_the_wrong_table() {
    check(
        "[payload]\n",
        "[payload]\nrod_mass_kg = 1.0\n",
        expect![[r#"
        Error:
          × unknown key `rod_mass_kg` in [payload]
            ╭─[bench.toml:29:1]
         28 │ [payload]
         29 │ rod_mass_kg = 1.0
            · ─────┬─────
            ·      ╰── unknown key
         30 │ mass_kg = 6.0
            ╰────
          help: `rod_mass_kg` belongs in [legs] or [[leg]]
    "#]],
    );
}

#[test]
fn key_like_no_other() {
    check(
        "[home]\n",
        "[home]\ncolour = 3\n",
        expect![[r#"
        Error:
          × unknown key `colour` in [home]
           ╭─[bench.toml:7:1]
         6 │ [home]
         7 │ colour = 3
           · ───┬──
           ·    ╰── unknown key
         8 │ position_m = [0.0, 0.0, 0.4]
           ╰────
          help: keys known here: position_m, rotation
    "#]],
    );
}

#[test]
fn misspelt_key_of_one_leg() {
    check_free(
        "number = 3\nbase_point_m",
        "number = 3\nbase_pint_m",
        expect![[r#"
        Error:
          × unknown key `base_pint_m` in [[leg]]
            ╭─[bench.toml:37:1]
         36 │ number = 3
         37 │ base_pint_m = [0.02, 0.19, 0.0]
            · ─────┬─────
            ·      ╰── unknown key
         38 │ platform_point_m = [-0.03, 0.12, 0.0]
            ╰────
          help: did you mean `base_point_m`?
    "#]],
    );
}

#[test]
fn misspelt_leg_table() {
    check_free(
        "[[leg]]\nnumber = 1\n",
        "[[legg]]\nnumber = 1\n",
        expect![[r#"
        Error:
          × unknown key `legg` in the file
            ╭─[bench.toml:27:3]
         26 │
         27 │ [[legg]]
            ·   ──┬─
            ·     ╰── unknown key
         28 │ number = 1
            ╰────
          help: did you mean `leg`?
    "#]],
    );
}

#[test]
fn misspelt_layout() {
    check(
        "[circular_layout]",
        "[circle_layout]",
        expect![[r#"
        Error:
          × unknown key `circle_layout` in the file
            ╭─[bench.toml:10:2]
          9 │
         10 │ [circle_layout]
            ·  ──────┬──────
            ·        ╰── unknown key
         11 │ base_radius_m = 0.2
            ╰────
          help: did you mean `circular_layout`?
    "#]],
    );
}
