//! How long things take. Not part of the ordinary tests, because other work on the machine decides as well:
//!
//! ```sh
//! cargo test --release -p dyn-gen --test figures -- --ignored --nocapture --test-threads 1
//! ```

mod common;

use std::fs;
use std::path::Path;
use std::process::Command;
use std::time::Instant;

const PLATFORM: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../platforms/uhp_2016.toml");
const RUNS: usize = 7;

/// Median and least time in s of the tool with these arguments.
fn time(folder: &Path, arguments: &[&str]) -> (f64, f64) {
    let mut times: Vec<f64> = (0..RUNS)
        .map(|_| {
            let started = Instant::now();
            let result = common::cli::dyn_gen(folder, arguments);
            assert_eq!(common::cli::code(&result), 0, "{}", common::cli::said(&result));
            started.elapsed().as_secs_f64()
        })
        .collect();
    times.sort_by(f64::total_cmp);
    (times[RUNS / 2], times[0])
}

#[test]
#[ignore = "a measurement"]
fn generate_and_check() {
    let folder = tempfile::tempdir().unwrap();
    let generate = ["generate", PLATFORM, "-o", "model.rs"];
    for (what, arguments, limit) in [
        ("generate, all functions, 1000 states", [&generate[..], &[]].concat(), 0.5),
        ("generate, all functions, no evidence", [&generate[..], &["--no-evidence"]].concat(), 0.1),
        ("check", vec!["check", PLATFORM, "model.rs"], 0.5),
    ] {
        let (median, least) = time(folder.path(), &arguments);
        println!("{what}: median {median:.3} s, least {least:.3} s of {RUNS} runs (goal {limit} s)");
    }
}

/// rustc on the file of all functions, by cargo in a crate of its own, dependencies compiled before.
#[test]
#[ignore = "a measurement"]
fn rustc_on_the_generated_file() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("src")).unwrap();
    let root = common::root().canonicalize().unwrap();
    let manifest = format!(
        "[package]\nname = \"timed\"\nversion = \"0.1.0\"\nedition = \"2024\"\n[dependencies]\ndyn-runtime = {{ path = {:?} }}\n[workspace]\n",
        root.join("dyn-runtime")
    );
    fs::write(folder.path().join("Cargo.toml"), manifest).unwrap();
    fs::copy(root.join("Cargo.lock"), folder.path().join("Cargo.lock")).unwrap();
    let build = |profile: &[&str]| {
        let mut cargo = Command::new(env!("CARGO"));
        cargo.args(["build", "--quiet"]).args(profile).current_dir(folder.path());
        cargo.env("CARGO_TARGET_DIR", folder.path().join("target")).env("CARGO_PROFILE_DEV_DEBUG", "full");
        let started = Instant::now();
        assert!(cargo.status().unwrap().success());
        started.elapsed().as_secs_f64()
    };
    let source = folder.path().join("src/lib.rs");
    for (what, profile) in [("release", &["--release"][..]), ("dev with debug information", &[])] {
        fs::write(&source, "").unwrap();
        build(profile);
        let arguments = ["generate", PLATFORM, "-o", "src/model.rs", "--no-evidence"];
        assert_eq!(common::cli::code(&common::cli::dyn_gen(folder.path(), &arguments)), 0);
        fs::write(&source, "pub mod model;\n").unwrap();
        println!("rustc, {what}: {:.2} s (goal 3 s)", build(profile));
    }
}
