//! Limits and voice coils as a model prints them.

use dyn_gen::emit::{Header, Limits, Model, RuntimePath, Scalar, model_file};
use expect_test::expect;

const UP: [f64; 3] = [0.0, 0.6, 0.8];
const DOWN: [f64; 3] = [-0.6, -0.0, -0.8];

/// A different number for everything, of which some legs lack some.
const LIMITS: Limits = Limits {
    minimum_length: [Some(0.1), None, Some(0.3), Some(0.4), Some(0.5), Some(0.6)],
    maximum_length: [Some(1.1), Some(1.2), Some(1.3), Some(1.4), Some(1.5), None],
    maximum_velocity: [None; 6],
    maximum_force: [Some(3.0); 6],
    maximum_hooke_joint_angle: [Some(0.25); 6],
    maximum_platform_joint_angle: [Some(0.75); 6],
    home_direction_in_base: [DOWN, UP, UP, UP, UP, UP],
    home_direction_in_platform: [UP, UP, UP, UP, UP, DOWN],
    force_constant: Some([10.0, 20.0, 30.0, 40.0, 50.0, 60.0]),
    maximum_current: [Some(2.0), None, None, None, None, None],
};

/// The functions of limits in the file of a model that has nothing else, an array to a line.
fn printed(limits: Option<Limits>) -> String {
    let header = Header {
        title: "Limits printed for a test.".into(),
        command: "cargo test".into(),
        graphs: Vec::new(),
        platform: None,
        casadi: "0.0.0".into(),
        operations: Vec::new(),
        eliminations: Vec::new(),
        evidence: Vec::new(),
    };
    let model = Model {
        name: "test_model",
        runtime: &RuntimePath::inside(),
        parameters: &[],
        scalars: &[Scalar::F64],
        defaults: None,
        limits: limits.as_ref(),
        signatures: &[],
        functions: &[],
        in_lanes: &[],
        prepared: &[],
    };
    let file = model_file(&header, &model).expect("a printable model");
    let Some((_, from_functions)) = file.split_once("impl TestModel {") else { return String::new() };
    let (functions, _) = from_functions.split_once("\n}").expect("an end");
    let code = functions.split('\n').map(str::trim).filter(|line| !line.starts_with("///"));
    let code = code.collect::<Vec<_>>().join(" ");
    code.replace("[ ", "[")
        .replace(", ]", "]")
        .replace("], ", "],\n")
        .replace("{ ", "{\n")
        .replace("} ", "}\n")
}

#[test]
fn every_limit_stands_under_its_name() {
    expect![[r#"
         pub fn limits<T: crate::Real>() -> crate::Limits<T> {
        let c = <T as Scalar>::constant; crate::Limits {
        minimum_length_m: [c(0.1), c(f64::NEG_INFINITY), c(0.3), c(0.4), c(0.5), c(0.6)],
        maximum_length_m: [c(1.1), c(1.2), c(1.3), c(1.4), c(1.5), c(f64::INFINITY)],
        maximum_force_n: [c(3.0), c(3.0), c(3.0), c(3.0), c(3.0), c(3.0)],
        maximum_hooke_joint_angle_rad: [c(0.25), c(0.25), c(0.25), c(0.25), c(0.25), c(0.25)],
        maximum_platform_joint_angle_rad: [c(0.75), c(0.75), c(0.75), c(0.75), c(0.75), c(0.75)],
        home_direction_in_base: [[c(-0.6), c(-0.0), c(-0.8)],
        [c(0.0), c(0.6), c(0.8)],
        [c(0.0), c(0.6), c(0.8)],
        [c(0.0), c(0.6), c(0.8)],
        [c(0.0), c(0.6), c(0.8)],
        [c(0.0), c(0.6), c(0.8)]],
        home_direction_in_platform: [[c(0.0), c(0.6), c(0.8)],
        [c(0.0), c(0.6), c(0.8)],
        [c(0.0), c(0.6), c(0.8)],
        [c(0.0), c(0.6), c(0.8)],
        [c(0.0), c(0.6), c(0.8)],
        [c(-0.6), c(-0.0), c(-0.8)]],
        ..crate::Limits::none() }
        }
        pub fn voice_coils<T: crate::Real>() -> crate::current::VoiceCoils<T> {
        let c = <T as Scalar>::constant; crate::current::VoiceCoils {
        force_constant_n_per_a: [c(10.0), c(20.0), c(30.0), c(40.0), c(50.0), c(60.0)],
        maximum_current_a: [c(2.0), c(f64::INFINITY), c(f64::INFINITY), c(f64::INFINITY), c(f64::INFINITY), c(f64::INFINITY)],
        }
        }"#]].assert_eq(&printed(Some(LIMITS)));
}

#[test]
fn without_six_force_constants_there_are_no_coils() {
    let limits = Limits { force_constant: None, ..LIMITS };
    assert!(printed(Some(limits)).contains("fn limits"));
    assert!(!printed(Some(limits)).contains("voice_coils"));
    assert_eq!(printed(None), "");
}
