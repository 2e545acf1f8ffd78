//! Values of the wrong type or shape.

use expect_test::expect;

use crate::{CIRCLES, CIRCULAR, check, check_text, with};

#[test]
fn number_in_quotes() {
    check(
        "mass_kg = 6.0",
        r#"mass_kg = "6.0""#,
        expect![[r#"
        Error:
          × `mass_kg` needs a number, found a text in quotes
            ╭─[bench.toml:29:11]
         28 │ [payload]
         29 │ mass_kg = "6.0"
            ·           ──┬──
            ·             ╰── found a text in quotes
         30 │ com_m = [0.0, 0.0, 0.03]
            ╰────
          help: give the mass of platform and payload together, kg, for example `mass_kg = 6.1`
    "#]],
    );
}

#[test]
fn number_for_a_vector() {
    check(
        "com_m = [0.0, 0.0, 0.03]",
        "com_m = 0.03",
        expect![[r#"
        Error:
          × `com_m` needs an array of 3 numbers, found a decimal number
            ╭─[bench.toml:30:9]
         29 │ mass_kg = 6.0
         30 │ com_m = 0.03
            ·         ──┬─
            ·           ╰── found a decimal number
         31 │ inertia_kg_m2 = [[0.02, 0.0, 0.0], [0.0, 0.02, 0.0], [0.0, 0.0, 0.03]]
            ╰────
          help: give the centre of mass of platform and payload in platform axes, m, for example `com_m = [0.0, 0.0,
                0.03]`
    "#]],
    );
}

#[test]
fn vector_too_short() {
    check(
        "com_m = [0.0, 0.0, 0.03]",
        "com_m = [0.0, 0.03]",
        expect![[r#"
        Error:
          × `com_m` needs an array of 3 numbers, found an array of 2
            ╭─[bench.toml:30:9]
         29 │ mass_kg = 6.0
         30 │ com_m = [0.0, 0.03]
            ·         ─────┬─────
            ·              ╰── found an array of 2
         31 │ inertia_kg_m2 = [[0.02, 0.0, 0.0], [0.0, 0.02, 0.0], [0.0, 0.0, 0.03]]
            ╰────
          help: give the centre of mass of platform and payload in platform axes, m, for example `com_m = [0.0, 0.0,
                0.03]`
    "#]],
    );
}

#[test]
fn text_in_a_vector() {
    check(
        "com_m = [0.0, 0.0, 0.03]",
        r#"com_m = [0.0, "x", 0.03]"#,
        expect![[r#"
        Error:
          × `com_m` needs a number, found a text in quotes
            ╭─[bench.toml:30:15]
         29 │ mass_kg = 6.0
         30 │ com_m = [0.0, "x", 0.03]
            ·               ─┬─
            ·                ╰── found a text in quotes
         31 │ inertia_kg_m2 = [[0.02, 0.0, 0.0], [0.0, 0.02, 0.0], [0.0, 0.0, 0.03]]
            ╰────
          help: give the centre of mass of platform and payload in platform axes, m, for example `com_m = [0.0, 0.0,
                0.03]`
    "#]],
    );
}

#[test]
fn inertia_as_a_diagonal() {
    check(
        "inertia_kg_m2 = [[0.02, 0.0, 0.0], [0.0, 0.02, 0.0], [0.0, 0.0, 0.03]]",
        "inertia_kg_m2 = [0.02, 0.02, 0.03]",
        expect![[r#"
            Error:
              × `inertia_kg_m2` needs an array of 3 numbers, found a decimal number
                ╭─[bench.toml:31:18]
             30 │ com_m = [0.0, 0.0, 0.03]
             31 │ inertia_kg_m2 = [0.02, 0.02, 0.03]
                ·                  ──┬─
                ·                    ╰── found a decimal number
                ╰────
              help: give the inertia about the centre of mass in platform axes, kg m^2, for example `inertia_kg_m2 =
                    [[0.02, 0.0, 0.0], [0.0, 0.02, 0.0], [0.0, 0.0, 0.03]]`
        "#]],
    );
}

#[test]
fn number_for_a_name() {
    check(
        r#"name = "bench""#,
        "name = 2016",
        expect![[r#"
        Error:
          × `name` needs a text in quotes, found a whole number
           ╭─[bench.toml:2:8]
         1 │ version = 1
         2 │ name = 2016
           ·        ──┬─
           ·          ╰── found a whole number
         3 │ leg_type = "uhp"
           ╰────
          help: give a short name in lower case, for example `name = "my_platform"`
    "#]],
    );
}

#[test]
fn truth_for_a_number() {
    check(
        "rod_com_fraction = 0.5",
        "rod_com_fraction = true",
        expect![[r#"
        Error:
          × `rod_com_fraction` needs a number, found true or false
            ╭─[bench.toml:21:20]
         20 │ rod_inertia_kg_m2 = 0.005
         21 │ rod_com_fraction = true
            ·                    ──┬─
            ·                      ╰── found true or false
         22 │ mover_mass_kg = 0.6
            ╰────
          help: give the place of the rod's centre of mass between Hooke joint (0) and platform joint (1), for
                example `rod_com_fraction = 0.5`
    "#]],
    );
}

#[test]
fn date_for_a_description() {
    check(
        r#"name = "bench""#,
        "name = \"bench\"\ndescription = 2016-11-01",
        expect![[r#"
        Error:
          × `description` needs a text in quotes, found a date or time
           ╭─[bench.toml:3:15]
         2 │ name = "bench"
         3 │ description = 2016-11-01
           ·               ─────┬────
           ·                    ╰── found a date or time
         4 │ leg_type = "uhp"
           ╰────
          help: give a sentence for people, for example `description = "test bench"`
    "#]],
    );
}

#[test]
fn value_for_a_table() {
    check(
        "name = \"bench\"\n",
        "name = \"bench\"\nleg = 6\n",
        expect![[r#"
        Error:
          × `leg` needs an array of tables, found a whole number
           ╭─[bench.toml:3:7]
         2 │ name = "bench"
         3 │ leg = 6
           ·       ┬
           ·       ╰── found a whole number
         4 │ leg_type = "uhp"
           ╰────
          help: give one table per leg, for example `[[leg]]`
    "#]],
    );
}

#[test]
fn table_for_an_array_of_tables() {
    check(
        "[payload]",
        "[leg]\nnumber = 1\n[payload]",
        expect![[r#"
        Error:
          × `leg` needs an array of tables, found a table
            ╭─[bench.toml:28:1]
         27 │
         28 │ [leg]
            · ──┬──
            ·   ╰── found a table
         29 │ number = 1
            ╰────
          help: give one table per leg, for example `[[leg]]`
    "#]],
    );
}

#[test]
fn number_among_the_legs() {
    check(
        "name = \"bench\"\n",
        "name = \"bench\"\nleg = [1]\n",
        expect![[r#"
        Error:
          × `leg` needs a table, found a whole number
           ╭─[bench.toml:3:8]
         2 │ name = "bench"
         3 │ leg = [1]
           ·        ┬
           ·        ╰── found a whole number
         4 │ leg_type = "uhp"
           ╰────
          help: give one table per leg, for example `[[leg]]`
    "#]],
    );
}

#[test]
fn fraction_of_a_leg_number() {
    check(
        "[payload]",
        "[[leg]]\nnumber = 1.5\n[payload]",
        expect![[r#"
        Error:
          × `number` needs a whole number, found a decimal number
            ╭─[bench.toml:29:10]
         28 │ [[leg]]
         29 │ number = 1.5
            ·          ─┬─
            ·           ╰── found a decimal number
         30 │ [payload]
            ╰────
          help: give the number of the leg, 1 to 6, for example `number = 1`
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
