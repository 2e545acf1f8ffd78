"""Every array that has a name: inputs, parameters, intermediates and outputs, declared once.

A name is the same in the graph file, the generated Rust, the numeric reference and the test vectors.
Frames: O inertial, B base, P platform; `B -> O` is the rotation matrix that takes B components to O components.
"""

from dataclasses import dataclass

LEG_COUNT = 6


@dataclass(frozen=True)
class Symbol:
    """A named array. The shape of a per-leg symbol leaves the leg dimension out."""

    name: str
    role: str
    shape: tuple[int, ...]
    unit: str
    frame: str
    meaning: str
    equation: str = ""
    per_leg: bool = False


def table(role: str, per_leg: bool, rows) -> list[Symbol]:
    """Symbols from rows of name, shape, unit, frame, meaning and equation."""
    return [Symbol(row[0], role, row[1], *row[2:], per_leg=per_leg) for row in rows]


TWIST = "m/s, rad/s"
TWIST_RATE = "m/s^2, rad/s^2"
WRENCH = "N, N m"
INERTIA_6 = "kg, kg m, kg m^2"
CORIOLIS_6 = "kg/s, kg m/s, kg m^2/s"
STIFFNESS_6 = "N/m, N, N m"

INPUTS = table("input", False, [
    ("base_position", (3,), "m", "O", "origin of the base frame"),
    ("base_rotation", (3, 3), "1", "B -> O", "rotation of the base", "(2)"),
    ("base_velocity", (6,), TWIST, "O", "base velocity [r_b'; w_b], w_b the angular velocity"),
    ("base_acceleration", (6,), TWIST_RATE, "O", "base acceleration [r_b''; w_b']"),
    ("platform_position", (3,), "m", "O", "centre of the platform's joint circle"),
    ("platform_rotation", (3, 3), "1", "P -> O", "rotation of the platform", "(2)"),
    ("platform_velocity", (6,), TWIST, "O", "platform velocity [r_p'; w_p], the generalised speeds"),
    ("platform_acceleration", (6,), TWIST_RATE, "O", "platform acceleration [r_p''; w_p']"),
    ("reference_velocity", (6,), TWIST, "O", "reference velocity [r_r'; w_r] of the platform, for passivity-based control"),
]) + table("input", True, [
    ("actuator_force", (), "N", "-", "actuator force along the actuator, positive to lengthen it"),
]) + table("input", False, [
    ("external_wrench", (6,), WRENCH, "O", "external force and moment [F_D; M_D] at the payload's centre of mass"),
])

PLATFORM_PARAMETERS = table("parameter", False, [
    ("payload_mass", (), "kg", "-", "mass of platform and payload"),
    ("payload_com", (3,), "m", "P", "centre of mass of platform and payload"),
    ("payload_inertia", (3, 3), "kg m^2", "P", "inertia about the payload's centre of mass (upper triangle is read)"),
    ("gravity", (3,), "m/s^2", "O", "acceleration of gravity"),
])

# Coordinates of the base frame keep the hot path short: actuators are fixed there.
MOTION = table("intermediate", False, [
    ("relative_position", (3,), "m", "B", "platform origin seen from the base"),
    ("relative_rotation", (3, 3), "1", "P -> B", "rotation of the platform seen from the base"),
    ("base_rate", (3,), "rad/s", "B", "angular velocity of the base"),
    ("platform_rate", (3,), "rad/s", "B", "angular velocity of the platform"),
    ("relative_velocity", (3,), "m/s", "B", "velocity of the platform origin relative to the base"),
    ("relative_rate", (3,), "rad/s", "B", "angular velocity of the platform relative to the base"),
    ("base_origin_acceleration", (3,), "m/s^2", "B", "acceleration of the base origin less gravity"),
    ("base_rate_derivative", (3,), "rad/s^2", "B", "angular acceleration of the base"),
    ("base_field", (3, 3), "1/s^2", "B", "acceleration per base coordinate of points that move with the base"),
    ("platform_origin_acceleration", (3,), "m/s^2", "B", "acceleration of the platform origin less gravity"),
    ("platform_rate_derivative", (3,), "rad/s^2", "B", "angular acceleration of the platform"),
    ("platform_field", (3, 3), "1/s^2", "P -> B", "acceleration per platform coordinate of points of the platform"),
    ("turning_center_acceleration", (3,), "m/s^2", "B", "acceleration of the platform origin relative to the base, less w x v"),
    ("relative_rate_derivative", (3,), "rad/s^2", "B", "rate of that angular velocity"),
]) + table("intermediate", True, [
    ("platform_lever", (3,), "m", "B", "platform joint from the platform origin"),
    ("joint_vector", (3,), "m", "B", "platform joint from the base point"),
    ("joint_velocity", (3,), "m/s", "B", "velocity of the platform joint relative to the base"),
    ("joint_acceleration", (3,), "m/s^2", "B", "acceleration of the platform joint relative to the base"),
])

# What every leg type provides; inertia without the end mass that moves with the platform joint.
LEG_INTERFACE = table("intermediate", True, [
    ("length_gradient", (3,), "1", "B", "gradient of the actuator length by the platform joint"),
    ("length_gradient_rate", (3,), "1/s", "B", "inertial rate of that gradient"),
    ("platform_end_mass", (), "kg", "-", "leg mass that moves with the platform joint"),
    ("axial_inertia_force", (), "N", "-", "leg inertia less weight along the actuator"),
    ("joint_inertia_force", (3,), "N", "B", "remaining leg inertia less weight at the platform joint"),
    ("leg_inertia_force", (3,), "N", "B", "inertia less weight of the whole leg"),
    ("leg_inertia_moment", (3,), "N m", "B", "its moment about the base origin"),
    ("joint_inertia", (3, 3), "kg", "O", "mass matrix of the leg in the speeds of its joint"),
    ("axial_weight", (), "N", "-", "weight of the leg along the actuator"),
    ("joint_weight_o", (3,), "N", "O", "remaining weight of the leg at the platform joint"),
    ("leg_kinetic_energy", (), "J", "-", "kinetic energy of the leg"),
    ("leg_potential_energy", (), "J", "-", "potential energy of the leg"),
])

DYNAMICS = table("intermediate", True, [
    ("passive_axial_force", (), "N", "-", "spring and damper force along the actuator"),
    ("joint_inertia_moment", (3,), "N m", "B", "moment about the platform origin of the leg's inertia at its joint"),
    ("jacobian_row", (6,), "1, m", "B", "row of the actuator Jacobian in base coordinates"),
    ("axial_reaction", (), "N", "-", "force along the actuator that balances the remaining wrench"),
    ("net_axial_force", (), "N", "-", "force along the actuator that reaches the platform"),
    ("platform_lever_o", (3,), "m", "O", "platform joint from the platform origin"),
    ("platform_lever_rate_o", (3,), "m/s", "O", "rate of the platform lever"),
    ("joint_position_o", (3,), "m", "O", "platform joint from the base origin"),
    ("length_gradient_o", (3,), "1", "O", "gradient of the actuator length"),
    ("length_gradient_rate_o", (3,), "1/s", "O", "inertial rate of that gradient"),
]) + table("intermediate", False, [
    ("merged_mass", (), "kg", "-", "mass of payload and platform-side leg ends"),
    ("merged_moment", (3,), "kg m", "P", "first moment of payload and platform-side leg ends"),
    ("merged_second_moment", (3, 3), "kg m^2", "P", "second moment of payload and platform-side leg ends"),
    ("inertia_force", (3,), "N", "B", "inertia force less weight, without the actuators' own shares"),
    ("inertia_moments", (3, 3), "N m", "B, P", "first moments by platform coordinate of the payload's inertia force"),
    ("joint_moment", (3,), "N m", "B", "moment of the legs' inertia at their joints about the platform origin"),
    ("inertia_moment", (3,), "N m", "B", "moment of the inertia force about the platform origin"),
    ("velocity_error", (3,), "m/s", "B", "reference less actual velocity of the platform origin"),
    ("rate_error", (3,), "rad/s", "B", "reference less actual angular velocity of the platform"),
    ("error_field", (3, 3), "1/s^2", "P -> B", "what that adds to the acceleration per platform coordinate"),
    ("wrench_map", (6, 6), "1, m", "B or O", "transposed actuator Jacobian about the platform origin"),
    ("remaining_wrench", (6,), WRENCH, "B or O", "inertia less external wrench that the actuators must balance"),
    ("platform_mass_matrix", (6, 6), INERTIA_6, "B", "mass matrix in base coordinates"),
    ("residual_wrench", (6,), WRENCH, "B", "wrench left at the trial acceleration"),
    ("acceleration_correction", (6,), TWIST_RATE, "B", "acceleration that removes the residual wrench"),
    ("legs_mass_matrix", (6, 6), INERTIA_6, "O", "mass matrix of the legs"),
    ("legs_coriolis_matrix", (6, 6), CORIOLIS_6, "O", "Coriolis matrix of the legs"),
])

OUTPUTS = table("output", True, [
    ("rod_alignment", (), "1", "-", "squared cosine between rod and line of the actuator's force; negative out of reach", "(18)"),
    ("actuator_length", (), "m", "-", "actuator length d", "(18)"),
    ("actuator_velocity", (), "m/s", "-", "actuator velocity d'", "(30)"),
    ("actuator_acceleration", (), "m/s^2", "-", "actuator acceleration d''", "(30)"),
    ("rod_direction", (3,), "1", "O", "rod direction u, from the Hooke joint to the platform joint", "(17)"),
    ("hooke_joint_position", (3,), "m", "O", "Hooke joint", "(14)"),
    ("platform_joint_position", (3,), "m", "O", "platform joint", "(14)"),
    ("platform_joint_rate", (3,), "rad/s", "O", "platform's angular velocity relative to the rod, w_p - w_s", "(23)"),
    ("jacobian_dp", (6,), "1, m", "O", "actuator Jacobian of the platform, d' = J_dp v_p - J_db v_b", "(32)"),
    ("jacobian_db", (6,), "1, m", "O", "actuator Jacobian of the base", "(31)"),
    ("inverse_dynamics", (), "N", "-", "actuator forces F", "(49)"),
    ("passive_inverse_dynamics", (), "N", "-", "actuator forces F at reference speeds", "(49)"),
]) + table("output", False, [
    ("payload_com_position", (3,), "m", "O", "centre of mass of the payload", "(11)-(13)"),
    ("payload_com_velocity", (3,), "m/s", "O", "velocity of the payload's centre of mass", "(11)-(13)"),
    ("payload_com_acceleration", (3,), "m/s^2", "O", "acceleration of the payload's centre of mass", "(11)-(13)"),
    ("payload_partial_velocity", (3, 6), "1, m", "O", "partial velocities of the payload's centre of mass", "(33)-(38)"),
    ("payload_partial_angular_velocity", (3, 6), "1", "O", "partial angular velocities of the payload", "(33)-(38)"),
    ("payload_active_force", (6,), WRENCH, "O", "generalised active force of the payload: gravity, external wrench", "(39)-(46)"),
    ("payload_inertia_force", (6,), WRENCH, "O", "generalised inertia force of the payload", "(39)-(46)"),
    ("mass_matrix_p", (6, 6), INERTIA_6, "O", "mass matrix M_p of the platform", "(49)"),
    ("mass_matrix_b", (6, 6), INERTIA_6, "O", "mass matrix M_b that couples the base acceleration", "(49)"),
    ("coriolis_matrix_p", (6, 6), CORIOLIS_6, "O", "Coriolis matrix C_p, natural factorisation", "(49)"),
    ("coriolis_matrix_b", (6, 6), CORIOLIS_6, "O", "Coriolis matrix C_b, natural factorisation", "(49)"),
    ("stiffness_matrix_p", (6, 6), STIFFNESS_6, "O", "linearised stiffness K_p = J_dp^T k_e J_dp", "(49)"),
    ("stiffness_matrix_b", (6, 6), STIFFNESS_6, "O", "linearised stiffness K_b = J_dp^T k_e J_db", "(49)"),
    ("gravity_force", (6,), WRENCH, "O", "generalised gravity, left side of the equation of motion", "(39)-(46)"),
    ("spring_force", (6,), WRENCH, "O", "generalised spring force J_dp^T k_e (d - d0), left side", "(39)-(46)"),
    ("damping_force", (6,), WRENCH, "O", "generalised damping force J_dp^T c_e d', left side", "(39)-(46)"),
    ("bias", (6,), WRENCH, "O", "C_p v_p - C_b v_b + gravity, spring and damping force", "(49)"),
    ("total_bias", (6,), WRENCH, "O", "bias - M_b v_b', so that M_p v_p' + total_bias = J_dp^T F + W_ext", "(49)"),
    ("forward_dynamics", (6,), TWIST_RATE, "O", "platform acceleration v_p'", "(49)"),
    ("base_wrench", (6,), WRENCH, "O", "wrench of the base on the mechanism, moments about the base origin"),
    ("kinetic_energy", (), "J", "-", "kinetic energy of all moving bodies"),
    ("potential_energy", (), "J", "-", "potential energy of gravity and springs"),
])


def symbols_of(leg) -> list[Symbol]:
    """Every symbol of a leg type (a module of `legs`)."""
    return [
        *INPUTS, *leg.PARAMETERS, *PLATFORM_PARAMETERS, *MOTION, *LEG_INTERFACE, *leg.INTERMEDIATES, *DYNAMICS,
        *leg.OUTPUTS, *OUTPUTS,
    ]
