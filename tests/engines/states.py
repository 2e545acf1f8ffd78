"""Seeded states over the workspace.

Families, in turn (`FAMILIES`):
    home        near home, moderate rates, base nearly level
    workspace   random reachable poses, moderate rates
    large       base turned by up to 1.2 rad, metres and radians per second, per second squared
    edge        pushed along a random line until the worst leg has u.a = 0.1 ... 0.25

Only sampling uses the reach of a leg: the distance of the platform joint from the actuator's line against
the rod length (UHP), the change of length against a stroke (UPS). At u.a = 0.1 accelerations grow like (u.a)^-3 and rounding with them; closer to the edge the
engines' common figure would measure rounding, not agreement. Likewise, states with cond(J) above 1e3 (moments
divided by the joint circle's radius, so that forces and moments compare) are drawn again: the 6x6 solve costs
the actuator forces that factor.
"""

import numpy as np

from description import Pose
from leg_types import leg_type_and_parameters
from outputs import Motion, State

FAMILIES = ("home", "workspace", "large", "edge", "workspace", "large", "edge", "home", "large", "workspace")
LEAST_ALIGNMENT = 0.1
LARGEST_CONDITION = 1e3
DRAWS = 2000


class SamplingError(Exception):
    """No acceptable state was found."""


class Sampler:
    def __init__(self, platform, seed):
        # The seed belongs to the platform's name, so that other platforms on the command line change nothing.
        self.random = np.random.default_rng([seed, *platform["name"].encode()])
        self.name = platform["name"]
        self.leg_type, self.parameters = leg_type_and_parameters(platform)
        self.home = Pose(*(np.asarray(platform["home"][key]) for key in ("position", "rotation")))
        self.radius = np.linalg.norm(self.parameters["platform_point"], axis=1).max()
        self.home_legs = self._legs(self.home)
        self.reach = self.leg_type.step(self.parameters, self.home_legs)
        self.force = self.parameters["payload_mass"] * 10.0
        if self._least_alignment(self.home) < LEAST_ALIGNMENT:
            raise SamplingError(f"{self.name}: home is beyond a leg's reach, or nearly")

    def candidates(self, count):
        """Yields `count` times (family, draw); `draw()` gives a fresh state each time it is called."""
        for index in range(count):
            family = FAMILIES[index % len(FAMILIES)]
            yield family, getattr(self, f"_{family}")

    def _home(self):
        for _ in range(DRAWS):
            pose = self._offset(self._direction(), 0.02)
            if self._least_alignment(pose) > LEAST_ALIGNMENT:
                break
        return self._state(pose, base_turn=0.1, rate=0.3, rate_rate=2.0)

    def _workspace(self):
        return self._state(self._reachable(), base_turn=0.6, rate=1.0, rate_rate=5.0)

    def _large(self):
        return self._state(self._reachable(), base_turn=1.2, rate=4.0, rate_rate=8.0)

    def _edge(self):
        target = self.random.uniform(LEAST_ALIGNMENT, 0.25)
        direction, near, far = self._direction(), 0.0, 1.0
        while self._least_alignment(self._offset(direction, far)) > target:
            far *= 2.0
        for _ in range(60):
            middle = 0.5 * (near + far)
            if self._least_alignment(self._offset(direction, middle)) > target:
                near = middle
            else:
                far = middle
        return self._state(self._offset(direction, near), base_turn=0.8, rate=1.0, rate_rate=5.0)

    def _reachable(self):
        """A pose relative to the base with every leg at u.a > 0.3 (or as good as home allows)."""
        enough = min(0.3, 0.9 * self._least_alignment(self.home))
        for _ in range(DRAWS):
            pose = self._offset(self._direction(), self.random.uniform(0.1, 0.8))
            if self._least_alignment(pose) > enough:
                return pose
        raise SamplingError(f"{self.name}: no reachable pose around home")

    def _direction(self):
        """[6] a random direction: displacement over the workspace's step, rotation vector."""
        direction = self.random.standard_normal(6)
        return direction / np.linalg.norm(direction)

    def _offset(self, direction, amount):
        turn = rotation(amount * direction[3:])
        return Pose(self.home.position + amount * self.reach * direction[:3], turn @ self.home.rotation)

    def _least_alignment(self, pose):
        """Least u.a of the legs, or what stands for it in this leg type; negative beyond reach."""
        return float(np.min(self.leg_type.reach(self.parameters, self._legs(pose), self.home_legs)))

    def _legs(self, pose):
        """[6][3] from base points to platform points, B coordinates."""
        p = self.parameters
        return pose.position + p["platform_point"] @ pose.rotation.T - p["base_point"]

    def _state(self, pose, base_turn, rate, rate_rate):
        random = self.random
        turn = rotation(base_turn * random.uniform(0.3, 1.0) * self._unit())
        base = Pose(random.uniform(-0.5, 0.5, 3), turn)
        platform = Pose(base.position + turn @ pose.position, turn @ pose.rotation)
        motions = [
            Motion(moving, rate * random.uniform(-1.0, 1.0, 6), rate_rate * random.uniform(-1.0, 1.0, 6))
            for moving in (base, platform)
        ]
        actuator_force = self.force * random.uniform(-1.0, 1.0, 6)
        lever = np.repeat([1.0, self.radius], 3)
        return State(*motions, actuator_force, self.force * lever * random.uniform(-0.5, 0.5, 6))

    def _unit(self):
        direction = self.random.standard_normal(3)
        return direction / np.linalg.norm(direction)


def rotation(vector):
    """Rotation matrix of a rotation vector [rad] (Rodrigues)."""
    angle = np.linalg.norm(vector)
    x, y, z = vector / max(angle, 1e-300)
    turn = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.eye(3) + np.sin(angle) * turn + (1.0 - np.cos(angle)) * turn @ turn


def well_conditioned(outputs, radius):
    """Whether cond(J), moments over the joint circle's radius, is small enough for the stated agreement."""
    scaled = outputs["jacobian_dp"] / np.repeat([1.0, radius], 3)
    return np.linalg.cond(scaled) < LARGEST_CONDITION
