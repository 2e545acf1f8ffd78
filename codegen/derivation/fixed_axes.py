"""Mass and Coriolis matrices of legs whose actuator axes are fixed to the base, from 6-vectors, in O coordinates.

Of a leg's bodies, those that slide along the axis a (mass `axial_mass` = mu) have the partial velocity a j^T, with j the
leg's row of J_dp; of the platform joint it is U = [1, -S(R_p p)]; a mass B (`rod_coupling`) couples the two; what moves
with the joint alone is part of the payload. J_b = Y - J_p X, since base and platform that move together move every body
like a rigid one: Y = [1, -S(y)] of a point y seen from the base origin, X = [1, -S(r); 0, 1], r = r_p - r_b. With

    G = sum B U^T a j^T      H = sum mu j j^T + G      D = sum mu j j'^T + sum B U^T (a j^T)'

the definitions of the matrices as sums of J^T m J and J^T m J' become, by a . a = 1 and a . a' = 0,

    M_p = H + G^T + payload                              C_p = D + (sum B U'^T a j^T)^T + payload
    M_b = H X - sum j sum_k m_k (Y_k^T a)^T - sum B U^T Y_h
    C_b = D X + H X' - sum j sum_k m_k (Y_k'^T a)^T - sum B U^T Y_h'

where k counts the sliding masses, and h is the sliding joint. Axes and base points are constants in base coordinates, where
most of their components are zero on most platforms: sums over the legs of j with weights from those alone (of B a j^T and
of j sum_k m_k (Y_k^T a)^T) are taken there and turned to O coordinates as a whole. The product of two levers is needed in
sum B S(R_p p) S(h) = W^T - tr(W) 1 with W = sum B (R_p p) h^T = R_p (sum B p h^T) R_b^T.
"""

import casadi as ca

from .matrices import transport
from .rotations import cross, outer, skew, symmetric
from .stages import leg_stage, platform_stage


@leg_stage
def jacobian_rate(platform_lever_o, platform_lever_rate_o, length_gradient_o, length_gradient_rate_o):
    """inertial rate of the row of the actuator Jacobian."""
    moment_rate = cross(platform_lever_rate_o, length_gradient_o) + cross(platform_lever_o, length_gradient_rate_o)
    return {"jacobian_dp_rate": ca.vertcat(length_gradient_rate_o, moment_rate)}


def _weighted(weights, rows):
    """sum weight row^T over the legs."""
    terms = (outer(weight, row) for weight, row in zip(weights, rows, strict=True))
    return sum(terms, ca.SX.zeros(weights[0].shape[0], 6))


@leg_stage
def coupled_axis(base_rotation, actuator_axis, rod_coupling, platform_lever_o):
    """coupling times axis, as a force at the platform joint, and its moment: the column U^T B a."""
    axis = rod_coupling * (base_rotation @ actuator_axis)
    return {"coupled_axis_o": axis, "coupled_axis_moment": cross(platform_lever_o, axis)}


@leg_stage
def coupled_axis_rates(
    base_velocity, platform_lever_o, platform_lever_rate_o, coupled_axis_o, coupled_axis_moment, axial_mass, jacobian_dp,
):
    """moments of that force's rate, and of the force by the rate of the lever: rotational halves of U^T B a' and U'^T B a."""
    return {
        "turning_axis_moment": cross(platform_lever_o, cross(base_velocity[3:], coupled_axis_o)),
        "moving_axis_moment": cross(platform_lever_rate_o, coupled_axis_o),
        "axial_moment": axial_mass * jacobian_dp[3:] + coupled_axis_moment,
    }


def _coupled_force(base_rotation, rod_coupling, actuator_axis, rows):
    """sum B a row^T in O coordinates."""
    axes = [mass * axis for mass, axis in zip(rod_coupling, actuator_axis, strict=True)]
    return base_rotation @ _weighted(axes, rows)


@platform_stage
def legs_inertia(base_rotation, actuator_axis, rod_coupling, axial_mass, jacobian_dp, coupled_axis_moment):
    """mass matrix of the legs, its part on the side of the axes, and of that the forces by the couplings."""
    squares = symmetric(_weighted([mass * row for mass, row in zip(axial_mass, jacobian_dp, strict=True)], jacobian_dp))
    force = _coupled_force(base_rotation, rod_coupling, actuator_axis, jacobian_dp)
    coupled = ca.vertcat(force, _weighted(coupled_axis_moment, jacobian_dp))
    return {
        "legs_axial_inertia": squares + coupled,
        "coupled_force": force,
        "legs_mass_matrix": symmetric(squares + coupled + coupled.T),
    }


@platform_stage
def coupling_moments(base_rotation, platform_rotation, base_point, actuator_axis, actuator_length, platform_point, rod_coupling):
    """moments of the couplings by the sliding joint, and by both joints."""
    hooke = [b + d * a for b, d, a in zip(base_point, actuator_length, actuator_axis, strict=True)]
    first, second = ca.SX.zeros(3), ca.SX.zeros(3, 3)
    for mass, point, position in zip(rod_coupling, platform_point, hooke, strict=True):
        first += mass * position
        second += outer(mass * point, position)
    return {
        "coupling_moment": base_rotation @ first,
        "coupling_second_moment": platform_rotation @ (second @ base_rotation.T),
    }


def _lever_products(second_moment):
    """sum B S(R_p p) S(h) from W."""
    return second_moment.T - ca.trace(second_moment) * ca.SX.eye(3)


@platform_stage
def mass_matrix_b(
    base_rotation, base_position, platform_position, platform_rotation, base_point, actuator_axis, platform_point,
    axial_mass, rod_coupling, jacobian_dp, legs_axial_inertia, coupling_moment, coupling_second_moment,
):
    """mass matrix that couples the base acceleration."""
    axes = [mass * axis for mass, axis in zip(axial_mass, actuator_axis, strict=True)]
    # h x a = b x a: the sliding joint is on the axis.
    moments = [cross(point, axis) for point, axis in zip(base_point, axes, strict=True)]
    sliding = ca.horzcat(*(_weighted(weights, jacobian_dp).T @ base_rotation.T for weights in (axes, moments)))
    levers = sum((mass * point for mass, point in zip(rod_coupling, platform_point, strict=True)), ca.SX.zeros(3))
    coupled = ca.blockcat([
        [sum(rod_coupling) * ca.SX.eye(3), -skew(coupling_moment)],
        [skew(platform_rotation @ levers), -_lever_products(coupling_second_moment)],
    ])
    return {"mass_matrix_b": transport(legs_axial_inertia, platform_position - base_position) - sliding - coupled}


@platform_stage
def legs_coriolis_matrix(
    base_rotation, base_velocity, actuator_axis, rod_coupling, axial_mass, jacobian_dp, jacobian_dp_rate, coupled_force,
    axial_moment, turning_axis_moment, moving_axis_moment,
):
    """Coriolis matrix of the legs, and its part on the side of the axes."""
    sliding = [mass * row[:3] for mass, row in zip(axial_mass, jacobian_dp, strict=True)]
    axial = ca.vertcat(
        _weighted(sliding, jacobian_dp_rate)
        + _coupled_force(base_rotation, rod_coupling, actuator_axis, jacobian_dp_rate)
        + skew(base_velocity[3:]) @ coupled_force,
        _weighted(axial_moment, jacobian_dp_rate) + _weighted(turning_axis_moment, jacobian_dp),
    )
    return {
        "legs_axial_coriolis": axial,
        "legs_coriolis_matrix": axial + ca.horzcat(ca.SX.zeros(6, 3), _weighted(moving_axis_moment, jacobian_dp).T),
    }


@leg_stage
def sliding_moment_rate(base_rate, base_point, actuator_axis, mover_mass, mover_offset, axial_mass, actuator_length):
    """sum_k m_k (Y_k'^T a), rotational half: (rate of the sliding masses' first moment from the base origin) x a."""
    moment = axial_mass * base_point + (axial_mass * actuator_length - mover_mass * mover_offset) * actuator_axis
    return {"sliding_moment_rate": cross(cross(base_rate, moment), actuator_axis)}


@platform_stage
def coriolis_matrix_b(
    base_rotation, base_position, base_velocity, platform_position, platform_rotation, platform_velocity, actuator_axis,
    actuator_velocity, platform_point, rod_coupling, jacobian_dp, legs_axial_inertia, legs_axial_coriolis,
    sliding_moment_rate, coupling_moment, coupling_second_moment,
):
    """Coriolis matrix that couples the base velocity."""
    shift, shift_rate = platform_position - base_position, platform_velocity[:3] - base_velocity[:3]
    first, second = ca.SX.zeros(3), ca.SX.zeros(3, 3)
    for mass, point, axis, rate in zip(rod_coupling, platform_point, actuator_axis, actuator_velocity, strict=True):
        first += rate * (mass * axis)
        second += rate * outer(mass * point, axis)
    moment_rate = cross(base_velocity[3:], coupling_moment) + base_rotation @ first
    second_moment_rate = (
        platform_rotation @ second @ base_rotation.T - coupling_second_moment @ skew(base_velocity[3:])
    )
    rotational = (
        _weighted(sliding_moment_rate, jacobian_dp).T @ base_rotation.T
        + legs_axial_inertia[:, :3] @ skew(shift_rate)
        - ca.vertcat(skew(moment_rate), _lever_products(second_moment_rate))
    )
    moved = transport(legs_axial_coriolis, shift)
    return {"coriolis_matrix_b": ca.horzcat(moved[:, :3], moved[:, 3:] - rotational)}
