"""The paper's leg as bodies and joints: base -> mover (prismatic) -> rod (Hooke) -> payload (closed numerically).

Body frames
    mover_i     origin at the Hooke joint, z along the actuator axis, x along the Hooke joint's first axis
    rod_i       origin at the Hooke joint; equal to mover_i's frame at zero Hooke angles, z along the rod
The prismatic coordinate d is the Hooke joint's way from b_i along z.
"""

import numpy as np

from description import Body, Link, Point, along_z, slender

PARAMETERS = {
    "base_point": (6, 3),
    "actuator_axis": (6, 3),
    "platform_point": (6, 3),
    "rod_length": (6,),
    "rod_mass": (6,),
    "rod_inertia": (6,),
    "rod_com_fraction": (6,),
    "mover_mass": (6,),
    "mover_offset": (6,),
    "rest_length": (6,),
    "axial_stiffness": (6,),
    "axial_damping": (6,),
}
LINKS = (Link("mover", "base", "slide"), Link("rod", "mover", "hooke"))
# Prefix in the names of outputs: of the body that turns with the leg, and of what belongs to each body's centre of mass.
TURNING = ("rod", "rod")
COM_OUTPUTS = {"rod": "rod_com", "mover": "mover"}
# The body that the actuator's force goes to, and the one along whose z it acts.
DRIVEN = "mover"


def bodies(parameters, i):
    """Bodies with mass of one leg, by kind."""
    return {
        "mover": Body(parameters["mover_mass"][i], along_z(-parameters["mover_offset"][i]), np.zeros((3, 3))),
        "rod": Body(
            parameters["rod_mass"][i],
            along_z(parameters["rod_com_fraction"][i] * parameters["rod_length"][i]),
            slender(parameters["rod_inertia"][i]),
        ),
    }


def points(parameters, i):
    """Where the Hooke joint is, and what is closed onto the platform point."""
    return {
        "hooke": Point(f"rod_{i}", np.zeros(3)),
        "leg_end": Point(f"rod_{i}", along_z(parameters["rod_length"][i])),
    }


def mounts(parameters, legs):
    """[6] axes z of the first joints, B coordinates. `legs`: [6][3] from base to platform points."""
    return [axis / np.linalg.norm(axis) for axis in parameters["actuator_axis"]]


def least_slides(parameters):
    """[6] d where the leg lies along its mount, less the distance of its end from the base point."""
    return -parameters["rod_length"]


def scales(parameters):
    """A displacement [m] to measure others by, and the legs' mass [kg]."""
    return np.max(parameters["rod_length"]), np.sum(parameters["rod_mass"]) + np.sum(parameters["mover_mass"])


def reach(parameters, legs, home_legs):
    """[6] u.a of every leg: 1 along the actuator, 0 perpendicular to it, negative beyond the rod's reach."""
    across = np.linalg.norm(np.cross(parameters["actuator_axis"], legs), axis=1)
    squares = 1.0 - (across / parameters["rod_length"]) ** 2
    return np.sign(squares) * np.sqrt(np.abs(squares))


def step(parameters, home_legs):
    """Displacement [m] by which the workspace is searched."""
    return np.min(parameters["rod_length"])
