"""The table of functions: outputs, equation, and the stages that lead to them, in order."""

from dataclasses import dataclass

from . import forces, matrices, motion, payload
from .stages import Solve, Stage


@dataclass(frozen=True)
class Function:
    """A generated function."""

    name: str
    meaning: str
    equation: str
    outputs: tuple[str, ...]
    steps: tuple[Stage | Solve, ...]
    # Whether its outputs belong to one leg type; those of every other function are the same for all.
    leg_specific: bool = False


LEG_KINEMATICS = (
    "actuator_length", "actuator_velocity", "actuator_acceleration", "rod_direction", "hooke_joint_position",
    "platform_joint_position", "platform_joint_rate",
)

MATRICES = (
    "mass_matrix_p", "coriolis_matrix_p", "jacobian_dp", "mass_matrix_b", "coriolis_matrix_b", "jacobian_db",
)


AXIAL_REACTION = Solve("axial_reaction", "wrench_map", "remaining_wrench", symmetric_positive_definite=False)


def functions(leg) -> list[Function]:
    """Every function for a leg type (a module of `legs`)."""
    pose = (motion.relative_pose, motion.joint_pose, leg.leg_closure)
    gradient = (*pose, leg.length_gradient)
    jacobians = (*gradient, matrices.joint_in_o, matrices.jacobian_rows)
    rates = (motion.relative_motion, motion.joint_motion, leg.leg_rates, leg.length_gradient_rate)
    acceleration = (motion.relative_acceleration, motion.joint_acceleration, leg.leg_accelerations)
    fields = (motion.base_acceleration_field, motion.platform_acceleration_field)

    merged = (leg.leg_masses, payload.merged_payload)
    mass = (*jacobians, *merged, *leg.MASS_MATRIX)
    inertia = (*jacobians, *merged, *leg.LEGS_INERTIA)
    coriolis = (*rates, matrices.joint_rates_in_o, *leg.CORIOLIS_MATRICES, matrices.coriolis_matrix_p)
    passive = (leg.leg_masses, leg.leg_weight, matrices.spring_and_damping_force, matrices.gravity_force)

    leg_forces = (*acceleration, leg.leg_inertia_forces, forces.passive_axial_force, forces.jacobian_row)
    wrench = (forces.joint_inertia_moment, forces.inertia_wrench)
    reaction = (*wrench, forces.remaining_wrench)
    mass_matrix = forces.platform_mass_matrix_with_joint_masses if leg.JOINT_MASS else forces.platform_mass_matrix
    bodies = (*gradient, *rates, *fields, *acceleration, *leg.BODY_KINEMATICS, payload.payload_kinematics)
    partials = (*leg.PARTIAL_VELOCITIES, payload.payload_partial_velocities)

    return [
        Function(
            "rod_alignment", "squared cosine between each rod and the line of its actuator's force", "(18)",
            ("rod_alignment",), pose,
        ),
        Function(
            "leg_kinematics", "actuator lengths, rates and accelerations, rods and joints", "(14)-(18), (22), (23), (30)",
            LEG_KINEMATICS, (*gradient, *rates, *fields, *acceleration, *leg.JOINT_KINEMATICS),
        ),
        Function(
            "body_kinematics", "position, velocity and acceleration of every body", "(11)-(13), (22), (24)-(29)",
            ("payload_com_position", "payload_com_velocity", "payload_com_acceleration", *leg.BODY_OUTPUTS), bodies,
            leg_specific=True,
        ),
        Function(
            "partial_velocities", "partial velocities and partial angular velocities of every body", "(33)-(38)",
            ("payload_partial_velocity", "payload_partial_angular_velocity", *leg.PARTIAL_OUTPUTS),
            (*jacobians, *partials), leg_specific=True,
        ),
        Function(
            "generalised_forces", "generalised active and inertia force of every body", "(39)-(46)",
            ("payload_active_force", "payload_inertia_force", *leg.FORCE_OUTPUTS),
            (*bodies, matrices.joint_in_o, matrices.jacobian_rows, forces.passive_axial_force,
             payload.payload_forces, leg.body_forces),
            leg_specific=True,
        ),
        Function("jacobian_dp", "actuator Jacobian of the platform", "(32)", ("jacobian_dp",), jacobians),
        Function("jacobian_db", "actuator Jacobian of the base", "(31)", ("jacobian_db",), jacobians),
        Function("mass_matrix_p", "mass matrix of the platform", "(49)", ("mass_matrix_p",), (*mass, matrices.mass_matrix_p)),
        Function(
            "mass_matrix_b", "mass matrix that couples the base acceleration", "(49)",
            ("mass_matrix_b",), (*inertia, *leg.MASS_MATRIX_B),
        ),
        Function(
            "coriolis_matrices", "Coriolis matrices C_p and C_b", "(49)",
            ("coriolis_matrix_p", "coriolis_matrix_b"), (*inertia, *coriolis),
        ),
        Function(
            "stiffness_matrices", "linearised stiffness matrices K_p and K_b", "(49)",
            ("stiffness_matrix_p", "stiffness_matrix_b"), (*jacobians, matrices.stiffness_matrices),
        ),
        Function(
            "matrices", "mass matrices, Coriolis matrices and actuator Jacobians in one call", "(31), (32), (49)",
            MATRICES, (*inertia, matrices.mass_matrix_p, *leg.MASS_MATRIX_B, *coriolis),
        ),
        Function(
            "passive_forces", "generalised gravity, spring and damping forces", "(40), (41)",
            ("gravity_force", "spring_force", "damping_force"), (*jacobians, *rates, *passive),
        ),
        Function(
            "bias", "velocity terms, gravity, springs and dampers without forming matrices", "(49)",
            ("bias",),
            (*gradient, *merged, *rates, motion.steady_base_field, motion.steady_platform_field, *leg_forces,
             *wrench, forces.inertia_moment, forces.opposing_axial_force, forces.bias_from_wrench),
        ),
        Function(
            "equation_of_motion", "the whole of (49) in one call", "(49)",
            ("mass_matrix_p", "coriolis_matrix_p", "stiffness_matrix_p", "jacobian_dp",
             "mass_matrix_b", "coriolis_matrix_b", "stiffness_matrix_b", "jacobian_db",
             "gravity_force", "spring_force", "damping_force", "bias"),
            (*inertia, matrices.mass_matrix_p, *leg.MASS_MATRIX_B, *coriolis, matrices.stiffness_matrices, *passive,
             matrices.bias_from_matrices),
        ),
        Function(
            "inverse_dynamics", "actuator forces for a given platform acceleration", "(49)",
            ("inverse_dynamics",),
            (*gradient, *merged, *rates, *fields, *leg_forces, *reaction, forces.wrench_map, AXIAL_REACTION,
             forces.actuator_forces),
        ),
        Function(
            "actuator_geometry", "actuator lengths with their gradients, for forward kinematics", "(18), (32)",
            ("rod_alignment", "actuator_length", "jacobian_dp"), jacobians,
        ),
        Function(
            "control", "what a controller by inverse dynamics needs, in one call", "(18), (30), (32), (49)",
            ("actuator_length", "actuator_velocity", "jacobian_dp", "mass_matrix_p", "total_bias", "inverse_dynamics"),
            (*mass, matrices.mass_matrix_p, *rates, motion.base_acceleration_field, motion.steady_platform_field, *acceleration,
             leg.leg_inertia_forces, forces.passive_axial_force, *wrench, forces.inertia_moment, forces.opposing_axial_force,
             forces.total_bias, forces.commanded_wrench, forces.wrench_map_in_o, AXIAL_REACTION, forces.commanded_forces),
        ),
        Function(
            "passive_inverse_dynamics", "actuator forces at reference speeds and accelerations, for passivity-based control",
            "(49)", ("passive_inverse_dynamics",),
            (*gradient, *merged, *rates, *fields, *acceleration, forces.reference_speeds,
             leg.leg_reference_forces, forces.passive_axial_force, forces.jacobian_row, *wrench,
             forces.remaining_reference_wrench, forces.wrench_map, AXIAL_REACTION, forces.reference_actuator_forces),
        ),
        Function(
            "base_reaction", "wrench of the base on the mechanism", "", ("base_wrench",),
            (*gradient, *merged, *rates, *fields, *acceleration, leg.leg_inertia_wrench, forces.base_reaction),
        ),
        Function(
            "forward_dynamics", "platform acceleration for given actuator forces", "(49)",
            ("forward_dynamics",),
            (*gradient, *merged, *rates, motion.base_acceleration_field, motion.trial_platform_field, *leg_forces,
             *reaction, forces.net_axial_force, forces.residual_wrench, leg.leg_inertia_squares, mass_matrix,
             Solve("acceleration_correction", "platform_mass_matrix", "residual_wrench", symmetric_positive_definite=True),
             forces.platform_acceleration),
        ),
        Function(
            "energy", "kinetic and potential energy", "",
            ("kinetic_energy", "potential_energy"),
            (*gradient, *rates, leg.leg_masses, leg.leg_energy, payload.total_energy),
        ),
    ]
