//! Generalised forces of every body for the six platform speeds, (39)-(46), and the passive forces, in O
//! coordinates.
//!
//! An active force is gravity on every body, the external wrench on the payload, and on the mover the forces
//! along its axis: actuator, spring, damper. An inertia force is `-m r''` with the moment `-(I w' + w x I
//! w)`. Each is projected on its body's partial velocities. In (42) the external force appears a second time;
//! it acts once, on the payload (39).

use core::array::from_fn;

use nalgebra::{Vector3, Vector6};

use crate::bodies::{mover_acceleration, rod_com};
use crate::leg::{LegAcceleration, LegGeometry, LegVelocity, leg_geometries, leg_velocities};
use crate::matrices::{payload_inertia, rod_inertia};
use crate::parameters::{Leg, Parameters};
use crate::partial_velocities::{LegPartials, PayloadPartials};
use crate::state::{RigidBodyMotion, State, angular, linear};

/// Force at a body's centre of mass and moment, N and N m, in O.
struct Wrench {
    force: Vector3<f64>,
    moment: Vector3<f64>,
}

/// Gravity and external wrench on the payload.
fn payload_active(parameters: &Parameters, state: &State) -> Wrench {
    Wrench {
        force: parameters.payload.mass_kg * parameters.gravity_m_s2 + linear(&state.external_wrench),
        moment: angular(&state.external_wrench),
    }
}

/// Inertia force and moment of the payload.
fn payload_inertia_wrench(parameters: &Parameters, platform: &RigidBodyMotion) -> Wrench {
    let acceleration = platform.point_acceleration(&(platform.rotation * parameters.payload.com_m));
    let inertia = payload_inertia(parameters, platform);
    let w = platform.angular_velocity();
    Wrench {
        force: -parameters.payload.mass_kg * acceleration,
        moment: -(inertia * platform.angular_acceleration() + w.cross(&(inertia * w))),
    }
}

/// Forces on one leg's bodies, N and N m, in O.
struct LegForces {
    rod_active: Vector3<f64>,
    rod_inertia: Wrench,
    mover_active: Vector3<f64>,
    mover_inertia: Vector3<f64>,
}

impl LegForces {
    fn new(
        leg: &Leg,
        gravity: &Vector3<f64>,
        actuator_force: f64,
        geometry: &LegGeometry,
        velocity: &LegVelocity,
        base: &RigidBodyMotion,
        platform: &RigidBodyMotion,
    ) -> Self {
        let acceleration = LegAcceleration::new(leg, geometry, velocity, base, platform);
        let rod_acceleration = rod_com(leg, &acceleration.hooke, &acceleration.platform_joint);
        // Without spin I w = J_s w, so that the gyroscopic moment w x I w of (43) vanishes.
        let rod_moment = rod_inertia(leg, geometry) * acceleration.rod_angular;
        let axial =
            actuator_force - spring_tension(leg, geometry) - leg.axial_damping_n_s_m * velocity.length_rate;
        Self {
            rod_active: leg.rod_mass_kg * gravity,
            rod_inertia: Wrench { force: -leg.rod_mass_kg * rod_acceleration, moment: -rod_moment },
            mover_active: leg.mover_mass_kg * gravity + axial * geometry.axis,
            mover_inertia: -leg.mover_mass_kg
                * mover_acceleration(leg, geometry, velocity, &acceleration, base),
        }
    }

    /// The leg's generalised force: every body's forces on its partial velocities (33)-(38).
    fn project(&self, partials: &LegPartials) -> Vector6<f64> {
        partials.rod.tr_mul(&(self.rod_active + self.rod_inertia.force))
            + partials.rod_angular.tr_mul(&self.rod_inertia.moment)
            + partials.mover.tr_mul(&(self.mover_active + self.mover_inertia))
    }
}

/// `k_e (d - d_0)`, N.
fn spring_tension(leg: &Leg, geometry: &LegGeometry) -> f64 {
    leg.axial_stiffness_n_m * (geometry.length - leg.rest_length_m)
}

fn project_payload(partials: &PayloadPartials, wrench: &Wrench) -> Vector6<f64> {
    partials.velocity.tr_mul(&wrench.force) + partials.angular_velocity.tr_mul(&wrench.moment)
}

/// What [`generalised_forces`] returns: one force per platform speed, N and N m, moments about `r_p`, in O.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GeneralisedForces {
    /// Payload: gravity and external wrench (39).
    pub payload_active_force: Vector6<f64>,
    /// Payload.
    pub payload_inertia_force: Vector6<f64>,
    /// Rods: gravity.
    pub rod_active_force: [Vector6<f64>; 6],
    /// Rods.
    pub rod_inertia_force: [Vector6<f64>; 6],
    /// Movers: gravity, actuator, spring, damper.
    pub mover_active_force: [Vector6<f64>; 6],
    /// Movers.
    pub mover_inertia_force: [Vector6<f64>; 6],
}

/// Kane's active and inertia forces of every body, (39)-(46), at the state's accelerations and forces. Their
/// total vanishes exactly when the equation of motion holds.
pub fn generalised_forces(parameters: &Parameters, state: &State) -> GeneralisedForces {
    let State { base, platform, .. } = state;
    let geometries = leg_geometries(parameters, state);
    let velocities = leg_velocities(parameters, state, &geometries);
    let payload = PayloadPartials::new(parameters, platform);
    let partials: [LegPartials; 6] =
        from_fn(|i| LegPartials::by_platform(&parameters.legs[i], &geometries[i]));
    let forces: [LegForces; 6] = from_fn(|i| {
        LegForces::new(
            &parameters.legs[i],
            &parameters.gravity_m_s2,
            state.actuator_force_n[i],
            &geometries[i],
            &velocities[i],
            base,
            platform,
        )
    });
    GeneralisedForces {
        payload_active_force: project_payload(&payload, &payload_active(parameters, state)),
        payload_inertia_force: project_payload(&payload, &payload_inertia_wrench(parameters, platform)),
        rod_active_force: from_fn(|i| partials[i].rod.tr_mul(&forces[i].rod_active)),
        rod_inertia_force: from_fn(|i| {
            partials[i].rod.tr_mul(&forces[i].rod_inertia.force)
                + partials[i].rod_angular.tr_mul(&forces[i].rod_inertia.moment)
        }),
        mover_active_force: from_fn(|i| partials[i].mover.tr_mul(&forces[i].mover_active)),
        mover_inertia_force: from_fn(|i| partials[i].mover.tr_mul(&forces[i].mover_inertia)),
    }
}

/// Sum of all generalised forces, active and inertia.
pub(crate) fn total_generalised_force(
    parameters: &Parameters,
    state: &State,
    geometries: &[LegGeometry; 6],
) -> Vector6<f64> {
    let State { base, platform, .. } = state;
    let payload = PayloadPartials::new(parameters, platform);
    let mut total = project_payload(&payload, &payload_active(parameters, state))
        + project_payload(&payload, &payload_inertia_wrench(parameters, platform));
    for (i, (leg, geometry)) in parameters.legs.iter().zip(geometries).enumerate() {
        let velocity = LegVelocity::new(leg, geometry, base, platform);
        let gravity = &parameters.gravity_m_s2;
        let forces =
            LegForces::new(leg, gravity, state.actuator_force_n[i], geometry, &velocity, base, platform);
        total += forces.project(&LegPartials::by_platform(leg, geometry));
    }
    total
}

/// What [`passive_forces`] returns: one force per platform speed, N and N m, as they stand on the left side
/// of the equation of motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PassiveForces {
    /// `-sum J_p^T m g` over payload, rods and movers.
    pub gravity_force: Vector6<f64>,
    /// `J_dp^T k_e (d - d_0)`.
    pub spring_force: Vector6<f64>,
    /// `J_dp^T c_e d'`.
    pub damping_force: Vector6<f64>,
}

/// Gravity, springs and dampers.
pub fn passive_forces(parameters: &Parameters, state: &State) -> PassiveForces {
    let geometries = leg_geometries(parameters, state);
    let velocities = leg_velocities(parameters, state, &geometries);
    passive_forces_of(parameters, &state.platform, &geometries, &velocities)
}

pub(crate) fn passive_forces_of(
    parameters: &Parameters,
    platform: &RigidBodyMotion,
    geometries: &[LegGeometry; 6],
    velocities: &[LegVelocity; 6],
) -> PassiveForces {
    let gravity = &parameters.gravity_m_s2;
    let payload = PayloadPartials::new(parameters, platform);
    let mut forces = PassiveForces {
        gravity_force: -payload.velocity.tr_mul(&(parameters.payload.mass_kg * gravity)),
        spring_force: Vector6::zeros(),
        damping_force: Vector6::zeros(),
    };
    for i in 0..6 {
        let (leg, geometry) = (&parameters.legs[i], &geometries[i]);
        let partials = LegPartials::by_platform(leg, geometry);
        let along = partials.length.transpose();
        forces.gravity_force -= partials.rod.tr_mul(&(leg.rod_mass_kg * gravity))
            + partials.mover.tr_mul(&(leg.mover_mass_kg * gravity));
        forces.spring_force += along * spring_tension(leg, geometry);
        forces.damping_force += along * (leg.axial_damping_n_s_m * velocities[i].length_rate);
    }
    forces
}
