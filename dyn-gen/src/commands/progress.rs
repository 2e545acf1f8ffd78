//! A line on standard error while a step takes long.

use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};

/// Steps shorter than this are not worth a line.
const PATIENCE: Duration = Duration::from_secs(2);

/// The result of `step`; while it takes longer than two seconds, `what` and the time since are shown.
pub fn with_progress<R>(what: &str, step: impl FnOnce() -> R) -> R {
    thread::scope(|scope| {
        let (done, is_done) = channel::<()>();
        scope.spawn(move || {
            if is_done.recv_timeout(PATIENCE) != Err(RecvTimeoutError::Timeout) {
                return;
            }
            let bar = ProgressBar::new_spinner().with_message(what.to_owned()).with_elapsed(PATIENCE);
            if let Ok(style) = ProgressStyle::with_template("{spinner} {msg} ({elapsed})") {
                bar.set_style(style);
            }
            // Where nobody watches a terminal the bar is hidden: then the line is printed once.
            if bar.is_hidden() {
                eprintln!("{what} ...");
            }
            bar.enable_steady_tick(Duration::from_millis(120));
            // The sender is dropped when the step has ended.
            let _ = is_done.recv();
            bar.finish_and_clear();
        });
        let result = step();
        drop(done);
        result
    })
}
