//! Mass and Coriolis matrices, kinetic energy.

use nalgebra::{Matrix6, Vector1};

use crate::law::{Law, difference, largest, unbalance};
use crate::motion::{REASON, TIME_STEP, TOLERANCE, after, derivative};
use crate::subject::{Values, parts};

/// M_p = M_p^T, bit for bit: the entries below the diagonal are copies.
#[test]
fn mass_matrix_is_symmetric() {
    let law = Law { name: "M_p = M_p^T", tolerance: 0.0, reason: "both triangles are the same numbers" };
    law.holds(|subject, state| {
        let mass = subject.matrix("mass_matrix_p", state);
        largest((mass - mass.transpose()).iter().map(|x| x.abs()))
    });
}

/// x^T M_p x > 0: M_p has a Cholesky factor, and its reciprocal condition number keeps clear of rounding.
#[test]
fn mass_matrix_is_positive_definite() {
    let law = Law {
        name: "M_p > 0: condition number (m and rad)",
        tolerance: 1e4,
        reason: "kg against kg m^2 at arms of decimetres: 100, times 1/(u.a)^2 for oblique rods",
    };
    law.holds(|subject, state| {
        let mass = subject.matrix("mass_matrix_p", state);
        if mass.cholesky().is_none() {
            return f64::INFINITY;
        }
        let eigenvalues = mass.symmetric_eigenvalues();
        eigenvalues.max() / eigenvalues.min()
    });
}

/// (M_p' - 2 C_p) + (M_p' - 2 C_p)^T = 0, M_p' along a motion of base and platform.
#[test]
fn mass_rate_less_twice_coriolis_is_skew() {
    let law = Law { name: "M_p' - 2 C_p is skew", tolerance: TOLERANCE, reason: REASON };
    law.holds(|subject, state| {
        let rate = derivative(
            |t| subject.call("mass_matrix_p", &after(state, t))["mass_matrix_p"].clone(),
            TIME_STEP,
        );
        let rate = Matrix6::from_row_slice(&rate);
        let coriolis: Matrix6<f64> = subject.call("coriolis_matrices", state).matrix("coriolis_matrix_p");
        let twice = coriolis * 2.0;
        unbalance(&[rate, rate.transpose(), -twice, -twice.transpose()])
    });
}

/// The kinetic energy is the quadratic form of both mass matrices: T(v_b, v_p) - T(v_b, 0) - T(0, v_p) = -v_p^T M_b v_b, and
/// T(0, v_p) = v_p^T M_p v_p / 2.
#[test]
fn kinetic_energy_is_the_form_of_the_mass_matrices() {
    let law = Law { name: "T = v^T M v / 2", tolerance: 1e-12, reason: "sums of some hundred rounded terms" };
    law.holds(|subject, state| {
        let energy = |state| subject.call("energy", &state).scalar("kinetic_energy");
        let (v_b, v_p) = (state.vector::<6>("base_velocity"), state.vector::<6>("platform_velocity"));
        let (base_rests, platform_rests) =
            (state.with("base_velocity", &[0.0; 6]), state.with("platform_velocity", &[0.0; 6]));
        let (both, base, platform) = (energy(state.clone()), energy(platform_rests), energy(base_rests));
        let coupling = v_p.dot(&(subject.matrix("mass_matrix_b", state) * v_b));
        let own = 0.5 * v_p.dot(&(subject.matrix("mass_matrix_p", state) * v_p));
        let balance = unbalance(&[both, -base, -platform, coupling].map(Vector1::new));
        largest([balance, difference(Vector1::new(platform), Vector1::new(own))])
    });
}

/// A common translation v of base and platform carries all bodies with it: T = (sum of masses) v^2 / 2.
#[test]
fn common_translation_has_the_energy_of_the_total_mass() {
    let law =
        Law { name: "common translation: T = m v^2 / 2", tolerance: 1e-12, reason: "sums of rounded terms" };
    law.holds(|subject, state| {
        let (v, _) = parts(state.vector("base_velocity"));
        let velocity = [v.as_slice(), &[0.0; 3]].concat();
        let together = state.with("base_velocity", &velocity).with("platform_velocity", &velocity);
        let sum = |name: &str| subject.parameters[name].iter().sum::<f64>();
        let legs = subject.bodies().bodies.iter();
        let mass = legs.fold(sum("payload_mass"), |mass, (body, _)| mass + sum(&format!("{body}_mass")));
        let energy = subject.call("energy", &together).scalar("kinetic_energy");
        (energy / (0.5 * mass * v.norm_squared()) - 1.0).abs()
    });
}
