//! Sampled states: inside the workspace, in the band of reach each kind has, and the same on every machine.

mod common;

use dyn_gen::graph::{Environment, Program, solve_general};
use dyn_gen::sample::{Kind, LARGEST_CONDITION, NoPose, Pose, Workspace, states};
use dyn_gen::{GenerateError, GraphFile, sampled_states};
use dyn_platform::{Platform, Starter, starter};

fn sampled(kind: Kind, count: usize, seed: u64) -> Vec<Environment> {
    sampled_states(&common::program(), &common::platform(), &[(kind, count)], seed).unwrap()
}

fn rotation(state: &Environment, name: &str) -> [[f64; 3]; 3] {
    std::array::from_fn(|i| std::array::from_fn(|j| state[name][3 * i + j]))
}

/// R_b^T (R_p, r_p - r_b)
fn relative(state: &Environment) -> Pose {
    let (base, platform) = (rotation(state, "base_rotation"), rotation(state, "platform_rotation"));
    let offset: [f64; 3] = std::array::from_fn(|k| state["platform_position"][k] - state["base_position"][k]);
    Pose {
        position: std::array::from_fn(|i| (0..3).map(|k| base[k][i] * offset[k]).sum()),
        rotation: std::array::from_fn(|i| {
            std::array::from_fn(|j| (0..3).map(|k| base[k][i] * platform[k][j]).sum())
        }),
    }
}

/// Distance from home, m, and largest difference of the rotation matrices' entries.
fn from_home(platform: &Platform, pose: &Pose) -> (f64, f64) {
    let home = &platform.home;
    let distance = (0..3).map(|k| (pose.position[k] - home.position[k]).powi(2)).sum::<f64>().sqrt();
    let entries = pose.rotation.as_flattened().iter().zip(home.rotation.as_flattened());
    (distance, entries.fold(0.0, |most, (x, y)| most.max((x - y).abs())))
}

/// Least u.a of the legs at home, and at every state of a kind.
fn cosines(program: &Program, platform: &Platform, states: &[Environment]) -> (f64, Vec<f64>) {
    let parameters = common::parameters(program, platform);
    let home = Pose { position: platform.home.position, rotation: platform.home.rotation };
    let cosine = |pose: &Pose| common::alignment(&parameters, pose).sqrt();
    (cosine(&home), states.iter().map(|state| cosine(&relative(state))).collect())
}

#[test]
fn states_of_all_platforms_fill_the_band_of_their_kind_away_from_home() {
    let program = common::program();
    for platform in common::platforms() {
        for kind in [Kind::Random, Kind::Large, Kind::NearEdge] {
            let states = sampled_states(&program, &platform, &[(kind, 60)], 11).unwrap();
            let (home, mut cosines) = cosines(&program, &platform, &states);
            let name = &platform.name;
            cosines.sort_by(f64::total_cmp);
            let (least, median, most) = (cosines[0], cosines[30], cosines[59]);
            let band = match kind {
                Kind::NearEdge => (0.1, 0.2),
                Kind::Large => (0.4 * home, 0.95 * home),
                _ => (0.4 * home, 1.0),
            };
            assert!(least > band.0 - 1e-9 && most < band.1 + 1e-9, "{name}, {kind:?}: {least} to {most}");
            if kind != Kind::Random {
                // Spread over the band, not at one end of it.
                let middle = (median - band.0) / (band.1 - band.0);
                assert!((0.3..0.7).contains(&middle), "{name}, {kind:?}: median {median} of {band:?}");
                assert!(most - least > 0.8 * (band.1 - band.0), "{name}, {kind:?}: {least} to {most}");
            }
            let away = states.iter().map(|state| from_home(&platform, &relative(state)));
            let (distances, turns): (Vec<f64>, Vec<f64>) = away.unzip();
            for (distance, turn) in distances.iter().zip(&turns) {
                assert!(*distance > 1e-4 && *turn > 1e-4, "{name}, {kind:?}: at home");
            }
            let farthest = distances.iter().copied().fold(0.0, f64::max);
            match kind {
                // Test platforms can all go two centimetres.
                Kind::Random => assert!((0.015..0.02 + 1e-9).contains(&farthest), "{name}: {farthest} m"),
                _ => assert!(farthest > 0.03, "{name}, {kind:?}: {farthest} m"),
            }
        }
    }
}

#[test]
fn large_states_are_away_from_singular_poses() {
    let program = common::program();
    let function = program.function("jacobian_dp").unwrap();
    for platform in common::platforms() {
        let parameters = common::parameters(&program, &platform);
        let points = &parameters["platform_point"];
        let radius = (points.iter().map(|x| x * x).sum::<f64>() / 6.0).sqrt();
        let kinds = [(Kind::Large, 30), (Kind::NearEdge, 30)];
        for mut state in sampled_states(&program, &platform, &kinds, 3).unwrap() {
            state.extend(parameters.clone());
            let mut jacobian = program.evaluate(function, &state).unwrap().remove("jacobian_dp").unwrap();
            jacobian.iter_mut().enumerate().filter(|(k, _)| k % 6 >= 3).for_each(|(_, x)| *x /= radius);
            // |J x| and |J^-1 x| for the unit vectors bound the norms from below.
            let norm = |values: &[f64]| values.iter().map(|x| x * x).sum::<f64>().sqrt();
            let column = |k: usize| (0..6).map(|row| jacobian[6 * row + k]).collect::<Vec<_>>();
            let inverse_column = |k: usize| {
                let mut x = vec![0.0; 6];
                x[k] = 1.0;
                solve_general(&mut jacobian.clone(), &mut x, &mut Vec::new());
                x
            };
            let most =
                |column: &dyn Fn(usize) -> Vec<f64>| (0..6).map(|k| norm(&column(k))).fold(0.0, f64::max);
            let condition = most(&column) * most(&inverse_column);
            assert!(condition <= LARGEST_CONDITION, "{}: {condition}", platform.name);
        }
    }
}

#[test]
fn a_workspace_without_a_wanted_pose_is_an_error() {
    let identity = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let home = Pose { position: [0.0, 0.0, 0.4], rotation: identity };
    let far = |pose: &Pose| 1.0 - (pose.position[0].powi(2) + pose.position[1].powi(2)) / 0.04;
    let (round, narrow, sound, singular) =
        (|_: &Pose| 1.0, |_: &Pose| 0.09, |_: &Pose| 10.0, |_: &Pose| f64::NAN);
    let sample = |alignment: &dyn Fn(&Pose) -> f64, condition: &dyn Fn(&Pose) -> f64, kind| {
        states(&Workspace { home, alignment, condition }, kind, 5, 1)
    };
    for kind in [Kind::Home, Kind::Random, Kind::Large, Kind::NearEdge] {
        assert_eq!(sample(&far, &sound, kind).map(|states| states.len()), Ok(5));
        let expected = match kind {
            Kind::Home | Kind::Random => Ok(5),
            _ => Err(NoPose::Reach { at_home: 1.0 }),
        };
        assert_eq!(sample(&round, &sound, kind).map(|states| states.len()), expected);
    }
    assert_eq!(sample(&narrow, &sound, Kind::Large), Err(NoPose::Reach { at_home: 0.3 }));
    assert_eq!(sample(&far, &singular, Kind::Large), Err(NoPose::Singular { least: f64::INFINITY }));
}

#[test]
fn the_edge_is_found_from_a_home_beyond_it() {
    let identity = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let home = Pose { position: [0.19, 0.0, 0.4], rotation: identity };
    // Home has u.a = 0.05: the reach grows towards the axis and ends on the other side.
    let alignment = |pose: &Pose| 1.0 - pose.position[0].powi(2) / (0.19 * 0.19 / 0.9975);
    let condition = |_: &Pose| 10.0;
    let workspace = Workspace { home, alignment: &alignment, condition: &condition };
    for state in states(&workspace, Kind::NearEdge, 10, 1).unwrap() {
        let cosine = alignment(&relative(&state)).sqrt();
        assert!((0.1 - 1e-9..0.2 + 1e-9).contains(&cosine), "{cosine}");
    }
}

/// Lengths of the actuators at states of these kinds, of the starter platform with this stroke.
fn lengths_with_stroke(which: Starter, stroke: &str, kind: Kind) -> (Vec<f64>, Vec<[f64; 6]>) {
    let text = starter(which).replacen("\n[legs]", &format!("\n[legs]\n{stroke}#"), 1);
    let platform = Platform::from_toml("stroke.toml", &text).unwrap();
    let program = GraphFile::of(platform.leg_type).unwrap().program;
    let function = program.function("leg_kinematics").unwrap();
    let length = |mut state: Environment| -> [f64; 6] {
        state.extend(common::parameters(&program, &platform));
        program.evaluate(function, &state).unwrap()["actuator_length"].as_slice().try_into().unwrap()
    };
    let sampled = |kind, count| sampled_states(&program, &platform, &[(kind, count)], 5).unwrap();
    let home = length(sampled(Kind::Home, 1).remove(0));
    (home.to_vec(), sampled(kind, 60).into_iter().map(length).collect())
}

/// The worst leg of each state uses as much of its stroke as the kind says, and none is past it.
#[test]
fn states_are_within_the_stroke_of_the_platform_file() {
    for (which, shorter, longer) in [(Starter::Paper, 0.01, 0.02), (Starter::Ups, 0.03, 0.05)] {
        let (home, _) = lengths_with_stroke(which, "", Kind::Home);
        let (shortest, longest) = (home[0] - shorter, home[0] + longer);
        let stroke = format!("minimum_length_m = {shortest}\nmaximum_length_m = {longest}\n");
        for (kind, least, most) in
            [(Kind::Random, 0.0, 0.935), (Kind::Large, 0.3, 0.935), (Kind::NearEdge, 0.979, 0.996)]
        {
            let (home, lengths) = lengths_with_stroke(which, &stroke, kind);
            let mut ends = [false; 2];
            for lengths in lengths {
                let used = (0..6).map(|leg| {
                    let change = lengths[leg] - home[leg];
                    if change < 0.0 { (-change / shorter, 0) } else { (change / longer, 1) }
                });
                let (worst, end) = used.max_by(|(a, _), (b, _)| a.total_cmp(b)).unwrap();
                ends[end] = true;
                assert!((least..most).contains(&worst), "{which:?}, {kind:?}: {worst} of the stroke");
            }
            assert_eq!(ends, [true; 2], "{which:?}, {kind:?}: both ends of the stroke");
        }
    }
}

#[test]
fn coinciding_legs_have_no_sound_pose() {
    let mut platform = common::platform();
    let parameters = &mut platform.parameters;
    for pair in 0..3 {
        parameters.base_point[2 * pair + 1] = parameters.base_point[2 * pair];
        parameters.platform_point[2 * pair + 1] = parameters.platform_point[2 * pair];
    }
    let error = sampled_states(&common::program(), &platform, &[(Kind::Large, 1)], 1).unwrap_err();
    assert!(matches!(error, GenerateError::NoPose { reason: NoPose::Singular { .. }, .. }), "{error}");
}

#[test]
fn rotations_are_orthonormal() {
    for state in sampled(Kind::Large, 40, 5) {
        for name in ["base_rotation", "platform_rotation"] {
            let r = rotation(&state, name);
            for (i, j) in [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)] {
                let product: f64 = (0..3).map(|k| r[i][k] * r[j][k]).sum();
                assert!((product - f64::from(u8::from(i == j))).abs() < 1e-14);
            }
        }
    }
}

#[test]
fn a_seed_gives_the_same_states_everywhere() {
    let first = sampled(Kind::Large, 3, 2016);
    assert_eq!(first, sampled(Kind::Large, 3, 2016));
    assert_ne!(first, sampled(Kind::Large, 3, 2017));
    let bits = first[2]["platform_position"].iter().map(|value| value.to_bits()).collect::<Vec<_>>();
    expect_test::expect![[r#"
        [
            4599241904824020208,
            4588725244010487988,
            4608040078030156935,
        ]
    "#]]
    .assert_debug_eq(&bits);
}

#[test]
fn home_is_at_rest() {
    let states = sampled(Kind::Home, 1, 1);
    let moving = |name: &str| states[0][name].iter().any(|value| *value != 0.0);
    for name in [
        "base_position",
        "base_velocity",
        "platform_velocity",
        "platform_acceleration",
        "actuator_force",
        "external_wrench",
    ] {
        assert!(!moving(name), "{name}");
    }
}
