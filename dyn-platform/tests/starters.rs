//! Files to start from: each is accepted without a warning, and is the platform that it says.

use std::path::Path;

use dyn_platform::{LegType, Platform, Starter, Vector3, starter};

fn read(which: Starter) -> Platform {
    let platform = Platform::from_toml(which.name(), starter(which))
        .unwrap_or_else(|error| panic!("{}: {error}: {:?}", which.name(), error.refusals()));
    assert_eq!(platform.warnings, [], "{}", which.name());
    platform
}

fn default_platform() -> Platform {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    Platform::from_file(root.join("platforms/uhp_2016.toml")).expect("the default platform")
}

#[test]
fn every_one_is_a_platform() {
    for which in Starter::ALL {
        let platform = read(which);
        let is_ups = which == Starter::Ups;
        assert_eq!(platform.leg_type, if is_ups { LegType::Ups } else { LegType::Uhp });
        assert_eq!(platform.name, "my_platform");
        assert!(platform.limits.is_empty());
    }
}

/// The header tells how to make use of the limits.
#[test]
fn limits_wait_behind_their_marks() {
    for which in Starter::ALL {
        let text = starter(which);
        let payload = text.find("\n[payload]").expect("a payload");
        let text = text[..payload].replace("#~ ", "") + &text[payload..];
        let platform = Platform::from_toml(which.name(), &text).expect("reasonable limits");
        assert_eq!(platform.warnings, []);
        let limits = platform.limits;
        assert!(limits.minimum_length[0].is_some() && limits.maximum_platform_joint_angle[5].is_some());
    }
}

#[test]
fn paper_is_the_default_platform() {
    let (paper, default) = (read(Starter::Paper), default_platform());
    assert_eq!((paper.home, &paper.parameters), (default.home, &default.parameters));
}

#[test]
fn free_is_the_default_platform_to_a_micrometre() {
    let (mut free, default) = (read(Starter::Free), default_platform());
    let near = |one: [Vector3; 6], other: [Vector3; 6]| {
        one.as_flattened().iter().zip(other.as_flattened()).all(|(a, b)| (a - b).abs() <= 0.5e-6)
    };
    assert!(near(free.parameters.base_point, default.parameters.base_point));
    assert!(near(free.parameters.platform_point, default.parameters.platform_point));
    free.parameters.base_point = default.parameters.base_point;
    free.parameters.platform_point = default.parameters.platform_point;
    assert_eq!((free.home, &free.parameters), (default.home, &default.parameters));
}

/// Legs that start at one corner are perpendicular, and each rod is in line with its actuator.
#[test]
fn cubic_legs_are_perpendicular() {
    let platform = read(Starter::Cubic);
    let parameters = &platform.parameters;
    let axes = parameters.leg_vectors("actuator_axis").expect("a parameter of legs uhp");
    let dot = |a: Vector3, b: Vector3| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    for corner in 0..3 {
        let (one, other) = (2 * corner, 2 * corner + 1);
        assert_eq!(parameters.base_point[one], parameters.base_point[other]);
        assert!(dot(axes[one], axes[other]).abs() < 1e-11);
    }
    for (leg, axis) in axes.into_iter().enumerate() {
        let between: Vector3 = std::array::from_fn(|k| {
            platform.home.position[k] + parameters.platform_point[leg][k] - parameters.base_point[leg][k]
        });
        let along = dot(between, axis);
        let across: Vector3 = std::array::from_fn(|k| between[k] - along * axis[k]);
        assert!(dot(across, across).sqrt() < 2e-9, "{across:?}");
        assert!((along - 0.32).abs() < 2e-9);
    }
}
