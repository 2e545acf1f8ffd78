"""The state at the start: positions that close the mechanism, consistent velocities and accelerations.

Positions come from Newton's method on Exudyn's constraint residuals, from a guess that only has to lie on the right
branch (Hooke joint below the platform joint). Velocities and accelerations solve Exudyn's own linear equations.

Exudyn's solver can compute initial accelerations too, but leaves out those that a prescribed motion imposes
("initial accelerations that are following from user functions in constraints are not considered"), and the trapezoidal
rule keeps such an error for ever, with alternating sign: 21 % of the largest angular acceleration in the large
experiment. So the accelerations are solved here, from Exudyn's M, C_q and f, and handed over.
"""

from dataclasses import dataclass

import numpy as np

from .equations import Equations
from .mechanism import LEGS, Mechanism, Placement, Pose

CLOSED = 1e-12  # m and 1: what Exudyn may report as residual
ITERATIONS = 100
TIME_DIFFERENCE = 2e-5  # s, for the velocity terms of the constraints' second derivatives


class CannotClose(Exception):
    """No position of the legs joins base and platform."""


@dataclass(frozen=True)
class Start:
    """The closed mechanism, its state, and Exudyn's largest constraint residual there."""

    mechanism: Mechanism
    coordinates: np.ndarray
    rates: np.ndarray
    accelerations: np.ndarray
    closure_residual: float


def guess(parameters, base, platform):
    """Movers somewhat below the platform joints, rods pointing there: a start for Newton's method."""
    movers, rods = [], []
    for i in LEGS:
        joint = platform.position + platform.rotation @ parameters["platform_point"][i]
        foot = base.position + base.rotation @ parameters["base_point"][i]
        z = base.rotation @ parameters["actuator_axis"][i]
        z = z / np.linalg.norm(z)
        across = joint - foot - z * (z @ (joint - foot))
        reach = np.linalg.norm(across)
        if reach > parameters["rod_length"][i]:
            raise CannotClose(
                f"leg {i + 1} is out of reach at the start: its platform joint is {reach:.6g} m from the actuator's "
                f"axis, its rod {parameters['rod_length'][i]:.6g} m long"
            )
        if reach < 1e-9 * parameters["rod_length"][i]:
            across = np.cross(z, np.eye(3)[np.argmin(np.abs(z))])
        y = across / np.linalg.norm(across)
        mover = np.column_stack([np.cross(y, z), y, z])
        hooke = joint - reach * y - 0.7 * parameters["rod_length"][i] * z
        along = (joint - hooke) / np.linalg.norm(joint - hooke)
        movers.append(Pose(hooke, mover))
        rods.append(Pose(hooke, np.column_stack([mover[:, 0], np.cross(along, mover[:, 0]), along])))
    return Placement(base, platform, movers, rods)


def close(mechanism, equations):
    """Coordinates [n] that bring every constraint to zero with base and platform held where they are."""
    held = np.zeros(equations.size, dtype=bool)
    for body in (mechanism.base, mechanism.platform):
        held[mechanism.coordinates_of(body)] = True
    coordinates, rates = np.zeros(equations.size), np.zeros(equations.size)

    def gap(values):
        equations.set_state(values, rates)
        return equations.residual()

    here = gap(coordinates)
    for _ in range(ITERATIONS):
        step = np.zeros(equations.size)
        step[~held] = np.linalg.lstsq(equations.jacobian()[:, ~held], -here, rcond=None)[0]
        scale = 1.0
        while np.linalg.norm(gap(coordinates + scale * step)) >= np.linalg.norm(here) and scale > 1e-9:
            scale /= 2.0
        if scale <= 1e-9:  # no step improves: closed to rounding, or stuck
            break
        coordinates = coordinates + scale * step
        here = gap(coordinates)
    gap(coordinates)
    return coordinates


def start(parameters, base, platform, platform_velocity, gravity, guide_rates, guide_accelerations, forces):
    """State at the start.

    `base`, `platform`: poses; `platform_velocity`: [6] [r'; w], O. `guide_rates`, `guide_accelerations`: [6] first and
    second derivatives of the base's coordinates (guide.py). `forces`: [6] N.
    """
    guessed = Mechanism(parameters, guess(parameters, base, platform), gravity)
    close(guessed, Equations(guessed.system))
    closed = Placement(
        base,
        platform,
        [body.present_pose() for body in guessed.movers],
        [body.present_pose() for body in guessed.rods],
    )
    mechanism = Mechanism(parameters, closed, gravity)
    mechanism.set_base_rates(guide_rates)
    mechanism.set_actuator_forces(forces)
    equations = Equations(mechanism.system)
    coordinates = close(mechanism, equations)

    jacobian = equations.jacobian()
    constrained = np.any(jacobian != 0.0, axis=1)
    jacobian = jacobian[constrained]
    rates = _consistent_rates(mechanism, jacobian, guide_rates, platform_velocity)
    equations.set_state(coordinates, rates)
    residual = max(np.abs(equations.residual()).max(), np.abs(equations.residual(velocity_level=True)).max())
    if not residual < CLOSED:
        raise CannotClose(f"the mechanism does not close at the start: Exudyn's constraint residual is {residual:.3g}")
    accelerations = _consistent_accelerations(
        mechanism, equations, jacobian, constrained, coordinates, rates, guide_accelerations
    )
    equations.set_state(coordinates, rates)
    return Start(mechanism, coordinates, rates, accelerations, float(residual))


def _consistent_rates(mechanism, jacobian, guide_rates, platform_velocity):
    """Rotation coordinates are zero at the start, where their rates are the angular velocity."""
    rates = np.zeros(jacobian.shape[1])
    free = np.ones(rates.size, dtype=bool)
    for body, given in ((mechanism.base, guide_rates), (mechanism.platform, platform_velocity)):
        rates[mechanism.coordinates_of(body)] = given
        free[mechanism.coordinates_of(body)] = False
    joints = np.any(jacobian[:, free] != 0.0, axis=1)  # without the base's guide
    rates[free] = np.linalg.solve(jacobian[joints][:, free], -jacobian[joints][:, ~free] @ rates[~free])
    return rates


def _consistent_accelerations(mechanism, equations, jacobian, constrained, coordinates, rates, guide_accelerations):
    """Solves M q'' + C_q^T lambda = f with C_q q'' = -(rate of C_q) q' for joints, = the given one for the guide."""

    def constraint_rates(time):
        equations.set_state(coordinates + time * rates, rates)
        return equations.residual(velocity_level=True)[constrained]

    h = TIME_DIFFERENCE
    near, far = constraint_rates(h) - constraint_rates(-h), constraint_rates(2.0 * h) - constraint_rates(-2.0 * h)
    right = -(8.0 * near - far) / (12.0 * h)
    base = mechanism.coordinates_of(mechanism.base)
    guide = ~np.any(np.delete(jacobian, np.r_[base], axis=1) != 0.0, axis=1)
    right[guide] = jacobian[guide][:, base] @ guide_accelerations
    equations.set_state(coordinates, rates)
    count = len(right)
    matrix = np.block([[equations.mass_matrix(), jacobian.T], [jacobian, np.zeros((count, count))]])
    return np.linalg.solve(matrix, np.concatenate([equations.forces(), right]))[: coordinates.size]
