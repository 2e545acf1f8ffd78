//! Names and leg types.

use expect_test::expect;

use crate::check;

#[test]
fn name_with_a_hyphen() {
    check(
        r#"name = "bench""#,
        r#"name = "bench-2""#,
        expect![[r#"
        Error:
          × `name` is "bench-2", which cannot name a generated module
           ╭─[bench.toml:2:8]
         1 │ version = 1
         2 │ name = "bench-2"
           ·        ────┬────
           ·            ╰── cannot name a module
         3 │ leg_type = "uhp"
           ╰────
          help: use lower-case letters, digits and underscores, a letter first: `name = "my_platform"`
    "#]],
    );
}

#[test]
fn name_that_is_a_keyword() {
    check(
        r#"name = "bench""#,
        r#"name = "fn""#,
        expect![[r#"
        Error:
          × `name` is "fn", a keyword of Rust, which cannot name a generated module
           ╭─[bench.toml:2:8]
         1 │ version = 1
         2 │ name = "fn"
           ·        ──┬─
           ·          ╰── a keyword of Rust
         3 │ leg_type = "uhp"
           ╰────
          help: choose another word, for example `name = "fn_platform"`
    "#]],
    );
}

#[test]
fn leg_type_in_capitals() {
    check(
        r#"leg_type = "uhp""#,
        r#"leg_type = "UHP""#,
        expect![[r#"
        Error:
          × `leg_type` "UHP" is unknown
           ╭─[bench.toml:3:12]
         2 │ name = "bench"
         3 │ leg_type = "UHP"
           ·            ──┬──
           ·              ╰── unknown leg type
         4 │ gravity_m_per_s2 = [0.0, 0.0, -9.81]
           ╰────
          help: did you mean "uhp"?
    "#]],
    );
}

#[test]
fn other_leg_type() {
    check(
        r#"leg_type = "uhp""#,
        r#"leg_type = "stewart""#,
        expect![[r#"
            Error:
              × `leg_type` "stewart" is unknown
               ╭─[bench.toml:3:12]
             2 │ name = "bench"
             3 │ leg_type = "stewart"
               ·            ────┬────
               ·                ╰── unknown leg type
             4 │ gravity_m_per_s2 = [0.0, 0.0, -9.81]
               ╰────
              help: leg types known here: uhp, ups
        "#]],
    );
}
