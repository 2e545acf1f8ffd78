//! Progress bars on standard error; lines where nobody watches a terminal.

use dyn_sim::experiment::Progress;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};

const PARTS: u64 = 1000;

/// One bar per step, which leaves a line behind.
#[derive(Default)]
pub struct Bars {
    bar: Option<ProgressBar>,
    step: String,
}

impl Progress for Bars {
    fn begin(&mut self, step: &str) {
        step.clone_into(&mut self.step);
        let bar = ProgressBar::new(PARTS).with_message(step.to_owned());
        if let Ok(style) = ProgressStyle::with_template("{msg:32} {bar:30} {percent:>3} % {elapsed}") {
            bar.set_style(style);
        }
        // The elapsed time runs even where nothing is told for a while.
        bar.enable_steady_tick(Duration::from_millis(200));
        self.bar = Some(bar);
    }

    fn at(&mut self, fraction: f64) {
        if let Some(bar) = &self.bar {
            bar.set_position((fraction.clamp(0.0, 1.0) * PARTS as f64) as u64);
        }
    }

    fn end(&mut self, seconds: f64) {
        if let Some(bar) = self.bar.take() {
            bar.finish_and_clear();
        }
        eprintln!("{:32} {seconds:7.3} s", self.step);
    }
}
