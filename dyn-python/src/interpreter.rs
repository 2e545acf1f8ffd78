//! Finding an interpreter.

use std::env;
use std::ffi::OsString;
use std::fmt;
use std::path::PathBuf;
use std::process::Command;

use crate::error::Error;
use crate::process;

/// Lowest accepted version: casadi's numpy asks for it.
const LOWEST: Version = Version { major: 3, minor: 11, patch: 0 };
/// Newest minor version that the lock files were tried with. A newer one is taken where nothing else is found.
const NEWEST_TRIED: u32 = 13;

/// Python 2 runs this as well, so that a machine with nothing newer is told its version. The base executable stands
/// behind an active virtual environment, which may be gone tomorrow.
const PROBE: &str = "import sys; sys.stdout.write(' '.join(['dyn-python'] + [str(n) for n in sys.version_info[:3]] + \
                     [getattr(sys, '_base_executable', '') or sys.executable]))";

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Version {
    major: u32,
    minor: u32,
    patch: u32,
}

impl fmt::Display for Version {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{}.{}.{}", self.major, self.minor, self.patch)
    }
}

/// An interpreter that ran and told its version.
#[derive(Clone, Debug)]
pub(crate) struct Interpreter {
    pub(crate) version: Version,
    pub(crate) executable: PathBuf,
}

impl fmt::Display for Interpreter {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "Python {} ({})", self.version, self.executable.display())
    }
}

/// Where to look.
#[derive(Debug, Default)]
pub(crate) struct Search {
    /// `DYN_PYTHON`: nothing else is tried when it is set.
    pub(crate) requested: Option<OsString>,
    /// Instead of the process's own `PATH`.
    pub(crate) path: Option<OsString>,
}

impl Search {
    pub(crate) fn from_environment() -> Self {
        Self { requested: env::var_os("DYN_PYTHON").filter(|value| !value.is_empty()), path: None }
    }

    /// First interpreter of a version that was tried, else the first newer one.
    pub(crate) fn find(&self) -> Result<Interpreter, Error> {
        if let Some(program) = &self.requested {
            return self.find_requested(program);
        }
        let (mut newer, mut old) = (None, Vec::new());
        for candidate in candidates() {
            let Some(interpreter) = self.probe(candidate[0].into(), &candidate[1..]) else { continue };
            let version = interpreter.version;
            if version < LOWEST {
                old.push(format!("{} ({version})", candidate.join(" ")));
            } else if version.major == LOWEST.major && version.minor <= NEWEST_TRIED {
                return Ok(interpreter);
            } else {
                newer.get_or_insert(interpreter);
            }
        }
        newer.ok_or_else(|| {
            if old.is_empty() {
                let tried: Vec<_> = candidates().iter().map(|candidate| candidate.join(" ")).collect();
                Error::PythonNotFound { tried: tried.join(", ") }
            } else {
                Error::PythonTooOld {
                    needed: format!("{}.{}", LOWEST.major, LOWEST.minor),
                    found: old.join(", "),
                }
            }
        })
    }

    fn find_requested(&self, program: &OsString) -> Result<Interpreter, Error> {
        let refuse = |problem: String| Error::RequestedPython {
            program: program.to_string_lossy().into_owned(),
            problem,
        };
        let interpreter =
            self.probe(program.clone(), &[]).ok_or_else(|| refuse("does not run as a Python".into()))?;
        if interpreter.version < LOWEST {
            let lowest = format!("{}.{}", LOWEST.major, LOWEST.minor);
            return Err(refuse(format!("is {}; {lowest} or later is needed", interpreter.version)));
        }
        Ok(interpreter)
    }

    /// `None` for whatever is not a working Python: absent, a version manager's stub, the Windows store's stub.
    fn probe(&self, program: OsString, arguments: &[&str]) -> Option<Interpreter> {
        let mut command = Command::new(program);
        command.args(arguments).args(["-c", PROBE]);
        process::isolate(&mut command);
        if let Some(path) = &self.path {
            command.env("PATH", path);
        }
        let finished = process::run(&mut command, |_| {}).ok().filter(|finished| finished.success)?;
        let mut words = finished.standard_output.trim().splitn(5, ' ');
        if words.next() != Some("dyn-python") {
            return None;
        }
        let mut number = || words.next()?.parse().ok();
        let version = Version { major: number()?, minor: number()?, patch: number()? };
        Some(Interpreter { version, executable: words.next()?.into() })
    }
}

/// Commands tried, in this order.
fn candidates() -> &'static [&'static [&'static str]] {
    const UNIX: &[&[&str]] =
        &[&["python3"], &["python3.13"], &["python3.12"], &["python3.11"], &["python3.14"], &["python"]];
    const WINDOWS: &[&[&str]] = &[&["python3"], &["python"], &["py", "-3"]];
    if cfg!(windows) { WINDOWS } else { UNIX }
}
