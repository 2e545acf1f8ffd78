"""Kane's method for a leg, in the three speeds of its platform joint; knows no leg type.

A leg reaches the platform through its joint alone, so its equations are written for the joint's velocity and projected
to the six platform speeds with U = [1, -S(lever)] afterwards. A leg of axisymmetric bodies without spin is a set of
vectors y_k with masses m_kl between them: its kinetic energy is 1/2 sum m_kl v_k . v_l (a rod: two end masses and a
coupling). A vector is a point of the leg or a direction that turns with it; between a point and a direction stands a
first moment, between directions a moment of inertia. All of them share one unit axis e and the gradient g of the
actuator length by the joint position; their partial velocities by the joint's velocity are

    D_k = along_k e g^T + across_k 1

so e . e = 1 and e . e' = 0 are used here once, for every leg type. Where the actuator lies along the leg itself, axis
and gradient are one vector: pass it twice. Time derivatives are inertial; vectors may be in any one frame, as long as
all of them are.
"""

from dataclasses import dataclass

import casadi as ca

from .rotations import cross, dot, outer, skew, symmetric


@dataclass(frozen=True)
class Point:
    """A vector of a leg: its partial velocity is `along e g^T + across 1`, with rates of the two factors.

    `translates` is 1 for a point, 0 for a direction: a translation of the whole leg leaves directions as they are.
    """

    along: ca.SX | float = 0
    across: ca.SX | float = 0
    along_rate: ca.SX | float = 0
    across_rate: ca.SX | float = 0
    translates: int = 1


@dataclass(frozen=True)
class Leg:
    """Points and directions by name, and masses between pairs of them (each unordered pair once)."""

    points: dict[str, Point]
    masses: dict[tuple[str, str], ca.SX]

    def pairs(self):
        """(point k, point l, name of l, mass) with both orders of unequal pairs."""
        for (first, second), mass in self.masses.items():
            yield self.points[first], self.points[second], second, mass
            if first != second:
                yield self.points[second], self.points[first], first, mass

    def total(self, weight):
        """sum over ordered pairs of mass times `weight(k, l)`."""
        return sum((mass * weight(k, l) for k, l, _, mass in self.pairs()), ca.SX(0))


def inertia_forces(leg: Leg, accelerations, components):
    """Inertia force along the actuator coordinate, and the rest at the joint: f = g axial + joint (39)-(46).

    `components` holds the inertial acceleration of every point along the axis, less gravity: weight is included; of a
    direction, its second inertial derivative. `accelerations` holds them as vectors, of the points that share a mass with one
    that moves across the axis too.
    """
    along = sum((mass * k.along * components[l] for k, _, l, mass in leg.pairs()), ca.SX(0))
    beside = (pair for pair in leg.pairs() if not ca.SX(pair[0].across).is_zero())
    across = sum((mass * k.across * accelerations[l] for k, _, l, mass in beside), ca.SX.zeros(3))
    return along, across


def inertia_wrench(leg: Leg, positions, accelerations):
    """Inertia force of the whole leg and its moment about the origin of `positions`, which of a direction is itself."""
    forces = {name: ca.SX.zeros(3) for name in leg.points}
    for (first, second), mass in leg.masses.items():
        forces[first] += mass * accelerations[second]
        if first != second:
            forces[second] += mass * accelerations[first]
    moment = sum((cross(positions[name], force) for name, force in forces.items()), ca.SX.zeros(3))
    total = sum((leg.points[name].translates * force for name, force in forces.items()), ca.SX.zeros(3))
    return total, moment


def bilinear_accelerations(leg: Leg, axis, axis_rate, gradient, gradient_rate, speed, speed_rate):
    """D_k' s + D_k s' of every point: what speeds s of the joint, other than its own, add to a point's acceleration.

    Their inertia forces are the leg's Coriolis matrix times s, as `joint_inertia_rate` has it, without the matrix.
    """
    axial, axial_rate = dot(gradient, speed), dot(gradient_rate, speed) + dot(gradient, speed_rate)
    return {
        name: axis * (point.along * axial_rate + point.along_rate * axial) + axis_rate * (point.along * axial)
        + point.across_rate * speed + point.across * speed_rate
        for name, point in leg.points.items()
    }


def joint_inertia(leg: Leg, axis, gradient):
    """N = sum m_kl D_k^T D_l: mass matrix of the leg in the speeds of its joint, 3 x 3."""
    squares = (outer(weight * row, row) for weight, row in joint_inertia_squares(leg, axis, gradient))
    return symmetric(sum(squares, joint_mass(leg) * ca.SX.eye(3)))


def joint_inertia_squares(leg: Leg, axis, gradient):
    """N less `joint_mass` times 1 as sum of weighted squares w v v^T: [(w, v), ...].

    A 6 x 6 matrix takes fewer operations from squares, and from masses that merge into the platform's.
    """
    both = leg.total(lambda k, l: k.along * l.along)
    mixed = leg.total(lambda k, l: k.across * l.along)
    if axis is gradient:
        return [(both + 2 * mixed, gradient)]
    return [(both, gradient + (mixed / both) * axis), (-(mixed * mixed) / both, axis)]


def joint_mass(leg: Leg):
    """sum m_kl across_k across_l: the part of N that is alike in all directions, a mass at the platform joint."""
    return leg.total(lambda k, l: k.across * l.across)


def joint_inertia_rate(leg: Leg, axis, axis_rate, gradient, gradient_rate):
    """sum m_kl D_k^T D_l': Coriolis matrix of the leg in the speeds of its joint, 3 x 3."""
    both = leg.total(lambda k, l: k.along * l.along)
    both_rate = leg.total(lambda k, l: k.along * l.along_rate)
    mixed = leg.total(lambda k, l: k.across * l.along)
    along_across_rate = leg.total(lambda k, l: k.along * l.across_rate)
    across_along_rate = leg.total(lambda k, l: k.across * l.along_rate)
    alone_rate = leg.total(lambda k, l: k.across * l.across_rate) * ca.SX.eye(3)
    if axis is gradient:
        turning = (both_rate + along_across_rate + across_along_rate) * axis + mixed * axis_rate
        return outer((both + mixed) * axis, axis_rate) + outer(turning, axis) + alone_rate
    return (
        outer(both * gradient + mixed * axis, gradient_rate)
        + outer(both_rate * gradient + across_along_rate * axis + mixed * axis_rate, gradient)
        + outer(along_across_rate * gradient, axis)
        + alone_rate
    )


def joint_base_inertia(leg: Leg, axis, gradient, positions):
    """sum m_kl D_k^T Y_l with Y = [translates, -S(y)]: inertia between joint and base speeds, 3 x 6.

    `positions` are the points seen from the base origin, and the directions.
    """
    along = leg.total(lambda k, l: k.along * l.translates)
    across = leg.total(lambda k, l: k.across * l.translates)
    along_moment = sum((mass * k.along * positions[l] for k, _, l, mass in leg.pairs()), ca.SX.zeros(3))
    across_moment = sum((mass * k.across * positions[l] for k, _, l, mass in leg.pairs()), ca.SX.zeros(3))
    row = ca.vertcat(along * axis, cross(along_moment, axis))
    return outer(gradient, row) + ca.horzcat(across * ca.SX.eye(3), -skew(across_moment))


def joint_base_inertia_rate(leg: Leg, axis, gradient, velocities):
    """sum m_kl D_k^T Y_l', of which only the rotational half is not zero, 3 x 3.

    `velocities` are the inertial rates of the points seen from the base origin, and of the directions.
    """
    along_moment = sum((mass * k.along * velocities[l] for k, _, l, mass in leg.pairs()), ca.SX.zeros(3))
    across_moment = sum((mass * k.across * velocities[l] for k, _, l, mass in leg.pairs()), ca.SX.zeros(3))
    return outer(gradient, cross(along_moment, axis)) - skew(across_moment)


def kinetic_energy(leg: Leg, velocities):
    """1/2 sum m_kl v_k . v_l for the inertial velocities of the points and rates of the directions."""
    return sum(
        (mass * dot(velocities[first], velocities[second]) * (0.5 if first == second else 1)
         for (first, second), mass in leg.masses.items()),
        ca.SX(0),
    )


def partial_velocity(body_velocity, speeds):
    """Partial velocities: derivative of a body's (angular) velocity by the generalised speeds."""
    return ca.jacobian(body_velocity, speeds)


def generalised_force(velocity, speeds, force):
    """J^T f with the partial velocities J of `velocity`, by reverse automatic differentiation: J is not formed."""
    return ca.jtimes(velocity, speeds, force, True)
