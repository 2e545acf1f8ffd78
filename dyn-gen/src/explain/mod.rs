//! A platform in figures: what it is, how it stands and moves, and what the generator makes of it.

mod conditioning;
mod limits;
mod modes;
mod text;

use dyn_platform::{Limits, Platform};
use serde::Serialize;

pub use conditioning::{Conditioning, RelativePose};
pub use limits::{Margin, Margins};
pub use modes::Mode;

use crate::GraphFile;
use crate::error::GenerateError;
use crate::evidence::{self, Evidence, EvidenceError, Sampling};
use crate::generate::{GeneratedFunction, optimise};
use crate::graph::{Environment, Program};
use crate::numbers::Numbers;
use crate::passes::PivotOrder;
use crate::sample::Pose;
use crate::workspace::{parameters, state_at};

/// Vertical acceleration of the platform in the sample motion, m/s^2.
const SAMPLE_ACCELERATION: f64 = 1.0;

/// A platform in figures. Arrays are row-major; everything is in SI units and, the base being level, in O.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Explanation {
    /// Its name.
    pub platform: String,
    /// How its legs are built.
    pub leg_type: &'static str,
    /// Degrees of freedom by (1).
    pub mobility: i64,
    /// m, B
    pub home_position: [f64; 3],
    /// P to B
    pub home_rotation: [[f64; 3]; 3],
    /// m
    pub actuator_length_at_home: Vec<f64>,
    /// Squared cosine between rod and actuator.
    pub rod_alignment_at_home: Vec<f64>,
    /// N: what holds the platform at home.
    pub holding_force: Vec<f64>,
    /// N: at home, base at rest, platform accelerating upwards by 1 m/s^2.
    pub sample_actuator_force: Vec<f64>,
    /// kg, kg m, kg m^2
    pub mass_matrix_p_at_home: Vec<f64>,
    /// Small motions about home, held by constant actuator forces, slowest first.
    pub modes: Vec<Mode>,
    /// Of J_dp over the workspace.
    pub conditioning: Conditioning,
    /// What the limits of the platform file leave; none where it has no limit of lengths or joint angles.
    pub margins: Option<Margins>,
    /// Parameters that are constants of the code.
    pub baked: Vec<String>,
    /// Parameters that are arguments.
    pub at_run_time: Vec<String>,
    /// One row per function.
    pub operations: Vec<Operations>,
    /// Linear systems solved in a fixed order of pivots.
    pub eliminations: Vec<Elimination>,
    /// What stands for or against the generated functions.
    pub evidence: Evidence,
}

/// Operations of one function.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Operations {
    /// The function.
    pub function: String,
    /// As derived.
    pub derived: usize,
    /// After each pass, in order.
    pub after: Vec<(&'static str, usize)>,
}

/// A linear system that a function solves in a fixed order of pivots.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Elimination {
    /// The function.
    pub function: String,
    /// The order and its growth.
    #[serde(flatten)]
    pub order: PivotOrder,
}

/// Explains the platform of `numbers` and the functions called `names` (all when `None`), generated from them.
///
/// # Errors
/// As [`generate`](crate::generate()), but for evidence against the functions, which is part of the explanation.
pub fn explain(
    file: &GraphFile,
    numbers: &Numbers<'_>,
    names: Option<&[String]>,
    sampling: Sampling,
) -> Result<Explanation, GenerateError> {
    let program = &file.program;
    let platform = numbers.platform().ok_or(EvidenceError::NoPlatform)?;
    let functions = optimise(program, numbers, names)?;
    let home = Home::new(program, platform)?;
    let accelerating = ("platform_acceleration", vec![0.0, 0.0, SAMPLE_ACCELERATION, 0.0, 0.0, 0.0]);
    // What the geometry alone allows: how much of that the limits leave is part of the explanation.
    let unlimited = Platform { limits: Limits::default(), ..platform.clone() };
    let cases = evidence::cases(program, &unlimited, sampling)?;
    let holding_force = home.output("inverse_dynamics", None)?;
    let at_run_time: Vec<String> =
        numbers.run_time_parameters(program)?.into_iter().map(|symbol| symbol.name.clone()).collect();
    let all = program.parameters().map(|symbol| symbol.name.clone());
    Ok(Explanation {
        platform: platform.name.clone(),
        leg_type: platform.leg_type.name(),
        mobility: mobility(program.leg_count),
        home_position: platform.home.position,
        home_rotation: platform.home.rotation,
        actuator_length_at_home: home.output("actuator_length", None)?,
        rod_alignment_at_home: home.output("rod_alignment", None)?,
        sample_actuator_force: home.output("inverse_dynamics", Some(accelerating))?,
        mass_matrix_p_at_home: home.output("mass_matrix_p", None)?,
        modes: modes::modes(&home, &holding_force)?,
        holding_force,
        conditioning: conditioning::conditioning(program, platform, &cases, sampling)?,
        margins: limits::margins(&home, platform, &cases)?,
        baked: all.filter(|name| !at_run_time.contains(name)).collect(),
        at_run_time,
        operations: functions.iter().map(operations).collect(),
        eliminations: functions.iter().flat_map(eliminations).collect(),
        evidence: evidence::gather(program, numbers, &functions, sampling)?,
    })
}

fn operations(function: &GeneratedFunction) -> Operations {
    Operations {
        function: function.graph.name.clone(),
        derived: function.before.total(),
        after: function.passes.iter().map(|pass| (pass.name, pass.after.total())).collect(),
    }
}

fn eliminations(function: &GeneratedFunction) -> impl Iterator<Item = Elimination> {
    let name = &function.graph.name;
    function.pivot_orders().map(move |order| Elimination { function: name.clone(), order: order.clone() })
}

/// Mobility by (1): F = 6 (n - m - 1) + sum f, with two links per leg between base and platform (n = 14 for six legs) and
/// three joints per leg with six freedoms together, whatever their order: m = 18, sum f = 36.
fn mobility(legs: usize) -> i64 {
    let legs = legs as i64;
    let (bodies, joints, freedoms) = (2 + 2 * legs, 3 * legs, 6 * legs);
    6 * (bodies - joints - 1) + freedoms
}

/// The platform at home with everything at rest, and what the graphs as derived say of it.
struct Home<'a> {
    program: &'a Program,
    /// State and parameters.
    environment: Environment,
}

impl<'a> Home<'a> {
    fn new(program: &'a Program, platform: &Platform) -> Result<Home<'a>, GenerateError> {
        let home = Pose { position: platform.home.position, rotation: platform.home.rotation };
        let mut environment = state_at(&home);
        environment.extend(parameters(program, platform)?);
        Ok(Home { program, environment })
    }

    /// An output of whichever function has it first, with one input changed.
    fn output(&self, name: &str, input: Option<(&str, Vec<f64>)>) -> Result<Vec<f64>, GenerateError> {
        let mut environment = self.environment.clone();
        environment.extend(input.map(|(name, values)| (name.to_owned(), values)));
        let graph = self.graph(name)?;
        let mut outputs = graph.evaluate(&environment).map_err(EvidenceError::from)?;
        Ok(outputs.remove(name).unwrap_or_default())
    }

    /// The first function that has this output, as derived.
    fn graph(&self, output: &str) -> Result<crate::graph::Graph, GenerateError> {
        let functions = &self.program.functions;
        let function = functions.iter().find(|function| function.outputs.iter().any(|name| name == output));
        let missing = || GenerateError::MissingOutput { output: output.to_owned() };
        Ok(self.program.flatten(function.ok_or_else(missing)?))
    }
}
