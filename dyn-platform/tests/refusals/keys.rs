//! Keys: unknown, misspelt, misplaced, missing.

use expect_test::expect;

use crate::{CIRCLES, CIRCULAR, check, check_free, check_text, free, with};

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
fn name_missing() {
    check(
        "name = \"bench\"\n",
        "",
        expect![[r#"
        Error:
          × `name` is missing in the file
           ╭─[bench.toml:1:1]
         1 │ version = 1
           · ─────┬─────
           ·      ╰── no `name` here
         2 │ leg_type = "uhp"
           ╰────
          help: give a short name in lower case, for example `name = "my_platform"`
    "#]],
    );
}

#[test]
fn home_missing() {
    check(
        "[home]\nposition_m = [0.0, 0.0, 0.4]\nrotation = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]\n",
        "",
        expect![[r#"
            Error:
              × [home] is missing
               ╭─[bench.toml:1:1]
             1 │ version = 1
               · ─────┬─────
               ·      ╰── no [home] in this file
             2 │ name = "bench"
               ╰────
              help: add the table [home]; docs/platform-file.md lists its keys
        "#]],
    );
}

#[test]
fn position_missing() {
    check(
        "position_m = [0.0, 0.0, 0.4]\n",
        "",
        expect![[r#"
        Error:
          × `position_m` is missing in [home]
           ╭─[bench.toml:6:1]
         5 │
         6 │ [home]
           · ───┬──
           ·    ╰── no `position_m` here
         7 │ rotation = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
           ╰────
          help: give the position of the platform's origin at home in base axes, m, for example `position_m = [0.0,
                0.0, 0.4]`
    "#]],
    );
}

#[test]
fn radius_missing() {
    check(
        "platform_radius_m = 0.13\n",
        "",
        expect![[r#"
        Error:
          × `platform_radius_m` is missing in [circular_layout]
            ╭─[bench.toml:10:1]
          9 │
         10 │ [circular_layout]
            · ────────┬────────
            ·         ╰── no `platform_radius_m` here
         11 │ base_radius_m = 0.2
            ╰────
          help: give the radius of the platform's joint circle, m, for example `platform_radius_m = 0.12`
    "#]],
    );
}

#[test]
fn leg_property_missing() {
    check(
        "rod_mass_kg = 1.0\n",
        "",
        expect![[r#"
        Error:
          × `rod_mass_kg` is missing: neither [legs] nor every leg has it
            ╭─[bench.toml:16:1]
         15 │
         16 │ [legs]
            · ───┬──
            ·    ╰── no `rod_mass_kg` here
         17 │ actuator_axis = [0.0, 0.0, 1.0]
            ╰────
          help: give the mass of one rod, kg, for example `rod_mass_kg = 1.024`
    "#]],
    );
}

#[test]
fn property_missing_in_one_leg() {
    let mut text = with(&free(), "rod_mass_kg = 1.0\n", "");
    for number in [1, 2, 4, 5, 6] {
        text =
            with(&text, &format!("number = {number}\n"), &format!("number = {number}\nrod_mass_kg = 1.0\n"));
    }
    check_text(
        &text,
        expect![[r#"
        Error:
          × `rod_mass_kg` is missing in leg 3
            ╭─[bench.toml:36:1]
         35 │ platform_point_m = [0.12, 0.03, 0.0]
         36 │ [[leg]]
            · ───┬───
            ·    ╰── no `rod_mass_kg` here
         37 │ number = 3
            ╰────
          help: give the mass of one rod, kg, for example `rod_mass_kg = 1.024`
    "#]],
    );
}

#[test]
fn property_missing_in_the_legs_without_a_table() {
    let text = with(CIRCULAR, "rod_mass_kg = 1.0\n", "") + "[[leg]]\nnumber = 3\nrod_mass_kg = 1.0\n";
    check_text(
        &text,
        expect![[r#"
        Error:
          × `rod_mass_kg` is missing: neither [legs] nor every leg has it
            ╭─[bench.toml:16:1]
         15 │
         16 │ [legs]
            · ───┬──
            ·    ╰── no `rod_mass_kg` here
         17 │ actuator_axis = [0.0, 0.0, 1.0]
            ╰────
          help: give the mass of one rod, kg, for example `rod_mass_kg = 1.024`
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

#[test]
fn leg_number_beyond_all_size() {
    check(
        "[payload]",
        "[[leg]]\nnumber = 99999999999999999999\n[payload]",
        expect![[r#"
        Error:
          × `number` needs a whole number of ordinary size
            ╭─[bench.toml:29:10]
         28 │ [[leg]]
         29 │ number = 99999999999999999999
            ·          ──────────┬─────────
            ·                    ╰── too large
         30 │ [payload]
            ╰────
          help: give the number of the leg, 1 to 6, for example `number = 1`
    "#]],
    );
}

#[test]
fn number_for_a_layout() {
    let text = with(CIRCULAR, CIRCLES, "");
    check_text(
        &with(&text, "[home]", "circular_layout = 0.2\n[home]"),
        expect![[r#"
        Error:
          × `circular_layout` needs a table, found a decimal number
           ╭─[bench.toml:6:19]
         5 │
         6 │ circular_layout = 0.2
           ·                   ─┬─
           ·                    ╰── found a decimal number
         7 │ [home]
           ╰────
          help: give the table of the joint circles, for example `[circular_layout]`
    "#]],
    );
}

#[test]
fn zero_inertia() {
    let (good, bad) =
        ("[[0.02, 0.0, 0.0], [0.0, 0.02, 0.0], [0.0, 0.0, 0.03]]", "[[0, 0, 0], [0, 0, 0], [0, 0, 0]]");
    check(
        good,
        bad,
        expect![[r#"
        Error:
          × `inertia_kg_m2` is not positive definite: its principal moments are 0.0000e0, 0.0000e0 and 0.0000e0 kg
          │ m^2
            ╭─[bench.toml:31:17]
         30 │ com_m = [0.0, 0.0, 0.03]
         31 │ inertia_kg_m2 = [[0, 0, 0], [0, 0, 0], [0, 0, 0]]
            ·                 ────────────────┬────────────────
            ·                                 ╰── not positive definite
            ╰────
          help: check the signs and sizes off the diagonal; every principal moment must be positive
    "#]],
    );
}

#[test]
fn point_missing_in_one_leg() {
    check_free(
        "platform_point_m = [-0.09, 0.09, 0.0]\n",
        "",
        expect![[r#"
        Error:
          × `platform_point_m` is missing in leg 4
            ╭─[bench.toml:39:1]
         38 │ platform_point_m = [-0.03, 0.12, 0.0]
         39 │ [[leg]]
            · ───┬───
            ·    ╰── no `platform_point_m` here
         40 │ number = 4
            ╰────
          help: give the platform joint in platform axes, m, for example `platform_point_m = [0.1, -0.03, 0.0]`
    "#]],
    );
}

#[test]
fn payload_inertia_missing() {
    check(
        "inertia_kg_m2 = [[0.02, 0.0, 0.0], [0.0, 0.02, 0.0], [0.0, 0.0, 0.03]]\n",
        "",
        expect![[r#"
        Error:
          × `inertia_kg_m2` is missing in [payload]
            ╭─[bench.toml:28:1]
         27 │
         28 │ [payload]
            · ────┬────
            ·     ╰── no `inertia_kg_m2` here
         29 │ mass_kg = 6.0
            ╰────
          help: give the inertia about the centre of mass in platform axes, kg m^2, for example `inertia_kg_m2 =
                [[0.02, 0.0, 0.0], [0.0, 0.02, 0.0], [0.0, 0.0, 0.03]]`
    "#]],
    );
}
