//! What "agree" means: the one table of tolerances, each with its reason.

/// Allowed deviation of an output array: largest absolute difference over the largest entry of the expected array.
#[derive(Clone, Copy, Debug)]
pub struct Tolerance {
    /// Outputs it is for.
    pub outputs: &'static [&'static str],
    /// Largest relative deviation in the maximum norm.
    pub relative: f64,
    /// Why not tighter.
    pub reason: &'static str,
}

/// Tolerances that differ from [`DEFAULT`].
pub const TOLERANCES: &[Tolerance] = &[Tolerance {
    outputs: &["inverse_dynamics"],
    relative: 1e-11,
    reason: "rounding errors are multiplied by the condition number of J_dp, up to some hundreds near the edge",
}];

/// Matrices, Jacobians, bias, accelerations, kinematics, energies: sums of a few hundred products.
pub const DEFAULT: Tolerance = Tolerance {
    outputs: &[],
    relative: 1e-12,
    reason: "sums of some hundred rounded terms, partly cancelling: some thousand times the unit roundoff",
};

/// The tolerance of an output.
pub fn tolerance(output: &str) -> f64 {
    TOLERANCES.iter().find(|row| row.outputs.contains(&output)).unwrap_or(&DEFAULT).relative
}
