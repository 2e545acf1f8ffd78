//! Generalised forces of every body for the six platform speeds, (39)-(46), and the passive forces, in O
//! coordinates.
//!
//! An active force is gravity on every body, the external wrench on the payload, and in a leg the forces along the
//! actuator: actuator, spring, damper. An inertia force is `-m r''` with the moment `-(I w' + w x I
//! w)`. Each is projected on its body's partial velocities. In (42) the external force appears a second time;
//! it acts once, on the payload (39).

use core::array::from_fn;

use nalgebra::{Vector3, Vector6};

use crate::leg::{LegGeometry, LegVelocity, leg_geometries, leg_velocities};
use crate::legs::{LegType, transverse_inertia};
use crate::matrices::payload_inertia;
use crate::parameters::Parameters;
use crate::partial_velocities::{LegPartials, PayloadPartials};
use crate::state::{RigidBodyMotion, State, angular, linear};

/// Force at a body's centre of mass and moment, N and N m, in O.
struct Wrench {
    force: Vector3<f64>,
    moment: Vector3<f64>,
}

/// Gravity and external wrench on the payload.
fn payload_active<L: LegType>(parameters: &Parameters<L>, state: &State) -> Wrench {
    Wrench {
        force: parameters.payload.mass_kg * parameters.gravity_m_s2 + linear(&state.external_wrench),
        moment: angular(&state.external_wrench),
    }
}

/// Inertia force and moment of the payload.
fn payload_inertia_wrench<L: LegType>(parameters: &Parameters<L>, platform: &RigidBodyMotion) -> Wrench {
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
    active: [Vector3<f64>; 2],
    /// `-m r''`.
    inertia: [Vector3<f64>; 2],
    /// `w_s'`, in rad/s^2: without spin `I w = J w`, so that the gyroscopic moment `w x I w` of (43) vanishes.
    turning: Vector3<f64>,
}

impl LegForces {
    fn new<L: LegType>(
        leg: &L,
        gravity: &Vector3<f64>,
        actuator_force: f64,
        geometry: &LegGeometry,
        velocity: &LegVelocity,
        base: &RigidBodyMotion,
        platform: &RigidBodyMotion,
    ) -> Self {
        let acceleration = leg.acceleration(geometry, velocity, base, platform);
        let element = leg.axial_element();
        let axial = actuator_force - element.spring_tension(geometry) - element.damper_tension(velocity);
        let [first, second] = leg.com_acceleration(geometry, velocity, &acceleration, base);
        let [first_mass, second_mass] = leg.masses();
        Self {
            active: leg.active_force(gravity, axial, geometry),
            inertia: [-first_mass * first, -second_mass * second],
            turning: acceleration.rod_angular,
        }
    }

    /// `-I w_s'` for a transverse moment of inertia.
    fn moment(&self, inertia: f64, geometry: &LegGeometry) -> Vector3<f64> {
        -(transverse_inertia(inertia, geometry) * self.turning)
    }

    /// The leg's generalised force: every body's forces on its partial velocities (33)-(38).
    fn project<L: LegType>(&self, leg: &L, geometry: &LegGeometry, partials: &LegPartials) -> Vector6<f64> {
        partials.com[0].tr_mul(&(self.active[0] + self.inertia[0]))
            + partials.angular.tr_mul(&self.moment(leg.turning_inertia(), geometry))
            + partials.com[1].tr_mul(&(self.active[1] + self.inertia[1]))
    }
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
    /// Both bodies of every leg: gravity, and on one or both actuator, spring, damper.
    pub active_force: [[Vector6<f64>; 2]; 6],
    /// Both bodies of every leg.
    pub inertia_force: [[Vector6<f64>; 2]; 6],
}

/// Kane's active and inertia forces of every body, (39)-(46), at the state's accelerations and forces. Their
/// total vanishes exactly when the equation of motion holds.
pub fn generalised_forces<L: LegType>(parameters: &Parameters<L>, state: &State) -> GeneralisedForces {
    let State { base, platform, .. } = state;
    let geometries = leg_geometries(parameters, state);
    let velocities = leg_velocities(parameters, state, &geometries);
    let payload = PayloadPartials::new(parameters, platform);
    let partials: [LegPartials; 6] = from_fn(|i| parameters.legs[i].partials_by_platform(&geometries[i]));
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
        active_force: from_fn(|i| from_fn(|body| partials[i].com[body].tr_mul(&forces[i].active[body]))),
        inertia_force: from_fn(|i| {
            let inertias = parameters.legs[i].inertias();
            from_fn(|body| {
                let moment = forces[i].moment(inertias[body], &geometries[i]);
                partials[i].com[body].tr_mul(&forces[i].inertia[body]) + partials[i].angular.tr_mul(&moment)
            })
        }),
    }
}

/// Sum of all generalised forces, active and inertia.
pub(crate) fn total_generalised_force<L: LegType>(
    parameters: &Parameters<L>,
    state: &State,
    geometries: &[LegGeometry; 6],
) -> Vector6<f64> {
    let State { base, platform, .. } = state;
    let payload = PayloadPartials::new(parameters, platform);
    let mut total = project_payload(&payload, &payload_active(parameters, state))
        + project_payload(&payload, &payload_inertia_wrench(parameters, platform));
    for (i, (leg, geometry)) in parameters.legs.iter().zip(geometries).enumerate() {
        let velocity = leg.velocity(geometry, base, platform);
        let gravity = &parameters.gravity_m_s2;
        let forces =
            LegForces::new(leg, gravity, state.actuator_force_n[i], geometry, &velocity, base, platform);
        total += forces.project(leg, geometry, &leg.partials_by_platform(geometry));
    }
    total
}

/// What [`passive_forces`] returns: one force per platform speed, N and N m, as they stand on the left side
/// of the equation of motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PassiveForces {
    /// `-sum J_p^T m g` over payload and legs' bodies.
    pub gravity_force: Vector6<f64>,
    /// `J_dp^T k_e (d - d_0)`.
    pub spring_force: Vector6<f64>,
    /// `J_dp^T c_e d'`.
    pub damping_force: Vector6<f64>,
}

/// Gravity, springs and dampers.
pub fn passive_forces<L: LegType>(parameters: &Parameters<L>, state: &State) -> PassiveForces {
    let geometries = leg_geometries(parameters, state);
    let velocities = leg_velocities(parameters, state, &geometries);
    passive_forces_of(parameters, &state.platform, &geometries, &velocities)
}

pub(crate) fn passive_forces_of<L: LegType>(
    parameters: &Parameters<L>,
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
        let partials = leg.partials_by_platform(geometry);
        let (along, element) = (partials.length.transpose(), leg.axial_element());
        let [first, second] = leg.masses();
        forces.gravity_force -=
            partials.com[0].tr_mul(&(first * gravity)) + partials.com[1].tr_mul(&(second * gravity));
        forces.spring_force += along * element.spring_tension(geometry);
        forces.damping_force += along * element.damper_tension(&velocities[i]);
    }
    forces
}
