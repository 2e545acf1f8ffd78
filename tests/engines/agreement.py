"""What must hold before a state becomes a test vector, each limit with its reason.

An array's difference is its largest absolute difference over its scale: its largest entry in either engine,
or the size of what it is a small difference of (`cancelling_scales`). An array is one quantity with one
unit, except the 6-vectors and 6x6 matrices, whose forces and moments (or metres and radians) are of like
size for decimetre platforms.
"""

from dataclasses import dataclass

import numpy as np

# Two engines, same array, where vectors are written or checked.
ENGINES_LIMIT = 1e-12
# The same over thousands of fresh states: some meet unlucky rounding at the edge, growing like (u.a)^-3.
LONG_RUN_LIMIT = 1e-11
# Loop closure, residual over the largest coordinate: a few units in the last place.
CLOSURE_LIMIT = 2e-15
# Pinocchio's own constrained forward dynamics against the reduced equations, over the largest acceleration.
CONSTRAINED_LIMIT = 1e-12
# Rate of the momentum that Pinocchio sums over the bodies against the virtual power of the base's speeds.
MOMENTUM_LIMIT = 1e-12
# Committed vectors against a fresh run elsewhere: other processors and numpy builds round differently.
CHECK_LIMIT = 1e-11


class Disagreement(Exception):
    """Two results that must agree do not."""


@dataclass(frozen=True)
class Figure:
    """A relative difference and where it occurred."""

    value: float
    where: str

    def __str__(self):
        return f"{self.value:.2g} ({self.where})"


def cancelling_scales(leg_type, parameters, outputs):
    """Least scale of the arrays that can cancel to nothing: {name: scale}.

    A spring near its rest length: its force counts as if stretched by a hundredth of the leg's length.
    Potential energy near the height zero: it counts as if the whole weight stood one metre up, the size of
    the coordinates.
    """
    length, mass_of_legs = leg_type.scales(parameters)
    stiff = np.max(parameters["axial_stiffness"])
    stretched = stiff * 0.01 * length
    carried = stretched * np.abs(outputs["jacobian_dp"]).max()
    mass = parameters["payload_mass"] + mass_of_legs
    return {
        "spring_force": carried,
        "bias": carried,
        f"{leg_type.DRIVEN}_active_force": carried,
        "inverse_dynamics": stretched,
        "forward_dynamics": carried * np.abs(np.linalg.inv(outputs["mass_matrix_p"])).max(),
        "potential_energy": mass * np.linalg.norm(parameters["gravity"]),
    }


def relative_difference(first, second, least_scale=0.0):
    scale = max(np.abs(first).max(), np.abs(second).max(), least_scale)
    difference = np.abs(first - second).max()
    # A NaN difference must not pass for zero: hence the comparison with the difference, not with the scale.
    return 0.0 if difference == 0.0 else float(difference / scale)


def require(name, value, limit, where):
    """`not <=` so that a NaN fails too."""
    if not value <= limit:
        raise Disagreement(f"{where}: {name}: {value:.3g} exceeds {limit:g}")
    return Figure(value, f"{where}, {name}")


def worst(figures):
    return max(figures, key=lambda figure: figure.value)


def compare(first, second, limit, where, scales=None):
    """All arrays of one state by name, from two sources; returns the worst figure.

    `scales`: least scales by name.
    """
    scales = scales or {}
    if first.keys() != second.keys():
        raise Disagreement(f"{where}: only one side has {sorted(first.keys() ^ second.keys())}")
    differences = {
        name: relative_difference(first[name], second[name], scales.get(name, 0.0)) for name in first
    }
    return worst([require(name, difference, limit, where) for name, difference in differences.items()])


def self_checks(solution, outputs, where):
    """Pinocchio's solution against other routines of Pinocchio; returns the worst figure.

    Leaves the mechanism with a heavy base: call it last.
    """
    return worst([_momentum(solution, outputs, where), _constrained_dynamics(solution, outputs, where)])


def _momentum(solution, outputs, where):
    """Newton and Euler for the whole mechanism: momentum rate = base wrench + gravity + external wrench."""
    m, state, about = solution.mechanism, solution.state, solution.state.base.pose.position
    wrench = outputs["base_wrench"] + _moved(state.external_wrench, outputs["payload_com_position"] - about)
    for name, body in m.description.bodies.items():
        weight = np.concatenate([body.mass * m.description["gravity"], np.zeros(3)])
        wrench = wrench + _moved(weight, m.position(f"com_{name}") - about)
    rate = m.momentum_rate(solution.acceleration, about)
    return require("momentum rate", relative_difference(rate, wrench), MOMENTUM_LIMIT, where)


def _moved(wrench, arm):
    return np.concatenate([wrench[:3], wrench[3:] + np.cross(arm, wrench[:3])])


def _constrained_dynamics(solution, outputs, where):
    """The engine's own forward dynamics of the closed loops, base free with an arbitrary inertia.

    The base's force is chosen so that the reduced equations give the state's v_b'; v_p' must then be theirs,
    and v_b' the state's.
    """
    m, state, reduction = solution.mechanism, solution.state, solution.reduction
    forces = m.wrench_forces("com_payload", state.external_wrench) + m.spring_forces() + m.damping_forces()
    forces[m.slide_speeds] += state.actuator_force
    # The massless base would leave the joint-space mass matrix singular wherever slides can undo its motion.
    m.set_base_inertia(10.0, 1.0)
    m.move(reduction.speeds)
    expected = np.concatenate([outputs["forward_dynamics"], state.base.acceleration])
    acceleration = reduction.acceleration(state.base.acceleration, outputs["forward_dynamics"])
    drive = reduction.base_basis.T @ (m.joint_forces(acceleration, gravity=True) - forces)
    m.accelerate(m.constrained_acceleration(forces + m.wrench_forces("base", drive)))
    found = np.concatenate([m.acceleration("platform"), m.acceleration("base")])
    difference = relative_difference(found, expected)
    return require("constrained forward dynamics", difference, CONSTRAINED_LIMIT, where)
