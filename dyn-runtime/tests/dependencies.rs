//! Without features, nothing that this crate depends on is built for `std` or with an allocator.
//!
//! Cargo is asked, because the answer depends on how it unites features: for this package alone, without the
//! rest of the workspace and without what only tests need.

use std::env;
use std::io::ErrorKind;
use std::process::Command;

/// Features that stand for the standard library or a heap, by the names that the dependencies give them.
const HOSTED: &[&str] = &["std", "alloc", "use_std", "use_alloc"];

/// The packages of the tree, and `package feature` for every hosted feature in it; `None` without cargo.
fn hosted_features(options: &[&str]) -> Option<(Vec<String>, Vec<String>)> {
    let cargo = env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let output = Command::new(cargo)
        .args(["tree", "--offline", "--package", "dyn-runtime", "--edges", "normal", "--prefix", "none"])
        .args(["--no-dedupe", "--format", "{p}|{f}", "--color", "never"])
        .args(["--manifest-path", concat!(env!("CARGO_MANIFEST_DIR"), "/Cargo.toml")])
        .args(options)
        .output();
    let output = match output {
        Ok(output) => output,
        Err(error) if error.kind() == ErrorKind::NotFound => return None,
        Err(error) => panic!("cargo tree: {error}"),
    };
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "cargo tree: {errors}");
    let tree = String::from_utf8(output.stdout).expect("UTF-8");

    let mut packages = Vec::new();
    let mut hosted = Vec::new();
    for line in tree.lines() {
        let (package, features) = line.split_once('|').expect("the format that was asked for");
        let name = package.split_whitespace().next().expect("a name");
        packages.push(name.to_owned());
        let of_the_host = features.split(',').filter(|feature| HOSTED.contains(feature));
        hosted.extend(of_the_host.map(|feature| format!("{name} {feature}")));
    }
    Some((packages, hosted))
}

#[test]
fn no_dependency_is_built_for_std_or_alloc() {
    let Some((packages, hosted)) = hosted_features(&["--no-default-features"]) else {
        println!("skipped: no cargo to ask for the features of the dependencies");
        return;
    };
    assert!(hosted.is_empty(), "{hosted:?}");
    for expected in ["dyn-runtime", "libm", "nalgebra", "num-traits", "simba"] {
        assert!(packages.iter().any(|package| package == expected), "{expected} is not in {packages:?}");
    }
    // What is looked for can be seen.
    let (_, hosted) = hosted_features(&["--features", "std"]).expect("cargo was there");
    assert_eq!(hosted, ["dyn-runtime std"]);
}
