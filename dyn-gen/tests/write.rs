//! Files are replaced as a whole or not at all: full devices, limits of size, and a process killed at any moment.

mod common;

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use common::cli::entries;

const PLATFORM: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../platforms/uhp_2016.toml");

/// `generate` of a small file, told to write in `folder` over `model.rs`.
fn generate(folder: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_dyn-gen"));
    let functions = ["--functions", "matrices,bias", "--no-evidence"];
    command.args(["generate", PLATFORM, "-o", "model.rs"]).args(functions).current_dir(folder);
    command.stdout(Stdio::null()).stderr(Stdio::piped());
    command
}

/// A process that is killed leaves the old file or the new one, and of the new one not a part.
#[test]
fn a_killed_write_leaves_the_old_file_or_the_new_one() {
    let folder = tempfile::tempdir().unwrap();
    let model = folder.path().join("model.rs");
    let started = Instant::now();
    assert!(generate(folder.path()).status().unwrap().success());
    let whole = started.elapsed();
    let new = fs::read(&model).unwrap();
    let old = "old \u{3b1}\n".repeat(50_000);
    let (mut kept, mut replaced) = (0, 0);
    // Moments from before the first to after the last, closer together towards the end, where it writes.
    for k in 0..40 {
        fs::write(&model, &old).unwrap();
        let mut child = generate(folder.path()).spawn().unwrap();
        std::thread::sleep(whole.mul_f64(1.2 * (1.0 - (1.0 - f64::from(k) / 40.0).powi(2))));
        let _ = child.kill();
        child.wait().unwrap();
        match fs::read(&model).unwrap() {
            found if found == old.as_bytes() => kept += 1,
            found if found == new => replaced += 1,
            found => {
                panic!("killed at moment {k}: {} bytes, neither the old file nor the new one", found.len())
            }
        }
    }
    println!("{kept} times the old file, {replaced} times the new one");
    assert!(kept > 0, "nothing was killed before it had written");
}

/// A device that is full, by a limit on the size of files: the write fails in the middle.
#[test]
#[cfg(unix)]
fn a_write_that_fails_half_way_leaves_the_old_file() {
    let folder = tempfile::tempdir().unwrap();
    let model = folder.path().join("model.rs");
    fs::write(&model, "old\n").unwrap();
    // 8 blocks of 1024 bytes (512 in some shells); the signal that comes with it is ignored.
    let script = format!(
        "trap '' XFSZ; ulimit -f 8; exec {} generate {PLATFORM} -o model.rs --functions matrices --no-evidence",
        env!("CARGO_BIN_EXE_dyn-gen")
    );
    let result = Command::new("bash").args(["-c", &script]).current_dir(folder.path()).output().unwrap();
    let said = String::from_utf8_lossy(&result.stderr).into_owned();
    assert_eq!(result.status.code(), Some(1), "{said}");
    assert!(said.contains("cannot write model.rs: File too large"), "{said}");
    assert!(said.contains("the file is as it was"), "{said}");
    assert_eq!(fs::read_to_string(&model).unwrap(), "old\n");
    assert_eq!(entries(folder.path()), ["model.rs"], "a temporary file is left");
}

/// Of two files none is replaced when one cannot be written.
#[test]
fn evidence_and_model_are_written_together() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("model.rs"), "old\n").unwrap();
    let result = Command::new(env!("CARGO_BIN_EXE_dyn-gen"))
        .args(["generate", PLATFORM, "-o", "model.rs", "--functions", "bias", "--states", "9"])
        .args(["--evidence", "no/such/evidence.json"])
        .current_dir(folder.path())
        .output()
        .unwrap();
    assert_eq!(result.status.code(), Some(1));
    assert_eq!(fs::read_to_string(folder.path().join("model.rs")).unwrap(), "old\n");
    assert_eq!(entries(folder.path()), ["model.rs"]);
}

/// Whoever reads the file while it is written sees one or the other as well.
#[test]
fn a_reader_never_sees_a_part() {
    let folder = tempfile::tempdir().unwrap();
    let model = folder.path().join("model.rs");
    assert!(generate(folder.path()).status().unwrap().success());
    let new = fs::read(&model).unwrap();
    fs::write(&model, "old\n").unwrap();
    let mut child = generate(folder.path()).spawn().unwrap();
    let started = Instant::now();
    while child.try_wait().unwrap().is_none() && started.elapsed() < Duration::from_secs(60) {
        let found = fs::read(&model).unwrap();
        assert!(found == b"old\n" || found == new, "{} bytes", found.len());
    }
    assert_eq!(fs::read(&model).unwrap(), new);
}
