"""The paper's equations by automatic differentiation of the whole mechanism, in inertial coordinates.

Positions of all bodies come from (14) and (18); CasADi differentiates them along the motion for velocities and accelerations
and by the platform speeds for partial velocities; Kane's equations (39)-(49) sum over payload, six rods, six movers. Nothing is
arranged for the sake of short code, and nothing is shared with the derivation but names and shapes of inputs.
"""

from dataclasses import dataclass

import casadi as ca

from derivation.symbols import LEG_COUNT, Symbol

from . import solve
from .numbers import inputs, parameters

INPUTS = {
    "inverse_dynamics": (
        "base_position", "base_rotation", "base_velocity", "base_acceleration", "platform_position", "platform_rotation",
        "platform_velocity", "platform_acceleration", "external_wrench",
    ),
    "forward_dynamics": (
        "base_position", "base_rotation", "base_velocity", "base_acceleration", "platform_position", "platform_rotation",
        "platform_velocity", "actuator_force", "external_wrench",
    ),
    "matrices": (
        "base_position", "base_rotation", "base_velocity", "platform_position", "platform_rotation", "platform_velocity",
    ),
}


@dataclass(frozen=True)
class Body:
    """Mass, inertia about the centre of mass (O axes), velocity and angular velocity of a body."""

    mass: ca.SX
    inertia: ca.SX
    velocity: ca.SX
    rate: ca.SX


class Mechanism:
    """The mechanism at symbolic inputs."""

    def __init__(self, symbols: list[Symbol], platform: dict):
        names = [symbol.name for symbol in symbols if symbol.role == "input"]
        columns, shaped = inputs(symbols, names)
        self.columns = dict(zip(names, columns, strict=True))
        self.input = {name: parts[0] if len(parts) == 1 else ca.vertcat(*parts) for name, parts in shaped.items()}
        self.number = parameters(symbols, platform)
        self.gravity = self.number["gravity"][0]
        self.base_speed, self.platform_speed = self.input["base_velocity"], self.input["platform_velocity"]
        self._build()

    def along_motion(self, value):
        """Time derivative: along the poses' rates and the speeds' derivatives."""
        directions = []
        for body in ("base", "platform"):
            velocity, rotation = self.input[f"{body}_velocity"], self.input[f"{body}_rotation"]
            directions += [
                (self.columns[f"{body}_position"], velocity[:3]),
                (self.columns[f"{body}_rotation"], ca.vec((ca.skew(velocity[3:]) @ rotation).T)),
                (self.columns[f"{body}_velocity"], self.input[f"{body}_acceleration"]),
            ]
        variables = ca.vertcat(*(variable for variable, _ in directions))
        return ca.jtimes(value, variables, ca.vertcat(*(direction for _, direction in directions)))

    def _build(self):
        number, base, platform = self.number, self.input["base_rotation"], self.input["platform_rotation"]
        lengths, self.bodies = [], []
        com = self.input["platform_position"] + platform @ number["payload_com"][0]
        inertia = platform @ number["payload_inertia"][0] @ platform.T
        self.bodies.append(Body(number["payload_mass"][0], inertia, self.along_motion(com), self.platform_speed[3:]))
        for leg in range(LEG_COUNT):
            value = {name: parts[leg] for name, parts in number.items() if len(parts) == LEG_COUNT}
            axis = base @ value["actuator_axis"]
            foot = self.input["base_position"] + base @ value["base_point"]
            joint = self.input["platform_position"] + platform @ value["platform_point"]
            line = joint - foot
            along = ca.dot(axis, line)
            length = along - ca.sqrt(along ** 2 - ca.dot(line, line) + value["rod_length"] ** 2)
            hooke = foot + length * axis
            direction = (joint - hooke) / value["rod_length"]
            rate = ca.cross(direction, self.along_motion(joint) - self.along_motion(hooke)) / value["rod_length"]
            k = value["rod_com_fraction"]
            rod = self.along_motion((1 - k) * hooke + k * joint)
            mover = self.along_motion(hooke - value["mover_offset"] * axis)
            across = value["rod_inertia"] * (ca.SX.eye(3) - direction @ direction.T)
            self.bodies.append(Body(value["rod_mass"], across, rod, rate))
            self.bodies.append(Body(value["mover_mass"], ca.SX.zeros(3, 3), mover, ca.SX.zeros(3)))
            lengths.append(length)
        self.lengths = ca.vertcat(*lengths)
        self.length_rates = self.along_motion(self.lengths)
        self.jacobian_p = ca.jacobian(self.length_rates, self.platform_speed)
        self.jacobian_b = -ca.jacobian(self.length_rates, self.base_speed)

    def _partials(self, body, speed):
        return ca.jacobian(body.velocity, speed), ca.jacobian(body.rate, speed)

    def inertia_force(self):
        """Generalised inertia force less weight, on the left side."""
        total = ca.SX.zeros(6)
        for body in self.bodies:
            linear, angular = self._partials(body, self.platform_speed)
            momentum_rate = self.along_motion(body.inertia @ body.rate)
            total += linear.T @ (body.mass * (self.along_motion(body.velocity) - self.gravity)) + angular.T @ momentum_rate
        return total

    def external_force(self):
        wrench = self.input["external_wrench"]
        arm = self.input["platform_rotation"] @ self.number["payload_com"][0]
        return ca.vertcat(wrench[:3], wrench[3:] + ca.cross(arm, wrench[:3]))

    def passive_force(self):
        number = {name: ca.vertcat(*self.number[name]) for name in ("axial_stiffness", "axial_damping", "rest_length")}
        return number["axial_stiffness"] * (self.lengths - number["rest_length"]) + number["axial_damping"] * self.length_rates

    def matrices(self):
        """M_p, C_p, J_dp, M_b, C_b, J_db."""
        mass_p, coriolis_p = self._mass_and_coriolis(self.platform_speed)
        mass_b, coriolis_b = self._mass_and_coriolis(self.base_speed)
        return mass_p, coriolis_p, self.jacobian_p, -mass_b, -coriolis_b, self.jacobian_b

    def _mass_and_coriolis(self, speed):
        """What multiplies the derivative of `speed` and `speed` itself in the generalised inertia force."""
        mass, coriolis = ca.SX.zeros(6, 6), ca.SX.zeros(6, 6)
        for body in self.bodies:
            linear, angular = self._partials(body, self.platform_speed)
            own_linear, own_angular = self._partials(body, speed)
            linear_rate = ca.reshape(self.along_motion(ca.vec(own_linear)), 3, 6)
            angular_rate = ca.reshape(self.along_motion(ca.vec(own_angular)), 3, 6)
            mass += linear.T @ (body.mass * own_linear) + angular.T @ body.inertia @ own_angular
            coriolis += linear.T @ (body.mass * linear_rate)
            coriolis += angular.T @ (body.inertia @ angular_rate + ca.skew(body.rate) @ body.inertia @ own_angular)
        return mass, coriolis


def expression(name: str, symbols: list[Symbol], platform: dict, general_solve) -> tuple[list[str], list, list]:
    """Names of inputs, input columns and output columns; `general_solve(matrix, right_hand_side)` writes a system out."""
    mechanism = Mechanism(symbols, platform)
    if name == "matrices":
        outputs = [ca.vec(ca.densify(matrix).T) for matrix in mechanism.matrices()]
    else:
        left = mechanism.inertia_force() - mechanism.external_force()
        passive = mechanism.passive_force()
        if name == "inverse_dynamics":
            outputs = [general_solve(mechanism.jacobian_p.T, left) + passive]
        else:
            acceleration = mechanism.input["platform_acceleration"]
            force = mechanism.jacobian_p.T @ (mechanism.input["actuator_force"] - passive)
            rest = ca.substitute(left, acceleration, ca.SX.zeros(6))
            outputs = [solve.ldl(ca.jacobian(left, acceleration), force - rest)]
    names = list(INPUTS[name])
    return names, [mechanism.columns[name] for name in names], outputs
