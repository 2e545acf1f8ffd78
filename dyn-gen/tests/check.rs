//! `dyn-gen check`: what is up to date, what is not, and what to do about it.

mod common;

use std::fs;
use std::path::Path;

use common::cli::{code, dyn_gen, entries, said, words};

const PLATFORM: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../platforms/uhp_2016.toml");

/// A folder with the platform file and a model made of it with these options.
fn place(options: &[&str]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::copy(PLATFORM, folder.path().join("my platform.toml")).unwrap();
    let arguments = [&["generate", "my platform.toml", "-o", "model.rs"][..], options].concat();
    let result = dyn_gen(folder.path(), &arguments);
    assert_eq!(code(&result), 0, "{}", said(&result));
    folder
}

fn replace(path: &Path, from: &str, to: &str) {
    let text = fs::read_to_string(path).unwrap();
    assert!(text.contains(from), "no `{from}` in {}", path.display());
    fs::write(path, text.replacen(from, to, 1)).unwrap();
}

#[test]
fn a_model_is_checked_with_the_options_in_its_first_lines() {
    let few = ["--functions", "rod_alignment,bias"];
    let cases: [&[&str]; 5] = [
        &["--no-evidence"],
        &["--states", "30"],
        &["--seed", "7", "--runtime", "payload,legs.k_e"],
        &["--model", "other", "--runtime-path", "::dyn_runtime::inner"],
        &["--runtime", "all", "--states", "9"],
    ];
    for options in cases {
        let folder = place(&[&few[..], options].concat());
        let check = || dyn_gen(folder.path(), &["check", "my platform.toml", "model.rs"]);
        let result = check();
        assert_eq!(code(&result), 0, "{options:?}: {}", said(&result));
        assert_eq!(said(&result), "model.rs is what my platform.toml gives\n");
        let before = entries(folder.path());
        replace(&folder.path().join("my platform.toml"), "mass_kg = 6.092 ", "mass_kg = 6.093 ");
        let result = check();
        assert_eq!(code(&result), 1, "{options:?}");
        assert!(
            words(&result).starts_with("model.rs is not what my platform.toml gives: line "),
            "{}",
            said(&result)
        );
        assert!(!said(&result).contains("edited"), "{}", said(&result));
        let command = [
            "make it again with\n  dyn-gen generate 'my platform.toml' -o model.rs",
            "--functions rod_alignment,bias",
        ];
        for part in command {
            assert!(said(&result).contains(part), "{}", said(&result));
        }
        for option in options {
            assert!(said(&result).contains(option), "{option} is not in the command: {}", said(&result));
        }
        assert_eq!(entries(folder.path()), before);
    }
}

#[test]
fn a_file_that_was_edited_is_not_what_the_platform_gives() {
    let folder = place(&["--functions", "rod_alignment", "--no-evidence"]);
    replace(&folder.path().join("model.rs"), "t1 ", "t1  ");
    let result = dyn_gen(folder.path(), &["check", "my platform.toml", "model.rs"]);
    assert_eq!(code(&result), 1);
    let text = fs::read_to_string(folder.path().join("model.rs")).unwrap();
    let line = 1 + text.lines().position(|line| line.contains("t1  ")).unwrap();
    assert!(said(&result).contains(&format!("line {line} is the first that differs")), "{}", said(&result));
    assert!(
        words(&result).contains("numbers and options are the same, so it was edited"),
        "{}",
        said(&result)
    );
}

#[test]
fn files_of_other_origin_are_refused_with_the_command_that_makes_them() {
    let folder = place(&["--functions", "rod_alignment", "--no-evidence"]);
    let check = |file: &str| {
        let result = dyn_gen(folder.path(), &["check", "my platform.toml", file]);
        assert_eq!(code(&result), 1, "{}", said(&result));
        words(&result)
    };
    fs::write(folder.path().join("own.rs"), "fn main() {}\n").unwrap();
    let own = check("own.rs");
    assert!(own.contains("own.rs was not written by `dyn-gen generate`: its first line is another"), "{own}");
    assert!(own.contains("help: write it with `dyn-gen generate 'my platform.toml' -o own.rs`"), "{own}");
    fs::write(folder.path().join("empty.rs"), "").unwrap();
    assert!(check("empty.rs").contains("its first line is another"));
    let missing = check("missing.rs");
    assert!(missing.contains("cannot read missing.rs: there is no such file"), "{missing}");
    assert!(
        missing.contains("or write it with `dyn-gen generate 'my platform.toml' -o missing.rs`"),
        "{missing}"
    );
    let swapped = words(&dyn_gen(folder.path(), &["check", "model.rs", "my platform.toml"]));
    assert!(swapped.contains("help: give the platform file first"), "{swapped}");
    for (command, mention) in [
        ("cargo regen", "it was made with `cargo regen`"),
        ("dyn-gen generate a.toml", "is not one of this version"),
        ("dyn-gen generate a.toml -o b.rs --unknown 3", "is not one of this version"),
        ("dyn-gen generate 'a.toml -o b.rs", "it was made with `dyn-gen generate 'a.toml -o b.rs`"),
    ] {
        let first = "// @generated by dyn-gen 9.9.9. Do not edit; make it again with\n";
        fs::write(folder.path().join("odd.rs"), format!("{first}//     {command}\n")).unwrap();
        let odd = check("odd.rs");
        assert!(odd.contains(mention), "{command}: {odd}");
    }
}

#[test]
fn a_graph_file_must_be_given_again() {
    let folder = tempfile::tempdir().unwrap();
    fs::copy(PLATFORM, folder.path().join("p.toml")).unwrap();
    fs::copy(common::root().join("codegen/graphs/uhp.json"), folder.path().join("g.json")).unwrap();
    let options = ["--functions", "rod_alignment", "--no-evidence", "--graph", "g.json"];
    let result = dyn_gen(folder.path(), &[&["generate", "p.toml", "-o", "m.rs"][..], &options].concat());
    assert_eq!(code(&result), 0, "{}", said(&result));
    let result = dyn_gen(folder.path(), &["check", "p.toml", "m.rs"]);
    assert_eq!(code(&result), 1);
    assert!(words(&result).contains("m.rs was made with the graph file g.json"), "{}", words(&result));
    assert!(words(&result).contains("help: give it: --graph g.json"));
    assert_eq!(code(&dyn_gen(folder.path(), &["check", "p.toml", "m.rs", "--graph", "g.json"])), 0);
}
