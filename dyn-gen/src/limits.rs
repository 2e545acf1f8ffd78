//! What the actuators and joints of a platform may do, from its file and its pose at home, ready to be printed.

use dyn_platform::{Limit, Platform};

use crate::emit::Limits;
use crate::graph::Program;
use crate::sample::Pose;
use crate::workspace::{parameters, state_at};

/// The output of a graph file that gives the directions of the rods, O.
const DIRECTION: &str = "rod_direction";

/// The limits of a platform; `None` where the graph file gives no directions of rods at home.
pub fn of_platform(program: &Program, platform: &Platform) -> Option<Limits> {
    let home = Pose { position: platform.home.position, rotation: platform.home.rotation };
    let mut environment = state_at(&home);
    environment.extend(parameters(program, platform).ok()?);
    let function =
        program.functions.iter().find(|function| function.outputs.iter().any(|name| name == DIRECTION))?;
    let outputs = program.flatten(function).evaluate(&environment).ok()?;
    let directions = outputs.get(DIRECTION).filter(|numbers| numbers.iter().all(|x| x.is_finite()))?;
    let (directions, []) = directions.as_chunks::<3>() else { return None };
    let in_base: [[f64; 3]; 6] = directions.try_into().ok()?;
    // R^T u: from axes of the base, which are those of O at home, to those of the platform.
    let turned = |u: [f64; 3]| [0, 1, 2].map(|k| (0..3).map(|row| home.rotation[row][k] * u[row]).sum());
    let file = &platform.limits;
    Some(Limits {
        minimum_length: file.minimum_length,
        maximum_length: file.maximum_length,
        maximum_velocity: file.maximum_velocity,
        maximum_force: file.maximum_force,
        maximum_hooke_joint_angle: file.maximum_hooke_joint_angle,
        maximum_platform_joint_angle: file.maximum_platform_joint_angle,
        home_direction_in_base: in_base,
        home_direction_in_platform: in_base.map(turned),
        force_constant: every(file.force_constant),
        maximum_current: std::array::from_fn(|leg| {
            Some(current(file.maximum_force[leg]?, file.force_constant[leg]?))
        }),
    })
}

/// The current of a force, both positive, rounded down where the coil would give more than that force otherwise. One number serves
/// both precisions, so some currents are less than they could be by the last digit of single precision.
fn current(force: f64, constant: f64) -> f64 {
    let mut current = force / constant;
    // Two roundings of three numbers are made good for by as many steps; beyond its range single precision has no digits.
    for _ in 0..4 {
        let single = current as f32;
        if single.is_normal() && (constant as f32).is_normal() && single * constant as f32 > force as f32 {
            current = single.next_down().into();
        }
    }
    while current * constant > force {
        current = current.next_down();
    }
    current
}

/// What all legs have.
fn every(limit: Limit) -> Option<[f64; 6]> {
    let given: Vec<f64> = limit.into_iter().flatten().collect();
    given.try_into().ok()
}

#[cfg(test)]
mod tests {
    #[test]
    fn no_current_makes_more_than_its_force() {
        assert_eq!(super::current(200.0, 25.0), 8.0);
        assert_eq!(super::current(1e200, 1e100), 1e100);
        assert_eq!(super::current(0.5, 1e-42), 0.5 / 1e-42);
        for k in 1..2000 {
            let (force, constant) = (f64::from(k) * 0.37, 17.0 + f64::from(k) * 0.013);
            let current = super::current(force, constant);
            assert!(current * constant <= force && (1.0 - current * constant / force) < 3e-7);
            assert!(current as f32 * constant as f32 <= force as f32, "{force} N, {constant} N/A");
        }
    }
}
