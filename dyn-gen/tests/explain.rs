//! A platform in figures: the figures are right, and both forms have them.

mod common;

use common::cli::{code, dyn_gen, said};
use dyn_gen::evidence::{Sampling, reference_parameters, reference_state};
use dyn_gen::explain::{Explanation, explain};
use dyn_gen::sample::Pose;
use dyn_gen::{GraphFile, Numbers, state_at};
use dyn_platform::Platform;

const PLATFORM: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../platforms/uhp_2016.toml");
const SAMPLING: Sampling = Sampling { states: 60, seed: 2016 };

fn explained(platform: &Platform) -> Explanation {
    let file = GraphFile::of(platform.leg_type).unwrap();
    explain(&file, &Numbers::baked(platform), None, SAMPLING).unwrap()
}

/// exp(S(v)) to second order and beyond, by the series.
fn turned(rotation: [[f64; 3]; 3], v: [f64; 3]) -> [[f64; 3]; 3] {
    let cross = [[0.0, -v[2], v[1]], [v[2], 0.0, -v[0]], [-v[1], v[0], 0.0]];
    let product = |a: [[f64; 3]; 3], b: [[f64; 3]; 3]| -> [[f64; 3]; 3] {
        std::array::from_fn(|i| std::array::from_fn(|j| (0..3).map(|k| a[i][k] * b[k][j]).sum()))
    };
    let (mut term, mut sum) = (rotation, rotation);
    for k in 1..8 {
        term = product(cross, term).map(|row| row.map(|x| x / f64::from(k)));
        sum = std::array::from_fn(|i| std::array::from_fn(|j| sum[i][j] + term[i][j]));
    }
    sum
}

/// Natural frequencies by differences of the hand-written forces, and by the definition det(K - w^2 M) = 0.
#[test]
fn frequencies_are_those_of_the_hand_written_dynamics() {
    for platform in common::platforms() {
        let explanation = explained(&platform);
        let parameters = reference_parameters(&platform).unwrap();
        let value = |pose: &Pose, name: &str| {
            let mut values = Vec::new();
            let state = reference_state(&state_at(pose)).unwrap();
            assert!(parameters.output(&state, name, &mut values));
            values
        };
        let home = Pose { position: platform.home.position, rotation: platform.home.rotation };
        let force = value(&home, "inverse_dynamics");
        // What is left over of gravity, springs and constant actuator forces.
        let left = |pose: &Pose| -> [f64; 6] {
            let (bias, jacobian) = (value(pose, "bias"), value(pose, "jacobian_dp"));
            std::array::from_fn(|i| {
                bias[i] - (0..6).map(|leg| jacobian[6 * leg + i] * force[leg]).sum::<f64>()
            })
        };
        let step = 1e-5;
        let mut stiffness = nalgebra::Matrix6::zeros();
        for k in 0..6 {
            let moved = |t: f64| {
                let mut position = home.position;
                let mut turn = [0.0; 3];
                if k < 3 {
                    position[k] += t
                } else {
                    turn[k - 3] = t
                }
                left(&Pose { position, rotation: turned(home.rotation, turn) })
            };
            let (before, after) = (moved(-step), moved(step));
            for i in 0..6 {
                stiffness[(i, k)] = (after[i] - before[i]) / (2.0 * step);
            }
        }
        let mass = nalgebra::Matrix6::from_row_slice(&value(&home, "mass_matrix_p"));
        assert_eq!(explanation.modes.len(), 6);
        for mode in &explanation.modes {
            let shape = nalgebra::Vector6::from(mode.shape);
            let restoring = stiffness * shape;
            let inertia = mass * shape * mode.angular_frequency_squared;
            let scale = restoring.amax().max(inertia.amax()).max(1e-3 * stiffness.amax() * shape.amax());
            let error = (restoring - inertia).amax() / scale;
            assert!(error < 1e-5, "{}: {mode:?} misses K x = w^2 M x by {error:.1e}", platform.name);
            let hertz = mode.angular_frequency_squared.max(0.0).sqrt() / (2.0 * std::f64::consts::PI);
            assert!((hertz - mode.frequency_hz).abs() < 1e-9);
        }
        assert!(
            explanation
                .modes
                .windows(2)
                .all(|pair| pair[0].angular_frequency_squared <= pair[1].angular_frequency_squared)
        );
        for (found, expected) in explanation.holding_force.iter().zip(&force) {
            assert!(
                (found - expected).abs() <= 1e-9 * force.iter().fold(1.0, |most: f64, x| most.max(x.abs()))
            );
        }
    }
}

#[test]
fn the_paper_s_platform_in_figures() {
    let explanation = explained(&common::platform());
    assert_eq!((explanation.mobility, explanation.leg_type), (6, "uhp"));
    assert!(explanation.actuator_length_at_home.iter().all(|length| (length - 0.19821).abs() < 1e-5));
    assert!(explanation.mass_matrix_p_at_home[14] - 15.902 < 1e-9);
    // Six springs at once carry 15.902 kg: w^2 is at least 6 k_e / m.
    let vertical = explanation.modes.iter().find(|mode| mode.shape[2].abs() > 0.99).expect("a vertical mode");
    let stiff = (6.0 * 21555.9_f64 / 15.902).sqrt() / (2.0 * std::f64::consts::PI);
    assert!((vertical.frequency_hz / stiff - 1.0).abs() < 0.01, "{} and {stiff}", vertical.frequency_hz);
    let conditioning = &explanation.conditioning;
    assert!(6.0 <= conditioning.home && conditioning.home <= conditioning.median);
    assert!(conditioning.median <= conditioning.worst && conditioning.worst <= 1000.0);
    assert!(explanation.margins.is_none());
    assert_eq!((explanation.baked.len(), explanation.at_run_time.len()), (16, 0));
    assert!(explanation.evidence.holds());
}

/// Without springs and gravity the platform drifts: all frequencies are zero up to rounding.
#[test]
fn a_platform_without_springs_in_free_fall_has_no_frequency() {
    let path = common::root().join("tests/platforms/no_springs.toml");
    let text = std::fs::read_to_string(path).unwrap();
    let text: String = text
        .lines()
        .map(|line| {
            if line.starts_with("gravity") {
                "gravity_m_per_s2 = [0, 0, 0]\n".into()
            } else {
                format!("{line}\n")
            }
        })
        .collect();
    let explanation = explained(&Platform::from_toml("drifting.toml", &text).unwrap());
    assert!(
        explanation.modes.iter().all(|mode| mode.angular_frequency_squared.abs() < 1e-9),
        "{:?}",
        explanation.modes
    );
}

#[test]
fn limits_leave_margins() {
    let text = std::fs::read_to_string(PLATFORM).unwrap().replace(
        "[legs]",
        "[legs]\nminimum_length_m = 0.19\nmaximum_length_m = 0.21\nmaximum_hooke_joint_angle_rad = 0.3",
    );
    let platform = Platform::from_toml("limited.toml", &text).unwrap();
    let explanation = explained(&platform);
    let margins = explanation.margins.as_ref().expect("limits");
    assert_eq!(
        margins.limits.iter().map(|row| row.limit).collect::<Vec<_>>(),
        ["minimum_length_m", "maximum_length_m", "maximum_hooke_joint_angle_rad"]
    );
    let [shortest, longest, hooke] = &margins.limits[..] else { panic!() };
    for leg in 0..6 {
        let length = explanation.actuator_length_at_home[leg];
        assert!((shortest.left_at_home[leg].unwrap() - (length - 0.19)).abs() < 1e-12);
        assert!((longest.left_at_home[leg].unwrap() - (0.21 - length)).abs() < 1e-12);
        assert!((hooke.left_at_home[leg].unwrap() - 0.3).abs() < 1e-7);
        assert!(hooke.left_at_worst[leg].unwrap() < 0.0, "the workspace has poses beyond 0.3 rad");
    }
    assert!(margins.share_of_poses_within > 0.0 && margins.share_of_poses_within < 1.0);
    let text = explanation.text();
    assert!(
        text.contains("What limits leave, leg by leg") && text.contains("% of the sampled poses"),
        "{text}"
    );
}

#[test]
fn explain_prints_text_and_json() {
    let folder = tempfile::tempdir().unwrap();
    let json = dyn_gen(folder.path(), &["explain", PLATFORM, "--json", "--states", "30"]);
    assert_eq!(code(&json), 0, "{}", said(&json));
    let json: serde_json::Value = serde_json::from_slice(&json.stdout).expect("JSON");
    assert_eq!(json["mobility"], 6);
    assert_eq!(json["modes"].as_array().map(Vec::len), Some(6));
    assert!(json["evidence"]["outputs"].as_array().unwrap().len() > 40);
    let arguments =
        ["explain", PLATFORM, "--states", "30", "--runtime", "payload", "--functions", "bias,energy"];
    let text = dyn_gen(folder.path(), &arguments);
    let text = String::from_utf8_lossy(&text.stdout).into_owned();
    assert!(text.starts_with("Platform uhp_2016 (legs uhp), mobility (1): 6\n"));
    assert!(text.contains("\nat run time     payload_mass, payload_com, payload_inertia\n"), "{text}");
    for heading in
        ["Small motions about home", "Condition of J_dp", "Operations (+ - * / sqrt)", "evidence: 30 states"]
    {
        assert!(text.contains(heading), "{heading}");
    }
    assert!(!text.contains("forward_dynamics  "));
}
