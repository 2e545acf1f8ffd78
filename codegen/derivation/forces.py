"""Forces without matrices: inverse dynamics, forward dynamics, bias, in base coordinates.

Every leg's inertia acts along its actuator coordinate (balanced by its own actuator, as is its spring) and at its
platform joint. Together with the payload's inertia the joint parts make the remaining wrench, which six reactions
along the actuators must balance: one 6 x 6 solve, no mass matrix.
"""

import casadi as ca

from .payload import mass_matrix, with_point_masses
from .rotations import cross, levers_cross, symmetric
from .stages import leg_stage, platform_stage


@leg_stage
def passive_axial_force(actuator_length, actuator_velocity, rest_length, axial_stiffness, axial_damping):
    """spring and damper force along the actuator."""
    return {"passive_axial_force": axial_stiffness * (actuator_length - rest_length) + axial_damping * actuator_velocity}


@leg_stage
def jacobian_row(platform_lever, length_gradient):
    """row of the actuator Jacobian in base coordinates."""
    return {"jacobian_row": ca.vertcat(length_gradient, cross(platform_lever, length_gradient))}


@platform_stage
def inertia_wrench(
    relative_rotation, platform_origin_acceleration, platform_field, merged_mass, merged_moment, merged_second_moment,
    platform_point, joint_inertia_force,
):
    """inertia, less weight, of the payload and of the legs at their joints."""
    force = merged_mass * platform_origin_acceleration + platform_field @ merged_moment
    moments = platform_origin_acceleration @ merged_moment.T + platform_field @ merged_second_moment
    for point, leg_force in zip(platform_point, joint_inertia_force, strict=True):
        force += leg_force
        moments += leg_force @ point.T
    return {"inertia_force": force, "inertia_moments": moments}


@platform_stage
def remaining_wrench(relative_rotation, base_rotation, inertia_force, inertia_moments, external_wrench, payload_com):
    """inertia less external wrench about the platform origin."""
    external = base_rotation.T @ external_wrench[:3]
    moment = levers_cross(relative_rotation, inertia_moments - external @ payload_com.T)
    return {
        "remaining_wrench": ca.vertcat(inertia_force - external, moment - base_rotation.T @ external_wrench[3:]),
    }


@platform_stage
def wrench_map(jacobian_row):
    """transposed actuator Jacobian."""
    return {"wrench_map": ca.horzcat(*jacobian_row)}


@leg_stage
def actuator_forces(axial_inertia_force, passive_axial_force, axial_reaction):
    """actuator force."""
    return {"inverse_dynamics": axial_inertia_force + passive_axial_force + axial_reaction}


@leg_stage
def net_axial_force(actuator_force, axial_inertia_force, passive_axial_force):
    """actuator force left for the platform."""
    return {"net_axial_force": actuator_force - (axial_inertia_force + passive_axial_force)}


@leg_stage
def opposing_axial_force(axial_inertia_force, passive_axial_force):
    """inertia, spring and damper force along the actuator, without an actuator force."""
    return {"net_axial_force": -(axial_inertia_force + passive_axial_force)}


@platform_stage
def residual_wrench(jacobian_row, net_axial_force, remaining_wrench):
    """wrench left at the trial acceleration."""
    reflected = sum((row * force for row, force in zip(jacobian_row, net_axial_force, strict=True)), ca.SX.zeros(6))
    return {"residual_wrench": reflected - remaining_wrench}


@platform_stage
def platform_mass_matrix(
    relative_rotation, merged_mass, merged_moment, merged_second_moment, inertia_weights, inertia_rows,
):
    """mass matrix in base coordinates."""
    merged = mass_matrix(relative_rotation, merged_mass, merged_moment, merged_second_moment)
    return {"platform_mass_matrix": _with_squares(merged, inertia_weights, inertia_rows)}


@platform_stage
def platform_mass_matrix_with_joint_masses(
    relative_rotation, merged_mass, merged_moment, merged_second_moment, inertia_weights, inertia_rows, joint_mass,
    platform_point,
):
    """mass matrix in base coordinates, of legs that leave a mass at the joint."""
    mass, moment, second_moment = with_point_masses(
        merged_mass, merged_moment, merged_second_moment, joint_mass, platform_point
    )
    merged = mass_matrix(relative_rotation, mass, moment, second_moment)
    return {"platform_mass_matrix": _with_squares(merged, inertia_weights, inertia_rows)}


def _with_squares(total, inertia_weights, inertia_rows):
    """A mass matrix and the weighted squares of all legs."""
    for weights, rows in zip(inertia_weights, inertia_rows, strict=True):
        for k in range(weights.shape[0]):
            total += rows[k, :].T @ (weights[k] * rows[k, :])
    return symmetric(total)


@platform_stage
def platform_acceleration(base_rotation, gravity, acceleration_correction):
    """acceleration of the platform in O."""
    return {
        "forward_dynamics": ca.vertcat(
            base_rotation @ acceleration_correction[:3] + gravity, base_rotation @ acceleration_correction[3:]
        )
    }


@platform_stage
def bias_from_wrench(base_rotation, relative_rotation, inertia_force, inertia_moments, jacobian_row, net_axial_force):
    """bias in O: the wrench that holds the platform at constant speeds."""
    reflected = sum((row * force for row, force in zip(jacobian_row, net_axial_force, strict=True)), ca.SX.zeros(6))
    force = inertia_force - reflected[:3]
    moment = levers_cross(relative_rotation, inertia_moments) - reflected[3:]
    return {"bias": ca.vertcat(base_rotation @ force, base_rotation @ moment)}
