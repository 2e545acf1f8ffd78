//! Reading what `venv` and `pip` print when they fail.

use std::path::Path;

use crate::error::Error;
use crate::interpreter::Interpreter;

/// What pip prints when the index is out of reach, and the reason in plain words. The first row found wins, so the
/// telling ones stand first.
const NETWORK: [(&str, &str); 19] = [
    ("CERTIFICATE_VERIFY_FAILED", "its certificate is not trusted"),
    ("Cannot connect to proxy", "the proxy does not answer"),
    ("ProxyError", "the proxy refuses"),
    ("name resolution", "its name cannot be resolved (no network?)"),
    ("Name or service not known", "its name cannot be resolved (no network?)"),
    ("nodename nor servname", "its name cannot be resolved (no network?)"),
    ("getaddrinfo failed", "its name cannot be resolved (no network?)"),
    ("NameResolutionError", "its name cannot be resolved (no network?)"),
    ("Network is unreachable", "no network"),
    ("No route to host", "no route to it"),
    ("Connection refused", "connection refused"),
    ("actively refused", "connection refused"),
    ("Connection reset", "connection reset"),
    ("timed out", "no answer in time"),
    ("SSLError", "no secure connection"),
    ("NewConnectionError", "no connection"),
    ("Max retries exceeded", "no connection"),
    ("Client Error", "it refuses the request"),
    ("Server Error", "it is out of order"),
];

/// The error behind a failed `pip install`.
pub(crate) fn of_pip(text: &str, folder: &Path, lock_file: &Path, python: &Interpreter) -> Error {
    let lock_file = lock_file.to_owned();
    if let Some(error) = of_system(text, folder) {
        error
    } else if text.contains("DO NOT MATCH THE HASHES") {
        let after = text.lines().skip_while(|line| !line.contains("DO NOT MATCH THE HASHES")).nth(1);
        let package = after.map_or("a package", |line| line.split(" from ").next().unwrap_or(line).trim());
        Error::HashMismatch { package: package.to_owned(), lock_file }
    } else if text.contains("--require-hashes mode") || text.contains("Invalid requirement") {
        Error::LockFileRefused { lock_file, said: refusal(text) }
    } else if let Some((_, reason)) = NETWORK.iter().find(|(pattern, _)| text.contains(pattern)) {
        Error::IndexUnreachable { reason: (*reason).to_owned() }
    } else if let Some((_, package)) = text.split_once("No matching distribution found for ") {
        let package = package.split([' ', '\n']).next().unwrap_or(package).to_owned();
        Error::NoWheel { package, python: python.to_string() }
    } else {
        Error::InstallFailed { said: last_lines(text) }
    }
}

/// Failures that any tool can run into while writing.
pub(crate) fn of_system(text: &str, folder: &Path) -> Option<Error> {
    let path = folder.to_owned();
    if text.contains("No space left on device") || text.contains("[WinError 112]") {
        return Some(Error::DiskFull { path });
    }
    let reason = ["Permission denied", "Read-only file system", "[WinError 5]"]
        .into_iter()
        .find(|pattern| text.contains(pattern))?;
    Some(Error::Unwritable { path, reason: reason.to_owned() })
}

/// The end of a tool's output: where it says what went wrong.
pub(crate) fn last_lines(text: &str) -> String {
    const COUNT: usize = 12;
    let lines: Vec<_> = text.lines().filter(|line| !line.trim().is_empty()).collect();
    if lines.is_empty() {
        return "it printed nothing".to_owned();
    }
    lines[lines.len().saturating_sub(COUNT)..].join("\n")
}

/// pip's complaint about a lock file: its sentence up to the first full stop, and the first requirement it lists.
fn refusal(text: &str) -> String {
    let mut lines = text.lines().skip_while(|line| !line.starts_with("ERROR: "));
    let sentence = lines.next().unwrap_or_default().trim_start_matches("ERROR: ");
    let sentence = sentence.split(". ").next().unwrap_or(sentence);
    match lines.next().and_then(|line| line.split_whitespace().next()) {
        Some(requirement) => format!("{sentence} ({requirement})"),
        None => sentence.to_owned(),
    }
}
