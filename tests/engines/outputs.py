"""Every published array of one state, from one engine.

README.md lists names, shapes and frames. The only mechanics here are the reduction of the engine's
joint-space quantities by the null space, and `without_spin`.
"""

from dataclasses import dataclass

import numpy as np

from description import LEGS, Description, Pose
from reduction import Reduction, close_loops, stack


@dataclass(frozen=True)
class Motion:
    """Pose, velocity [r'; w] and acceleration [r''; w'] of the base or the platform, in O."""

    pose: Pose
    velocity: np.ndarray
    acceleration: np.ndarray


@dataclass(frozen=True)
class State:
    base: Motion
    platform: Motion
    actuator_force: np.ndarray
    external_wrench: np.ndarray


def hooke_axes(parameters, state, turn):
    """[6][3] first Hooke axes in B, far from the joint's singularity (rod along the first axis).

    Across actuator axis and leg, so that the rod moves in the plane normal to it; then turned about the
    actuator axis by `turn` [rad]. With a spinless rod the choice has no effect: the engines get different
    turns.
    """
    base, platform = state.base.pose, state.platform.pose
    axes = []
    names = ("actuator_axis", "base_point", "platform_point")
    for axis, start, end in zip(*(np.asarray(parameters[name]) for name in names)):
        leg = base.rotation.T @ (platform.position + platform.rotation @ end - base.position) - start
        across = np.cross(axis, leg)
        if np.linalg.norm(across) < 1e-6 * np.linalg.norm(leg):
            across = np.cross(axis, np.eye(3)[np.argmin(np.abs(axis))])
        axes.append(np.cos(turn) * across + np.sin(turn) * np.cross(axis, across))
    return axes


class Solution:
    """One engine's mechanism at one state."""

    def __init__(self, engine, parameters, state, turn):
        self.state = state
        self.mechanism = engine(Description(parameters, hooke_axes(parameters, state, turn)))
        self.residual = close_loops(self.mechanism, state.base.pose, state.platform.pose)
        self.reduction = Reduction(self.mechanism, state.base.velocity, state.platform.velocity)
        self.acceleration = self.reduction.acceleration(state.base.acceleration, state.platform.acceleration)

    def outputs(self):
        """All arrays by name; kinematics first, since force routines overwrite the engines' accelerations."""
        self.mechanism.accelerate(self.acceleration)
        result = {**self.kinematics(), **self.partial_velocities(), **self.matrices(), **self.forces()}
        result.update(self.generalised_forces())
        return result

    def kinematics(self):
        m, slides = self.mechanism, self.mechanism.slide_speeds
        direction = np.array([m.rotation(f"rod_com_{i}")[:, 2] for i in LEGS])
        axis = np.array([m.rotation(f"mover_{i}")[:, 2] for i in LEGS])
        spinning = stack(m.velocity, "rod_com_{}")[:, 3:]
        spinning_rate = stack(m.acceleration, "rod_com_{}")[:, 3:]
        rod_rate = without_spin(direction, spinning)
        spin = np.sum(spinning * direction, axis=1, keepdims=True)
        # Derivative of w - (w.u)u, with u' = w x u, hence w.u' = 0.
        rod_rate_rate = without_spin(direction, spinning_rate) - spin * np.cross(spinning, direction)
        return {
            "actuator_length": m.slides(),
            "actuator_velocity": self.reduction.speeds[slides],
            "actuator_acceleration": self.acceleration[slides],
            "rod_alignment": np.sum(direction * axis, axis=1) ** 2,
            "rod_direction": direction,
            "hooke_joint_position": stack(m.position, "hooke_{}"),
            "platform_joint_position": stack(m.position, "platform_point_{}"),
            "universal_joint_rate": m.velocity("platform")[3:] - rod_rate,
            "rod_angular_velocity": rod_rate,
            "rod_angular_acceleration": rod_rate_rate,
            "rod_com_position": stack(m.position, "rod_com_{}"),
            "rod_com_velocity": stack(m.velocity, "rod_com_{}")[:, :3],
            "rod_com_acceleration": stack(m.acceleration, "rod_com_{}")[:, :3],
            "mover_position": stack(m.position, "mover_{}"),
            "mover_velocity": stack(m.velocity, "mover_{}")[:, :3],
            "mover_acceleration": stack(m.acceleration, "mover_{}")[:, :3],
            "payload_com_position": m.position("payload_com"),
            "payload_com_velocity": m.velocity("payload_com")[:3],
            "payload_com_acceleration": m.acceleration("payload_com")[:3],
        }

    def partial_velocities(self):
        m, basis = self.mechanism, self.reduction.platform_basis
        payload = m.jacobian("payload_com") @ basis
        rods = stack(m.jacobian, "rod_com_{}") @ basis
        direction = np.array([m.rotation(f"rod_com_{i}")[:, 2] for i in LEGS])
        # Each column is an angular velocity: the same projection as for the rod's.
        turning = np.stack([without_spin(direction, rods[:, 3:, k]) for k in range(6)], axis=2)
        return {
            "payload_partial_velocity": payload[:3],
            "payload_partial_angular_velocity": payload[3:],
            "rod_partial_velocity": rods[:, :3],
            "rod_partial_angular_velocity": turning,
            "mover_partial_velocity": stack(m.jacobian, "mover_{}")[:, :3] @ basis,
        }

    def matrices(self):
        m, slides = self.mechanism, self.mechanism.slide_speeds
        of_base, of_platform = self.reduction.base_basis, self.reduction.platform_basis
        mass, stiffness = m.mass_matrix(), m.description["axial_stiffness"][:, None]
        slide_p, slide_b = of_platform[slides], -of_base[slides]
        return {
            "mass_matrix_p": of_platform.T @ mass @ of_platform,
            "mass_matrix_b": -of_platform.T @ mass @ of_base,
            "jacobian_dp": slide_p,
            "jacobian_db": slide_b,
            "stiffness_matrix_p": slide_p.T @ (stiffness * slide_p),
            "stiffness_matrix_b": slide_p.T @ (stiffness * slide_b),
        }

    def forces(self):
        m, state, basis = self.mechanism, self.state, self.reduction.platform_basis
        springs, dampers = m.spring_forces(), m.damping_forces()
        external = m.wrench_forces("payload_com", state.external_wrench)
        drift = m.joint_forces(self.reduction.drift, gravity=True)
        needed = m.joint_forces(self.acceleration, gravity=True)
        bias = basis.T @ (drift - springs - dampers)
        joint_mass, slide_p = m.mass_matrix(), basis[m.slide_speeds]
        base_drive = joint_mass @ (self.reduction.base_basis @ state.base.acceleration)
        drive = slide_p.T @ state.actuator_force + basis.T @ (external - base_drive)
        return {
            "gravity_force": basis.T @ m.gravity_forces(),
            "spring_force": -basis.T @ springs,
            "damping_force": -basis.T @ dampers,
            "bias": bias,
            "inverse_dynamics": np.linalg.solve(slide_p.T, basis.T @ (needed - springs - dampers - external)),
            "forward_dynamics": np.linalg.solve(basis.T @ joint_mass @ basis, drive - bias),
            "base_wrench": self.base_wrench(needed, external),
            "kinetic_energy": np.array(m.kinetic_energy()),
            "potential_energy": np.array(m.potential_energy()),
        }

    def base_wrench(self, needed, external):
        """[6] whole wrench of the base on the mechanism, moments about r_b, at the state's accelerations.

        Virtual power of the base's speeds at fixed platform speeds; the slides' own share of it is given
        back, because their forces also act between base and mover.
        """
        m, of_base, of_platform = self.mechanism, self.reduction.base_basis, self.reduction.platform_basis
        slides = m.slide_speeds
        sliding = np.linalg.solve(of_platform[slides].T, of_platform.T @ (needed - external))
        return of_base.T @ (needed - external) - of_base[slides].T @ sliding

    def generalised_forces(self):
        """Per body, with every other body massless: the engine's own equations for that body alone."""
        m, state, basis = self.mechanism, self.state, self.reduction.platform_basis
        active, inertia = {}, {}
        for body in m.description.bodies:
            m.set_massive([body])
            m.move(self.reduction.speeds)
            active[body] = -basis.T @ m.gravity_forces()
            inertia[body] = -basis.T @ m.joint_forces(self.acceleration, gravity=False)
        m.set_massive(m.description.bodies)
        m.move(self.reduction.speeds)
        active["payload"] += basis.T @ m.wrench_forces("payload_com", state.external_wrench)
        passive = m.spring_forces() + m.damping_forces()
        for i, slide in enumerate(m.slide_speeds):
            active[f"mover_{i}"] += basis[slide] * (state.actuator_force[i] + passive[slide])
        result = {"payload_active_force": active["payload"], "payload_inertia_force": inertia["payload"]}
        for kind in ("rod", "mover"):
            result[f"{kind}_active_force"] = np.array([active[f"{kind}_{i}"] for i in LEGS])
            result[f"{kind}_inertia_force"] = np.array([inertia[f"{kind}_{i}"] for i in LEGS])
        return result


def without_spin(direction, angular):
    """[6][3] the part of the rods' angular vectors across their axes.

    A Hooke joint spins its rod, the model does not; without axial inertia no force depends on the spin.
    """
    return angular - np.sum(angular * direction, axis=1, keepdims=True) * direction
