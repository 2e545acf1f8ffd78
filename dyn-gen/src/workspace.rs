//! Sampled states of a platform, with the reach of its legs and J_dp taken from the graph itself.

use std::cell::RefCell;

use dyn_platform::{LegType, Platform};

use crate::error::GenerateError;
use crate::graph::{Environment, Evaluator, Function, Graph, Program, Role, Symbol, solve_general};
use crate::passes::{Context, PASSES};
use crate::sample::{Kind, Pose, Workspace, states};

/// The function of a graph file that tells how far a pose is from a leg's limit, and its number of results.
const ALIGNMENT: (&str, usize) = ("rod_alignment", 6);
/// The function of a graph file that gives the matrix of the linear system of actuator forces, and its number of results.
const JACOBIAN: (&str, usize) = ("jacobian_dp", 36);
/// The output of a graph file that gives actuator lengths, and its number of results.
const LENGTH: (&str, usize) = ("actuator_length", 6);

/// `count` states of every kind in `kinds` for `platform`, the same for the same seed, within the stroke that its file gives.
///
/// # Errors
/// If the graph file lacks `rod_alignment` or `jacobian_dp`, if it and the platform differ in their parameters or it and
/// sampled states in their inputs, or if poses of a kind cannot be found.
pub fn sampled_states(
    program: &Program,
    platform: &Platform,
    kinds: &[(Kind, usize)],
    seed: u64,
) -> Result<Vec<Environment>, GenerateError> {
    let parameters = parameters(program, platform)?;
    let home = Pose { position: platform.home.position, rotation: platform.home.rotation };
    check_inputs(program, &state_at(&home))?;
    let legs = AtRest::new(program, ALIGNMENT, &parameters)?;
    let condition = jacobian_condition(program, platform, &parameters)?;
    let stroke = Stroke::new(program, platform, &parameters)?;
    let most = |pose: &Pose| stroke.as_ref().map_or(1.0, |stroke| stroke.reach(pose));
    let alignment = |pose: &Pose| {
        // Out of reach may also be NaN, which must not pass for aligned.
        let aligned = legs.at(pose).into_iter();
        aligned.fold(most(pose), |least, value| if value >= least { least } else { value })
    };
    let workspace = Workspace { home, alignment: &alignment, condition: &condition };
    let mut all = Vec::new();
    for &(kind, count) in kinds {
        let sampled = states(&workspace, kind, count, seed);
        let name = || platform.name.clone();
        all.extend(sampled.map_err(|reason| GenerateError::NoPose { platform: name(), reason })?);
    }
    Ok(all)
}

/// The condition number of J_dp at a pose of the platform relative to the base, moments over the radius of the platform joints.
pub(crate) fn jacobian_condition(
    program: &Program,
    platform: &Platform,
    parameters: &Environment,
) -> Result<impl Fn(&Pose) -> f64 + use<>, GenerateError> {
    let jacobian = AtRest::new(program, JACOBIAN, parameters)?;
    let radius = joint_radius(platform);
    Ok(move |pose: &Pose| {
        let mut matrix = jacobian.at(pose);
        for row in matrix.chunks_mut(6) {
            row[3..].iter_mut().for_each(|moment| *moment /= radius);
        }
        condition(&matrix, 6)
    })
}

/// Every parameter of `program` as the platform has it.
///
/// # Errors
/// If the platform lacks one or has it in another size.
pub fn parameters(program: &Program, platform: &Platform) -> Result<Environment, GenerateError> {
    let value = |symbol: &Symbol| {
        let name = symbol.name.clone();
        let Some(values) = platform.parameter(&name) else {
            return Err(GenerateError::UnknownParameter { name });
        };
        if values.len() != symbol.len() {
            let (platform, graph) = (values.len(), symbol.shape.clone());
            return Err(GenerateError::ParameterShape { name, platform, graph });
        }
        Ok((name, values))
    };
    program.parameters().map(value).collect()
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
        "reference_velocity",
        "actuator_force",
        "external_wrench",
    ] {
        state.insert(name.into(), vec![0.0; 6]);
    }
    state
}

/// Every input that the graph file declares must be part of `state`, in the same size.
fn check_inputs(program: &Program, state: &Environment) -> Result<(), GenerateError> {
    for declaration in program.symbols.iter().filter(|declaration| declaration.role == Role::Input) {
        let symbol = &declaration.symbol;
        let sampled = state.get(&symbol.name).map_or(0, Vec::len);
        if sampled != symbol.len() {
            let (name, graph) = (symbol.name.clone(), symbol.shape.clone());
            return Err(GenerateError::InputShape { name, sampled, graph });
        }
    }
    Ok(())
}

/// A function of the graph file with the base at the origin and everything at rest.
pub(crate) struct AtRest {
    graph: Graph,
    /// The inputs, but for the platform's pose.
    inputs: Vec<Vec<f64>>,
    /// Which inputs are the platform's position and rotation.
    pose: [Option<usize>; 2],
    evaluator: RefCell<Evaluator>,
}

impl AtRest {
    pub(crate) fn new(
        program: &Program,
        (name, length): (&'static str, usize),
        parameters: &Environment,
    ) -> Result<AtRest, GenerateError> {
        let Some(function) = program.function(name) else {
            return Err(GenerateError::Sampling { name, problem: "is not in the graph file".into() });
        };
        AtRest::of_function(program, function, (name, length), parameters)
    }

    /// One output, of whichever function has it first.
    fn output(
        program: &Program,
        (name, length): (&'static str, usize),
        parameters: &Environment,
    ) -> Result<AtRest, GenerateError> {
        let has = |function: &&Function| function.outputs.iter().any(|output| output == name);
        let Some(function) = program.functions.iter().find(has) else {
            return Err(GenerateError::Sampling { name, problem: "is no output of the graph file".into() });
        };
        let mut function = function.clone();
        function.outputs.retain(|output| output == name);
        AtRest::of_function(program, &function, (name, length), parameters)
    }

    fn of_function(
        program: &Program,
        function: &Function,
        (name, length): (&'static str, usize),
        parameters: &Environment,
    ) -> Result<AtRest, GenerateError> {
        let graph = program.flatten(function);
        let found: usize = graph.outputs.iter().map(|output| output.nodes.len()).sum();
        if found != length {
            let problem = format!("gives {found} numbers instead of {length}");
            return Err(GenerateError::Sampling { name, problem });
        }
        // It is asked a hundred times for one pose on a ray: passes that keep every bit make it a third as long.
        let context = Context { parameters: parameters.clone(), states: Vec::new(), ..Context::default() };
        let exact = PASSES.iter().filter(|pass| ["bake", "simplify", "prune"].contains(&pass.name));
        let graph = exact.fold(graph, |graph, pass| (pass.run)(&graph, &context, &mut Vec::new()));
        let state = state_at(&Pose { position: [0.0; 3], rotation: [[0.0; 3]; 3] });
        let value = |symbol: &Symbol| {
            let value = state.get(&symbol.name).or_else(|| parameters.get(&symbol.name));
            value.cloned().unwrap_or_default()
        };
        let inputs = graph.inputs.iter().map(value).collect();
        let position = |name: &str| graph.inputs.iter().position(|symbol| symbol.name == name);
        let pose = ["platform_position", "platform_rotation"].map(position);
        Ok(AtRest { graph, inputs, pose, evaluator: RefCell::default() })
    }

    /// All results at a pose of the platform, one after another.
    pub(crate) fn at(&self, pose: &Pose) -> Vec<f64> {
        let mut inputs: Vec<&[f64]> = self.inputs.iter().map(Vec::as_slice).collect();
        for (input, values) in self.pose.iter().zip([&pose.position[..], pose.rotation.as_flattened()]) {
            if let Some(input) = input {
                inputs[*input] = values;
            }
        }
        let mut evaluator = self.evaluator.borrow_mut();
        let values = evaluator.run(&self.graph, &inputs);
        let results = self.graph.outputs.iter().flat_map(|output| &output.nodes);
        results.map(|node| values[node.index()]).collect()
    }
}

/// Change of length, as a fraction of the length at home, that counts as the stroke of a telescopic leg whose platform file
/// gives none.
const TELESCOPIC_STROKE: f64 = 0.6;

/// Where lengths limit the reach of legs.
struct Stroke {
    /// Actuator lengths, m.
    lengths: AtRest,
    at_home: Vec<f64>,
    shortest: [f64; 6],
    longest: [f64; 6],
}

impl Stroke {
    /// That of the platform file or, for legs whose reach nothing else limits, [`TELESCOPIC_STROKE`]; none where no length is
    /// limited.
    fn new(
        program: &Program,
        platform: &Platform,
        parameters: &Environment,
    ) -> Result<Option<Stroke>, GenerateError> {
        let otherwise = match platform.leg_type {
            // The rod perpendicular to its actuator comes first.
            LegType::Uhp => f64::INFINITY,
            LegType::Ups => TELESCOPIC_STROKE,
        };
        let (minimum, maximum) = (platform.limits.minimum_length, platform.limits.maximum_length);
        if otherwise.is_infinite() && minimum.iter().chain(&maximum).all(Option::is_none) {
            return Ok(None);
        }
        let lengths = AtRest::output(program, LENGTH, parameters)?;
        let at_home =
            lengths.at(&Pose { position: platform.home.position, rotation: platform.home.rotation });
        let end = |limit: Option<f64>, leg: usize, side: f64| {
            limit.unwrap_or_else(|| at_home[leg] + side * otherwise * at_home[leg].abs())
        };
        let shortest = std::array::from_fn(|leg| end(minimum[leg], leg, -1.0));
        let longest = std::array::from_fn(|leg| end(maximum[leg], leg, 1.0));
        Ok(Some(Stroke { lengths, at_home, shortest, longest }))
    }

    /// What stands for (u.a)^2 where lengths limit the reach: for the leg that has used most of its stroke, 1 at home, 0 at the
    /// end, negative beyond.
    fn reach(&self, pose: &Pose) -> f64 {
        let now = self.lengths.at(pose);
        let used = |leg: usize| {
            let (now, home) = (now[leg], self.at_home[leg]);
            let end = if now < home { self.shortest[leg] } else { self.longest[leg] };
            (now - home) / (end - home)
        };
        // Out of reach there is no length, and rod_alignment says so.
        (0..6).map(|leg| 1.0 - used(leg) * used(leg)).fold(1.0, f64::min)
    }
}

/// Root mean square distance of the platform joints from the platform's origin, m.
fn joint_radius(platform: &Platform) -> f64 {
    let points = platform.parameters.platform_point.as_flattened();
    (points.iter().map(|x| x * x).sum::<f64>() / 6.0).sqrt()
}

/// |A| |A^-1| in the Frobenius norm, which is between the spectral condition number and n times it; not finite or NaN for a
/// singular matrix (n x n, row-major).
fn condition(matrix: &[f64], n: usize) -> f64 {
    let square_sum = |values: &[f64]| values.iter().map(|x| x * x).sum::<f64>();
    let mut pivots = Vec::new();
    let inverse: f64 = (0..n)
        .map(|k| {
            let mut column = vec![0.0; n];
            column[k] = 1.0;
            solve_general(&mut matrix.to_vec(), &mut column, &mut pivots);
            square_sum(&column)
        })
        .sum();
    (square_sum(matrix) * inverse).sqrt()
}

#[cfg(test)]
mod tests {
    use super::condition;

    #[test]
    fn the_condition_of_small_matrices() {
        // |A|^2 = 1 + 1e6, |A^-1|^2 = 1 + 1e-6.
        let diagonal = condition(&[1.0, 0.0, 0.0, 1e3], 2);
        assert!((diagonal / (1e3 + 1e-3) - 1.0).abs() < 1e-12, "{diagonal}");
        let singular = condition(&[1.0, 2.0, 2.0, 4.0], 2);
        assert!(!singular.is_finite(), "{singular}");
    }
}
