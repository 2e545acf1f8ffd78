//! The example crates, built and run the way a user's crate is: from outside the workspace.

mod common;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::time::Instant;

use common::cli::{code, dyn_gen, said};

/// A copy of an example outside the repository, its path dependencies pointing back into it.
struct Crate {
    folder: tempfile::TempDir,
    name: &'static str,
}

fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to).unwrap();
    for entry in fs::read_dir(from).unwrap() {
        let entry = entry.unwrap();
        let target = to.join(entry.file_name());
        if entry.file_type().unwrap().is_dir() {
            copy(&entry.path(), &target);
        } else {
            fs::copy(entry.path(), target).unwrap();
        }
    }
}

impl Crate {
    fn new(name: &'static str) -> Crate {
        let root = common::root().canonicalize().unwrap();
        let folder = tempfile::tempdir().unwrap();
        copy(&root.join("examples").join(name), folder.path());
        let manifest = folder.path().join("Cargo.toml");
        let text = fs::read_to_string(&manifest).unwrap();
        assert!(text.contains("path = \"../../"));
        fs::write(&manifest, text.replace("path = \"../../", &format!("path = \"{}/", root.display())))
            .unwrap();
        // The versions that this repository was tested with.
        fs::copy(root.join("Cargo.lock"), folder.path().join("Cargo.lock")).unwrap();
        Crate { folder, name }
    }

    fn path(&self, file: &str) -> PathBuf {
        self.folder.path().join(file)
    }

    /// Shared by all runs of these tests, so that dependencies are compiled once.
    fn cargo(&self, command: &str) -> Output {
        let target = Path::new(env!("CARGO_TARGET_TMPDIR")).join("examples");
        Command::new(env!("CARGO"))
            .args([command, "--quiet"])
            .env("CARGO_TARGET_DIR", target)
            .env("RUSTFLAGS", "-D warnings")
            .current_dir(self.folder.path())
            .output()
            .unwrap()
    }

    /// What it prints.
    fn run(&self) -> String {
        let result = self.cargo("run");
        assert!(result.status.success(), "{}: {}", self.name, said(&result));
        assert_eq!(said(&result), "", "{}: warnings", self.name);
        String::from_utf8(result.stdout).unwrap()
    }

    fn edit(&self, file: &str, from: &str, to: &str) {
        let text = fs::read_to_string(self.path(file)).unwrap();
        assert!(text.contains(from), "{file} has no `{from}`");
        fs::write(self.path(file), text.replacen(from, to, 1)).unwrap();
    }
}

/// The committed model is up to date; a leg is moved by 5 mm, the check says so, one command mends it.
#[test]
fn a_committed_model_is_regenerated_after_a_change_of_geometry() {
    let example = Crate::new("committed_model");
    let check = || dyn_gen(example.folder.path(), &["check", "my_platform.toml", "src/my_platform.rs"]);
    let checked = check();
    assert_eq!(code(&checked), 0, "examples/committed_model is not up to date: {}", said(&checked));
    let before = example.run();
    assert!(before.starts_with("actuator forces [N]:"), "{before}");

    example.edit("my_platform.toml", "base_point_m = [0.131644,", "base_point_m = [0.136644,");
    let checked = check();
    assert_eq!(code(&checked), 1);
    assert_eq!(example.run(), before, "the model is not what changed");
    let text = said(&checked);
    let command = text.lines().last().unwrap().trim();
    assert!(
        command.starts_with("dyn-gen generate my_platform.toml -o src/my_platform.rs --functions "),
        "{command}"
    );
    let arguments: Vec<&str> = command.split(' ').skip(1).collect();
    assert_eq!(code(&dyn_gen(example.folder.path(), &arguments)), 0);
    assert_eq!(code(&check()), 0);
    assert_ne!(example.run(), before);
}

/// The model is made by the build, again when the platform file has changed and only then; a mistake in it ends the build
/// with its place.
#[test]
fn a_build_script_makes_the_model() {
    let example = Crate::new("build_script");
    let before = example.run();
    let lines: Vec<&str> = before.lines().collect();
    assert!(lines[0].starts_with("6.092 kg, actuator forces [N]:"), "{before}");
    assert!(before.contains("\n8.5 kg, actuator forces [N]:"), "{before}");
    assert!(
        before.ends_with("parameter `payload_mass` keeps its value: element 0 must be positive, but is -1\n"),
        "{before}"
    );
    let generated = || {
        let built = Path::new(env!("CARGO_TARGET_TMPDIR")).join("examples/debug/build");
        let folders = fs::read_dir(built).unwrap().map(|entry| entry.unwrap().path().join("out/model.rs"));
        let times = folders.filter_map(|file| fs::metadata(file).ok()?.modified().ok());
        times.max().expect("a generated model")
    };
    let first = generated();
    assert_eq!(example.run(), before);
    assert_eq!(generated(), first, "the model was made again although nothing had changed");
    example.edit("src/main.rs", "8.5", "8.25");
    example.run();
    assert_eq!(generated(), first, "the model was made again although only the program had changed");

    let started = Instant::now();
    example.edit("my_platform.toml", "platform_radius_m = 0.12", "platform_radius_m = 0.125");
    let after = example.run();
    println!("change of geometry to result: {:.2} s", started.elapsed().as_secs_f64());
    assert_ne!(generated(), first);
    assert_ne!(after, before);

    example.edit("my_platform.toml", "platform_radius_m = 0.125", "platform_radius_mm = 125");
    let result = example.cargo("build");
    assert_ne!(code(&result), 0);
    for mention in ["my_platform.toml:", "unknown key `platform_radius_mm`", "platform_radius_m", "help"] {
        assert!(said(&result).contains(mention), "cargo does not show `{mention}`:\n{}", said(&result));
    }
    assert!(!said(&result).contains('\u{1b}'), "colours in a log");
}
