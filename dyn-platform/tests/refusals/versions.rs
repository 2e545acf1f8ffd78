//! Files of another version of the format.

use expect_test::expect;

use crate::check;

#[test]
fn newer_version() {
    check(
        "version = 1",
        "version = 2",
        expect![[r#"
            Error:
              × the file has format version 2, newer than version 1, the newest that this program knows
               ╭─[bench.toml:1:11]
             1 │ version = 2
               ·           ┬
               ·           ╰── must be 1
             2 │ name = "bench"
               ╰────
              help: install a newer dyn-gen
        "#]],
    );
}

#[test]
fn version_missing() {
    check(
        "version = 1\n",
        "",
        expect![[r#"
            Error:
              × `version` is missing in the file
               ╭─[bench.toml:1:1]
             1 │ name = "bench"
               · ───────┬──────
               ·        ╰── no `version` here
             2 │ leg_type = "uhp"
               ╰────
              help: give the version of the file format (a draft without one must first be brought into the form of
                    docs/platform-file.md), for example `version = 1`
        "#]],
    );
}

#[test]
fn version_in_quotes() {
    check(
        "version = 1",
        r#"version = "1""#,
        expect![[r#"
            Error:
              × `version` needs a whole number, found a text in quotes
               ╭─[bench.toml:1:11]
             1 │ version = "1"
               ·           ─┬─
               ·            ╰── found a text in quotes
             2 │ name = "bench"
               ╰────
              help: give the version of the file format (a draft without one must first be brought into the form of
                    docs/platform-file.md), for example `version = 1`
        "#]],
    );
}

#[test]
fn older_version() {
    check(
        "version = 1",
        "version = 0",
        expect![[r#"
            Error:
              × the file has format version 0, older than version 1 (drafts from before the format was fixed, without
              │ settled names and units)
               ╭─[bench.toml:1:11]
             1 │ version = 0
               ·           ┬
               ·           ╰── must be 1
             2 │ name = "bench"
               ╰────
              help: bring the keys into the form of docs/platform-file.md, in SI units, then write `version = 1`
        "#]],
    );
}

#[test]
fn version_that_never_was() {
    check(
        "version = 1",
        "version = -1",
        expect![[r#"
            Error:
              × there is no format version -1
               ╭─[bench.toml:1:11]
             1 │ version = -1
               ·           ─┬
               ·            ╰── must be 1
             2 │ name = "bench"
               ╰────
              help: give the version of the file format (a draft without one must first be brought into the form of
                    docs/platform-file.md), for example `version = 1`
        "#]],
    );
}
