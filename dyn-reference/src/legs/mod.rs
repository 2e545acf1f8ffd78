//! Leg types, one module each.
//!
//! A leg has two moving bodies without spin that are axisymmetric about lines which turn with the leg's direction `u`, or
//! point masses. A module says where they are, how they move with base and platform, and how heavy they are;
//! everything else in this crate sums over them.

pub mod uhp;
pub mod ups;

use core::fmt::Debug;

use nalgebra::{Matrix3, Vector3};

use crate::inputs::InputError;
use crate::leg::{LegAcceleration, LegGeometry, LegVelocity};
use crate::outputs::Output;
use crate::partial_velocities::LegPartials;
use crate::state::RigidBodyMotion;

/// Spring and damper along the actuator.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AxialElement {
    /// Actuator length `d_0` at which the spring is relaxed, m.
    pub rest_length_m: f64,
    /// Stiffness `k_e`, N/m.
    pub stiffness_n_m: f64,
    /// Viscous damping `c_e`, N s/m; the paper has none.
    pub damping_n_s_m: f64,
}

impl AxialElement {
    /// `k_e (d - d_0)`, N.
    pub fn spring_tension(&self, geometry: &LegGeometry) -> f64 {
        self.stiffness_n_m * (geometry.length - self.rest_length_m)
    }

    /// `c_e d'`, N.
    pub fn damper_tension(&self, velocity: &LegVelocity) -> f64 {
        self.damping_n_s_m * velocity.length_rate
    }
}

/// One leg and its two bodies. Arrays of two are the bodies, first the one nearer to what the module names first.
pub trait LegType: Copy + Debug + PartialEq + 'static {
    /// Names and shapes of the parameters; a leading 6 counts the legs.
    const PARAMETERS: &'static [(&'static str, &'static [usize])];
    /// Results that have their own names in this leg type.
    const OUTPUTS: &'static [Output<Self>];

    /// Six legs from flat row-major arrays under the names of [`LegType::PARAMETERS`].
    ///
    /// # Errors
    /// A value is missing or has the wrong number of entries.
    fn from_arrays(lookup: &mut impl FnMut(&str) -> Option<Vec<f64>>) -> Result<[Self; 6], InputError>;

    /// Solves the closure. Out of reach, `length` and all that follows are NaN.
    fn geometry(&self, base: &RigidBodyMotion, platform: &RigidBodyMotion) -> LegGeometry;

    /// Differentiates the closure once; uses the velocities of base and platform.
    fn velocity(
        &self,
        geometry: &LegGeometry,
        base: &RigidBodyMotion,
        platform: &RigidBodyMotion,
    ) -> LegVelocity;

    /// Differentiates the closure twice; uses the velocities and accelerations of base and platform.
    fn acceleration(
        &self,
        geometry: &LegGeometry,
        velocity: &LegVelocity,
        base: &RigidBodyMotion,
        platform: &RigidBodyMotion,
    ) -> LegAcceleration;

    /// Squared cosine between `u` and the line of the actuator's force; negative or NaN where the leg cannot be built.
    fn alignment(&self, base: &RigidBodyMotion, platform: &RigidBodyMotion) -> f64;

    /// Spring and damper.
    fn axial_element(&self) -> AxialElement;

    /// Masses, kg.
    fn masses(&self) -> [f64; 2];

    /// Transverse moments of inertia about the bodies' own centres of mass, kg m^2. Both turn with `w_s`.
    fn inertias(&self) -> [f64; 2];

    /// Sum of [`LegType::inertias`], kg m^2.
    fn turning_inertia(&self) -> f64;

    /// Centres of mass, m, in O, from O's origin.
    fn com_position(
        &self,
        geometry: &LegGeometry,
        base: &RigidBodyMotion,
        platform: &RigidBodyMotion,
    ) -> [Vector3<f64>; 2];

    /// Velocities of the centres of mass, m/s, in O.
    fn com_velocity(
        &self,
        geometry: &LegGeometry,
        velocity: &LegVelocity,
        base: &RigidBodyMotion,
    ) -> [Vector3<f64>; 2];

    /// Accelerations of the centres of mass, m/s^2, in O.
    fn com_acceleration(
        &self,
        geometry: &LegGeometry,
        velocity: &LegVelocity,
        acceleration: &LegAcceleration,
        base: &RigidBodyMotion,
    ) -> [Vector3<f64>; 2];

    /// Gravity on both bodies, and the axial force (actuator less spring and damper, N) where it acts; N, in O.
    fn active_force(
        &self,
        gravity: &Vector3<f64>,
        axial_force: f64,
        geometry: &LegGeometry,
    ) -> [Vector3<f64>; 2];

    /// Partial velocities by the platform's speeds `v_p`.
    fn partials_by_platform(&self, geometry: &LegGeometry) -> LegPartials;

    /// Partial velocities by the base's speeds `v_b`.
    fn partials_by_base(&self, geometry: &LegGeometry) -> LegPartials;

    /// Time derivatives of [`LegType::partials_by_platform`], whose result is `partials`.
    fn partial_rates_by_platform(
        &self,
        partials: &LegPartials,
        geometry: &LegGeometry,
        velocity: &LegVelocity,
        platform: &RigidBodyMotion,
    ) -> LegPartials;

    /// Time derivatives of [`LegType::partials_by_base`], whose result is `partials`.
    fn partial_rates_by_base(
        &self,
        partials: &LegPartials,
        geometry: &LegGeometry,
        velocity: &LegVelocity,
        base: &RigidBodyMotion,
    ) -> LegPartials;
}

/// `J (1 - u u^T)`: inertia of a thin axisymmetric body about its centre of mass, kg m^2, in O.
pub(crate) fn transverse_inertia(inertia: f64, geometry: &LegGeometry) -> Matrix3<f64> {
    let u = &geometry.direction;
    inertia * (Matrix3::identity() - u * u.transpose())
}
