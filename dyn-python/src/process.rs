//! Running Python untouched by the caller's Python settings, with its output kept.

use std::env;
use std::ffi::OsStr;
use std::io::{self, BufRead, BufReader, Read};
use std::process::{Command, Stdio};
use std::thread;

/// Variables that would send pip's work elsewhere or change what it installs. Those that say how to reach an index
/// (`PIP_INDEX_URL`, `PIP_CERT`, `PIP_PROXY`, `PIP_FIND_LINKS`, ...) stay: hashes guard what they bring.
const REMOVED_PIP_VARIABLES: [&str; 12] = [
    "PIP_CONSTRAINT",
    "PIP_DRY_RUN",
    "PIP_NO_BINARY",
    "PIP_PLATFORM",
    "PIP_PREFIX",
    "PIP_PYTHON",
    "PIP_PYTHON_VERSION",
    "PIP_QUIET",
    "PIP_REQUIREMENT",
    "PIP_ROOT",
    "PIP_TARGET",
    "PIP_VERBOSE",
];

/// A finished process.
pub(crate) struct Finished {
    pub(crate) success: bool,
    /// Standard output, then standard error: `python -m venv` reports its failures on the former.
    pub(crate) text: String,
    pub(crate) standard_output: String,
}

/// Takes the caller's Python settings away from `command`: nothing outside the environment may be imported, and a
/// run must not depend on the order of hashes or on the locale.
pub(crate) fn isolate(command: &mut Command) {
    for (name, _) in env::vars_os() {
        if is_python_setting(&name) {
            command.env_remove(name);
        }
    }
    command.env("PYTHONHASHSEED", "0").env("PYTHONUTF8", "1");
}

/// `PYTHONPATH`, `PYTHONHOME` and their kin; macOS passes the outer interpreter on in `__PYVENV_LAUNCHER__`.
pub(crate) fn is_python_setting(name: &OsStr) -> bool {
    let name = name.to_string_lossy().to_ascii_uppercase();
    name.starts_with("PYTHON") || name == "__PYVENV_LAUNCHER__" || name == "VIRTUAL_ENV"
}

/// Takes pip settings away that would install elsewhere, and bounds the wait for a network that is not there.
pub(crate) fn isolate_pip(command: &mut Command) {
    for name in REMOVED_PIP_VARIABLES {
        command.env_remove(name);
    }
    command.env("PIP_USER", "0");
    if env::var_os("PIP_RETRIES").is_none() {
        command.env("PIP_RETRIES", "2");
    }
}

/// Runs `command` with its output kept, calling `on_line` for each line of standard output as it comes.
pub(crate) fn run(command: &mut Command, mut on_line: impl FnMut(&str)) -> io::Result<Finished> {
    let mut child = command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn()?;
    let (stdout, stderr) = (child.stdout.take(), child.stderr.take());
    // Both pipes are drained at once: a process blocks when either is full.
    let errors = thread::spawn(move || {
        let mut bytes = Vec::new();
        if let Some(mut stderr) = stderr {
            // Whatever was read before a failure is still worth showing.
            let _ = stderr.read_to_end(&mut bytes);
        }
        String::from_utf8_lossy(&bytes).into_owned()
    });
    let mut standard_output = String::new();
    if let Some(stdout) = stdout {
        for line in BufReader::new(stdout).split(b'\n') {
            let line = line?;
            let line = String::from_utf8_lossy(&line);
            on_line(line.trim_end());
            standard_output.push_str(line.trim_end());
            standard_output.push('\n');
        }
    }
    let status = child.wait()?;
    let text = standard_output.clone() + &errors.join().unwrap_or_default();
    Ok(Finished { success: status.success(), text, standard_output })
}
