//! Laws of mechanics that the printed graphs have to obey, whatever they are compared with. Rates along a motion are exact:
//! graphs are differentiated, not sampled at neighbouring times.

use std::collections::BTreeMap;

use nalgebra::{Matrix3, Matrix6, SVector, Vector3, Vector6};
use serde::Serialize;

use super::comparison::{Worst, evaluate, input};
use super::{Case, EvidenceError};
use crate::graph::{Batch, Environment, Graph, LANES, LaneEvaluator, Number, Rates, Values};

/// A law, and the outputs that must be generated for it to be examined.
pub struct Law {
    /// As a formula.
    pub name: &'static str,
    /// What it takes.
    needs: &'static [&'static str],
    motion: Motion,
    /// Largest violation allowed.
    pub tolerance: f64,
    /// Why not tighter.
    pub reason: &'static str,
    violation: fn(&At) -> f64,
}

/// Along which motion its outputs are taken.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Motion {
    /// At the state, no rates.
    Stopped,
    /// Along the state's velocities and accelerations, with rates.
    Along,
    /// The same with the base at rest.
    BaseAtRest,
    /// At the state, with the actuator forces that the inverse dynamics asks for.
    Driven,
}

/// Every law.
pub const LAWS: [Law; 7] = [
    Law {
        name: "M_p = M_p^T",
        needs: &["mass_matrix_p"],
        motion: Motion::Stopped,
        tolerance: 1e-14,
        reason: "both triangles are sums of the same terms",
        violation: |at| {
            let mass = at.matrix("mass_matrix_p");
            (mass - mass.transpose()).amax() / mass.amax()
        },
    },
    Law {
        name: "M_p > 0: condition number, diagonal scaled to 1",
        needs: &["mass_matrix_p"],
        motion: Motion::Stopped,
        tolerance: 1e8,
        reason: "half the digits of a solution with M_p must be left",
        violation: |at| definiteness(&at.matrix("mass_matrix_p")),
    },
    Law {
        name: "M_p' - 2 C_p is skew",
        needs: &["mass_matrix_p", "coriolis_matrix_p"],
        motion: Motion::Along,
        tolerance: 1e-10,
        reason: "rates cancel by up to the condition of a rod near a right angle to its actuator",
        violation: |at| {
            let rate = at.matrix_rate("mass_matrix_p");
            let coriolis = at.matrix("coriolis_matrix_p");
            let sum = rate - (coriolis + coriolis.transpose());
            // Cross-coupled products of speeds leave nothing at rest.
            let scale = rate.amax().max(2.0 * coriolis.amax());
            if sum.amax() == 0.0 { 0.0 } else { sum.amax() / scale }
        },
    },
    Law {
        name: "T = v_p^T M_p v_p / 2, base at rest",
        needs: &["kinetic_energy", "mass_matrix_p"],
        motion: Motion::BaseAtRest,
        tolerance: 1e-12,
        reason: "sums of some hundred rounded terms",
        violation: |at| {
            let speed = at.input::<6>("platform_velocity");
            balance([at.scalar("kinetic_energy"), -0.5 * speed.dot(&(at.matrix("mass_matrix_p") * speed))])
        },
    },
    Law {
        name: "(T + V)' = F.d' + W_ext.v_p - D.v_p, base at rest",
        needs: &["kinetic_energy", "potential_energy", "jacobian_dp", "inverse_dynamics", "damping_force"],
        motion: Motion::BaseAtRest,
        tolerance: 1e-8,
        reason: "forces have lost as many digits as the condition number of J_dp, up to 1000, has",
        violation: |at| {
            let speed = at.input::<6>("platform_velocity");
            let stored = at.scalar_rate("kinetic_energy") + at.scalar_rate("potential_energy");
            let driven = at.vector("inverse_dynamics").dot(&(at.matrix("jacobian_dp") * speed));
            let load = at.load().dot(&speed);
            balance([stored, -driven, -load, at.vector("damping_force").dot(&speed)])
        },
    },
    Law {
        name: "M_p v_p' + bias = J_dp^T F + W_ext + M_b v_b' (49)",
        needs: &["mass_matrix_p", "mass_matrix_b", "jacobian_dp", "bias", "inverse_dynamics"],
        motion: Motion::Stopped,
        tolerance: 1e-10,
        reason: "forces solve J_dp^T F = ... up to rounding, times the growth of the elimination",
        violation: |at| {
            let mass = at.matrix("mass_matrix_p");
            let platform = mass * at.input::<6>("platform_acceleration");
            let base = at.matrix("mass_matrix_b") * at.input::<6>("base_acceleration");
            let driven = at.matrix("jacobian_dp").transpose() * at.vector("inverse_dynamics");
            // Relaxed springs without gravity leave forces that are nothing but rounding: 1 mm/s^2 is measured by at least.
            residual([platform, at.vector("bias"), -driven, -at.load(), -base], 1e-3 * mass.amax())
        },
    },
    Law {
        name: "forward dynamics of the inverse dynamics' forces give v_p'",
        needs: &["inverse_dynamics", "forward_dynamics"],
        motion: Motion::Driven,
        tolerance: 1e-7,
        reason: "forces that have lost the digits of J_dp's condition, up to 1000, through M_p^-1 with a rod near its limit",
        violation: |at| {
            let wanted = at.input::<6>("platform_acceleration");
            let difference = (at.vector("forward_dynamics") - wanted).amax();
            // What the platform would do without its actuators has to be held first.
            difference / wanted.amax().max(at.vector("forward_dynamics").amax()).max(1.0)
        },
    },
];

/// Condition number of a symmetric matrix with its diagonal scaled to 1; infinite if it is not positive definite.
fn definiteness(matrix: &Matrix6<f64>) -> f64 {
    let diagonal = matrix.diagonal().map(|entry| 1.0 / entry.sqrt());
    let scaled = Matrix6::from_fn(|i, j| diagonal[i] * matrix[(i, j)] * diagonal[j]);
    if !scaled.iter().all(|entry| entry.is_finite()) {
        return f64::INFINITY;
    }
    let eigenvalues = scaled.symmetric_eigenvalues();
    let (least, most) = (eigenvalues.min(), eigenvalues.max());
    if least > 0.0 { most / least } else { f64::INFINITY }
}

/// What is left of terms that should cancel, relative to the largest.
fn balance<const N: usize>(terms: [f64; N]) -> f64 {
    residual(terms.map(SVector::<f64, 1>::new), 0.0)
}

/// The same of vectors, relative to `least` at least.
fn residual<const N: usize, const D: usize>(terms: [SVector<f64, D>; N], least: f64) -> f64 {
    let left = terms.iter().sum::<SVector<f64, D>>().amax();
    if left == 0.0 { 0.0 } else { left / terms.iter().fold(least, |most, term| f64::max(most, term.amax())) }
}

/// A law and how well it holds.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct LawRow {
    /// [`Law::name`]
    pub law: &'static str,
    /// The functions it was asked of; none where an output that it needs is not generated.
    pub functions: Vec<String>,
    /// [`Law::tolerance`]
    pub tolerance: f64,
    /// The largest violation; none where it was not examined.
    pub worst: Option<Worst>,
}

impl LawRow {
    /// Whether the violation is within the tolerance, or nothing was examined; NaN is not.
    pub fn holds(&self) -> bool {
        self.worst.is_none_or(|worst| worst.is_allowed())
    }
}

/// The functions whose laws are examined.
pub(super) struct Subject<'a> {
    graphs: Vec<&'a Graph>,
}

type Lanes = BTreeMap<&'static str, Vec<Rates>>;

impl<'a> Subject<'a> {
    pub(super) fn new(graphs: impl Iterator<Item = &'a Graph>) -> Subject<'a> {
        Subject { graphs: graphs.collect() }
    }

    /// The smallest function with this output, and the output's number there.
    fn place(&self, output: &str) -> Option<(usize, usize)> {
        let places = self.graphs.iter().enumerate().filter_map(|(number, graph)| {
            let position = graph.outputs.iter().position(|other| other.symbol.name == output)?;
            Some((number, position))
        });
        places.min_by_key(|(number, _)| self.graphs[*number].nodes.len())
    }

    /// Names of the functions that a law is asked of, none if one is not there.
    pub(super) fn functions_of(&self, law: &Law) -> Vec<String> {
        let places: Option<Vec<_>> = law.needs.iter().map(|output| self.place(output)).collect();
        let mut numbers: Vec<usize> =
            places.unwrap_or_default().into_iter().map(|(number, _)| number).collect();
        numbers.sort_unstable();
        numbers.dedup();
        numbers.into_iter().map(|number| self.graphs[number].name.clone()).collect()
    }

    /// The worst violation of each law in one batch; `results[k]` are the outputs of function k there.
    pub(super) fn examine(
        &self,
        batch: &[Case],
        first: usize,
        inputs: &Batch,
        results: &[Vec<Vec<Values>>],
    ) -> Result<Vec<Option<Worst>>, EvidenceError> {
        let mut evaluators = Evaluators::default();
        let mut known: Vec<(Motion, usize, Vec<Vec<Rates>>)> = Vec::new();
        let mut all = Vec::with_capacity(LAWS.len());
        for law in &LAWS {
            let Some(places) = law.needs.iter().map(|output| self.place(output)).collect::<Option<Vec<_>>>()
            else {
                all.push(None);
                continue;
            };
            let mut lanes = Lanes::new();
            for (output, (function, position)) in law.needs.iter().zip(places) {
                let found = known.iter().position(|(motion, k, _)| (*motion, *k) == (law.motion, function));
                let found = match found {
                    Some(found) => found,
                    None => {
                        let values = self.outputs(law.motion, function, inputs, results, &mut evaluators)?;
                        known.push((law.motion, function, values));
                        known.len() - 1
                    }
                };
                lanes.insert(output, known[found].2[position].clone());
            }
            let violations = batch.iter().enumerate().map(|(lane, case)| {
                let at = At { lanes: &lanes, environment: &case.environment, lane };
                Worst {
                    error: (law.violation)(&at),
                    tolerance: law.tolerance,
                    state: first + lane,
                    kind: case.kind,
                }
            });
            all.push(violations.reduce(Worst::or));
        }
        Ok(all)
    }

    /// The outputs of one function along a motion.
    fn outputs(
        &self,
        motion: Motion,
        function: usize,
        inputs: &Batch,
        results: &[Vec<Vec<Values>>],
        evaluators: &mut Evaluators,
    ) -> Result<Vec<Vec<Rates>>, EvidenceError> {
        let graph = self.graphs[function];
        let still = |values: &[Vec<Values>]| -> Vec<Vec<Rates>> {
            let still = |value: &Values| Rates { value: *value, ..Rates::constant(0.0) };
            values.iter().map(|array| array.iter().map(still).collect()).collect()
        };
        match motion {
            Motion::Stopped => Ok(still(&results[function])),
            Motion::Along => moving(graph, inputs, &rates_of(inputs), &mut evaluators.rates),
            Motion::BaseAtRest => {
                let mut resting = inputs.clone();
                for part in ["base_velocity", "base_acceleration"] {
                    resting.set(part, vec![[0.0; LANES]; 6]);
                }
                moving(graph, &resting, &rates_of(&resting), &mut evaluators.rates)
            }
            Motion::Driven => {
                let mut driven = inputs.clone();
                if let Some((function, output)) = self.place("inverse_dynamics") {
                    driven.set("actuator_force", results[function][output].clone());
                }
                Ok(still(&evaluate(graph, &driven, &mut evaluators.values)?))
            }
        }
    }
}

/// Memory for evaluations.
#[derive(Default)]
struct Evaluators {
    values: LaneEvaluator<Values>,
    rates: LaneEvaluator<Rates>,
}

/// The outputs of a graph with their rates for these rates of its inputs; an input without is at rest.
pub(crate) fn moving(
    graph: &Graph,
    inputs: &Batch,
    rates: &Batch,
    evaluator: &mut LaneEvaluator<Rates>,
) -> Result<Vec<Vec<Rates>>, EvidenceError> {
    let inputs = graph.inputs.iter().map(|symbol| {
        let values = input(graph, symbol, inputs)?;
        let rates = rates.get(&symbol.name).unwrap_or_default();
        let rate = |k: usize| rates.get(k).copied().unwrap_or([0.0; LANES]);
        let with_rate = |(k, value): (usize, &Values)| Rates { value: *value, rate: rate(k) };
        Ok(values.iter().enumerate().map(with_rate).collect())
    });
    let inputs = inputs.collect::<Result<Vec<Vec<Rates>>, EvidenceError>>()?;
    Ok(evaluator.run(graph, &inputs.iter().map(Vec::as_slice).collect::<Vec<_>>()))
}

/// Rates of the inputs along each state's motion: positions change by velocities, these by accelerations, parameters and
/// loads not at all.
fn rates_of(inputs: &Batch) -> Batch {
    let mut rates = Batch::default();
    for body in ["base", "platform"] {
        let part = |part: &str| inputs.get(&format!("{body}_{part}")).unwrap_or_default();
        let (velocity, rotation) = (part("velocity"), part("rotation"));
        if let ([x, y, z, turn @ ..], 9) = (velocity, rotation.len())
            && let [w1, w2, w3] = turn
        {
            // R' = S(w) R, row by row.
            let product = |a: &Values, b: &Values, c: &Values, d: &Values| -> Values {
                std::array::from_fn(|lane| a[lane] * b[lane] - c[lane] * d[lane])
            };
            let at = |row: usize, column: usize| &rotation[3 * row + column];
            let row = |row: usize, column: usize| match row {
                0 => product(w2, at(2, column), w3, at(1, column)),
                1 => product(w3, at(0, column), w1, at(2, column)),
                _ => product(w1, at(1, column), w2, at(0, column)),
            };
            rates.set(&format!("{body}_position"), vec![*x, *y, *z]);
            rates.set(&format!("{body}_rotation"), (0..9).map(|k| row(k / 3, k % 3)).collect());
        }
        rates.set(&format!("{body}_velocity"), part("acceleration").to_vec());
    }
    rates
}

/// The outputs that a law needs, at one state.
struct At<'a> {
    lanes: &'a Lanes,
    environment: &'a Environment,
    lane: usize,
}

impl At<'_> {
    fn array<const N: usize>(&self, name: &str, part: fn(&Rates) -> &Values) -> [f64; N] {
        let array = self.lanes.get(name).map_or(&[][..], Vec::as_slice);
        std::array::from_fn(|k| array.get(k).map_or(f64::NAN, |number| part(number)[self.lane]))
    }

    fn matrix(&self, name: &str) -> Matrix6<f64> {
        Matrix6::from_row_slice(&self.array::<36>(name, |number| &number.value))
    }

    fn matrix_rate(&self, name: &str) -> Matrix6<f64> {
        Matrix6::from_row_slice(&self.array::<36>(name, |number| &number.rate))
    }

    fn vector(&self, name: &str) -> Vector6<f64> {
        Vector6::from(self.array::<6>(name, |number| &number.value))
    }

    fn scalar(&self, name: &str) -> f64 {
        self.array::<1>(name, |number| &number.value)[0]
    }

    fn scalar_rate(&self, name: &str) -> f64 {
        self.array::<1>(name, |number| &number.rate)[0]
    }

    fn input<const N: usize>(&self, name: &str) -> SVector<f64, N> {
        let array = self.environment.get(name).map_or(&[][..], Vec::as_slice);
        SVector::from_fn(|k, _| array.get(k).copied().unwrap_or(f64::NAN))
    }

    /// W_ext = [F_D; M_D + (R_p r_c) x F_D]
    fn load(&self) -> Vector6<f64> {
        let wrench = self.input::<6>("external_wrench");
        let rotation = self.input::<9>("platform_rotation");
        let arm = Matrix3::from_row_slice(rotation.as_slice()) * self.input::<3>("payload_com");
        let force = Vector3::new(wrench[0], wrench[1], wrench[2]);
        let turn = arm.cross(&force);
        wrench + Vector6::new(0.0, 0.0, 0.0, turn.x, turn.y, turn.z)
    }
}
