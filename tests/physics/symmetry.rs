//! Where the mechanism is, how it is turned, how legs are numbered and which uniform motion it shares makes no difference.

use dyn_gen::graph::Environment;
use nalgebra::{Matrix3, Matrix6, Rotation3, SVector, Vector3, Vector6};

use crate::law::{Law, difference, largest};
use crate::subject::{Subject, Values, cases, parts};

const SOLVING: &str = "rounding errors times the condition of J_dp and M_p";

/// A change of a state that leaves lengths and forces of the legs as they were, but for their order.
struct Symmetry {
    /// Orthogonal map of inertial vectors.
    turn: Matrix3<f64>,
    /// Shift of inertial positions, m.
    shift: Vector3<f64>,
    /// Orthogonal map of vectors in base and platform axes, of the same determinant.
    relabelling: Matrix3<f64>,
    /// Where each leg goes.
    legs: [usize; 6],
}

impl Symmetry {
    const NONE: Symmetry = Symmetry {
        turn: Matrix3::new(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0),
        shift: Vector3::new(0.0, 0.0, 0.0),
        relabelling: Matrix3::new(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0),
        legs: [0, 1, 2, 3, 4, 5],
    };

    /// Map of velocities and wrenches: angular velocities and moments keep their sense under a mirror.
    fn twist_map(&self) -> Matrix6<f64> {
        let mut map = Matrix6::zeros();
        map.fixed_view_mut::<3, 3>(0, 0).copy_from(&self.turn);
        map.fixed_view_mut::<3, 3>(3, 3).copy_from(&(self.turn * self.turn.determinant()));
        map
    }

    /// Values per leg in their new order.
    fn permuted(&self, values: &[f64]) -> Vec<f64> {
        let width = values.len() / 6;
        let mut result = values.to_vec();
        for (from, to) in self.legs.into_iter().enumerate() {
            result[to * width..][..width].copy_from_slice(&values[from * width..][..width]);
        }
        result
    }

    fn state(&self, state: &Environment) -> Environment {
        let mut moved = state.with("actuator_force", &self.permuted(&state["actuator_force"]));
        for body in ["base", "platform"] {
            let name = |part| format!("{body}_{part}");
            let position: SVector<f64, 3> = self.turn * state.vector::<3>(&name("position")) + self.shift;
            let rotation = self.turn * state.matrix::<3, 3>(&name("rotation")) * self.relabelling.transpose();
            moved = moved
                .with(&name("position"), position.as_slice())
                .with(&name("rotation"), rotation.transpose().as_slice());
        }
        let twists = [
            "base_velocity",
            "base_acceleration",
            "platform_velocity",
            "platform_acceleration",
            "external_wrench",
        ];
        twists.iter().fold(moved, |moved, name| {
            moved.with(name, (self.twist_map() * state.vector::<6>(name)).as_slice())
        })
    }

    /// How far `after` in the changed state differs from `before` in the state.
    fn deviation(&self, before: &Subject, after: &Subject, state: &Environment) -> f64 {
        let (moved, map) = (self.state(state), self.twist_map());
        let permuted = |x: Vector6<f64>| Vector6::from_row_slice(&self.permuted(x.as_slice()));
        let lengths = [(before, state), (after, &moved)]
            .map(|(subject, state)| subject.call("leg_kinematics", state).vector::<6>("actuator_length"));
        let both_matrices = |name| (before.matrix(name, state), after.matrix(name, &moved));
        let both_vectors = |name| (before.vector(name, state), after.vector(name, &moved));
        let (mass_p, mass_p_after) = both_matrices("mass_matrix_p");
        let (mass_b, mass_b_after) = both_matrices("mass_matrix_b");
        let (bias, bias_after) = both_vectors("bias");
        let (force, force_after) = both_vectors("inverse_dynamics");
        let (acceleration, acceleration_after) = both_vectors("forward_dynamics");
        largest([
            difference(lengths[1], permuted(lengths[0])),
            difference(mass_p_after, map * mass_p * map.transpose()),
            difference(mass_b_after, map * mass_b * map.transpose()),
            difference(bias_after, map * bias),
            difference(force_after, permuted(force)),
            difference(acceleration_after, map * acceleration),
        ])
    }
}

/// The cases whose parameters are given at run time.
fn at_run_time() -> impl Iterator<Item = &'static (Subject, Vec<Environment>)> {
    cases().iter().filter(|(subject, _)| subject.label.starts_with("run time"))
}

/// Asserts a law between models with changed parameters and the originals.
fn holds(
    law: &Law,
    change: impl Fn(&Environment) -> Environment,
    deviation: impl Fn(&Subject, &Subject, &Environment) -> f64,
) {
    law.judge(at_run_time().flat_map(|(subject, states)| {
        let changed = subject.with(change(&subject.parameters));
        let deviations = states.iter().map(|state| deviation(subject, &changed, state)).enumerate();
        deviations.map(|(k, found)| (format!("{}, state {k}", subject.label), found)).collect::<Vec<_>>()
    }));
}

/// Everything moved to another place and turned as one, gravity as well, feels the same: M -> T M T^T with T = blkdiag(Q, Q),
/// forces of the actuators and lengths unchanged.
#[test]
fn place_and_orientation_in_space_make_no_difference() {
    let law = Law { name: "rigid motion of everything: F, d unchanged", tolerance: 1e-11, reason: SOLVING };
    let turn = Rotation3::from_scaled_axis(Vector3::new(0.9, -1.3, 0.6)).into_inner();
    let symmetry = Symmetry { turn, shift: Vector3::new(0.7, -1.1, 0.4), ..Symmetry::NONE };
    let change = |parameters: &Environment| {
        parameters.with("gravity", (turn * parameters.vector::<3>("gravity")).as_slice())
    };
    holds(&law, change, |before, after, state| symmetry.deviation(before, after, state));
}

/// Legs in another order are the same mechanism.
#[test]
fn numbering_of_legs_makes_no_difference() {
    let law = Law {
        name: "permuted legs: M_p, bias, v_p' unchanged, F permuted",
        tolerance: 1e-11,
        reason: SOLVING,
    };
    let symmetry = Symmetry { legs: [3, 0, 5, 1, 2, 4], ..Symmetry::NONE };
    let change = |parameters: &Environment| {
        let of_leg = |name: &str| name != "gravity" && !name.starts_with("payload");
        let entry = |(name, values): (&String, &Vec<f64>)| {
            (name.clone(), if of_leg(name) { symmetry.permuted(values) } else { values.clone() })
        };
        parameters.iter().map(entry).collect()
    };
    holds(&law, change, |before, after, state| symmetry.deviation(before, after, state));
}

/// The equivalence principle: a common linear acceleration is a change of gravity.
#[test]
fn common_acceleration_is_gravity() {
    let law =
        Law { name: "common acceleration with gravity: F unchanged", tolerance: 1e-11, reason: SOLVING };
    let common = Vector6::new(7.0, -11.0, 5.0, 0.0, 0.0, 0.0);
    let change = |parameters: &Environment| {
        let gravity = parameters.vector::<3>("gravity") + parts(common).0;
        parameters.with("gravity", gravity.as_slice())
    };
    holds(&law, change, |before, after, state| {
        let accelerated =
            ["base_acceleration", "platform_acceleration"].iter().fold(state.clone(), |state, name| {
                state.with(name, (state.vector::<6>(name) + common).as_slice())
            });
        let force = difference(
            after.vector("inverse_dynamics", &accelerated),
            before.vector("inverse_dynamics", state),
        );
        let free = before.vector("forward_dynamics", state) + common;
        largest([force, difference(after.vector("forward_dynamics", &accelerated), free)])
    });
}

/// Galilei: a common uniform velocity changes no force, length or rate of a leg, and no acceleration.
#[test]
fn common_velocity_makes_no_difference() {
    let law = Law { name: "Galilean boost: F, d, d', v_p' unchanged", tolerance: 1e-11, reason: SOLVING };
    let common = Vector6::new(5.0, 3.0, -4.0, 0.0, 0.0, 0.0);
    law.holds(|subject, state| {
        let boosted = ["base_velocity", "platform_velocity"].iter().fold(state.clone(), |state, name| {
            state.with(name, (state.vector::<6>(name) + common).as_slice())
        });
        let vectors = ["inverse_dynamics", "forward_dynamics", "bias"]
            .map(|name| difference(subject.vector(name, &boosted), subject.vector(name, state)));
        let (legs, legs_boosted) =
            (subject.call("leg_kinematics", state), subject.call("leg_kinematics", &boosted));
        let rates = ["actuator_length", "actuator_velocity", "actuator_acceleration"]
            .map(|name| difference(legs_boosted.vector::<6>(name), legs.vector(name)));
        largest(vectors.into_iter().chain(rates))
    });
}

/// Asserts a symmetry of the default platform itself.
fn default_platform_has(law: &Law, symmetry: &Symmetry) {
    let cases = cases().iter().filter(|(subject, _)| subject.label.ends_with(" uhp_2016"));
    law.judge(cases.flat_map(|(subject, states)| {
        let deviations = states.iter().map(|state| symmetry.deviation(subject, subject, state)).enumerate();
        deviations.map(|(k, found)| (format!("{}, state {k}", subject.label), found)).collect::<Vec<_>>()
    }));
}

/// The default platform is its own image in the plane y = 0, which swaps legs at opposite angles.
#[test]
fn default_platform_is_mirror_symmetric() {
    let law = Law { name: "uhp_2016: mirror y -> -y", tolerance: 1e-11, reason: SOLVING };
    let mirror = Matrix3::from_diagonal(&Vector3::new(1.0, -1.0, 1.0));
    default_platform_has(
        &law,
        &Symmetry { turn: mirror, relabelling: mirror, legs: [1, 0, 5, 4, 3, 2], ..Symmetry::NONE },
    );
}

/// Base and platform of the default platform, both turned by 120° about their own z, are as before with legs two further on.
#[test]
fn default_platform_is_threefold_symmetric() {
    let law =
        Law { name: "uhp_2016: base and platform turned by 120 degrees", tolerance: 1e-11, reason: SOLVING };
    let third = Rotation3::from_scaled_axis(Vector3::z() * (std::f64::consts::TAU / 3.0)).into_inner();
    default_platform_has(&law, &Symmetry { relabelling: third, legs: [2, 3, 4, 5, 0, 1], ..Symmetry::NONE });
}
