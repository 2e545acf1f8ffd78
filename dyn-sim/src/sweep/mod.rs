//! Sweeps: the same scenario for many designs of a platform, or from many starts, at once.
//!
//! A sweep file names a scenario and what varies in it or in its platform file; `scenarios/README.md` describes it. Every design
//! is read and checked as a file of its own would be, and then computed in lanes and threads (`dyn_runtime::batch`):
//!
//! | scenario | computed | found |
//! |-|-|-|
//! | `[target]` | inverse dynamics along it | forces, lengths of the actuators |
//! | `[free]` | simulation, Runge-Kutta of fourth order | accelerations, lengths, transmissibility |
//!
//! | module | holds |
//! |-|-|
//! | `file` | the sweep file, checked |
//! | `keys` | numbers in TOML files, by path |
//! | `designs` | which numbers each design has, and the design made of them |
//! | `flight`, `pursuit` | free platforms, platforms along a target |
//! | `found` | what is found out about a design |

mod designs;
mod file;
mod flight;
mod found;
mod keys;
mod pursuit;

use std::time::Instant;

use rayon::ThreadPool;
use rayon::prelude::*;

pub use designs::Design;
pub use file::{Spread, Sweep, Variation, Varied};
pub use found::{Ending, Found, Measure, measures};

use crate::experiment::Progress;
use crate::scenario::Steering;

/// Designs that a thread takes at a time: a multiple of all numbers of lanes, and few enough to tell progress.
const DESIGNS_AT_ONCE: usize = 64;

/// A sweep with its results.
#[derive(Debug)]
pub struct Swept {
    /// Each design: the numbers it has in the place of those that vary, and it itself or why it was refused.
    pub designs: Vec<(Vec<f64>, Result<Design, String>)>,
    /// What was found out about each; nothing about those that were refused.
    pub found: Vec<Option<Found>>,
    /// Time for making all designs, s.
    pub making_s: f64,
    /// Time for computing them, s.
    pub computing_s: f64,
}

impl Swept {
    /// Why the first design could not be computed, if none could.
    pub fn why_nothing(&self) -> Option<&str> {
        if self.found.iter().any(Option::is_some) {
            return None;
        }
        self.designs.first().and_then(|(_, design)| design.as_ref().err()).map(String::as_str)
    }
}

/// Makes and computes all designs of a sweep, in the threads of `pool`.
pub fn run(sweep: &Sweep, pool: &ThreadPool, progress: &mut dyn Progress) -> Swept {
    let started = Instant::now();
    progress.begin("designs");
    let numbers = sweep.numbers();
    let mut designs = Vec::with_capacity(numbers.len());
    let total = numbers.len();
    for part in numbers.chunks(DESIGNS_AT_ONCE * pool.current_num_threads()) {
        let made = |numbers: &Vec<f64>| (numbers.clone(), sweep.design(numbers));
        pool.install(|| designs.par_extend(part.par_iter().map(made)));
        progress.at(designs.len() as f64 / total as f64);
    }
    let making_s = started.elapsed().as_secs_f64();
    progress.end(making_s);

    let started = Instant::now();
    progress.begin("dynamics in lanes");
    let sound: Vec<&Design> = designs.iter().filter_map(|(_, design)| design.as_ref().ok()).collect();
    let compute = |part: &[&Design]| match sweep.nominal.steering {
        Steering::Free(..) => flight::fly(sweep, part),
        Steering::Target(_) => pursuit::pursue(sweep, part),
    };
    let mut results = Vec::with_capacity(sound.len());
    for part in sound.chunks(DESIGNS_AT_ONCE * pool.current_num_threads()) {
        let found: Vec<Vec<Found>> = pool.install(|| part.par_chunks(DESIGNS_AT_ONCE).map(compute).collect());
        results.extend(found.into_iter().flatten());
        progress.at(results.len() as f64 / sound.len() as f64);
    }
    let mut results = results.into_iter();
    let found = designs.iter().map(|(_, design)| design.as_ref().ok().and_then(|_| results.next())).collect();
    let computing_s = started.elapsed().as_secs_f64();
    progress.end(computing_s);
    Swept { designs, found, making_s, computing_s }
}
