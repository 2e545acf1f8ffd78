"""Loop closure and the map to the platform's and the base's speeds, both found numerically on an engine.

Nothing here knows the leg's kinematics. Positions, Jacobians and accelerations come from the engine; the
closure is Newton's method on them, the speeds are the null space of the closure rates.
"""

import numpy as np

from description import LEGS

CONTINUATION = np.linspace(0.0, 1.0, 9)
NEWTON_STEPS = 40


class ClosureError(Exception):
    """The legs cannot be closed at this pose."""


def close_loops(mechanism, base, payload):
    """Places the mechanism with every leg's end on its platform point; returns the largest residual.

    The residual counts in the largest coordinate, at least 1 m: rounding of coordinates bounds it.

    Branch: the leg's end above the Hooke joint along the mount of the first joint (UHP: the actuator axis). Newton
    starts with each leg along its mount, aimed at the platform point's foot on that axis; the aim then moves to the
    point itself in steps. A leg never turns past perpendicular on the way, so the branch is kept.
    """
    legs = np.zeros((6, 3))
    mechanism.place(base, payload, legs)
    targets = stack(mechanism.position, "platform_point_{}")
    starts = stack(mechanism.position, "base_point_{}")
    axes = np.array([base.rotation @ mount for mount in mechanism.description.mounts])
    along = np.sum(axes * (targets - starts), axis=1)
    across = targets - starts - along[:, None] * axes
    legs[:, 0] = along + mechanism.description.leg.least_slides(mechanism.description.parameters)
    scale = max(1.0, np.abs(targets).max())
    for share in CONTINUATION:
        residual = _newton(mechanism, base, payload, legs, targets - (1.0 - share) * across)
        if residual > 1e-14 * scale:
            raise ClosureError(f"the loops do not close: {residual:.3g} m are left")
    above = stack(mechanism.position, "leg_end_{}") - stack(mechanism.position, "hooke_{}")
    if np.any(np.sum(above * axes, axis=1) <= 0.0):
        raise ClosureError("a Hooke joint lies above its platform joint")
    return residual / scale


def _newton(mechanism, base, payload, legs, targets):
    """Moves `legs` until the legs' ends meet their targets as rounding allows; returns the residual [m]."""
    columns = mechanism.leg_speeds
    best, best_legs = np.inf, legs.copy()
    for _ in range(NEWTON_STEPS):
        mechanism.place(base, payload, legs)
        error = stack(mechanism.position, "leg_end_{}") - targets
        size = np.abs(error).max()
        if size >= best and best < 1e-13:
            break
        best, best_legs = size, legs.copy()
        rates = np.vstack([mechanism.jacobian(f"leg_end_{i}")[:3, columns] for i in LEGS])
        step = np.linalg.solve(rates, error.ravel()).reshape(6, 3)
        # A step of less than half a radian cannot jump to another branch.
        legs -= step * min(1.0, 0.5 / max(np.abs(step[:, 1:]).max(), 1e-300))
    legs[:] = best_legs
    mechanism.place(base, payload, legs)
    return best


class Reduction:
    """The closed mechanism's twelve free speeds: v_b = [r_b'; w_b] and v_p = [r_p'; w_p], in O.

    `base_basis`, `platform_basis`: [nv][6] joint speeds per unit of v_b, v_p (the null space of the closure
    rates, normalised on the engine's own velocities of the base's and the platform's origin).
    `drift`: [nv] joint acceleration at v_b' = v_p' = 0.
    """

    def __init__(self, mechanism, base_velocity, platform_velocity):
        rates = self._rows(mechanism.jacobian)
        basis = np.linalg.solve(rates, np.eye(mechanism.speed_count)[:, :12])
        self.base_basis, self.platform_basis = basis[:, :6], basis[:, 6:]
        self.speeds = basis @ np.concatenate([base_velocity, platform_velocity])
        mechanism.move(self.speeds)
        self.drift = np.linalg.solve(rates, -self._rows(mechanism.acceleration))

    @staticmethod
    def _rows(motion):
        closures = [motion(f"leg_end_{i}")[:3] - motion(f"platform_point_{i}")[:3] for i in LEGS]
        return np.concatenate([motion("base"), motion("platform"), *closures])

    def acceleration(self, base_acceleration, platform_acceleration):
        """[nv] joint acceleration for the given v_b', v_p'."""
        return self.base_basis @ base_acceleration + self.platform_basis @ platform_acceleration + self.drift


def stack(query, pattern):
    """[6][...] of a query per leg; `pattern` names the point with {} for the leg's number."""
    return np.array([query(pattern.format(i)) for i in LEGS])
