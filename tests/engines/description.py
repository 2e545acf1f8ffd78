"""The mechanism as plain data: bodies, joints and named points, for any engine to build from.

This file holds no mechanics. It says which rigid bodies there are, where each joint sits and which points
are watched; positions and rates are left to the engines. What a leg is made of is in a module per leg type
(`uhp_leg.py`, `ups_leg.py`).

Body frames
    base        frame B
    payload     frame P
    links       see the leg type's module
Joints
    world -> base, world -> payload     free
    base -> first link -> second link   prismatic along z ("slide", coordinate d), or Hooke ("hooke"): revolute
                                        about x, then about the turned y
    leg -> payload                      spherical, closed numerically (reduction.py): leg_end_i on
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


@dataclass(frozen=True)
class Link:
    """A kind of leg body, what it is joined to (a kind, or the base) and the joint between them."""

    kind: str
    parent: str
    joint: str


def along_z(distance):
    return np.array([0.0, 0.0, distance])


def slender(transverse):
    """Inertia of a body without any about its z."""
    return np.diag([transverse, transverse, 0.0])


class Description:
    """One platform with chosen mounts of the legs' first joints.

    `leg`: module of the leg type. `parameters`: the `parameters` object of a resolved platform file.
    `mounts`: [6][3] z axes of the first joints, B coordinates, unit vectors. `hooke_axes`: [6][3], first axes of the
    Hooke joints, B coordinates; only the part across the mount counts.
    """

    def __init__(self, leg, parameters, mounts, hooke_axes):
        self.leg = leg
        self.parameters = parameters
        self.mounts, self.hooke_axes = mounts, hooke_axes

    def __getitem__(self, name):
        return self.parameters[name]

    def links(self):
        """(name, name of what it is joined to, joint, rotation, position) of every link, parents first."""
        for i in LEGS:
            for link in self.leg.LINKS:
                if link.parent == "base":
                    yield i, f"{link.kind}_{i}", "base", link.joint, self.rotations[i], self["base_point"][i]
                else:
                    parent = f"{link.parent}_{i}"
                    yield i, f"{link.kind}_{i}", parent, link.joint, np.eye(3), np.zeros(3)

    @cached_property
    def rotations(self):
        """[6] rotations of the first links at zero coordinates, to B."""
        rotations = []
        for z, across in zip(self.mounts, self.hooke_axes):
            x = across - z * (z @ across)
            x = x / np.linalg.norm(x)
            rotations.append(np.column_stack([x, np.cross(z, x), z]))
        return rotations

    @cached_property
    def bodies(self):
        """Bodies with mass. The base has none: its motion is prescribed."""
        bodies = {"payload": Body(float(self["payload_mass"]), self["payload_com"], self["payload_inertia"])}
        for i in LEGS:
            for kind, body in self.leg.bodies(self.parameters, i).items():
                bodies[f"{kind}_{i}"] = body
        return bodies

    @cached_property
    def points(self):
        """Watched points; `com_NAME` is the centre of mass of a leg's body."""
        origin = np.zeros(3)
        points = {
            "base": Point("base", origin),
            "platform": Point("payload", origin),
            "com_payload": Point("payload", self["payload_com"]),
        }
        for i in LEGS:
            points[f"base_point_{i}"] = Point("base", self["base_point"][i])
            points[f"platform_point_{i}"] = Point("payload", self["platform_point"][i])
            for name, point in self.leg.points(self.parameters, i).items():
                points[f"{name}_{i}"] = point
        for name, body in self.bodies.items():
            points[f"com_{name}"] = Point(name, body.com)
        return points
