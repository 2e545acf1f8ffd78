//! Every error from a stand-in for Python (a shell script), and real environments where pip needs no network.

use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::RwLock;

use tempfile::TempDir;

use crate::install;
use crate::interpreter::Search;
use crate::process::is_python_setting;
use crate::{Environment, Error, Recipe};

/// A script that is open for writing while another thread starts a process cannot be run ("text file busy"): scripts
/// are written under `write`, processes started under `read`.
static SCRIPTS: RwLock<()> = RwLock::new(());

/// A workspace of its own for each test.
struct Place {
    folder: TempDir,
}

impl Place {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("requirements.lock"), "").unwrap();
        fs::create_dir(folder.path().join("bin")).unwrap();
        Self { folder }
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn lock(self, text: &str) -> Self {
        fs::write(self.path("requirements.lock"), text).unwrap();
        self
    }

    /// Only the stand-ins are found.
    fn prepare(&self) -> Result<Environment, Error> {
        self.prepare_with(&Search { requested: None, path: Some(self.path("bin").into()) })
    }

    fn prepare_with(&self, search: &Search) -> Result<Environment, Error> {
        let _guard = SCRIPTS.read().unwrap();
        let recipe = Recipe {
            name: "test",
            lock_file: &self.path("requirements.lock"),
            target_directory: &self.path("target"),
        };
        Environment::prepare_with(&recipe, search)
    }

    /// Calls of the stand-in so far that made an environment.
    #[cfg(unix)]
    fn venv_calls(&self) -> usize {
        fs::read_to_string(self.path("calls")).map_or(0, |text| text.lines().count())
    }
}

#[cfg(unix)]
impl Place {
    /// A stand-in called `name` that says it is `version`, with shell code for `-m venv` and for `-m pip`.
    fn python(self, name: &str, version: &str, venv: &str, pip: &str) -> Self {
        use std::os::unix::fs::PermissionsExt;
        let script = format!(
            r#"#!/bin/sh
PATH=/usr/bin:/bin
for last; do :; done
case "$*" in
    -c*) echo "dyn-python {version} $0" ;;
    *"venv "*) echo "$*" >> {calls}; {venv} ;;
    *pip*) {pip} ;;
esac
"#,
            version = version.replace('.', " "),
            calls = self.path("calls").display(),
        );
        let path = self.path("bin").join(name);
        let _guard = SCRIPTS.write().unwrap();
        fs::write(&path, script).unwrap();
        fs::set_permissions(&path, fs::Permissions::from_mode(0o755)).unwrap();
        drop(_guard);
        self
    }

    /// pip of the environment fails with `says`.
    fn with_failing_pip(says: &str) -> Self {
        let pip = format!("case \"$*\" in *--version) exit 0;; esac\ncat >&2 <<'END'\n{says}\nEND\nexit 1");
        Self::new().python("python3", "3.12.1", WORKING_VENV, &pip)
    }
}

#[cfg(unix)]
const WORKING_VENV: &str = r#"mkdir -p "$last/bin" && cp "$0" "$last/bin/python""#;
#[cfg(unix)]
mod stand_ins {
    use super::*;

    #[test]
    fn no_python() {
        let error = Place::new().prepare().unwrap_err();
        assert!(matches!(error, Error::PythonNotFound { .. }), "{error:?}");
        assert!(error.is_environment_missing());
        assert!(error.to_string().contains("python3.11"), "{error}");
        assert!(error.remedy().contains("apt-get install python3 python3-venv"));
    }

    #[test]
    fn too_old_names_what_was_found() {
        let place = Place::new().python("python3", "3.9.2", "", "").python("python", "2.7.18", "", "");
        let error = place.prepare().unwrap_err();
        assert!(matches!(error, Error::PythonTooOld { .. }), "{error:?}");
        assert!(error.is_environment_missing());
        assert_eq!(
            error.to_string(),
            "Python 3.11 or later is needed, found only python3 (3.9.2), python (2.7.18)"
        );
    }

    #[test]
    fn an_old_python3_is_passed_over() {
        let place = Place::new().python("python3", "3.9.2", "exit 1", "").python(
            "python3.12",
            "3.12.1",
            WORKING_VENV,
            "",
        );
        place.prepare().unwrap();
    }

    #[test]
    fn a_version_that_was_tried_comes_before_a_newer_one() {
        let place = Place::new().python("python3", "3.19.0", "exit 1", "").python(
            "python3.12",
            "3.12.1",
            WORKING_VENV,
            "",
        );
        place.prepare().unwrap();
        let place = Place::new().python("python3", "3.19.0", WORKING_VENV, "");
        place.prepare().unwrap();
    }

    #[test]
    fn a_stub_is_not_a_python() {
        let place = Place::new().python("python3", "3.12.1", "", "");
        let _guard = SCRIPTS.write().unwrap();
        fs::write(place.path("bin/python3"), "#!/bin/sh\necho 'pyenv: python3: command not found'\n")
            .unwrap();
        drop(_guard);
        assert!(matches!(place.prepare().unwrap_err(), Error::PythonNotFound { .. }));
    }

    #[test]
    fn requested_python_is_the_only_one_tried() {
        let place =
            Place::new().python("python3", "3.12.1", WORKING_VENV, "").python("old", "3.10.0", "", "");
        let request = |name: &str| {
            place.prepare_with(&Search { requested: Some(place.path("bin").join(name).into()), path: None })
        };
        let error = request("absent").unwrap_err();
        assert!(
            matches!(error, Error::RequestedPython { .. }) && !error.is_environment_missing(),
            "{error:?}"
        );
        assert!(request("old").unwrap_err().to_string().ends_with("is 3.10.0; 3.11 or later is needed"));
        request("python3").unwrap();
    }

    #[test]
    fn venv_missing() {
        let says = "echo \"$0: No module named venv\" >&2; exit 1";
        let error = Place::new().python("python3", "3.12.1", says, "").prepare().unwrap_err();
        assert!(matches!(error, Error::VenvMissing { .. }), "{error:?}");
        assert!(error.is_environment_missing());
        assert!(error.remedy().contains("python3-venv"));
    }

    #[test]
    fn ensurepip_and_pip_missing() {
        let pip = "case \"$*\" in *ensurepip*) echo \"$0: No module named ensurepip\" >&2;; esac; exit 1";
        let error = Place::new().python("python3", "3.12.1", WORKING_VENV, pip).prepare().unwrap_err();
        assert!(matches!(error, Error::PipMissing { .. }), "{error:?}");
        assert!(error.is_environment_missing());
        assert!(error.remedy().contains("apt-get install python3-venv"));
    }

    #[test]
    fn ensurepip_serves_where_pip_is_missing_or_old() {
        let pip = "case \"$*\" in *ensurepip*) touch \"$0.ensured\"; exit 0;; *--python*) exit 2;; esac; \
                   test -e \"$0.ensured\"";
        Place::new().python("python3", "3.12.1", WORKING_VENV, pip).prepare().unwrap();
    }

    #[test]
    fn without_ensurepip_the_interpreters_pip_installs() {
        let pip = "case \"$*\" in *'pip --python '*) exit 0;; esac; exit 1";
        Place::new().python("python3", "3.12.1", WORKING_VENV, pip).prepare().unwrap();
    }

    #[test]
    fn another_venv_failure_is_quoted_from_standard_output() {
        let place = Place::new().python("python3", "3.12.1", "echo 'Error: broken'; exit 1", "");
        let error = place.prepare().unwrap_err();
        assert!(matches!(&error, Error::VenvFailed { said } if said == "Error: broken"), "{error:?}");
    }

    #[test]
    fn disk_full_and_unwritable_while_installing() {
        let says = "ERROR: Could not install packages due to an OSError: [Errno 28] No space left on device";
        let error = Place::with_failing_pip(says).prepare().unwrap_err();
        assert!(matches!(error, Error::DiskFull { .. }) && !error.is_environment_missing(), "{error:?}");
        let venv = "echo \"Error: [Errno 13] Permission denied: '$last'\"; exit 1";
        let error = Place::new().python("python3", "3.12.1", venv, "").prepare().unwrap_err();
        assert!(matches!(error, Error::Unwritable { .. }), "{error:?}");
    }

    #[test]
    fn network_reasons() {
        let cases = [
            (
                "Failed to establish a new connection: [Errno -3] Temporary failure in name resolution')",
                "its name cannot be resolved (no network?)",
            ),
            ("NewConnectionError('<...>: Failed ...: [Errno 111] Connection refused')", "connection refused"),
            (
                "SSLError(SSLCertVerificationError(1, '[SSL: CERTIFICATE_VERIFY_FAILED]",
                "its certificate is not trusted",
            ),
            ("ReadTimeoutError(\"HTTPSConnectionPool(...): Read timed out.\")", "no answer in time"),
            ("ERROR: HTTP error 403 Client Error: Forbidden", "it refuses the request"),
        ];
        for (line, expected) in cases {
            let says = format!(
                "WARNING: Retrying (Retry(total=0)) after connection broken by '{line}\nERROR: No matching \
                 distribution found for casadi==3.8.2"
            );
            let error = Place::with_failing_pip(&says).prepare().unwrap_err();
            assert!(matches!(&error, Error::IndexUnreachable { reason } if reason == expected), "{error:?}");
            assert!(error.is_environment_missing());
        }
    }

    #[test]
    fn no_wheel_names_package_and_interpreter() {
        let says = "ERROR: Could not find a version that satisfies the requirement casadi==3.8.2 (from versions: \
                    none)\nERROR: No matching distribution found for casadi==3.8.2";
        let error = Place::with_failing_pip(says).prepare().unwrap_err();
        assert!(error.to_string().starts_with("no wheel of casadi==3.8.2 fits Python 3.12.1 ("), "{error}");
        assert!(error.is_environment_missing());
    }

    #[test]
    fn another_pip_failure_is_quoted() {
        let error = Place::with_failing_pip("ERROR: something else").prepare().unwrap_err();
        assert!(
            matches!(&error, Error::InstallFailed { said } if said == "ERROR: something else"),
            "{error:?}"
        );
    }

    #[test]
    fn a_failure_leaves_nothing_and_is_tried_again() {
        let place = Place::with_failing_pip("ERROR: something else");
        for calls in 1..3 {
            place.prepare().unwrap_err();
            assert_eq!(place.venv_calls(), calls);
            let left: Vec<_> = fs::read_dir(place.path("target/python")).unwrap().flatten().collect();
            assert!(left.iter().all(|entry| entry.path().is_file()), "{left:?}");
        }
    }

    #[test]
    fn reused_until_lock_interpreter_or_stamp_changes() {
        let place = Place::new().python("python3", "3.12.1", WORKING_VENV, "");
        let first = place.prepare().unwrap();
        assert!(first.python().exists() && first.folder().starts_with(place.path("target/python")));
        assert_eq!(place.prepare().unwrap().folder(), first.folder());
        assert_eq!(place.venv_calls(), 1);

        // Line ends are git's business.
        let place = place.lock("# one\n");
        let second = place.prepare().unwrap();
        assert_ne!(second.folder(), first.folder());
        let place = place.lock("# one\r\n");
        assert_eq!(place.prepare().unwrap().folder(), second.folder());
        assert_eq!(place.venv_calls(), 2);

        // An interrupted installation: no stamp, rubbish inside.
        fs::remove_file(second.folder().join("complete.stamp")).unwrap();
        fs::write(second.folder().join("rubbish"), "").unwrap();
        place.prepare().unwrap();
        assert_eq!(place.venv_calls(), 3);
        let place = place.python("python3", "3.12.10", WORKING_VENV, "");
        place.prepare().unwrap();
        assert_eq!(place.venv_calls(), 4);
        place.prepare().unwrap();
        assert_eq!(place.venv_calls(), 4);
    }

    #[test]
    fn reuse_starts_no_process() {
        let place = Place::new().python("python3", "3.12.1", WORKING_VENV, "");
        place.prepare().unwrap();
        // Nothing to start any more on this PATH.
        let elsewhere = Search { requested: None, path: Some(place.path("target").into()) };
        place.prepare_with(&elsewhere).unwrap();
    }

    #[test]
    fn two_at_once_make_one() {
        let place = Place::new().python("python3", "3.12.1", &format!("sleep 0.3; {WORKING_VENV}"), "");
        std::thread::scope(|scope| {
            for _ in 0..3 {
                scope.spawn(|| place.prepare().unwrap());
            }
        });
        assert_eq!(place.venv_calls(), 1);
    }
}

#[test]
fn unwritable_target_folder() {
    let place = Place::new();
    fs::write(place.path("target"), "a file, not a folder").unwrap();
    let error = place.prepare().unwrap_err();
    assert!(matches!(error, Error::Unwritable { .. }) && !error.is_environment_missing(), "{error:?}");
    assert!(error.remedy().contains("CARGO_TARGET_DIR"));
}

#[test]
fn unreadable_lock_file() {
    let place = Place::new();
    fs::remove_file(place.path("requirements.lock")).unwrap();
    let error = place.prepare().unwrap_err();
    assert!(matches!(error, Error::LockFileUnreadable { .. }), "{error:?}");
    assert!(error.to_string().contains("requirements.lock cannot be read"), "{error}");
}

#[test]
fn python_settings_are_taken_away() {
    for name in ["PYTHONPATH", "PYTHONHOME", "PYTHONSTARTUP", "PYTHONHASHSEED", "__PYVENV_LAUNCHER__"] {
        assert!(is_python_setting(OsStr::new(name)), "{name}");
    }
    for name in ["PATH", "DYN_PYTHON", "PIP_INDEX_URL", "HOME"] {
        assert!(!is_python_setting(OsStr::new(name)), "{name}");
    }
}

#[test]
fn real_environment_and_what_real_pip_refuses() {
    let place = Place::new();
    let search = Search::from_environment();
    let environment = place.prepare_with(&search).unwrap();
    fs::create_dir(place.path("package")).unwrap();
    fs::write(place.path("package/__main__.py"), "import sys; print(sys.prefix, hash('x') % 1000)").unwrap();
    let run = || {
        let output =
            environment.command().args(["-m", "package"]).current_dir(place.path(".")).output().unwrap();
        assert!(output.status.success(), "{output:?}");
        String::from_utf8(output.stdout).unwrap()
    };
    let said = run();
    let prefix = Path::new(said.split(' ').next().unwrap());
    assert_eq!(prefix.canonicalize().unwrap(), environment.folder().canonicalize().unwrap());
    assert_eq!(run(), said, "hashes have a fixed order");
    assert!(!place.path("package/__pycache__").exists());

    // No network needed: a wheel on disk that is not what the lock file means, and an index that nobody serves.
    let wheel = place.path("demo-1.0-py3-none-any.whl");
    fs::write(&wheel, "not a wheel").unwrap();
    let address = wheel.display().to_string().replace('\\', "/");
    let address = format!("file:///{}", address.trim_start_matches('/'));
    let zeros = "0".repeat(64);
    let python = search.find().unwrap();
    let folder = place.path("other");
    let installer = install::create(&folder, &python).unwrap();
    let refusal = |lock: &str| {
        let lock_file = place.path("other.lock");
        fs::write(&lock_file, lock).unwrap();
        install::fill(&folder, &lock_file, &python, &installer, |_| {}).unwrap_err()
    };
    let error = refusal(&format!("demo @ {address} --hash=sha256:{zeros}\n"));
    assert!(
        matches!(&error, Error::HashMismatch { package, .. } if package.starts_with("demo")),
        "{error:?}"
    );
    assert!(!error.is_environment_missing());
    let error = refusal(&format!("demo @ {address}\n"));
    assert!(matches!(&error, Error::LockFileRefused { .. }), "{error:?}");
    let error = refusal(&format!("--index-url http://127.0.0.1:9/simple\ndemo==1.0 --hash=sha256:{zeros}\n"));
    assert!(
        matches!(&error, Error::IndexUnreachable { reason } if reason == "connection refused"),
        "{error:?}"
    );
}
