//! The file as a whole: unreadable, empty, with several mistakes.

use std::fs;

use dyn_platform::Platform;
use expect_test::expect;

use crate::{CIRCULAR, check, check_text, rendered, with};

#[test]
fn vanished_file() {
    let error = Platform::from_file("no/such/platform.toml").expect_err("no such file");
    expect![[r#"
        Error:
          × cannot read the platform file `no/such/platform.toml`: No such file or directory (os error 2)
          help: check the path and its permissions; `dyn-gen init` prints an example
    "#]]
    .assert_eq(&rendered(&error));
}

#[test]
fn not_utf8() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("latin1.toml");
    fs::write(&path, b"version = 1\nname = \"b\xe9b\xe9\"\n").expect("a writable folder");
    let error = Platform::from_file(&path).expect_err("not UTF-8");
    let shown = rendered(&error).replace(&path.display().to_string(), "latin1.toml");
    expect![[r#"
        Error:
          × the platform file is not UTF-8 text
           ╭─[latin1.toml:2:10]
         1 │ version = 1
         2 │ name = "b�b�"
           ·          ┬
           ·          ╰── not UTF-8 from here
           ╰────
          help: save it as UTF-8
    "#]]
    .assert_eq(&shown);
}

#[test]
fn empty_file() {
    check_text(
        "",
        expect![[r#"
        Error:
          × the platform file is empty
           ╭─[bench.toml:1:1]
           ╰────
          help: start from a copy of platforms/uhp_2016.toml; docs/platform-file.md describes the format
    "#]],
    );
}

#[test]
fn only_comments() {
    check_text(
        "# nothing yet\n\n",
        expect![[r#"
        Error:
          × the platform file is empty
           ╭─[bench.toml:1:1]
         1 │ # nothing yet
           · ──────┬──────
           ·       ╰── no key in this file
         2 │
           ╰────
          help: start from a copy of platforms/uhp_2016.toml; docs/platform-file.md describes the format
    "#]],
    );
}

#[test]
fn syntax_error() {
    check(
        "mass_kg = 6.0",
        "mass_kg = = 6.0",
        expect![[r#"
        Error:
          × this is not TOML: extra `=`, expected nothing
            ╭─[bench.toml:29:11]
         28 │ [payload]
         29 │ mass_kg = = 6.0
            ·           ┬
            ·           ╰── here
         30 │ com_m = [0.0, 0.0, 0.03]
            ╰────
          help: mend the syntax; https://toml.io describes it, `dyn-gen init` prints an example
    "#]],
    );
}

#[test]
fn key_given_twice() {
    check(
        "rod_mass_kg = 1.0",
        "rod_mass_kg = 1.0\nrod_mass_kg = 1.1",
        expect![[r#"
        Error:
          × this is not TOML: duplicate key
            ╭─[bench.toml:20:1]
         19 │ rod_mass_kg = 1.0
         20 │ rod_mass_kg = 1.1
            · ─────┬─────
            ·      ╰── here
         21 │ rod_inertia_kg_m2 = 0.005
            ╰────
          help: mend the syntax; https://toml.io describes it, `dyn-gen init` prints an example
    "#]],
    );
}

#[test]
fn several_mistakes_at_once() {
    check_text(
        &with(&with(CIRCULAR, "mass_kg = 1.0", "mass_kg = -1.0"), "com_m", "con_m"),
        expect![[r#"
        Error:
          × bench.toml: 2 mistakes

        Error:
          × `rod_mass_kg` must be positive, but is -1
            ╭─[bench.toml:19:15]
         18 │ rod_length_m = 0.25
         19 │ rod_mass_kg = -1.0
            ·               ──┬─
            ·                 ╰── must be positive
         20 │ rod_inertia_kg_m2 = 0.005
            ╰────
          help: give the mass of one rod, kg, for example `rod_mass_kg = 1.024`

        Error:
          × unknown key `con_m` in [payload]
            ╭─[bench.toml:30:1]
         29 │ mass_kg = 6.0
         30 │ con_m = [0.0, 0.0, 0.03]
            · ──┬──
            ·   ╰── unknown key
         31 │ inertia_kg_m2 = [[0.02, 0.0, 0.0], [0.0, 0.02, 0.0], [0.0, 0.0, 0.03]]
            ╰────
          help: did you mean `com_m`?
    "#]],
    );
}
