//! Times of generated code beside everything it is compared with: ids `FUNCTION/IMPLEMENTATION/{throughput,latency}`. Ends with the
//! table of ratios, which goes into the folder `DYN_BENCHES_WRITE` too, if that is set.

use std::path::Path;
use std::time::{Duration, Instant};

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, BenchmarkId, Criterion};
use dyn_benches::accuracy::{self, Exact};
use dyn_benches::call::{Call, latency, throughput};
use dyn_benches::cases::{Case, FUNCTIONS, IMPLEMENTATIONS, Visitor, all, check_agreement, visit};
use dyn_benches::machine::Machine;
use dyn_benches::ratios::summarise;
use dyn_benches::results::{MACHINE, SINGLE_CALLS, VARIANTS, results_folder, write_own};
use dyn_benches::selection::Selection;
use dyn_benches::states::{COUNT, States, platform, sampled};
use dyn_benches::{CODEGEN, batch, tail};

fn main() {
    println!("compiled by {CODEGEN}");
    let platform = platform();
    let states = States::new(&sampled(&platform));
    check_agreement(&platform, &states);
    let cases = all(&platform, &states);
    let absent =
        |name: &&&str| **name != "generated_batch" && cases.iter().all(|case| case.implementation != **name);
    for name in IMPLEMENTATIONS.iter().filter(absent) {
        println!("absent: {name}");
    }
    // `DYN_EXACT` is set by `cargo xtask bench --platform`.
    let exact = std::env::var_os("DYN_EXACT").map_or_else(Exact::committed, |path| Path::new(&path).into());
    match Exact::read(&exact, &platform) {
        Ok(exact) => println!("\nrounding errors\n{}", accuracy::text(&exact.judge(&platform))),
        Err(reason) => println!("absent: rounding errors: {reason}"),
    }

    let selection = Selection::measure(&platform, &states);
    // Short enough for everything to take three minutes, in which a machine hardly changes its mood.
    let mut criterion = Criterion::default()
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_secs(1))
        .nresamples(10_000)
        .configure_from_args();
    for function in FUNCTIONS {
        let mut timer = Timer { group: criterion.benchmark_group(function), selection: &selection };
        visit(function, &platform, &states, &mut timer);
        batch::visit(function, &states, |run| timer.batch(run));
        timer.group.finish();
    }
    criterion.final_summary();

    let folder = results_folder();
    let written = write_own(&folder, VARIANTS, &selection.variants())
        .and_then(|()| write_own(&folder, MACHINE, &Machine::now()))
        .and_then(|()| write_own(&folder, SINGLE_CALLS, &tail::measure(&platform, &states, &selection)));
    let report = || {
        let summary = summarise(&folder)?;
        let into = std::env::var_os("DYN_BENCHES_WRITE");
        let written = into.map(|into| summary.write(Path::new(&into))).transpose()?;
        Ok(format!("\n{}{}", summary.text(), written.unwrap_or_default()))
    };
    match written.and_then(|()| report()) {
        Ok(text) => print!("{text}"),
        Err(reason) => eprintln!("error: {reason}"),
    }
}

struct Timer<'a> {
    group: BenchmarkGroup<'a, WallTime>,
    selection: &'a Selection,
}

impl Timer<'_> {
    /// A run computes a whole batch; the time is that of one state.
    fn batch(&mut self, run: &mut dyn FnMut()) {
        let id = BenchmarkId::new("generated_batch", "throughput");
        self.group.bench_function(id, |bencher| {
            bencher.iter_custom(|states| {
                let runs = states.div_ceil(batch::STATES as u64);
                let start = Instant::now();
                (0..runs).for_each(|_| run());
                start.elapsed().mul_f64(states as f64 / (runs * batch::STATES as u64) as f64)
            });
        });
    }
}

impl Visitor for Timer<'_> {
    fn visit<C: Call>(&mut self, case: Case, states: &[C::State; COUNT], mut call: C) {
        if self.selection.is_best(case, "throughput") {
            let mut run = throughput(&mut call, states);
            let id = BenchmarkId::new(case.implementation, "throughput");
            self.group.bench_function(id, |bencher| bencher.iter(&mut run));
        }
        if self.selection.is_best(case, "latency") {
            let mut run = latency(&mut call, states);
            let id = BenchmarkId::new(case.implementation, "latency");
            self.group.bench_function(id, |bencher| bencher.iter(&mut run));
        }
    }
}
