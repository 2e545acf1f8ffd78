//! Sampled states of a platform, with the reach of its legs taken from the graph itself.

use dyn_platform::Platform;

use crate::generate::GenerateError;
use crate::graph::{Environment, Evaluator, Program};
use crate::sample::{Kind, Pose, Workspace, states};

/// The function of a graph file that tells how far a pose is from a leg's limit.
const ALIGNMENT: &str = "rod_alignment";

/// `count` states of every kind in `kinds` for `platform`, the same for the same seed.
///
/// # Errors
/// If the graph file has no function `rod_alignment` or the platform lacks a parameter.
pub fn sampled_states(
    program: &Program,
    platform: &Platform,
    kinds: &[(Kind, usize)],
    seed: u64,
) -> Result<Vec<Environment>, GenerateError> {
    let function = program
        .function(ALIGNMENT)
        .ok_or_else(|| GenerateError::UnknownFunction { name: ALIGNMENT.into(), known: String::new() })?;
    let graph = program.flatten(function);
    let fixed = state_at(&pose_of(platform));
    let fixed = graph
        .inputs
        .iter()
        .map(|symbol| match fixed.get(&symbol.name) {
            Some(values) => Ok(values.clone()),
            None => parameter(platform, &symbol.name),
        })
        .collect::<Result<Vec<_>, _>>()?;
    let alignment = |pose: &Pose| {
        let inputs: Vec<&[f64]> = graph
            .inputs
            .iter()
            .zip(&fixed)
            .map(|(symbol, fixed)| match symbol.name.as_str() {
                "platform_position" => &pose.position[..],
                "platform_rotation" => pose.rotation.as_flattened(),
                _ => fixed,
            })
            .collect();
        let mut evaluator = Evaluator::new();
        let values = evaluator.run(&graph, &inputs);
        let legs = graph.outputs.iter().flat_map(|output| &output.nodes).map(|id| values[id.index()]);
        // Out of reach may also be NaN, which must not pass for aligned.
        legs.fold(1.0, |least, value| if value >= least { least } else { value })
    };
    let workspace = Workspace { home: pose_of(platform), alignment: &alignment };
    Ok(kinds.iter().flat_map(|&(kind, count)| states(&workspace, kind, count, seed)).collect())
}

/// The state at rest with the base at the origin and the platform at `pose`, no load.
pub fn state_at(pose: &Pose) -> Environment {
    let level = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
    let mut state: Environment = [
        ("base_position", vec![0.0; 3]),
        ("base_rotation", level.to_vec()),
        ("platform_position", pose.position.to_vec()),
        ("platform_rotation", pose.rotation.as_flattened().to_vec()),
    ]
    .map(|(name, values)| (name.to_owned(), values))
    .into();
    for name in [
        "base_velocity",
        "base_acceleration",
        "platform_velocity",
        "platform_acceleration",
        "actuator_force",
        "external_wrench",
    ] {
        state.insert(name.into(), vec![0.0; 6]);
    }
    state
}

/// Home of the platform relative to its base.
fn pose_of(platform: &Platform) -> Pose {
    Pose { position: platform.home.position, rotation: platform.home.rotation }
}

/// A parameter of the platform by name.
pub fn parameter(platform: &Platform, name: &str) -> Result<Vec<f64>, GenerateError> {
    platform.parameter(name).ok_or_else(|| GenerateError::UnknownParameter { name: name.into() })
}
