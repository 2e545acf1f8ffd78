//! Telling that something slow goes on: a spinner on a terminal, plain lines in a log.

use std::io::{self, IsTerminal};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

/// Runs from [`Progress::start`] to [`Progress::finish`]; dropping it removes the spinner.
pub(crate) struct Progress {
    spinner: Option<ProgressBar>,
    started: Instant,
}

impl Progress {
    pub(crate) fn start(what: &str) -> Self {
        let spinner = io::stderr().is_terminal().then(|| {
            let spinner = ProgressBar::new_spinner().with_prefix(what.to_owned());
            if let Ok(style) = ProgressStyle::with_template("{spinner} {prefix}: {wide_msg} {elapsed}") {
                spinner.set_style(style);
            }
            spinner.enable_steady_tick(Duration::from_millis(100));
            spinner
        });
        if spinner.is_none() {
            eprintln!("{what} ...");
        }
        Self { spinner, started: Instant::now() }
    }

    /// What it is busy with at this moment (terminals only: a log would fill).
    pub(crate) fn detail(&self, text: &str) {
        if let Some(spinner) = &self.spinner {
            spinner.set_message(text.trim().to_owned());
        }
    }

    /// Leaves one line behind.
    pub(crate) fn finish(self, what: &str) {
        if let Some(spinner) = &self.spinner {
            spinner.finish_and_clear();
        }
        eprintln!("{what} ({:.1} s)", self.started.elapsed().as_secs_f64());
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some(spinner) = &self.spinner {
            spinner.finish_and_clear();
        }
    }
}
