"""The classical Gough-Stewart leg as bodies and joints: base -> lower (Hooke) -> upper (prismatic) -> payload (closed
numerically).

Body frames
    lower_i     origin at the base joint b_i, z along the leg
    upper_i     origin at the leg's end, z along the leg; equal to lower_i's frame at d = 0
The prismatic coordinate d is the distance of the leg's end from the base joint.
"""

import numpy as np

from description import Body, Link, Point, along_z, slender

PARAMETERS = {
    "base_point": (6, 3),
    "platform_point": (6, 3),
    "lower_mass": (6,),
    "lower_com_distance": (6,),
    "lower_inertia": (6,),
    "upper_mass": (6,),
    "upper_com_distance": (6,),
    "upper_inertia": (6,),
    "rest_length": (6,),
    "axial_stiffness": (6,),
    "axial_damping": (6,),
}
LINKS = (Link("lower", "base", "hooke"), Link("upper", "lower", "slide"))
TURNING = ("lower", "leg")
COM_OUTPUTS = {"lower": "lower_com", "upper": "upper_com"}
DRIVEN = "upper"

# The Hooke joints are mounted oblique to the legs, so that their angles are not small [rad].
MOUNT_TILT = 0.5
# Change of length, as a fraction of the length at home, at the end of the workspace.
STROKE = 0.6


def bodies(parameters, i):
    """Bodies with mass of one leg, by kind."""
    return {
        part: Body(
            parameters[f"{part}_mass"][i],
            along_z(sign * parameters[f"{part}_com_distance"][i]),
            slender(parameters[f"{part}_inertia"][i]),
        )
        for part, sign in (("lower", 1.0), ("upper", -1.0))
    }


def points(parameters, i):
    """Where the Hooke joint is, and what is closed onto the platform point."""
    return {"hooke": Point(f"lower_{i}", np.zeros(3)), "leg_end": Point(f"upper_{i}", np.zeros(3))}


def mounts(parameters, legs):
    """[6] axes z of the first joints, B coordinates: the legs, tilted. `legs`: [6][3] from base to platform points."""
    axes = []
    for leg in legs:
        along = leg / np.linalg.norm(leg)
        across = np.cross(along, np.eye(3)[np.argmin(np.abs(along))])
        axes.append(np.cos(MOUNT_TILT) * along + np.sin(MOUNT_TILT) * across / np.linalg.norm(across))
    return axes


def least_slides(parameters):
    """[6] d where the leg lies along its mount, less the distance of its end from the base point."""
    return np.zeros(6)


def scales(parameters):
    """A displacement [m] to measure others by, and the legs' mass [kg]."""
    return np.max(parameters["rest_length"]), np.sum(parameters["lower_mass"]) + np.sum(parameters["upper_mass"])


def reach(parameters, legs, home_legs):
    """[6] what stands for u.a of the paper's legs: 1 at the length at home, 0 at the end of a stroke, negative beyond."""
    change = np.linalg.norm(legs, axis=1) / np.linalg.norm(home_legs, axis=1) - 1.0
    squares = 1.0 - (change / STROKE) ** 2
    return np.sign(squares) * np.sqrt(np.abs(squares))


def step(parameters, home_legs):
    """Displacement [m] by which the workspace is searched."""
    return STROKE * np.min(np.linalg.norm(home_legs, axis=1))
