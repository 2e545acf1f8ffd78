"""Forces without matrices: inverse dynamics, forward dynamics, bias, in base coordinates.

Every leg's inertia acts along its actuator coordinate (balanced by its own actuator, as is its spring) and at its
platform joint. Together with the payload's inertia the joint parts make the remaining wrench, which six reactions
along the actuators must balance: one 6 x 6 solve, no mass matrix.
"""

import casadi as ca

from .payload import mass_matrix, with_point_masses
from .rotations import cross, levers_cross, skew, symmetric
from .stages import leg_stage, platform_stage


@leg_stage
def passive_axial_force(actuator_length, actuator_velocity, rest_length, axial_stiffness, axial_damping):
    """spring and damper force along the actuator."""
    return {"passive_axial_force": axial_stiffness * (actuator_length - rest_length) + axial_damping * actuator_velocity}


@leg_stage
def jacobian_row(platform_lever, length_gradient):
    """row of the actuator Jacobian in base coordinates."""
    return {"jacobian_row": ca.vertcat(length_gradient, cross(platform_lever, length_gradient))}


@leg_stage
def joint_inertia_moment(platform_lever, joint_inertia_force):
    """moment of the leg's inertia at the platform joint."""
    return {"joint_inertia_moment": cross(platform_lever, joint_inertia_force)}


@platform_stage
def inertia_wrench(
    platform_origin_acceleration, platform_field, merged_mass, merged_moment, merged_second_moment,
    joint_inertia_force, joint_inertia_moment,
):
    """inertia, less weight, of the payload and of the legs at their joints."""
    force = merged_mass * platform_origin_acceleration + platform_field @ merged_moment
    moments = platform_origin_acceleration @ merged_moment.T + platform_field @ merged_second_moment
    return {
        "inertia_force": sum(joint_inertia_force, force),
        "inertia_moments": moments,
        "joint_moment": sum(joint_inertia_moment, ca.SX.zeros(3)),
    }


@platform_stage
def reference_speeds(base_rotation, platform_velocity, reference_velocity, platform_rate, relative_rotation):
    """reference less actual speeds of the platform, and the acceleration field that goes with their product."""
    velocity = base_rotation.T @ (reference_velocity[:3] - platform_velocity[:3])
    rate = base_rotation.T @ (reference_velocity[3:] - platform_velocity[3:])
    return {
        "velocity_error": velocity,
        "rate_error": rate,
        "error_field": skew(rate) @ skew(platform_rate) @ relative_rotation,
    }


@platform_stage
def remaining_reference_wrench(
    relative_rotation, base_rotation, inertia_force, inertia_moments, joint_moment, external_wrench, payload_com,
    payload_inertia, platform_rate, rate_error, error_field, merged_moment, merged_second_moment,
):
    """inertia at reference speeds less external wrench about the platform origin."""
    external = base_rotation.T @ external_wrench[:3]
    moments = inertia_moments + error_field @ merged_second_moment
    moment = levers_cross(relative_rotation, moments - external @ payload_com.T) + joint_moment
    # Points at reference speeds give -S(w) Sigma where the natural factorisation has S(w) I, about the payload's com.
    gyroscopic = (ca.trace(payload_inertia) / 2) * cross(platform_rate, rate_error)
    return {
        "remaining_wrench": ca.vertcat(
            inertia_force + error_field @ merged_moment - external,
            moment + gyroscopic - base_rotation.T @ external_wrench[3:],
        ),
    }


@platform_stage
def base_reaction(
    relative_rotation, relative_position, base_rotation, platform_origin_acceleration, platform_field,
    merged_mass, merged_moment, merged_second_moment, leg_inertia_force, leg_inertia_moment, external_wrench, payload_com,
):
    """wrench of the base on the mechanism in O, moments about the base origin."""
    external = base_rotation.T @ external_wrench[:3]
    force = merged_mass * platform_origin_acceleration + platform_field @ merged_moment - external
    moments = (
        platform_origin_acceleration @ merged_moment.T + platform_field @ merged_second_moment - external @ payload_com.T
    )
    moment = levers_cross(relative_rotation, moments) + cross(relative_position, force)
    moment -= base_rotation.T @ external_wrench[3:]
    for leg_force, leg_moment in zip(leg_inertia_force, leg_inertia_moment, strict=True):
        force += leg_force
        moment += leg_moment
    return {"base_wrench": ca.vertcat(base_rotation @ force, base_rotation @ moment)}


@platform_stage
def remaining_wrench(
    relative_rotation, base_rotation, inertia_force, inertia_moments, joint_moment, external_wrench, payload_com,
):
    """inertia less external wrench about the platform origin."""
    external = base_rotation.T @ external_wrench[:3]
    moment = levers_cross(relative_rotation, inertia_moments - external @ payload_com.T) + joint_moment
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
def reference_actuator_forces(axial_inertia_force, passive_axial_force, axial_reaction):
    """actuator force at reference speeds."""
    return {"passive_inverse_dynamics": axial_inertia_force + passive_axial_force + axial_reaction}


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
def commanded_wrench(
    platform_rotation, platform_acceleration, mass_matrix_p, total_bias, external_wrench, payload_com,
):
    """M_p v_p' + bias - M_b v_b' - W_ext in O."""
    moment = external_wrench[3:] + cross(platform_rotation @ payload_com, external_wrench[:3])
    external = ca.vertcat(external_wrench[:3], moment)
    return {"remaining_wrench": mass_matrix_p @ platform_acceleration + total_bias - external}


@platform_stage
def wrench_map_in_o(jacobian_dp):
    """transposed actuator Jacobian in O."""
    return {"wrench_map": ca.horzcat(*jacobian_dp)}


@leg_stage
def commanded_forces(axial_reaction):
    """actuator force."""
    return {"inverse_dynamics": axial_reaction}


@platform_stage
def inertia_moment(relative_rotation, inertia_moments, joint_moment):
    """moment of the inertia force about the platform origin."""
    return {"inertia_moment": levers_cross(relative_rotation, inertia_moments) + joint_moment}


@platform_stage
def bias_from_wrench(base_rotation, inertia_force, inertia_moment, jacobian_row, net_axial_force):
    """bias in O: the wrench that holds the platform at constant speeds."""
    reflected = sum((row * force for row, force in zip(jacobian_row, net_axial_force, strict=True)), ca.SX.zeros(6))
    force = inertia_force - reflected[:3]
    moment = inertia_moment - reflected[3:]
    return {"bias": ca.vertcat(base_rotation @ force, base_rotation @ moment)}


@platform_stage
def total_bias(base_rotation, inertia_force, inertia_moment, jacobian_dp, net_axial_force):
    """bias in O on a base that accelerates."""
    reflected = sum((row * force for row, force in zip(jacobian_dp, net_axial_force, strict=True)), ca.SX.zeros(6))
    return {"total_bias": ca.vertcat(base_rotation @ inertia_force, base_rotation @ inertia_moment) - reflected}
