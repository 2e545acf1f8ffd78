//! The generated forces, played to the mechanism in Exudyn, give the wanted motion: the published and the large
//! experiment. Needs Python 3.11 or later and, the first time, the network.

mod common;

use std::path::Path;

use dyn_sim::compare::worst_percent;
use dyn_sim::experiment::{self, Experiment, Silent};
use dyn_sim::scenario::Scenario;

use common::scenario;

/// By dyn-gen's own integrator and by Exudyn, in this order.
fn run(scenario: &Scenario) -> Experiment {
    let workspace = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let experiment = experiment::run(scenario, Some(&workspace), "test", &mut Silent);
    if let Some(error) = &experiment.prototype_error {
        let remedy = miette::Diagnostic::help(error).map(|help| help.to_string()).unwrap_or_default();
        panic!("{error}\n{remedy}");
    }
    assert_eq!(experiment.stop, None);
    assert_eq!(experiment.outcome.simulations.len(), 2);
    experiment
}

#[test]
fn published() {
    let scenario = scenario("published");
    assert!(scenario.grid.step_s <= 1e-4 && !scenario.prototype_half_steps);
    let tables = run(&scenario).outcome.amplitude_tables;
    let [own, exudyn] = [&tables[0], &tables[1]].map(worst_percent);
    println!("published: own integrator {own:.1e} %, Exudyn {exudyn:.1e} %");
    assert!(own < 1e-5, "own integrator: {own:e} %");
    assert!(exudyn < 0.01, "Exudyn: {exudyn:e} %");
}

/// What is left is the engine's own: its method is of second order.
#[test]
fn half_the_engines_step_leaves_a_quarter_of_the_error() {
    let mut scenario = scenario("published");
    let tables = run(&scenario).outcome.amplitude_tables;
    scenario.prototype_half_steps = true;
    let halved = run(&scenario).outcome.amplitude_tables;
    let ratio = worst_percent(&tables[1]) / worst_percent(&halved[1]);
    println!("published: Exudyn at half steps {:.1e} %, ratio {ratio:.2}", worst_percent(&halved[1]));
    assert!((3.7..4.3).contains(&ratio), "{ratio}");
}

#[test]
fn large() {
    let scenario = scenario("large");
    assert!(scenario.grid.step_s <= 2e-4 && !scenario.prototype_half_steps);
    for errors in run(&scenario).outcome.time_errors {
        let (relative, position) = (errors.acceleration_relative, errors.position_m);
        println!("large, {}: acceleration {relative:.1e}, position {position:.1e} m", errors.label);
        assert!(relative < 1e-4, "{}: {relative:e}", errors.label);
        assert!(position < 1e-6, "{}: {position:e} m", errors.label);
    }
}
