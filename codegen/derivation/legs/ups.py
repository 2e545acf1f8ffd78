"""The classical Gough-Stewart leg, UPS: universal joint on the base, telescopic leg, spherical joint on the platform.

Unknown at the platform joint: x, its vector from the base joint. The actuator lies along the leg itself: its length is
d = |x|, and the gradient of d by x is the leg's direction u = x/d, which is also the axis. Lower and upper part have
their centres of mass on the line of the joints and do not spin, so the leg is three vectors: base joint, platform joint
and the direction u, whose partial velocity is (1 - u u^T)/d. Everything here is in base coordinates unless a name ends
in `_o`; rates of the direction are inertial.
"""

import casadi as ca

from .. import kane, matrices
from ..rotations import cross, dot
from ..stages import leg_stage
from ..symbols import WRENCH, table

PARAMETERS = table("parameter", True, [
    ("base_point", (3,), "m", "B", "universal joint b on the base", "(14)"),
    ("platform_point", (3,), "m", "P", "platform joint p", "(14)"),
    ("lower_mass", (), "kg", "-", "mass m_l of the lower part"),
    ("lower_com_distance", (), "m", "-", "distance e_l of the lower part's centre of mass from the base joint"),
    ("lower_inertia", (), "kg m^2", "-", "transverse inertia J_l of the lower part about its centre of mass"),
    ("upper_mass", (), "kg", "-", "mass m_u of the upper part"),
    ("upper_com_distance", (), "m", "-", "distance e_u of the upper part's centre of mass from the platform joint"),
    ("upper_inertia", (), "kg m^2", "-", "transverse inertia J_u of the upper part about its centre of mass"),
    ("rest_length", (), "m", "-", "actuator length d0 at which the axial spring is relaxed", "(39)-(46)"),
    ("axial_stiffness", (), "N/m", "-", "axial stiffness k_e", "(39)-(46)"),
    ("axial_damping", (), "N s/m", "-", "axial viscous damping c_e"),
])

INTERMEDIATES = table("intermediate", True, [
    ("length_reciprocal", (), "1/m", "-", "reciprocal of the actuator length"),
    ("lower_moment", (), "kg m", "-", "first moment of the lower part about the base joint"),
    ("upper_moment", (), "kg m", "-", "first moment of the upper part about the platform joint"),
    ("turning_inertia", (), "kg m^2", "-", "inertia of both parts, each about its joint, that turns with the direction"),
    ("joint_mass", (), "kg", "-", "leg inertia alike in all directions at the platform joint"),
    ("inertia_weights", (1,), "kg", "-", "weight of the square in the leg's mass matrix"),
    ("inertia_rows", (1, 6), "1, m", "B", "the vector that is squared, in the platform speeds"),
    ("joint_inertia_rate", (3, 3), "kg/s", "O", "Coriolis matrix of the leg in the speeds of its joint"),
    ("joint_base_inertia", (3, 6), "kg, kg m", "O", "leg inertia between joint and base speeds"),
    ("joint_base_inertia_rate", (3, 3), "kg m/s", "O", "Coriolis matrix between joint and base angular velocity"),
    ("joint_velocity_o", (3,), "m/s", "O", "velocity of the platform joint less that of the base origin"),
    ("base_joint_velocity", (3,), "m/s", "O", "velocity of the base joint"),
    ("platform_joint_velocity", (3,), "m/s", "O", "velocity of the platform joint"),
    ("direction_rate_o", (3,), "1/s", "O", "inertial rate of the leg's direction"),
])

OUTPUTS = table("output", True, [
    ("leg_angular_velocity", (3,), "rad/s", "O", "angular velocity w_s of the leg, without spin", "(22)"),
    ("leg_angular_acceleration", (3,), "rad/s^2", "O", "angular acceleration of the leg", "(22)"),
    ("lower_com_position", (3,), "m", "O", "centre of mass of the lower part"),
    ("lower_com_velocity", (3,), "m/s", "O", "velocity of the lower part's centre of mass"),
    ("lower_com_acceleration", (3,), "m/s^2", "O", "acceleration of the lower part's centre of mass"),
    ("upper_com_position", (3,), "m", "O", "centre of mass of the upper part"),
    ("upper_com_velocity", (3,), "m/s", "O", "velocity of the upper part's centre of mass"),
    ("upper_com_acceleration", (3,), "m/s^2", "O", "acceleration of the upper part's centre of mass"),
    ("lower_partial_velocity", (3, 6), "1, m", "O", "partial velocities of the lower part's centre of mass", "(33)-(38)"),
    ("upper_partial_velocity", (3, 6), "1, m", "O", "partial velocities of the upper part's centre of mass", "(33)-(38)"),
    ("leg_partial_angular_velocity", (3, 6), "1/m, 1", "O", "partial angular velocities of the leg", "(33)-(38)"),
    ("lower_active_force", (6,), WRENCH, "O", "generalised active force of the lower part: gravity", "(39)-(46)"),
    ("lower_inertia_force", (6,), WRENCH, "O", "generalised inertia force of the lower part", "(39)-(46)"),
    ("upper_active_force", (6,), WRENCH, "O", "generalised active force of the upper part: gravity, actuator, spring, damper",
     "(39)-(46)"),
    ("upper_inertia_force", (6,), WRENCH, "O", "generalised inertia force of the upper part", "(39)-(46)"),
])


def _leg(length_reciprocal, actuator_velocity, lower_moment, upper_moment, turning_inertia) -> kane.Leg:
    """Points and masses. Left out: the lower part's mass at the base joint, which no platform speed moves, and the
    upper part's at the platform joint, which is merged into the payload."""
    rate = actuator_velocity * length_reciprocal * length_reciprocal
    return kane.Leg(
        points={
            "base": kane.Point(),
            "joint": kane.Point(across=1),
            "direction": kane.Point(
                along=-length_reciprocal, across=length_reciprocal, along_rate=rate, across_rate=-rate, translates=0
            ),
        },
        masses={
            ("base", "direction"): lower_moment,
            ("joint", "direction"): -upper_moment,
            ("direction", "direction"): turning_inertia,
        },
    )


@leg_stage
def leg_masses(lower_mass, lower_com_distance, lower_inertia, upper_mass, upper_com_distance, upper_inertia):
    """masses, first moments and moment of inertia of both parts."""
    lower_moment = lower_mass * lower_com_distance
    upper_moment = upper_mass * upper_com_distance
    return {
        "platform_end_mass": upper_mass,
        "lower_moment": lower_moment,
        "upper_moment": upper_moment,
        "turning_inertia":
            lower_inertia + lower_moment * lower_com_distance + upper_inertia + upper_moment * upper_com_distance,
    }


@leg_stage
def leg_closure(joint_vector):
    """closure of the leg: actuator length."""
    length = ca.sqrt(ca.sumsqr(joint_vector))
    reciprocal = 1 / length
    return {
        "actuator_length": length,
        "length_reciprocal": reciprocal,
        # Rod and line of force are one: u.u = 1, and not a number where the joints coincide.
        "rod_alignment": ca.sumsqr(joint_vector * reciprocal),
    }


@leg_stage
def length_gradient(joint_vector, length_reciprocal):
    """gradient of the actuator length by the platform joint: the leg's direction."""
    return {"length_gradient": joint_vector * length_reciprocal}


@leg_stage
def leg_rates(joint_velocity, length_gradient):
    """actuator velocity."""
    return {"actuator_velocity": dot(length_gradient, joint_velocity)}


@leg_stage
def length_gradient_rate(base_rate, joint_vector, joint_velocity, actuator_velocity, length_gradient, length_reciprocal):
    """inertial rate of the leg's direction."""
    span_rate = joint_velocity + cross(base_rate, joint_vector)
    return {"length_gradient_rate": (span_rate - actuator_velocity * length_gradient) * length_reciprocal}


def _joint_accelerations(
    base_point, platform_point, base_origin_acceleration, base_field, platform_origin_acceleration, platform_field,
):
    """Inertial accelerations, less gravity, of base joint and platform joint."""
    return base_origin_acceleration + base_field @ base_point, platform_origin_acceleration + platform_field @ platform_point


@leg_stage
def leg_accelerations(
    base_point, platform_point, base_origin_acceleration, base_field, platform_origin_acceleration, platform_field,
    actuator_length, length_gradient, length_gradient_rate,
):
    """actuator acceleration."""
    base, joint = _joint_accelerations(
        base_point, platform_point, base_origin_acceleration, base_field, platform_origin_acceleration, platform_field
    )
    centripetal = actuator_length * ca.sumsqr(length_gradient_rate)
    return {"actuator_acceleration": dot(length_gradient, joint - base) + centripetal}


def _point_accelerations(
    base_point, platform_point, base_origin_acceleration, base_field, platform_origin_acceleration, platform_field,
    actuator_velocity, actuator_acceleration, length_gradient, length_gradient_rate, length_reciprocal,
):
    """Inertial acceleration of every point, less gravity, and second derivative of the direction."""
    base, joint = _joint_accelerations(
        base_point, platform_point, base_origin_acceleration, base_field, platform_origin_acceleration, platform_field
    )
    span = joint - base - actuator_acceleration * length_gradient - (2 * actuator_velocity) * length_gradient_rate
    return {"base": base, "joint": joint, "direction": span * length_reciprocal}


@leg_stage
def leg_reference_forces(
    base_point, platform_point, platform_lever, base_origin_acceleration, base_field, platform_origin_acceleration,
    platform_field, actuator_velocity, actuator_acceleration, length_gradient, length_gradient_rate, length_reciprocal,
    lower_moment, upper_moment, turning_inertia, velocity_error, rate_error, error_field,
):
    """inertia of the leg, less weight, at reference speeds: at the actuator and at the platform joint."""
    accelerations = _point_accelerations(
        base_point, platform_point, base_origin_acceleration, base_field, platform_origin_acceleration, platform_field,
        actuator_velocity, actuator_acceleration, length_gradient, length_gradient_rate, length_reciprocal,
    )
    leg = _leg(length_reciprocal, actuator_velocity, lower_moment, upper_moment, turning_inertia)
    more = kane.bilinear_accelerations(
        leg, length_gradient, length_gradient_rate, length_gradient, length_gradient_rate,
        velocity_error + cross(rate_error, platform_lever), error_field @ platform_point,
    )
    accelerations = {name: acceleration + more[name] for name, acceleration in accelerations.items()}
    components = {name: dot(length_gradient, acceleration) for name, acceleration in accelerations.items()}
    axial, at_joint = kane.inertia_forces(leg, accelerations, components)
    return {"axial_inertia_force": axial, "joint_inertia_force": at_joint}


@leg_stage
def leg_inertia_wrench(
    base_point, platform_point, joint_vector, base_origin_acceleration, base_field, platform_origin_acceleration,
    platform_field, actuator_velocity, actuator_acceleration, length_gradient, length_gradient_rate, length_reciprocal,
    lower_mass, lower_moment, upper_moment, turning_inertia,
):
    """inertia of the whole leg, less weight, about the base origin."""
    accelerations = _point_accelerations(
        base_point, platform_point, base_origin_acceleration, base_field, platform_origin_acceleration, platform_field,
        actuator_velocity, actuator_acceleration, length_gradient, length_gradient_rate, length_reciprocal,
    )
    positions = {"base": base_point, "joint": base_point + joint_vector, "direction": length_gradient}
    leg = _leg(length_reciprocal, actuator_velocity, lower_moment, upper_moment, turning_inertia)
    leg.masses["base", "base"] = lower_mass
    force, moment = kane.inertia_wrench(leg, positions, accelerations)
    return {"leg_inertia_force": force, "leg_inertia_moment": moment}


@leg_stage
def leg_inertia_forces(
    base_point, platform_point, base_origin_acceleration, base_field, platform_origin_acceleration, platform_field,
    actuator_velocity, actuator_acceleration, length_gradient, length_gradient_rate, length_reciprocal,
    lower_moment, upper_moment, turning_inertia,
):
    """inertia of the leg, less weight, at the actuator and at the platform joint."""
    accelerations = _point_accelerations(
        base_point, platform_point, base_origin_acceleration, base_field, platform_origin_acceleration, platform_field,
        actuator_velocity, actuator_acceleration, length_gradient, length_gradient_rate, length_reciprocal,
    )
    leg = _leg(length_reciprocal, actuator_velocity, lower_moment, upper_moment, turning_inertia)
    components = {name: dot(length_gradient, acceleration) for name, acceleration in accelerations.items()}
    axial, at_joint = kane.inertia_forces(leg, accelerations, components)
    return {"axial_inertia_force": axial, "joint_inertia_force": at_joint}


@leg_stage
def leg_inertia_squares(
    actuator_velocity, jacobian_row, length_reciprocal, lower_moment, upper_moment, turning_inertia,
):
    """mass matrix of the leg in the platform speeds, as weighted square and mass at the joint."""
    leg = _leg(length_reciprocal, actuator_velocity, lower_moment, upper_moment, turning_inertia)
    ((weight, row),) = kane.joint_inertia_squares(leg, jacobian_row, jacobian_row)
    return {"inertia_weights": weight, "inertia_rows": row.T, "joint_mass": kane.joint_mass(leg)}


@leg_stage
def leg_inertia(
    base_rotation, base_point, length_gradient_o, joint_position_o, length_reciprocal, lower_moment, upper_moment,
    turning_inertia,
):
    """mass matrices of the leg in the speeds of its joint and of the base."""
    leg = _leg(length_reciprocal, 0, lower_moment, upper_moment, turning_inertia)
    positions = {"base": base_rotation @ base_point, "joint": joint_position_o, "direction": length_gradient_o}
    return {
        "joint_inertia": kane.joint_inertia(leg, length_gradient_o, length_gradient_o),
        "joint_base_inertia": kane.joint_base_inertia(leg, length_gradient_o, length_gradient_o, positions),
    }


@leg_stage
def leg_inertia_rates(
    base_rotation, base_velocity, base_point, actuator_velocity, length_gradient_o, length_gradient_rate_o,
    joint_velocity_o, length_reciprocal, lower_moment, upper_moment, turning_inertia,
):
    """Coriolis matrices of the leg in the speeds of its joint and of the base."""
    leg = _leg(length_reciprocal, actuator_velocity, lower_moment, upper_moment, turning_inertia)
    u, u_rate = length_gradient_o, length_gradient_rate_o
    base = cross(base_velocity[3:], base_rotation @ base_point)
    velocities = {"base": base, "joint": joint_velocity_o, "direction": u_rate}
    return {
        "joint_inertia_rate": kane.joint_inertia_rate(leg, u, u_rate, u, u_rate),
        "joint_base_inertia_rate": kane.joint_base_inertia_rate(leg, u, u, velocities),
    }


@leg_stage
def leg_weight(base_rotation, gravity, length_gradient, length_reciprocal, upper_mass, lower_moment, upper_moment):
    """weight of the leg: along the actuator coordinate and at the platform joint."""
    turning = (lower_moment - upper_moment) * length_reciprocal
    return {
        "axial_weight": -turning * dot(base_rotation @ length_gradient, gravity),
        "joint_weight_o": (upper_mass + turning) * gravity,
    }


@leg_stage
def leg_energy(
    base_rotation, base_position, base_velocity, platform_position, platform_rotation, platform_velocity, platform_point,
    base_point, actuator_length, actuator_velocity, length_gradient, length_reciprocal, lower_mass, lower_moment,
    upper_mass, upper_moment, turning_inertia, gravity, rest_length, axial_stiffness,
):
    """kinetic and potential energy of the leg."""
    direction = base_rotation @ length_gradient
    arm, lever = base_rotation @ base_point, platform_rotation @ platform_point
    base = base_velocity[:3] + cross(base_velocity[3:], arm)
    joint = platform_velocity[:3] + cross(platform_velocity[3:], lever)
    direction_rate = (joint - base - actuator_velocity * direction) * length_reciprocal
    leg = _leg(length_reciprocal, actuator_velocity, lower_moment, upper_moment, turning_inertia)
    leg.masses["base", "base"] = lower_mass
    leg.masses["joint", "joint"] = upper_mass
    first_moment = (
        lower_mass * (base_position + arm) + upper_mass * (platform_position + lever)
        + (lower_moment - upper_moment) * direction
    )
    extension = actuator_length - rest_length
    return {
        "leg_kinetic_energy": kane.kinetic_energy(leg, {"base": base, "joint": joint, "direction": direction_rate}),
        "leg_potential_energy": axial_stiffness * extension * extension / 2 - dot(gravity, first_moment),
    }


@leg_stage
def rod_direction(base_rotation, length_gradient):
    """direction of the leg."""
    return {"rod_direction": base_rotation @ length_gradient}


@leg_stage
def leg_and_joint_kinematics(
    base_position, base_rotation, base_velocity, platform_position, platform_rotation, platform_velocity, platform_point,
    base_point, actuator_velocity, rod_direction, length_reciprocal,
):
    """joints and angular velocity of the leg."""
    arm, lever = base_rotation @ base_point, platform_rotation @ platform_point
    base = base_velocity[:3] + cross(base_velocity[3:], arm)
    joint = platform_velocity[:3] + cross(platform_velocity[3:], lever)
    angular = cross(rod_direction, joint - base) * length_reciprocal
    return {
        "hooke_joint_position": base_position + arm,
        "platform_joint_position": platform_position + lever,
        "base_joint_velocity": base,
        "platform_joint_velocity": joint,
        "direction_rate_o": (joint - base - actuator_velocity * rod_direction) * length_reciprocal,
        "leg_angular_velocity": angular,
        "platform_joint_rate": platform_velocity[3:] - angular,
    }


@leg_stage
def part_velocities(
    rod_direction, hooke_joint_position, platform_joint_position, base_joint_velocity, platform_joint_velocity,
    direction_rate_o, lower_com_distance, upper_com_distance,
):
    """position and velocity of lower and upper part."""
    return {
        "lower_com_position": hooke_joint_position + lower_com_distance * rod_direction,
        "lower_com_velocity": base_joint_velocity + lower_com_distance * direction_rate_o,
        "upper_com_position": platform_joint_position - upper_com_distance * rod_direction,
        "upper_com_velocity": platform_joint_velocity - upper_com_distance * direction_rate_o,
    }


@leg_stage
def part_accelerations(
    base_rotation, base_velocity, base_acceleration, platform_rotation, platform_velocity, platform_acceleration,
    platform_point, base_point, actuator_velocity, actuator_acceleration, rod_direction, direction_rate_o,
    length_reciprocal, lower_com_distance, upper_com_distance,
):
    """acceleration of lower and upper part."""
    arm, lever = base_rotation @ base_point, platform_rotation @ platform_point

    def of_point(velocity, acceleration, arm):
        return acceleration[:3] + cross(acceleration[3:], arm) + cross(velocity[3:], cross(velocity[3:], arm))

    base = of_point(base_velocity, base_acceleration, arm)
    joint = of_point(platform_velocity, platform_acceleration, lever)
    span = joint - base - actuator_acceleration * rod_direction - (2 * actuator_velocity) * direction_rate_o
    second_rate = span * length_reciprocal
    return {
        # u x u'' is what is left of the derivative of w_s = u x u'.
        "leg_angular_acceleration": cross(rod_direction, second_rate),
        "lower_com_acceleration": base + lower_com_distance * second_rate,
        "upper_com_acceleration": joint - upper_com_distance * second_rate,
    }


def _velocities(
    speeds, platform_rotation, platform_point, jacobian_dp, rod_direction, length_reciprocal, lower_com_distance,
    upper_com_distance,
):
    """Velocities of lower part, upper part and angular velocity, as far as the platform speeds cause them."""
    joint = speeds[:3] + cross(speeds[3:], platform_rotation @ platform_point)
    direction_rate = (joint - dot(jacobian_dp, speeds) * rod_direction) * length_reciprocal
    angular = cross(rod_direction, joint) * length_reciprocal
    return lower_com_distance * direction_rate, joint - upper_com_distance * direction_rate, angular


@leg_stage
def part_partial_velocities(
    platform_rotation, platform_point, jacobian_dp, rod_direction, length_reciprocal, lower_com_distance,
    upper_com_distance,
):
    """partial velocities of lower and upper part by the six platform speeds."""
    speeds = ca.SX.sym("speeds", 6)
    lower, upper, angular = _velocities(
        speeds, platform_rotation, platform_point, jacobian_dp, rod_direction, length_reciprocal, lower_com_distance,
        upper_com_distance,
    )
    return {
        "lower_partial_velocity": kane.partial_velocity(lower, speeds),
        "upper_partial_velocity": kane.partial_velocity(upper, speeds),
        "leg_partial_angular_velocity": kane.partial_velocity(angular, speeds),
    }


@leg_stage
def part_forces(
    platform_rotation, platform_point, gravity, jacobian_dp, actuator_force, passive_axial_force, rod_direction,
    length_reciprocal, lower_mass, lower_com_distance, lower_inertia, upper_mass, upper_com_distance, upper_inertia,
    leg_angular_acceleration, lower_com_acceleration, upper_com_acceleration,
):
    """generalised active and inertia forces of lower and upper part."""
    speeds = ca.SX.sym("speeds", 6)
    lower, upper, angular = _velocities(
        speeds, platform_rotation, platform_point, jacobian_dp, rod_direction, length_reciprocal, lower_com_distance,
        upper_com_distance,
    )

    def project(velocity, force):
        return kane.generalised_force(velocity, speeds, force)

    # On the lower part the same force acts backwards, where it does no work: that part moves across the leg only.
    axial = (actuator_force - passive_axial_force) * rod_direction

    def inertia(velocity, mass, acceleration, transverse):
        # Without spin w_s' is perpendicular to the leg: (1 - u u^T) leaves it, and w_s x I w_s vanishes.
        return -(project(velocity, mass * acceleration) + project(angular, transverse * leg_angular_acceleration))

    return {
        "lower_active_force": project(lower, lower_mass * gravity),
        "lower_inertia_force": inertia(lower, lower_mass, lower_com_acceleration, lower_inertia),
        "upper_active_force": project(upper, upper_mass * gravity + axial),
        "upper_inertia_force": inertia(upper, upper_mass, upper_com_acceleration, upper_inertia),
    }


# What the table of functions asks of a leg type beyond its share of the dynamics: its own bodies and joints.
MASS_MATRIX = LEGS_INERTIA = (leg_inertia, matrices.legs_mass_matrix)
MASS_MATRIX_B = (matrices.mass_matrix_b,)
CORIOLIS_MATRICES = (
    matrices.joint_motion_in_o, leg_inertia_rates, matrices.legs_coriolis_matrix, matrices.coriolis_matrix_b,
)
# Whether `leg_inertia_squares` leaves a mass at the joint.
JOINT_MASS = True
JOINT_KINEMATICS = (rod_direction, leg_and_joint_kinematics)
BODY_KINEMATICS = (rod_direction, leg_and_joint_kinematics, part_velocities, part_accelerations)
PARTIAL_VELOCITIES = (rod_direction, part_partial_velocities)
body_forces = part_forces

BODY_OUTPUTS = (
    "leg_angular_velocity", "leg_angular_acceleration", "lower_com_position", "lower_com_velocity",
    "lower_com_acceleration", "upper_com_position", "upper_com_velocity", "upper_com_acceleration",
)
PARTIAL_OUTPUTS = ("lower_partial_velocity", "upper_partial_velocity", "leg_partial_angular_velocity")
FORCE_OUTPUTS = ("lower_active_force", "lower_inertia_force", "upper_active_force", "upper_inertia_force")
