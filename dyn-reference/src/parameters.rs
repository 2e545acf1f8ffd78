//! The platform's physical parameters, plain numbers in SI units. Those of the legs are in [`crate::legs`].

use nalgebra::{Matrix3, Vector3};

use crate::legs::uhp;

/// The platform together with its payload, one rigid body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Payload {
    /// Mass `m_p`, kg.
    pub mass_kg: f64,
    /// Centre of mass `r_c`, m, in P.
    pub com_m: Vector3<f64>,
    /// Inertia `I_c` about the centre of mass, kg m^2, in P; symmetric.
    pub inertia_kg_m2: Matrix3<f64>,
}

/// All parameters of a six-legged platform with legs of type `L`; the paper's, if nothing is said.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameters<L = uhp::Leg> {
    /// The six legs.
    pub legs: [L; 6],
    /// Platform and payload.
    pub payload: Payload,
    /// Gravitational acceleration `g`, m/s^2, in O; zero for the paper's simulation.
    pub gravity_m_s2: Vector3<f64>,
}
