//! Making the virtual environment and filling it.

use std::path::Path;
use std::process::Command;

use crate::diagnosis;
use crate::error::Error;
use crate::interpreter::Interpreter;
use crate::process;
use crate::stamp;

/// Whose pip installs.
pub(crate) enum Installer {
    /// The interpreter's, told to install into the environment: saves seconds, and Debian ships `ensurepip` apart.
    OfInterpreter,
    /// The environment's own, put there by `ensurepip`.
    Own,
}

/// Installs what `lock_file` names into the environment `folder`.
pub(crate) fn fill(
    folder: &Path,
    lock_file: &Path,
    python: &Interpreter,
    installer: &Installer,
    on_line: impl FnMut(&str),
) -> Result<(), Error> {
    let mut pip = match installer {
        Installer::OfInterpreter => {
            let mut pip = Command::new(&python.executable);
            pip.args(["-m", "pip", "--python"]).arg(stamp::python(folder));
            pip
        }
        Installer::Own => {
            let mut pip = Command::new(stamp::python(folder));
            pip.args(["-m", "pip"]);
            pip
        }
    };
    // Only wheels: building casadi from its source takes an hour and a compiler, which nobody expects here.
    pip.args(["install", "--require-hashes", "--only-binary=:all:", "--no-input", "--progress-bar=off"])
        .args(["--disable-pip-version-check", "--no-warn-script-location", "--root-user-action=ignore", "-r"])
        .arg(lock_file);
    process::isolate(&mut pip);
    process::isolate_pip(&mut pip);
    let finished =
        process::run(&mut pip, on_line).map_err(|error| Error::InstallFailed { said: error.to_string() })?;
    if finished.success { Ok(()) } else { Err(diagnosis::of_pip(&finished.text, folder, lock_file, python)) }
}

/// Makes `folder` an empty environment of `python` and says whose pip can fill it.
pub(crate) fn create(folder: &Path, python: &Interpreter) -> Result<Installer, Error> {
    let made = run(Command::new(&python.executable).args(["-m", "venv", "--without-pip"]).arg(folder))?;
    if !made.success {
        let missing = made.text.contains("No module named venv");
        return Err(if missing {
            Error::VenvMissing { python: python.to_string() }
        } else {
            failed(&made, folder)
        });
    }
    let own = stamp::python(folder);
    // pip before 22.3 does not know `--python`.
    let version =
        run(Command::new(&python.executable).args(["-m", "pip", "--python"]).arg(&own).arg("--version"))?;
    if version.success {
        return Ok(Installer::OfInterpreter);
    }
    let ensured = run(Command::new(&own).args(["-m", "ensurepip"]))?;
    if ensured.success {
        Ok(Installer::Own)
    } else if ensured.text.contains("No module named ensurepip") {
        Err(Error::PipMissing { python: python.to_string() })
    } else {
        Err(failed(&ensured, folder))
    }
}

fn run(command: &mut Command) -> Result<process::Finished, Error> {
    process::isolate(command);
    process::isolate_pip(command);
    process::run(command, |_| {}).map_err(|error| Error::VenvFailed { said: error.to_string() })
}

fn failed(finished: &process::Finished, folder: &Path) -> Error {
    diagnosis::of_system(&finished.text, folder)
        .unwrap_or_else(|| Error::VenvFailed { said: diagnosis::last_lines(&finished.text) })
}
