//! Time of one simulated second at 10 kHz: the published experiment by the fixed-step integrator, forces and base given,
//! with the baked model and with parameters at run time. `cargo bench -p dyn-sim`; close other programs first.

use criterion::{Criterion, criterion_group, criterion_main};
use dyn_sim::mechanism::{self, Mechanism, Model};
use dyn_sim::scenario::{Scenario, Steering};
use dyn_sim::simulate::{self, Drive, Grid};

const GRID: Grid = Grid { step_s: 1e-4, steps: 10_000 };

fn one_second(criterion: &mut Criterion) {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenarios/published.toml");
    let scenario = Scenario::from_file(path).expect("a committed scenario is valid");
    let Steering::Target(motion) = &scenario.steering else {
        panic!("the published experiment has a target")
    };
    let base = simulate::sample(GRID, &scenario.base, |_| ());
    let target = simulate::sample(GRID, motion, |_| ());
    let (baked, _) = mechanism::of_platform(&scenario.platform, scenario.gravity_on);
    let (drive, stop) = simulate::forces_along(&*baked, GRID, &base, &target, None, |_| ());
    assert_eq!(stop, None);
    let start = target[0].as_platform();

    let model = mechanism::run_time_model(&scenario.platform);
    let run_time = Model::without_gravity(model, scenario.platform.parameters.gravity);
    let mut group = criterion.benchmark_group("simulation of 1 s at 10 kHz");
    let simulate = |mechanism: &dyn Mechanism, drive: &Drive| {
        let run = simulate::simulate(mechanism, drive, &start, None, |_| ());
        assert_eq!(run.stop, None);
        run
    };
    group.bench_function("baked", |bencher| bencher.iter_with_large_drop(|| simulate(&*baked, &drive)));
    group.bench_function("parameters at run time", |bencher| {
        bencher.iter_with_large_drop(|| simulate(&run_time, &drive));
    });
    group.finish();
}

criterion_group!(benches, one_second);
criterion_main!(benches);
