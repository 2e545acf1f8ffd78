"""Payload and the leg masses that move with the platform joints, as one rigid distribution of mass about P.

Second moments Sigma = integral of rho rho^T dm replace the inertia: the legs' end masses then merge by addition, and
forces and moments of an acceleration field need no cross product per mass.
"""

import casadi as ca

from . import kane
from .rotations import cross, dot, outer, skew, symmetric
from .stages import platform_stage


@platform_stage
def merged_payload(payload_mass, payload_com, payload_inertia, platform_end_mass, platform_point):
    """mass, first and second moment of payload and platform-side leg ends."""
    inertia = symmetric(payload_inertia)
    central = ca.trace(inertia) / 2 * ca.SX.eye(3) - inertia
    second = central + payload_mass * outer(payload_com, payload_com)
    mass, first, second = with_point_masses(
        payload_mass, payload_mass * payload_com, second, platform_end_mass, platform_point
    )
    return {"merged_mass": mass, "merged_moment": first, "merged_second_moment": second}


def with_point_masses(mass, first, second, added, points):
    """Mass, first and second moment of a body with further point masses on it."""
    for point_mass, point in zip(added, points, strict=True):
        mass = mass + point_mass
        first = first + point_mass * point
        second = second + point_mass * outer(point, point)
    return mass, first, symmetric(second)


@platform_stage
def payload_kinematics(
    platform_position, platform_rotation, platform_velocity, platform_acceleration, payload_com,
):
    """position, velocity and acceleration of the payload's centre of mass."""
    arm = platform_rotation @ payload_com
    rate, rate_derivative = platform_velocity[3:], platform_acceleration[3:]
    return {
        "payload_com_position": platform_position + arm,
        "payload_com_velocity": platform_velocity[:3] + cross(rate, arm),
        "payload_com_acceleration":
            platform_acceleration[:3] + cross(rate_derivative, arm) + cross(rate, cross(rate, arm)),
    }


def _com_velocity(speeds, platform_rotation, payload_com):
    return speeds[:3] + cross(speeds[3:], platform_rotation @ payload_com)


@platform_stage
def payload_partial_velocities(platform_rotation, payload_com):
    """partial velocities of the payload by the six platform speeds."""
    speeds = ca.SX.sym("speeds", 6)
    return {
        "payload_partial_velocity":
            kane.partial_velocity(_com_velocity(speeds, platform_rotation, payload_com), speeds),
        "payload_partial_angular_velocity": kane.partial_velocity(speeds[3:], speeds),
    }


@platform_stage
def payload_forces(
    platform_rotation, platform_velocity, platform_acceleration, external_wrench, gravity, payload_mass, payload_com,
    payload_inertia, payload_com_acceleration,
):
    """generalised active and inertia force of the payload."""
    inertia = platform_rotation @ symmetric(payload_inertia) @ platform_rotation.T
    rate = platform_velocity[3:]
    moment = inertia @ platform_acceleration[3:] + cross(rate, inertia @ rate)

    speeds = ca.SX.sym("speeds", 6)
    com_velocity = _com_velocity(speeds, platform_rotation, payload_com)

    def project(force, moment):
        return (
            kane.generalised_force(com_velocity, speeds, force) + kane.generalised_force(speeds[3:], speeds, moment)
        )

    return {
        "payload_active_force": project(payload_mass * gravity + external_wrench[:3], external_wrench[3:]),
        "payload_inertia_force": -project(payload_mass * payload_com_acceleration, moment),
    }


def mass_matrix(rotation, mass, moment, second_moment):
    """Mass matrix of the merged payload in the six platform speeds, in the frame that `rotation` leads to."""
    first = rotation @ moment
    second = symmetric(rotation @ second_moment @ rotation.T)
    inertia = ca.trace(second_moment) * ca.SX.eye(3) - second
    return ca.blockcat([[mass * ca.SX.eye(3), -skew(first)], [skew(first), inertia]])


def coriolis_matrix(rotation, rate, payload_inertia, moment, second_moment):
    """Natural Coriolis matrix of the merged payload.

    A point mass contributes -S(w) rho rho^T to the rotational block; a rigid body S(w) I about its centre of mass,
    which is more by S(w) times the trace of its second moments, half the trace of I.
    """
    first = rotation @ moment
    second = symmetric(rotation @ second_moment @ rotation.T)
    half_trace = ca.trace(payload_inertia) / 2
    rotational = skew(rate) @ (half_trace * ca.SX.eye(3) - second)
    return ca.blockcat([[ca.SX.zeros(3, 3), -skew(cross(rate, first))], [ca.SX.zeros(3, 3), rotational]])


def kinetic_energy(rotation, velocity, mass, com, inertia):
    """Kinetic energy of the payload alone."""
    com_velocity = velocity[:3] + cross(velocity[3:], rotation @ com)
    body_rate = rotation.T @ velocity[3:]
    return mass * dot(com_velocity, com_velocity) / 2 + dot(body_rate, symmetric(inertia) @ body_rate) / 2


@platform_stage
def total_energy(
    platform_position, platform_rotation, platform_velocity, payload_mass, payload_com, payload_inertia, gravity,
    leg_kinetic_energy, leg_potential_energy,
):
    """kinetic and potential energy."""
    kinetic = kinetic_energy(platform_rotation, platform_velocity, payload_mass, payload_com, payload_inertia)
    potential = -payload_mass * dot(gravity, platform_position + platform_rotation @ payload_com)
    return {
        "kinetic_energy": kinetic + sum(leg_kinetic_energy),
        "potential_energy": potential + sum(leg_potential_energy),
    }
