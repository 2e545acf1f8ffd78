"""Matrices of (49) in O coordinates: Jacobians, mass, Coriolis and stiffness matrices, passive forces.

The six platform speeds move a platform joint by U = [1, -S(lever)], the six base speeds by Y = [1, -S(joint from the
base origin)] = U X with X = [1, -S(r); 0, 1]. With N, L (see `kane.joint_inertia`, `kane.joint_base_inertia`) and their
Coriolis counterparts P, Q of each leg:

    M_p = sum U^T N U + payload          M_b = (sum U^T N U) X - sum U^T L
    C_p = sum U^T (P U + N U') + payload C_b = (sum U^T (P U + N U')) X + (sum U^T N U) X' - sum U^T Q

A leg type may offer a shorter way to the same matrices (see `fixed_axes`).
"""

import casadi as ca

from . import payload
from .rotations import cross, skew, symmetric
from .stages import leg_stage, platform_stage


def project(levers, joint_matrices):
    """sum U^T A U for symmetric 3 x 3 matrices A at joints with the given levers."""
    total = ca.SX.zeros(6, 6)
    for lever, matrix in zip(levers, joint_matrices, strict=True):
        mixed = -(matrix @ skew(lever))
        total += ca.blockcat([[matrix, mixed], [mixed.T, symmetric(skew(lever) @ mixed)]])
    return symmetric(total)


def project_rows(levers, joint_rows):
    """sum U^T A for 3 x n matrices A."""
    zero = ca.SX.zeros(6, joint_rows[0].shape[1])
    return sum((ca.vertcat(rows, skew(lever) @ rows) for lever, rows in zip(levers, joint_rows, strict=True)), zero)


def transport(matrix, shift):
    """A X with X = [1, -S(shift); 0, 1]."""
    return ca.horzcat(matrix[:, :3], matrix[:, 3:] - matrix[:, :3] @ skew(shift))


@leg_stage
def joint_in_o(base_rotation, base_position, platform_position, platform_rotation, platform_point, length_gradient):
    """platform joint and length gradient in O."""
    lever = platform_rotation @ platform_point
    return {
        "platform_lever_o": lever,
        "joint_position_o": (platform_position - base_position) + lever,
        "length_gradient_o": base_rotation @ length_gradient,
    }


@leg_stage
def joint_rates_in_o(
    base_rotation, platform_velocity, platform_lever_o, length_gradient_rate,
):
    """rates of lever and length gradient in O."""
    return {
        "platform_lever_rate_o": cross(platform_velocity[3:], platform_lever_o),
        "length_gradient_rate_o": base_rotation @ length_gradient_rate,
    }


@leg_stage
def joint_motion_in_o(base_velocity, platform_velocity, platform_lever_rate_o):
    """velocity of the platform joint in O."""
    return {"joint_velocity_o": (platform_velocity[:3] - base_velocity[:3]) + platform_lever_rate_o}


@leg_stage
def jacobian_rows(platform_lever_o, joint_position_o, length_gradient_o):
    """rows of the actuator Jacobians."""
    return {
        "jacobian_dp": ca.vertcat(length_gradient_o, cross(platform_lever_o, length_gradient_o)),
        "jacobian_db": ca.vertcat(length_gradient_o, cross(joint_position_o, length_gradient_o)),
    }


@platform_stage
def legs_mass_matrix(platform_lever_o, joint_inertia):
    """mass matrix of the legs."""
    return {"legs_mass_matrix": project(platform_lever_o, joint_inertia)}


@platform_stage
def mass_matrix_p(platform_rotation, merged_mass, merged_moment, merged_second_moment, legs_mass_matrix):
    """mass matrix of the platform."""
    rigid = payload.mass_matrix(platform_rotation, merged_mass, merged_moment, merged_second_moment)
    return {"mass_matrix_p": symmetric(rigid + legs_mass_matrix)}


@platform_stage
def mass_matrix_b(base_position, platform_position, platform_lever_o, legs_mass_matrix, joint_base_inertia):
    """mass matrix that couples the base acceleration."""
    shift = platform_position - base_position
    return {"mass_matrix_b": transport(legs_mass_matrix, shift) - project_rows(platform_lever_o, joint_base_inertia)}


@platform_stage
def legs_coriolis_matrix(platform_lever_o, platform_lever_rate_o, joint_inertia, joint_inertia_rate):
    """Coriolis matrix of the legs."""
    rows = [
        ca.horzcat(rate, -(rate @ skew(lever) + inertia @ skew(lever_rate)))
        for lever, lever_rate, inertia, rate in zip(
            platform_lever_o, platform_lever_rate_o, joint_inertia, joint_inertia_rate, strict=True
        )
    ]
    return {"legs_coriolis_matrix": project_rows(platform_lever_o, rows)}


@platform_stage
def coriolis_matrix_p(
    platform_rotation, platform_velocity, payload_inertia, merged_moment, merged_second_moment, legs_coriolis_matrix,
):
    """Coriolis matrix of the platform."""
    rigid = payload.coriolis_matrix(
        platform_rotation, platform_velocity[3:], payload_inertia, merged_moment, merged_second_moment
    )
    return {"coriolis_matrix_p": rigid + legs_coriolis_matrix}


@platform_stage
def coriolis_matrix_b(
    base_position, base_velocity, platform_position, platform_velocity, platform_lever_o, legs_mass_matrix,
    legs_coriolis_matrix, joint_base_inertia_rate,
):
    """Coriolis matrix that couples the base velocity."""
    shift = platform_position - base_position
    shift_rate = platform_velocity[:3] - base_velocity[:3]
    moved = transport(legs_coriolis_matrix, shift)
    rotational = legs_mass_matrix[:, :3] @ skew(shift_rate) + project_rows(platform_lever_o, joint_base_inertia_rate)
    return {"coriolis_matrix_b": ca.horzcat(moved[:, :3], moved[:, 3:] - rotational)}


def _reflect(rows, forces):
    """sum J^T f over the legs."""
    return sum((row * force for row, force in zip(rows, forces, strict=True)), ca.SX.zeros(6))


def _stiffness(left, right, stiffness):
    """sum k left right^T over the legs."""
    terms = (a @ (k * b).T for a, b, k in zip(left, right, stiffness, strict=True))
    return sum(terms, ca.SX.zeros(6, 6))


@platform_stage
def stiffness_matrices(jacobian_dp, jacobian_db, axial_stiffness):
    """linearised stiffness matrices for small twists, preload left out as in the paper."""
    return {
        "stiffness_matrix_p": symmetric(_stiffness(jacobian_dp, jacobian_dp, axial_stiffness)),
        "stiffness_matrix_b": _stiffness(jacobian_dp, jacobian_db, axial_stiffness),
    }


@platform_stage
def spring_and_damping_force(
    jacobian_dp, actuator_length, actuator_velocity, rest_length, axial_stiffness, axial_damping,
):
    """generalised spring and damping forces."""
    springs = [k * (d - d0) for k, d, d0 in zip(axial_stiffness, actuator_length, rest_length, strict=True)]
    dampers = [c * rate for c, rate in zip(axial_damping, actuator_velocity, strict=True)]
    return {"spring_force": _reflect(jacobian_dp, springs), "damping_force": _reflect(jacobian_dp, dampers)}


@platform_stage
def gravity_force(
    platform_rotation, platform_lever_o, jacobian_dp, axial_weight, joint_weight_o, gravity, payload_mass, payload_com,
):
    """generalised gravity force."""
    weight = payload_mass * gravity
    total = ca.vertcat(weight, cross(platform_rotation @ payload_com, weight)) + _reflect(jacobian_dp, axial_weight)
    return {"gravity_force": -(total + project_rows(platform_lever_o, joint_weight_o))}


@platform_stage
def bias_from_matrices(
    coriolis_matrix_p, coriolis_matrix_b, platform_velocity, base_velocity, gravity_force, spring_force, damping_force,
):
    """bias: velocity terms, gravity, springs and dampers."""
    velocity_terms = coriolis_matrix_p @ platform_velocity - coriolis_matrix_b @ base_velocity
    return {"bias": velocity_terms + gravity_force + spring_force + damping_force}
