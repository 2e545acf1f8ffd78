//! Sampled states: inside the workspace, near its edge where asked, and the same on every machine.

mod common;

use dyn_gen::graph::Environment;
use dyn_gen::sample::{Kind, Pose, Workspace, states};

fn sampled(kind: Kind, count: usize, seed: u64) -> (Environment, Vec<Environment>) {
    let program = common::program();
    let platform = common::platform();
    let parameters = common::parameters(&program, &platform);
    let alignment = |pose: &Pose| common::alignment(&parameters, pose);
    let home = Pose { position: platform.home.position, rotation: platform.home.rotation };
    let states = states(&Workspace { home, alignment: &alignment }, kind, count, seed);
    (parameters, states)
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

#[test]
fn every_state_is_within_reach() {
    for (kind, least, most) in [
        (Kind::Home, 0.5, 1.0),
        (Kind::Random, 0.5, 1.0),
        (Kind::Large, 0.4, 0.9),
        (Kind::NearEdge, 0.1, 0.2),
    ] {
        let (parameters, states) = sampled(kind, 40, 11);
        for state in states {
            let cosine = common::alignment(&parameters, &relative(&state)).sqrt();
            assert!(cosine > least - 1e-9 && cosine < most + 1e-9, "{kind:?}: u.a = {cosine}");
        }
    }
}

#[test]
fn rotations_are_orthonormal() {
    for state in sampled(Kind::Large, 40, 5).1 {
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
    let (_, first) = sampled(Kind::Large, 3, 2016);
    assert_eq!(first, sampled(Kind::Large, 3, 2016).1);
    assert_ne!(first, sampled(Kind::Large, 3, 2017).1);
    let bits = first[2]["platform_position"].iter().map(|value| value.to_bits()).collect::<Vec<_>>();
    expect_test::expect![[r#"
        [
            4599164549726398245,
            4588123773250276836,
            4608052801190679392,
        ]
    "#]]
    .assert_debug_eq(&bits);
}

#[test]
fn home_is_at_rest() {
    let (_, states) = sampled(Kind::Home, 1, 1);
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
