"""The mechanism as plain data: bodies, joints and named points, for any engine to build from.

This file holds no mechanics. It says which rigid bodies there are, where each joint sits and which points
are watched; positions and rates are left to the engines.

Body frames
    base        frame B
    payload     frame P
    mover_i     origin at the Hooke joint, z along the actuator axis, x along the Hooke joint's first axis
    rod_i       origin at the Hooke joint; equal to mover_i's frame at zero Hooke angles, z along the rod
Joints
    world -> base, world -> payload     free
    base -> mover_i                     prismatic along mover z; coordinate d: the Hooke joint's way from b_i
    mover_i -> rod_i                    Hooke: revolute about x, then about the turned y
    rod_i -> payload                    spherical, closed numerically (reduction.py): rod_end_i on
                                        platform_point_i
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

LEGS = range(6)


@dataclass(frozen=True)
class Pose:
    """Position [m] and rotation matrix, body to inertial frame O."""

    position: np.ndarray
    rotation: np.ndarray


@dataclass(frozen=True)
class Body:
    """Mass [kg], centre of mass [m] and inertia about it [kg m^2], in the body's frame."""

    mass: float
    com: np.ndarray
    inertia: np.ndarray


@dataclass(frozen=True)
class Point:
    """A point fixed to a body, position [m] in the body's frame."""

    body: str
    position: np.ndarray


class Description:
    """One platform with a chosen first axis for each Hooke joint.

    `parameters`: the `parameters` object of a resolved platform file.
    `hooke_axes`: [6][3], B coordinates; only the part across the actuator axis counts.
    """

    def __init__(self, parameters, hooke_axes):
        self.parameters = {name: np.asarray(value, dtype=float) for name, value in parameters.items()}
        self.hooke_axes = np.asarray(hooke_axes, dtype=float)

    def __getitem__(self, name):
        return self.parameters[name]

    @cached_property
    def mover_rotations(self):
        """[6] rotations, mover frame to B."""
        rotations = []
        for axis, across in zip(self["actuator_axis"], self.hooke_axes):
            z = axis / np.linalg.norm(axis)
            x = across - z * (z @ across)
            x = x / np.linalg.norm(x)
            rotations.append(np.column_stack([x, np.cross(z, x), z]))
        return rotations

    @cached_property
    def bodies(self):
        """Bodies with mass. The base has none: its motion is prescribed."""
        bodies = {"payload": Body(float(self["payload_mass"]), self["payload_com"], self["payload_inertia"])}
        for i in LEGS:
            bodies[f"mover_{i}"] = Body(self["mover_mass"][i], self.mover_com(i), np.zeros((3, 3)))
            transverse = self["rod_inertia"][i]
            bodies[f"rod_{i}"] = Body(
                self["rod_mass"][i], self.rod_com(i), np.diag([transverse, transverse, 0.0])
            )
        return bodies

    @cached_property
    def points(self):
        origin = np.zeros(3)
        points = {
            "base": Point("base", origin),
            "platform": Point("payload", origin),
            "payload_com": Point("payload", self["payload_com"]),
        }
        for i in LEGS:
            points[f"base_point_{i}"] = Point("base", self["base_point"][i])
            points[f"mover_{i}"] = Point(f"mover_{i}", self.mover_com(i))
            points[f"hooke_{i}"] = Point(f"rod_{i}", origin)
            points[f"rod_com_{i}"] = Point(f"rod_{i}", self.rod_com(i))
            points[f"rod_end_{i}"] = Point(f"rod_{i}", np.array([0.0, 0.0, self["rod_length"][i]]))
            points[f"platform_point_{i}"] = Point("payload", self["platform_point"][i])
        return points

    def mover_com(self, i):
        return np.array([0.0, 0.0, -self["mover_offset"][i]])

    def rod_com(self, i):
        return np.array([0.0, 0.0, self["rod_com_fraction"][i] * self["rod_length"][i]])
