//! C programs, compiled strictly, linked statically and dynamically, run. In single precision with
//! `cargo test -p dyn-capi --features f32 --test c_programs`.
#![cfg(unix)]

mod support;

use std::fs;
use std::process::Command;

use support::{Link, compile, compile_with, compiler, folder, program, records, succeed};

const LINKS: [Link; 2] = [Link::Static, Link::Dynamic];

#[test]
fn first_call() {
    let scratch = tempfile::tempdir().unwrap();
    for link in LINKS {
        let path = compile(&folder().join("examples/first_call.c"), link, scratch.path());
        let output = succeed(&mut program(&path));
        let text = String::from_utf8(output.stdout).unwrap();
        assert!(text.starts_with("platform uhp_2016\n"), "{text}");
    }
}

#[test]
fn every_call_agrees_with_the_vectors_of_the_engines() {
    let scratch = tempfile::tempdir().unwrap();
    let file = scratch.path().join("vectors.txt");
    let good = records();
    // The comparison must be able to fail: one digit of one number.
    let bad = scratch.path().join("broken.txt");
    let (before, after) = good.split_once("output inverse_dynamics 7 0e0 ").expect("a record");
    fs::write(&bad, format!("{before}output inverse_dynamics 7 0e0 1{after}")).unwrap();
    fs::write(&file, good).unwrap();
    for link in LINKS {
        let path = compile(&folder().join("tests/c/vectors.c"), link, scratch.path());
        let output = succeed(program(&path).arg(&file));
        let text = String::from_utf8(output.stdout).unwrap();
        let arrays: usize = text.split(' ').next().and_then(|count| count.parse().ok()).expect("a count");
        assert!(arrays > 1000, "{text}");
        assert!(!program(&path).arg(&bad).output().unwrap().status.success(), "a wrong number passes");
    }
}

#[test]
fn every_refusal() {
    let scratch = tempfile::tempdir().unwrap();
    for link in LINKS {
        succeed(&mut program(&compile(&folder().join("tests/c/refusals.c"), link, scratch.path())));
    }
}

#[test]
fn calls_of_a_control_loop() {
    let scratch = tempfile::tempdir().unwrap();
    for link in LINKS {
        succeed(&mut program(&compile(&folder().join("tests/c/control.c"), link, scratch.path())));
    }
}

/// Against a stub of Simulink's header: it compiles, and what it computes is what the library computes.
#[test]
fn s_function() {
    let scratch = tempfile::tempdir().unwrap();
    let stub = folder().join("tests/simulink");
    for link in LINKS {
        let arguments = ["-I".as_ref(), stub.as_os_str()];
        let source = folder().join("simulink/dyn_platform.c");
        succeed(&mut program(&compile_with(&arguments, &source, link, scratch.path())));
    }
}

/// The blocks of C in the chapter about control loops, one after another, and a cycle of what they make.
#[test]
fn documented_control_loop() {
    let scratch = tempfile::tempdir().unwrap();
    let chapter = fs::read_to_string(folder().join("../docs/control-loop.md")).unwrap();
    let blocks: Vec<&str> =
        chapter.split("```c\n").skip(1).filter_map(|text| text.split("```").next()).collect();
    assert!(blocks.len() >= 4, "{} blocks", blocks.len());
    let source = scratch.path().join("control_loop.c");
    let main = fs::read_to_string(folder().join("tests/c/control_loop_main.c")).unwrap();
    fs::write(&source, blocks.join("\n") + &main).unwrap();
    for link in LINKS {
        succeed(&mut program(&compile(&source, link, scratch.path())));
    }
}

/// A library with a platform file of the user's: the vectors of that platform, by the baked model; its limits and coils.
#[test]
#[ignore = "builds the library anew, some minutes: cargo test -p dyn-capi --test c_programs -- --ignored"]
fn own_platform() {
    let scratch = tempfile::tempdir().unwrap();
    let root = folder().join("..").canonicalize().unwrap();
    let target = root.join("target/own-platform");
    let platform = scratch.path().join("platform.toml");
    let everything = fs::read_to_string(root.join("tests/platforms/everything.toml")).unwrap();
    let limits = "[legs]\nmaximum_force_n = 100.0\nforce_constant_n_per_a = 40.0\n\n[payload]";
    let limited = everything.replacen("[payload]", limits, 1);
    assert_ne!(limited, everything);
    fs::write(&platform, limited).unwrap();
    succeed(
        Command::new(env!("CARGO"))
            .args(["build", "--package", "dyn-capi", "--features", "own-platform", "--target-dir"])
            .arg(&target)
            .env("DYN_PLATFORM", &platform)
            .current_dir(&root),
    );
    let file = scratch.path().join("vectors.txt");
    fs::write(&file, records()).unwrap();
    let library = target.join("debug/libdyn_capi.a");
    let build = |name: &str| {
        let (source, path) =
            (folder().join("tests/c").join(name), scratch.path().join(name).with_extension(""));
        succeed(compiler().arg(source).arg("-o").arg(&path).arg(&library).args(["-lm", "-lpthread", "-ldl"]));
        path
    };
    succeed(program(&build("vectors.c")).arg(&file));
    assert_eq!(succeed(&mut program(&build("own_platform.c"))).stdout, b"everything 100 40 2.5\n");
}
