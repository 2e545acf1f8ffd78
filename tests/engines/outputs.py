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


def describe(leg_type, parameters, state, turn):
    """The mechanism with first Hooke axes far from the joints' singularity (leg along the first axis).

    Across mount and leg, so that the leg moves in the plane normal to it; then turned about the mount by `turn` [rad].
    With spinless legs the choice has no effect: the engines get different turns.
    """
    base, platform = state.base.pose, state.platform.pose
    ends = (platform.position - base.position + parameters["platform_point"] @ platform.rotation.T) @ base.rotation
    legs = ends - parameters["base_point"]
    mounts, axes = leg_type.mounts(parameters, legs), []
    for axis, leg in zip(mounts, legs):
        across = np.cross(axis, leg)
        if np.linalg.norm(across) < 1e-6 * np.linalg.norm(leg):
            across = np.cross(axis, np.eye(3)[np.argmin(np.abs(axis))])
        axes.append(np.cos(turn) * across + np.sin(turn) * np.cross(axis, across))
    return Description(leg_type, parameters, mounts, axes)


class Solution:
    """One engine's mechanism at one state."""

    def __init__(self, engine, leg_type, parameters, state, turn):
        self.state, self.leg = state, leg_type
        self.mechanism = engine(describe(leg_type, parameters, state, turn))
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
        turning, prefix = self.leg.TURNING
        direction = self.directions(turning)
        axis = self.directions(self.leg.DRIVEN)
        spinning = stack(m.velocity, f"com_{turning}_{{}}")[:, 3:]
        spinning_rate = stack(m.acceleration, f"com_{turning}_{{}}")[:, 3:]
        rod_rate = without_spin(direction, spinning)
        spin = np.sum(spinning * direction, axis=1, keepdims=True)
        # Derivative of w - (w.u)u, with u' = w x u, hence w.u' = 0.
        rod_rate_rate = without_spin(direction, spinning_rate) - spin * np.cross(spinning, direction)
        result = {
            "actuator_length": m.slides(),
            "actuator_velocity": self.reduction.speeds[slides],
            "actuator_acceleration": self.acceleration[slides],
            "rod_alignment": np.sum(direction * axis, axis=1) ** 2,
            "rod_direction": direction,
            "hooke_joint_position": stack(m.position, "hooke_{}"),
            "platform_joint_position": stack(m.position, "platform_point_{}"),
            "platform_joint_rate": m.velocity("platform")[3:] - rod_rate,
            f"{prefix}_angular_velocity": rod_rate,
            f"{prefix}_angular_acceleration": rod_rate_rate,
        }
        for body, name in self.leg.COM_OUTPUTS.items():
            result[f"{name}_position"] = stack(m.position, f"com_{body}_{{}}")
            result[f"{name}_velocity"] = stack(m.velocity, f"com_{body}_{{}}")[:, :3]
            result[f"{name}_acceleration"] = stack(m.acceleration, f"com_{body}_{{}}")[:, :3]
        result["payload_com_position"] = m.position("com_payload")
        result["payload_com_velocity"] = m.velocity("com_payload")[:3]
        result["payload_com_acceleration"] = m.acceleration("com_payload")[:3]
        return result

    def directions(self, body):
        """[6][3] z axes of the legs' bodies of one kind, in O."""
        return np.array([self.mechanism.rotation(f"com_{body}_{i}")[:, 2] for i in LEGS])

    def partial_velocities(self):
        m, basis = self.mechanism, self.reduction.platform_basis
        payload = m.jacobian("com_payload") @ basis
        partial = {body: stack(m.jacobian, f"com_{body}_{{}}") @ basis for body in self.leg.COM_OUTPUTS}
        turning, prefix = self.leg.TURNING
        direction, angular = self.directions(turning), partial[turning][:, 3:]
        # Each column is an angular velocity: the same projection as for the leg's.
        across = np.stack([without_spin(direction, angular[:, :, k]) for k in range(6)], axis=2)
        return {
            "payload_partial_velocity": payload[:3],
            "payload_partial_angular_velocity": payload[3:],
            f"{prefix}_partial_angular_velocity": across,
            **{f"{body}_partial_velocity": rows[:, :3] for body, rows in partial.items()},
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
        external = m.wrench_forces("com_payload", state.external_wrench)
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
        back, because their forces also act inside the legs, or between base and leg.
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
        active["payload"] += basis.T @ m.wrench_forces("com_payload", state.external_wrench)
        passive = m.spring_forces() + m.damping_forces()
        for i, slide in enumerate(m.slide_speeds):
            active[f"{self.leg.DRIVEN}_{i}"] += basis[slide] * (state.actuator_force[i] + passive[slide])
        result = {"payload_active_force": active["payload"], "payload_inertia_force": inertia["payload"]}
        for kind in self.leg.COM_OUTPUTS:
            result[f"{kind}_active_force"] = np.array([active[f"{kind}_{i}"] for i in LEGS])
            result[f"{kind}_inertia_force"] = np.array([inertia[f"{kind}_{i}"] for i in LEGS])
        return result


def without_spin(direction, angular):
    """[6][3] the part of the legs' angular vectors across their axes.

    A Hooke joint spins its leg, the model does not; without axial inertia no force depends on the spin.
    """
    return angular - np.sum(angular * direction, axis=1, keepdims=True) * direction
