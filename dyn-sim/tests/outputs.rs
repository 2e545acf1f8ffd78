//! Reports that cannot be written: one message, exit code 1, and nothing half-written under the final name. Results
//! without Python: one line that says so.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const TOOL: &str = env!("CARGO_BIN_EXE_dyn-sim");

/// A folder with a scenario, which asks for everything, and its platform.
struct Bench {
    folder: tempfile::TempDir,
}

impl Bench {
    fn new() -> Self {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let platform = Path::new(env!("CARGO_MANIFEST_DIR")).join("../platforms/uhp_2016.toml");
        fs::copy(platform, folder.path().join("uhp_2016.toml")).expect("a copy");
        let scenario = "version = 1\nname = \"outputs\"\nplatform = \"uhp_2016.toml\"\ngravity = true\nduration_s = 0.2\n\
                        step_s = 1e-3\nprototype = true\n[outputs]\njson = true\n[target]\n[[target.harmonic]]\n\
                        frequency_hz = 5.0\nlinear_m = [0.01, 0.0, 0.0]\n";
        fs::write(folder.path().join("outputs.toml"), scenario).expect("a file");
        Self { folder }
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn run(&self, arguments: &[&str]) -> Output {
        let mut command = Command::new(TOOL);
        command.args(["run", "outputs.toml"]).args(arguments).current_dir(self.folder.path());
        command.output().expect("dyn-sim runs")
    }

    /// What the folder holds, hidden things too.
    fn entries(&self) -> Vec<String> {
        let entries = fs::read_dir(self.folder.path()).expect("readable");
        let mut names: Vec<String> = entries
            .map(|entry| entry.expect("readable").file_name().to_string_lossy().into_owned())
            .collect();
        names.sort();
        names
    }
}

/// Exit code 1, and a message with `text`.
fn refused(output: &Output, text: &str) {
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.contains(text) && said.contains("help:"), "{said}");
}

#[test]
fn everything_appears_at_once() {
    let bench = Bench::new();
    let output = bench.run(&["--no-prototype", "--output", "report"]);
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    for file in ["report/index.html", "report/tables.json", "report/csv/base.csv", "report/svg/platform.svg"]
    {
        assert!(bench.path(file).is_file(), "{file}");
    }
    assert_eq!(bench.entries(), ["outputs.toml", "report", "uhp_2016.toml"]);
    let said = String::from_utf8_lossy(&output.stdout);
    assert!(said.contains("\ntime: ") && said.contains("ms per simulated second"), "{said}");
    assert!(said.ends_with("report/index.html\n"), "{said}");
}

#[test]
fn a_file_in_the_way() {
    let bench = Bench::new();
    fs::write(bench.path("report"), "mine").expect("a file");
    refused(&bench.run(&["--no-prototype", "--output", "report"]), "is in the way");
    refused(&bench.run(&["--no-prototype", "--output", "report/inside"]), "cannot");
    assert_eq!(fs::read_to_string(bench.path("report")).expect("readable"), "mine");
    assert_eq!(bench.entries(), ["outputs.toml", "report", "uhp_2016.toml"]);
}

/// A file system that takes no folders, whoever asks.
#[test]
#[cfg(target_os = "linux")]
fn an_unwritable_folder() {
    refused(
        &Bench::new().run(&["--no-prototype", "--output", "/proc/report"]),
        "cannot create the folder `/proc/report`",
    );
}

/// No file may grow beyond some kilobytes: the report breaks off in the middle of a curve.
#[test]
#[cfg(target_os = "linux")]
fn no_room() {
    let bench = Bench::new();
    let limited = |blocks: u32| {
        let mut command = Command::new("bash");
        // Without the signal the write itself fails, as on a full disk.
        let script = format!(
            "trap '' XFSZ; ulimit -f {blocks}; exec \"$0\" run outputs.toml --no-prototype -o report"
        );
        command.args(["-c", &script, TOOL]).current_dir(bench.folder.path());
        command.output().expect("bash runs")
    };
    refused(&limited(16), "raise the limit");
    assert_eq!(bench.entries(), ["outputs.toml", "uhp_2016.toml"], "nothing half-written");

    assert_eq!(bench.run(&["--no-prototype", "--output", "report"]).status.code(), Some(0));
    let before = fs::read_to_string(bench.path("report/index.html")).expect("readable");
    refused(&limited(16), "cannot write");
    let after = fs::read_to_string(bench.path("report/index.html")).expect("readable");
    assert!(before == after && bench.path("report/tables.json").is_file(), "the earlier report stays");
    assert_eq!(bench.entries(), ["outputs.toml", "report", "uhp_2016.toml"]);
}

/// Everything but the prototype is done, and one line says why.
#[test]
fn without_python() {
    let bench = Bench::new();
    let mut command = Command::new(TOOL);
    command.args(["run", "outputs.toml", "--output", "report"]).current_dir(bench.folder.path());
    // An environment that was made before must not help.
    command.env("PATH", bench.folder.path()).env("CARGO_TARGET_DIR", bench.path("target"));
    command.env_remove("DYN_PYTHON");
    let output = command.output().expect("dyn-sim runs");
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{said}");
    let lines: Vec<&str> = said.lines().filter(|line| line.starts_with("warning: ")).collect();
    assert_eq!(lines.len(), 1, "{said}");
    assert!(
        lines[0].starts_with("warning: no virtual prototype, as with --no-prototype: no Python was found"),
        "{said}"
    );
    assert!(bench.path("report/index.html").is_file());
}
