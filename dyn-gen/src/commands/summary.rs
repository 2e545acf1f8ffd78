//! `dyn-gen summary`: what a platform is and what the generator makes of it.

use std::path::PathBuf;

use clap::Args;
use dyn_gen::deviation::tolerance;
use dyn_gen::evidence::{self, Agreement, KINDS};
use dyn_gen::graph::Environment;
use dyn_gen::passes::PivotOrder;
use dyn_gen::sample::Pose;
use dyn_gen::{GeneratedFunction, GraphFile, Numbers, optimise, state_at};
use dyn_platform::Platform;
use miette::{IntoDiagnostic, Result};
use serde::Serialize;

use super::Outcome;
use super::progress::with_progress;

/// States of each kind at which results are compared.
const STATES: usize = 100;
/// Their seed; another than that of the states by which pivots were chosen.
const SEED: u64 = 2016;
/// Vertical acceleration of the platform in the sample motion, m/s^2.
const SAMPLE_ACCELERATION: f64 = 1.0;

/// Arguments of `summary`.
#[derive(Args)]
pub struct Summary {
    /// Platform file
    #[arg(value_name = "PLATFORM.toml")]
    platform: PathBuf,
    /// Machine-readable
    #[arg(long)]
    json: bool,
}

/// Everything the summary says.
#[derive(Serialize)]
struct Report {
    platform: String,
    leg_type: &'static str,
    mobility: i64,
    /// m
    actuator_length_at_home: Vec<f64>,
    /// kg, kg m, kg m^2; row-major, O
    mass_matrix_p_at_home: Vec<f64>,
    /// N, at home, base at rest, platform accelerating upwards by 1 m/s^2
    sample_actuator_force: Vec<f64>,
    operations: Vec<Operations>,
    eliminations: Vec<Elimination>,
    evidence: Evidence,
}

#[derive(Serialize)]
struct Operations {
    function: String,
    derived: usize,
    /// After each pass, in order.
    after: Vec<(&'static str, usize)>,
}

/// A linear system that a function solves in a fixed order of pivots.
#[derive(Serialize)]
struct Elimination {
    function: String,
    #[serde(flatten)]
    order: PivotOrder,
}

#[derive(Serialize)]
struct Evidence {
    states_of_each_kind: usize,
    seed: u64,
    outputs: Vec<Agreement>,
}

impl Summary {
    /// Prints the summary.
    pub fn run(self) -> Result<Outcome> {
        let platform = Platform::from_file(&self.platform)?;
        let file = GraphFile::uhp()?;
        let report = with_progress("comparing with the hand-written dynamics", || report(&file, &platform))?;
        if self.json {
            println!("{}", serde_json::to_string_pretty(&report).into_diagnostic()?);
        } else {
            print!("{}", report.text());
        }
        let beyond: Vec<&Agreement> = report.evidence.outputs.iter().filter(|row| !row.holds()).collect();
        for row in &beyond {
            eprintln!(
                "{}, {}: relative error {:.1e} is beyond the tolerance {:.0e}",
                row.function,
                row.output,
                row.overall(),
                tolerance(&row.output)
            );
        }
        Ok(if beyond.is_empty() { Outcome::Done } else { Outcome::Differs })
    }
}

fn report(file: &GraphFile, platform: &Platform) -> Result<Report> {
    let functions = optimise(&file.program, Numbers::Baked(platform), None)?;
    let mut state = state_at(&Pose { position: platform.home.position, rotation: platform.home.rotation });
    state.insert("platform_acceleration".into(), vec![0.0, 0.0, SAMPLE_ACCELERATION, 0.0, 0.0, 0.0]);
    let operations = functions.iter().map(|function| Operations {
        function: function.graph.name.clone(),
        derived: function.before.total(),
        after: function.passes.iter().map(|pass| (pass.name, pass.after.total())).collect(),
    });
    let eliminations = functions.iter().flat_map(|function| {
        let orders = function.passes.iter().flat_map(|pass| &pass.pivot_orders);
        orders.map(|order| Elimination { function: function.graph.name.clone(), order: order.clone() })
    });
    Ok(Report {
        platform: platform.name.clone(),
        leg_type: platform.leg_type.name(),
        mobility: mobility(file.program.leg_count),
        actuator_length_at_home: output(&functions, "actuator_length", &state)?,
        mass_matrix_p_at_home: output(&functions, "mass_matrix_p", &state)?,
        sample_actuator_force: output(&functions, "inverse_dynamics", &state)?,
        operations: operations.collect(),
        eliminations: eliminations.collect(),
        evidence: Evidence {
            states_of_each_kind: STATES,
            seed: SEED,
            outputs: evidence::compare(&file.program, platform, &functions, STATES, SEED)?,
        },
    })
}

/// Mobility by (1): F = 6 (n - m - 1) + sum f, with two links per leg between base and platform (n = 14 for six
/// legs), and per leg a slider (f = 1), a Hooke joint (2) and the platform's universal joint with its three rotations (3):
/// m = 18, sum f = 36.
fn mobility(legs: usize) -> i64 {
    let legs = legs as i64;
    let (bodies, joints, freedoms) = (2 + 2 * legs, 3 * legs, (1 + 2 + 3) * legs);
    6 * (bodies - joints - 1) + freedoms
}

/// An output of whichever function has it first.
fn output(functions: &[GeneratedFunction], name: &str, state: &Environment) -> Result<Vec<f64>> {
    let has = |function: &&GeneratedFunction| {
        function.graph.outputs.iter().any(|output| output.symbol.name == name)
    };
    let function =
        functions.iter().find(has).ok_or_else(|| miette::miette!("the graph file has no output `{name}`"))?;
    let mut outputs = function.graph.evaluate(state).into_diagnostic()?;
    Ok(outputs.remove(name).unwrap_or_default())
}

impl Report {
    fn text(&self) -> String {
        let mut lines = vec![
            format!("Platform {} (legs {}), mobility (1): {}", self.platform, self.leg_type, self.mobility),
            String::new(),
            format!("actuator lengths at home [m]       {}", numbers(&self.actuator_length_at_home, 5)),
            format!("actuator forces of a motion [N]    {}", numbers(&self.sample_actuator_force, 3)),
            format!(
                "  (at home, base at rest, platform accelerating upwards by {SAMPLE_ACCELERATION} m/s^2)"
            ),
            "mass matrix M_p at home [kg, kg m, kg m^2]".into(),
        ];
        lines.extend(self.mass_matrix_p_at_home.chunks(6).map(|row| format!("  {}", numbers(row, 5))));
        lines.extend([String::new(), "Operations (+ - * / sqrt) as derived and after each pass".into()]);
        if let Some(first) = self.operations.first() {
            let passes: String = first.after.iter().map(|(pass, _)| format!("{pass:>9}")).collect();
            lines.push(format!("  {:<20}{:>9}{passes}", "function", "derived"));
        }
        for row in &self.operations {
            let counts: String = row.after.iter().map(|(_, count)| format!("{count:>9}")).collect();
            lines.push(format!("  {:<20}{:>9}{counts}", row.function, row.derived));
        }
        for Elimination { function, order } in &self.eliminations {
            lines.push(format!(
                "  the 6 x 6 solve of {function} lets rounding errors grow by {:.1} at the worst of {} states (complete pivoting: {:.1})",
                order.growth, order.states, order.growth_of_complete_pivoting
            ));
        }
        let Evidence { states_of_each_kind, seed, outputs } = &self.evidence;
        lines.extend([
            String::new(),
            "Agreement with the hand-written dynamics: largest relative error of any output".into(),
            format!("  ({states_of_each_kind} states of each kind, seed {seed}; --json has every output)"),
        ]);
        let kinds: String = KINDS.iter().map(|(_, name)| format!("{name:>11}")).collect();
        lines.push(format!("  {:<20}{kinds}   output", "function"));
        for rows in outputs.chunk_by(|a, b| a.function == b.function) {
            let worst = rows.iter().max_by(|a, b| a.overall().total_cmp(&b.overall())).unwrap_or(&rows[0]);
            let errors: String = worst.worst.iter().map(|error| format!("{error:>11.1e}")).collect();
            lines.push(format!("  {:<20}{errors}   {}", worst.function, worst.output));
        }
        lines.push(String::new());
        lines.join("\n")
    }
}

fn numbers(values: &[f64], decimals: usize) -> String {
    // No minus sign on what rounds to zero.
    let half = 0.5 * 0.1_f64.powi(decimals as i32);
    let shown = |value: &f64| if value.abs() < half { 0.0 } else { *value };
    values.iter().map(|value| format!("{:>10.decimals$}", shown(value))).collect()
}
