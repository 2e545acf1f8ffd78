"""The paper's leg, UHP: universal joint on the platform, rod, Hooke joint, prismatic actuator fixed to the base.

Unknown at the platform joint: x, its vector from the base point. With n = x - (a.x) a and h = sqrt(s^2 - n.n), the
assembly branch of (18) with the Hooke joint below the platform joint is d = a.x - h, and the rod direction (17) is
u = (n + h a)/s. Everything here is in base coordinates unless a name ends in `_o`.
"""

import casadi as ca

from .. import fixed_axes, kane, matrices
from ..rotations import cross, dot
from ..stages import leg_stage
from ..symbols import CORIOLIS_6, INERTIA_6, WRENCH, table


PARAMETERS = table("parameter", True, [
    ("base_point", (3,), "m", "B", "point b of the actuator axis", "(14)"),
    ("actuator_axis", (3,), "1", "B", "unit vector a of the actuator, towards the platform", "(14)"),
    ("platform_point", (3,), "m", "P", "platform joint p", "(14)"),
    ("rod_length", (), "m", "-", "rod length s", "(17)"),
    ("rod_mass", (), "kg", "-", "rod mass m_s", "(27)-(29)"),
    ("rod_inertia", (), "kg m^2", "-", "transverse inertia J_s of the rod about its centre of mass", "(27)-(29)"),
    ("rod_com_fraction", (), "1", "-", "rod's centre of mass, from Hooke joint (0) to platform joint (1)"),
    ("mover_mass", (), "kg", "-", "mover mass m_d", "(24)-(26)"),
    ("mover_offset", (), "m", "-", "distance d* of the mover's centre of mass below the Hooke joint", "(24)-(26)"),
    ("rest_length", (), "m", "-", "actuator length d0 at which the leaf springs are relaxed", "(39)-(46)"),
    ("axial_stiffness", (), "N/m", "-", "axial stiffness k_e of the leaf springs", "(39)-(46)"),
    ("axial_damping", (), "N s/m", "-", "axial viscous damping c_e"),
])

INTERMEDIATES = table("intermediate", True, [
    ("radial_offset", (3,), "m", "B", "offset of the platform joint from the actuator axis"),
    ("axial_span", (), "m", "-", "extent of the rod along the actuator axis"),
    ("axial_span_reciprocal", (), "1/m", "-", "reciprocal of that extent"),
    ("radial_offset_rate", (3,), "m/s", "B", "rate of the offset from the actuator axis"),
    ("axial_span_rate", (), "m/s", "-", "rate of the rod's extent along the actuator axis"),
    ("hooke_end_mass", (), "kg", "-", "rod's end mass at the Hooke joint"),
    ("rod_coupling", (), "kg", "-", "rod's inertial coupling between its ends"),
    ("axial_mass", (), "kg", "-", "mass that slides along the actuator axis: mover and rod's end"),
    ("jacobian_dp_rate", (6,), "1/s, m/s", "O", "inertial rate of the row of the actuator Jacobian"),
    ("sliding_moment_rate", (3,), "kg m/s", "B", "rate of the sliding masses' first moment, its moment about the axis"),
    ("coupled_axis_o", (3,), "kg", "O", "rod's coupling times axis, a force at the platform joint"),
    ("coupled_axis_moment", (3,), "kg m", "O", "moment of that force"),
    ("turning_axis_moment", (3,), "kg m/s", "O", "moment of that force's rate"),
    ("moving_axis_moment", (3,), "kg m/s", "O", "moment of that force by the rate of the lever"),
    ("axial_moment", (3,), "kg m", "O", "moment of the force along the axis that an acceleration of the actuator takes"),
    ("inertia_weights", (2,), "kg", "-", "weights of the squares that make the leg's mass matrix"),
    ("inertia_rows", (2, 6), "1, m", "B", "the vectors that are squared, in the platform speeds"),
    ("hooke_joint_velocity", (3,), "m/s", "O", "velocity of the Hooke joint"),
    ("platform_joint_velocity", (3,), "m/s", "O", "velocity of the platform joint"),
]) + table("intermediate", False, [
    ("legs_axial_inertia", (6, 6), INERTIA_6, "O", "part of the legs' mass matrix on the side of the axes"),
    ("legs_axial_coriolis", (6, 6), CORIOLIS_6, "O", "part of the legs' Coriolis matrix on the side of the axes"),
    ("coupled_force", (3, 6), "kg, kg m", "O", "forces of the rods' couplings along the axes, by the platform speeds"),
    ("coupling_moment", (3,), "kg m", "O", "first moment of the rods' couplings by the Hooke joint"),
    ("coupling_second_moment", (3, 3), "kg m^2", "O", "their moment by platform joint and Hooke joint"),
])

OUTPUTS = table("output", True, [
    ("rod_angular_velocity", (3,), "rad/s", "O", "angular velocity w_s of the rod, without spin", "(22)"),
    ("rod_angular_acceleration", (3,), "rad/s^2", "O", "angular acceleration of the rod", "(22)"),
    ("rod_com_position", (3,), "m", "O", "centre of mass of the rod", "(27)-(29)"),
    ("rod_com_velocity", (3,), "m/s", "O", "velocity of the rod's centre of mass", "(27)-(29)"),
    ("rod_com_acceleration", (3,), "m/s^2", "O", "acceleration of the rod's centre of mass", "(27)-(29)"),
    ("mover_position", (3,), "m", "O", "centre of mass of the mover", "(24)-(26)"),
    ("mover_velocity", (3,), "m/s", "O", "velocity of the mover", "(24)-(26)"),
    ("mover_acceleration", (3,), "m/s^2", "O", "acceleration of the mover", "(24)-(26)"),
    ("rod_partial_velocity", (3, 6), "1, m", "O", "partial velocities of the rod's centre of mass", "(33)-(38)"),
    ("rod_partial_angular_velocity", (3, 6), "1/m, 1", "O", "partial angular velocities of the rod", "(33)-(38)"),
    ("mover_partial_velocity", (3, 6), "1, m", "O", "partial velocities of the mover", "(33)-(38)"),
    ("rod_active_force", (6,), WRENCH, "O", "generalised active force of the rod: gravity", "(39)-(46)"),
    ("rod_inertia_force", (6,), WRENCH, "O", "generalised inertia force of the rod", "(39)-(46)"),
    ("mover_active_force", (6,), WRENCH, "O", "generalised active force of the mover: gravity, actuator, spring, damper", "(39)-(46)"),
    ("mover_inertia_force", (6,), WRENCH, "O", "generalised inertia force of the mover", "(39)-(46)"),
])

_RIGID = kane.Point(along=1)
_JOINT = kane.Point(across=1)


def _leg(hooke_end_mass, rod_coupling, mover_mass) -> kane.Leg:
    """Points and masses; the rod's platform-side end mass moves with the platform and is merged into the payload."""
    return kane.Leg(
        points={"hooke": _RIGID, "joint": _JOINT, "mover": _RIGID},
        masses={
            ("hooke", "hooke"): hooke_end_mass,
            ("hooke", "joint"): rod_coupling,
            ("mover", "mover"): mover_mass,
        },
    )


@leg_stage
def rod_ends(rod_mass, rod_inertia, rod_length, rod_com_fraction, mover_mass):
    """rod without spin as two end masses and a coupling, exact; the mass that slides."""
    k = rod_com_fraction
    transverse = rod_inertia / (rod_length * rod_length)
    return {
        "hooke_end_mass": rod_mass * (1 - k) * (1 - k) + transverse,
        "platform_end_mass": rod_mass * k * k + transverse,
        "rod_coupling": rod_mass * k * (1 - k) - transverse,
        "axial_mass": rod_mass * (1 - k) * (1 - k) + transverse + mover_mass,
    }


@leg_stage
def leg_closure(joint_vector, actuator_axis, rod_length):
    """closure of the leg: actuator length and rod alignment."""
    axial = dot(actuator_axis, joint_vector)
    offset = joint_vector - axial * actuator_axis
    squared_span = rod_length * rod_length - ca.sumsqr(offset)
    span = ca.sqrt(squared_span)
    return {
        "radial_offset": offset,
        "axial_span": span,
        "axial_span_reciprocal": 1 / span,
        "actuator_length": axial - span,
        "rod_alignment": squared_span / (rod_length * rod_length),
    }


@leg_stage
def length_gradient(radial_offset, axial_span_reciprocal, actuator_axis):
    """gradient of the actuator length by the platform joint, u/(u.a)."""
    return {"length_gradient": actuator_axis + radial_offset * axial_span_reciprocal}


@leg_stage
def leg_rates(joint_velocity, length_gradient, actuator_axis):
    """actuator velocity."""
    axial = dot(actuator_axis, joint_velocity)
    actuator_velocity = dot(length_gradient, joint_velocity)
    return {
        "radial_offset_rate": joint_velocity - axial * actuator_axis,
        "axial_span_rate": axial - actuator_velocity,
        "actuator_velocity": actuator_velocity,
    }


@leg_stage
def length_gradient_rate(
    base_rate, length_gradient, radial_offset, radial_offset_rate, axial_span_rate, axial_span_reciprocal,
):
    """inertial rate of the gradient of the actuator length."""
    direction = radial_offset * axial_span_reciprocal
    relative = (radial_offset_rate - direction * axial_span_rate) * axial_span_reciprocal
    return {"length_gradient_rate": relative + cross(base_rate, length_gradient)}


@leg_stage
def leg_accelerations(
    joint_acceleration, length_gradient, radial_offset_rate, axial_span_rate, axial_span_reciprocal,
):
    """actuator acceleration."""
    curvature = ca.sumsqr(radial_offset_rate) + axial_span_rate * axial_span_rate
    return {"actuator_acceleration": dot(length_gradient, joint_acceleration) + curvature * axial_span_reciprocal}


def _joint_accelerations(
    base_point, actuator_axis, platform_point, actuator_length, actuator_velocity, actuator_acceleration,
    base_origin_acceleration, base_field, base_rate, platform_origin_acceleration, platform_field,
):
    """Inertial accelerations of the rod's joints, less gravity, B."""
    hooke = (
        base_origin_acceleration
        + base_field @ (base_point + actuator_length * actuator_axis)
        + (2 * actuator_velocity) * cross(base_rate, actuator_axis)
        + actuator_acceleration * actuator_axis
    )
    return {"hooke": hooke, "joint": platform_origin_acceleration + platform_field @ platform_point}


def _inertia_forces(leg, actuator_axis, mover_offset, base_rate, accelerations):
    """Inertia less weight, along the actuator and at the joint."""
    components = {name: dot(actuator_axis, acceleration) for name, acceleration in accelerations.items()}
    # The mover is d* below the Hooke joint on an axis that turns: a . (w' x a + w x (w x a)) = -|w x a|^2.
    components["mover"] = components["hooke"] + mover_offset * ca.sumsqr(cross(base_rate, actuator_axis))
    return kane.inertia_forces(leg, accelerations, components)


@leg_stage
def leg_inertia_forces(
    base_point, actuator_axis, platform_point, mover_mass, mover_offset, hooke_end_mass, rod_coupling,
    actuator_length, actuator_velocity, actuator_acceleration,
    base_origin_acceleration, base_field, base_rate, platform_origin_acceleration, platform_field,
):
    """inertia of the leg, less weight, at the actuator and at the platform joint."""
    accelerations = _joint_accelerations(
        base_point, actuator_axis, platform_point, actuator_length, actuator_velocity, actuator_acceleration,
        base_origin_acceleration, base_field, base_rate, platform_origin_acceleration, platform_field,
    )
    leg = _leg(hooke_end_mass, rod_coupling, mover_mass)
    axial, joint = _inertia_forces(leg, actuator_axis, mover_offset, base_rate, accelerations)
    return {"axial_inertia_force": axial, "joint_inertia_force": joint}


@leg_stage
def leg_reference_forces(
    base_point, actuator_axis, platform_point, platform_lever, mover_mass, mover_offset, hooke_end_mass, rod_coupling,
    actuator_length, actuator_velocity, actuator_acceleration, length_gradient, length_gradient_rate,
    base_origin_acceleration, base_field, base_rate, platform_origin_acceleration, platform_field,
    velocity_error, rate_error, error_field,
):
    """inertia of the leg, less weight, at reference speeds: at the actuator and at the platform joint."""
    leg = _leg(hooke_end_mass, rod_coupling, mover_mass)
    accelerations = _joint_accelerations(
        base_point, actuator_axis, platform_point, actuator_length, actuator_velocity, actuator_acceleration,
        base_origin_acceleration, base_field, base_rate, platform_origin_acceleration, platform_field,
    )
    more = kane.bilinear_accelerations(
        leg, actuator_axis, cross(base_rate, actuator_axis),
        length_gradient, length_gradient_rate,
        velocity_error + cross(rate_error, platform_lever), error_field @ platform_point,
    )
    # The mover's own share is the Hooke joint's: both slide along the axis.
    accelerations = {name: acceleration + more[name] for name, acceleration in accelerations.items()}
    axial, joint = _inertia_forces(leg, actuator_axis, mover_offset, base_rate, accelerations)
    return {"axial_inertia_force": axial, "joint_inertia_force": joint}


@leg_stage
def leg_inertia_wrench(
    base_point, actuator_axis, platform_point, joint_vector, mover_mass, mover_offset, hooke_end_mass, rod_coupling,
    actuator_length, actuator_velocity, actuator_acceleration,
    base_origin_acceleration, base_field, base_rate, platform_origin_acceleration, platform_field,
):
    """inertia of the whole leg, less weight, about the base origin."""
    accelerations = _joint_accelerations(
        base_point, actuator_axis, platform_point, actuator_length, actuator_velocity, actuator_acceleration,
        base_origin_acceleration, base_field, base_rate, platform_origin_acceleration, platform_field,
    )
    accelerations["mover"] = accelerations["hooke"] - mover_offset * (base_field @ actuator_axis)
    hooke = base_point + actuator_length * actuator_axis
    positions = {"hooke": hooke, "joint": base_point + joint_vector, "mover": hooke - mover_offset * actuator_axis}
    force, moment = kane.inertia_wrench(_leg(hooke_end_mass, rod_coupling, mover_mass), positions, accelerations)
    return {"leg_inertia_force": force, "leg_inertia_moment": moment}


@leg_stage
def leg_inertia_squares(
    actuator_axis, platform_lever, jacobian_row, mover_mass, hooke_end_mass, rod_coupling,
):
    """mass matrix of the leg in the platform speeds, as weighted squares."""
    leg = _leg(hooke_end_mass, rod_coupling, mover_mass)
    axis_row = ca.vertcat(actuator_axis, cross(platform_lever, actuator_axis))
    squares = kane.joint_inertia_squares(leg, axis_row, jacobian_row)
    return {
        "inertia_weights": ca.vertcat(*(weight for weight, _ in squares)),
        "inertia_rows": ca.horzcat(*(row for _, row in squares)).T,
    }


@leg_stage
def leg_inertia(base_rotation, actuator_axis, mover_mass, hooke_end_mass, rod_coupling, length_gradient_o):
    """mass matrix of the leg in the speeds of its joint."""
    leg = _leg(hooke_end_mass, rod_coupling, mover_mass)
    return {"joint_inertia": kane.joint_inertia(leg, base_rotation @ actuator_axis, length_gradient_o)}


@leg_stage
def leg_weight(base_rotation, gravity, actuator_axis, rod_mass, rod_com_fraction, mover_mass):
    """weight of the leg: along the actuator coordinate and at the platform joint."""
    along = mover_mass + rod_mass * (1 - rod_com_fraction)
    return {
        "axial_weight": along * dot(base_rotation @ actuator_axis, gravity),
        "joint_weight_o": rod_mass * rod_com_fraction * gravity,
    }


@leg_stage
def leg_energy(
    base_rotation, base_position, base_velocity, platform_position, platform_rotation, platform_velocity, platform_point,
    base_point, actuator_axis, actuator_length, actuator_velocity, rod_mass, rod_com_fraction, mover_mass, mover_offset,
    hooke_end_mass, platform_end_mass, rod_coupling, gravity, rest_length, axial_stiffness,
):
    """kinetic and potential energy of the leg."""
    axis = base_rotation @ actuator_axis
    arm = base_rotation @ base_point + actuator_length * axis
    lever = platform_rotation @ platform_point
    hooke = base_position + arm
    joint = platform_position + lever
    mover = hooke - mover_offset * axis
    hooke_velocity = base_velocity[:3] + cross(base_velocity[3:], arm) + actuator_velocity * axis
    velocities = {
        "hooke": hooke_velocity,
        "joint": platform_velocity[:3] + cross(platform_velocity[3:], lever),
        "mover": hooke_velocity - mover_offset * cross(base_velocity[3:], axis),
    }
    leg = _leg(hooke_end_mass, rod_coupling, mover_mass)
    leg.masses["joint", "joint"] = platform_end_mass
    rod_moment = rod_mass * ((1 - rod_com_fraction) * hooke + rod_com_fraction * joint)
    extension = actuator_length - rest_length
    return {
        "leg_kinetic_energy": kane.kinetic_energy(leg, velocities),
        "leg_potential_energy": axial_stiffness * extension * extension / 2 - dot(gravity, rod_moment + mover_mass * mover),
    }


@leg_stage
def rod_direction(base_rotation, radial_offset, axial_span, actuator_axis, rod_length):
    """rod direction."""
    return {"rod_direction": base_rotation @ ((radial_offset + axial_span * actuator_axis) / rod_length)}


@leg_stage
def rod_and_joint_kinematics(
    base_position, base_rotation, base_velocity, platform_position, platform_rotation, platform_velocity, platform_point,
    base_point, actuator_axis, actuator_length, actuator_velocity, rod_direction, rod_length,
):
    """joints and joint rates."""
    axis = base_rotation @ actuator_axis
    arm = base_rotation @ base_point + actuator_length * axis
    lever = platform_rotation @ platform_point
    hooke_velocity = base_velocity[:3] + cross(base_velocity[3:], arm) + actuator_velocity * axis
    joint_velocity = platform_velocity[:3] + cross(platform_velocity[3:], lever)
    angular = cross(rod_direction, joint_velocity - hooke_velocity) / rod_length
    return {
        "hooke_joint_position": base_position + arm,
        "platform_joint_position": platform_position + lever,
        "hooke_joint_velocity": hooke_velocity,
        "platform_joint_velocity": joint_velocity,
        "rod_angular_velocity": angular,
        "platform_joint_rate": platform_velocity[3:] - angular,
    }


@leg_stage
def rod_and_mover_velocities(
    base_rotation, base_velocity, actuator_axis, rod_com_fraction, mover_offset,
    hooke_joint_position, platform_joint_position, hooke_joint_velocity, platform_joint_velocity,
):
    """position and velocity of rod and mover."""
    k = rod_com_fraction
    axis = base_rotation @ actuator_axis
    return {
        "rod_com_position": (1 - k) * hooke_joint_position + k * platform_joint_position,
        "rod_com_velocity": (1 - k) * hooke_joint_velocity + k * platform_joint_velocity,
        "mover_position": hooke_joint_position - mover_offset * axis,
        "mover_velocity": hooke_joint_velocity - mover_offset * cross(base_velocity[3:], axis),
    }


@leg_stage
def rod_and_mover_accelerations(
    base_rotation, base_velocity, base_acceleration, platform_rotation, platform_velocity, platform_acceleration,
    platform_point, base_point, actuator_axis, actuator_length, actuator_velocity, actuator_acceleration,
    rod_direction, rod_angular_velocity, rod_length, rod_com_fraction, mover_offset,
):
    """acceleration of rod and mover."""
    k = rod_com_fraction
    rate, rate_derivative = base_velocity[3:], base_acceleration[3:]
    axis = base_rotation @ actuator_axis
    axis_rate = cross(rate, axis)
    axis_acceleration = cross(rate_derivative, axis) + cross(rate, axis_rate)
    point = base_rotation @ base_point
    hooke = (
        base_acceleration[:3] + cross(rate_derivative, point) + cross(rate, cross(rate, point))
        + actuator_length * axis_acceleration + 2 * actuator_velocity * axis_rate + actuator_acceleration * axis
    )
    lever = platform_rotation @ platform_point
    lever_rate = cross(platform_velocity[3:], lever)
    joint = platform_acceleration[:3] + cross(platform_acceleration[3:], lever) + cross(platform_velocity[3:], lever_rate)
    return {
        # u x u'' is what is left of the derivative of w_s = u x u'.
        "rod_angular_acceleration": cross(rod_direction, joint - hooke) / rod_length,
        "rod_com_acceleration": (1 - k) * hooke + k * joint,
        "mover_acceleration": hooke - mover_offset * axis_acceleration,
    }


def _velocities(speeds, base_rotation, platform_rotation, platform_point, actuator_axis, jacobian_dp, rod_direction,
                rod_length, rod_com_fraction):
    """Velocity and angular velocity of the rod, velocity of the mover, as far as the platform speeds cause them."""
    k = rod_com_fraction
    hooke = (base_rotation @ actuator_axis) * dot(jacobian_dp, speeds)
    joint = speeds[:3] + cross(speeds[3:], platform_rotation @ platform_point)
    angular = cross(rod_direction, joint - hooke) / rod_length
    return (1 - k) * hooke + k * joint, angular, hooke


@leg_stage
def rod_and_mover_partial_velocities(
    base_rotation, platform_rotation, platform_point, actuator_axis, jacobian_dp, rod_direction, rod_length, rod_com_fraction,
):
    """partial velocities of rod and mover by the six platform speeds."""
    speeds = ca.SX.sym("speeds", 6)
    rod, angular, mover = _velocities(
        speeds, base_rotation, platform_rotation, platform_point, actuator_axis, jacobian_dp, rod_direction, rod_length,
        rod_com_fraction,
    )
    return {
        "rod_partial_velocity": kane.partial_velocity(rod, speeds),
        "rod_partial_angular_velocity": kane.partial_velocity(angular, speeds),
        "mover_partial_velocity": kane.partial_velocity(mover, speeds),
    }


@leg_stage
def rod_and_mover_forces(
    base_rotation, platform_rotation, platform_point, gravity, actuator_axis, jacobian_dp, actuator_force,
    passive_axial_force, rod_mass, rod_inertia, rod_length, rod_com_fraction, mover_mass,
    rod_direction, rod_angular_acceleration, rod_com_acceleration, mover_acceleration,
):
    """generalised active and inertia forces of rod and mover."""
    speeds = ca.SX.sym("speeds", 6)
    rod, angular, mover = _velocities(
        speeds, base_rotation, platform_rotation, platform_point, actuator_axis, jacobian_dp, rod_direction, rod_length,
        rod_com_fraction,
    )

    def project(velocity, force):
        return kane.generalised_force(velocity, speeds, force)

    axial = (actuator_force - passive_axial_force) * (base_rotation @ actuator_axis)
    # Without spin w_s and w_s' are perpendicular to the rod: (1 - u u^T) leaves them, and w_s x I w_s vanishes.
    moment = rod_inertia * rod_angular_acceleration
    return {
        "rod_active_force": project(rod, rod_mass * gravity),
        "rod_inertia_force": -(project(rod, rod_mass * rod_com_acceleration) + project(angular, moment)),
        "mover_active_force": project(mover, mover_mass * gravity + axial),
        "mover_inertia_force": -project(mover, mover_mass * mover_acceleration),
    }


# What the table of functions asks of a leg type beyond its share of the dynamics: its own bodies and joints.
leg_masses = rod_ends
# The mass matrix alone takes fewer operations from the joints' 3 x 3 matrices, all matrices together from 6-vectors.
MASS_MATRIX = (leg_inertia, matrices.legs_mass_matrix)
LEGS_INERTIA = (fixed_axes.coupled_axis, fixed_axes.legs_inertia)
MASS_MATRIX_B = (fixed_axes.coupling_moments, fixed_axes.mass_matrix_b)
CORIOLIS_MATRICES = (
    fixed_axes.jacobian_rate, fixed_axes.coupled_axis_rates, fixed_axes.legs_coriolis_matrix, fixed_axes.coupling_moments,
    fixed_axes.sliding_moment_rate, fixed_axes.coriolis_matrix_b,
)
# Whether `leg_inertia_squares` leaves a mass at the joint: all that moves with the joint alone is in `platform_end_mass`.
JOINT_MASS = False
JOINT_KINEMATICS = (rod_direction, rod_and_joint_kinematics)
BODY_KINEMATICS = (rod_direction, rod_and_joint_kinematics, rod_and_mover_velocities, rod_and_mover_accelerations)
PARTIAL_VELOCITIES = (rod_direction, rod_and_mover_partial_velocities)
body_forces = rod_and_mover_forces

BODY_OUTPUTS = (
    "rod_angular_velocity", "rod_angular_acceleration", "rod_com_position", "rod_com_velocity", "rod_com_acceleration",
    "mover_position", "mover_velocity", "mover_acceleration",
)
PARTIAL_OUTPUTS = ("rod_partial_velocity", "rod_partial_angular_velocity", "mover_partial_velocity")
FORCE_OUTPUTS = ("rod_active_force", "rod_inertia_force", "mover_active_force", "mover_inertia_force")
