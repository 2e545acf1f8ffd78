//! Keys and tables that are missing.

use expect_test::expect;

use crate::{CIRCULAR, check, check_free, check_text, free, with};

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
