//! Times of generated code beside the hand-written reference: ids `FUNCTION/IMPLEMENTATION/{throughput,latency}`.

use std::time::Duration;

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, BenchmarkId, Criterion};
use dyn_benches::CODEGEN;
use dyn_benches::call::{Call, latency, throughput};
use dyn_benches::cases::{FUNCTIONS, Visitor, check_agreement, visit};
use dyn_benches::states::{COUNT, States, platform, sampled};

fn main() {
    println!("compiled by {CODEGEN}");
    let platform = platform();
    let states = States::new(&sampled(&platform));
    check_agreement(&platform, &states);

    // 36 cases: short enough to stay within a few minutes, in which a machine hardly changes its mood.
    let mut criterion = Criterion::default()
        .warm_up_time(Duration::from_secs(1))
        .measurement_time(Duration::from_secs(2))
        .configure_from_args();
    for function in FUNCTIONS {
        let mut timer = Timer(criterion.benchmark_group(function));
        visit(function, &platform, &states, &mut timer);
        timer.0.finish();
    }
    criterion.final_summary();
}

struct Timer<'a>(BenchmarkGroup<'a, WallTime>);

impl Visitor for Timer<'_> {
    fn visit<C: Call>(
        &mut self,
        _: &'static str,
        implementation: &'static str,
        states: &[C::State; COUNT],
        mut call: C,
    ) {
        let mut run = throughput(&mut call, states);
        self.0
            .bench_function(BenchmarkId::new(implementation, "throughput"), |bencher| bencher.iter(&mut run));
        drop(run);
        let mut run = latency(&mut call, states);
        self.0.bench_function(BenchmarkId::new(implementation, "latency"), |bencher| bencher.iter(&mut run));
    }
}
