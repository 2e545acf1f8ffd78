//! Numbers baked in and numbers given at run time are the same model.

mod common;

use dyn_gen::evidence::{Sampling, cases};
use dyn_gen::graph::{Environment, Program};
use dyn_gen::{Numbers, optimise};
use dyn_platform::Platform;

fn chosen(program: &Program, platform: &Platform, names: &[&str]) -> Vec<String> {
    let numbers = Numbers::with_run_time(platform, names.iter().copied());
    let symbols = numbers.run_time_parameters(program).unwrap();
    symbols.into_iter().map(|symbol| symbol.name.clone()).collect()
}

#[test]
fn parameters_have_their_names_keys_symbols_and_groups() {
    let (program, platform) = (common::program(), common::platform());
    let one = |name: &str| match &chosen(&program, &platform, &[name])[..] {
        [only] => only.clone(),
        several => panic!("`{name}` is {several:?}"),
    };
    for (name, parameter) in [
        ("axial_stiffness", "axial_stiffness"),
        ("axial_stiffness_n_per_m", "axial_stiffness"),
        ("k_e", "axial_stiffness"),
        ("legs.k_e", "axial_stiffness"),
        ("legs.axial_stiffness_n_per_m", "axial_stiffness"),
        ("legs.d*", "mover_offset"),
        ("payload_mass", "payload_mass"),
        ("payload_mass_kg", "payload_mass"),
        ("payload.mass", "payload_mass"),
        ("payload.mass_kg", "payload_mass"),
        ("payload.com_m", "payload_com"),
        ("payload.inertia_kg_m2", "payload_inertia"),
        ("gravity", "gravity"),
        ("gravity_m_per_s2", "gravity"),
        ("g", "gravity"),
        ("a", "actuator_axis"),
        ("rod_length_m", "rod_length"),
        ("J_s", "rod_inertia"),
    ] {
        assert_eq!(one(name), parameter, "{name}");
    }
    assert_eq!(chosen(&program, &platform, &["payload"]), ["payload_mass", "payload_com", "payload_inertia"]);
    assert_eq!(chosen(&program, &platform, &["legs"]).len(), 12);
    let all: Vec<_> = program.parameters().map(|symbol| symbol.name.clone()).collect();
    assert_eq!(chosen(&program, &platform, &["all"]), all);
    assert_eq!(chosen(&program, &platform, &["legs", "gravity", "payload"]), all);
    // The order is the program's, whatever the order of the names.
    assert_eq!(chosen(&program, &platform, &["g", "k_e", "legs.k_e"]), ["axial_stiffness", "gravity"]);
    for wrong in ["mass", "mass_kg", "payload.", "gravity.k_e", "legs.payload_mass", "", "payload.rod_mass"] {
        assert!(
            Numbers::with_run_time(&platform, [wrong]).run_time_parameters(&program).is_err(),
            "`{wrong}` was accepted"
        );
    }
}

/// All outputs at some states.
fn outputs(program: &Program, platform: &Platform, numbers: &Numbers) -> Vec<Environment> {
    let functions = optimise(program, numbers, None).unwrap();
    let cases = cases(program, platform, Sampling { states: 10, seed: 3 }).unwrap();
    let evaluate = |case: &dyn_gen::evidence::Case| {
        functions
            .iter()
            .map(|function| function.graph.evaluate(&case.environment).unwrap())
            .collect::<Vec<_>>()
    };
    cases.iter().flat_map(evaluate).collect()
}

#[test]
fn baked_and_run_time_variants_are_equal() {
    let program = common::program();
    for platform in common::platforms() {
        let baked = outputs(&program, &platform, &Numbers::baked(&platform));
        for names in
            [&["payload"][..], &["gravity", "k_e"], &["legs.rod_length", "base_point"], &["legs"], &["all"]]
        {
            let numbers = Numbers::with_run_time(&platform, names.iter().copied());
            let run_time = outputs(&program, &platform, &numbers);
            for (baked, run_time) in baked.iter().zip(&run_time) {
                for (name, baked) in baked {
                    let largest = baked.iter().fold(1e-3, |most: f64, x| most.max(x.abs()));
                    let deviation =
                        baked.iter().zip(&run_time[name]).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
                    assert!(
                        deviation <= 1e-11 * largest,
                        "{}, {names:?}, {name}: {deviation:e}",
                        platform.name
                    );
                }
            }
        }
    }
}

#[test]
fn the_solve_pivots_at_run_time_only_where_geometry_is_given_then() {
    let (program, platform) = (common::program(), common::platform());
    let solves = |names: &[&str]| {
        let numbers = Numbers::with_run_time(&platform, names.iter().copied());
        let functions = optimise(&program, &numbers, Some(&["inverse_dynamics".to_owned()])).unwrap();
        (functions[0].graph.operation_count().solves, functions[0].pivot_orders().count())
    };
    assert_eq!(solves(&[]), (0, 1));
    assert_eq!(
        solves(&["payload", "gravity", "k_e", "c_e", "rod_mass", "mover_mass", "rest_length"]),
        (0, 1)
    );
    for geometry in ["base_point", "actuator_axis", "platform_point", "rod_length", "all"] {
        assert_eq!(solves(&[geometry]), (1, 0), "{geometry}");
    }
}

#[test]
fn fewer_numbers_at_run_time_are_fewer_operations() {
    let (program, platform) = (common::program(), common::platform());
    let operations = |names: &[&str]| {
        let numbers = Numbers::with_run_time(&platform, names.iter().copied());
        let functions = optimise(&program, &numbers, Some(&["inverse_dynamics".to_owned()])).unwrap();
        functions[0].graph.operation_count().total()
    };
    let (none, payload, all) = (operations(&[]), operations(&["payload"]), operations(&["all"]));
    assert!(none < payload && payload < all, "{none}, {payload}, {all}");
}
