//! What the machine is and what else it does, as far as it says so.

use std::fs;

use serde::{Deserialize, Serialize};

/// Processor, cores, load.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Machine {
    /// Name of the processor.
    pub processor: String,
    /// Cores that this process may use.
    pub cores: usize,
    /// Programs that wanted to run in the last minute, on average; more than cores: they waited for one another.
    pub load: Option<f64>,
}

impl Machine {
    /// The one this runs on, now.
    pub fn now() -> Self {
        let information = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
        let name = information.lines().find_map(|line| line.strip_prefix("model name"));
        let name = name.map_or("unknown processor", |name| name.trim_start_matches([' ', '\t', ':']));
        Self {
            processor: name.into(),
            cores: std::thread::available_parallelism().map_or(1, usize::from),
            load: load(&fs::read_to_string("/proc/loadavg").unwrap_or_default()),
        }
    }

    /// In one line.
    pub fn text(&self) -> String {
        let load = self.load.map_or("unknown".into(), |load| format!("{load:.1}"));
        format!("{}, {} cores, load {load}", self.processor, self.cores)
    }
}

/// The first number of `/proc/loadavg`.
fn load(text: &str) -> Option<f64> {
    text.split(' ').next()?.parse().ok()
}

#[cfg(test)]
mod tests {
    #[test]
    fn load_is_the_first_number() {
        assert_eq!(super::load("2.37 2.41 2.04 1/300 12345\n"), Some(2.37));
        assert_eq!(super::load(""), None);
    }
}
