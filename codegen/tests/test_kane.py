"""Kane's sums against their definition, for legs that use every term."""

import casadi as ca
import numpy as np
import pytest
from derivation import kane
from derivation.rotations import skew

from numeric import generator, value

AXIS = np.array([0.36, -0.48, 0.8])


def general_leg(rng):
    """A leg that uses every term: along, across and both rates at every point and a direction, all masses."""
    points = {
        name: kane.Point(*map(float, rng.normal(size=4)), translates=translates)
        for name, translates in (("one", 1), ("two", 1), ("direction", 0))
    }
    names = list(points)
    masses = {
        (names[i], names[j]): ca.SX(float(rng.uniform(0.5, 2))) for i in range(3) for j in range(i, 3)
    }
    return kane.Leg(points, masses)


def partials(leg, axis, axis_rate, gradient, gradient_rate):
    """D_k and D_k' as their definition says."""
    one = np.eye(3)
    first, second = {}, {}
    for name, p in leg.points.items():
        first[name] = p.along * np.outer(axis, gradient) + p.across * one
        second[name] = (
            np.outer(p.along_rate * axis + p.along * axis_rate, gradient)
            + p.along * np.outer(axis, gradient_rate) + p.across_rate * one
        )
    return first, second


def weighted(leg, term):
    total = 0
    for (k, l), mass in leg.masses.items():
        total = total + float(mass) * term(k, l)
        if k != l:
            total = total + float(mass) * term(l, k)
    return total


@pytest.mark.parametrize("coaxial", [False, True])
def test_kane_sums_equal_their_definition(coaxial):
    rng = generator(2)
    leg = general_leg(rng)
    axis = AXIS
    axis_rate = np.cross(rng.normal(size=3), axis)
    gradient, gradient_rate = (axis, axis_rate) if coaxial else rng.normal(size=(2, 3))
    vectors = {name: rng.normal(size=3) for name in leg.points}
    d, d_rate = partials(leg, axis, axis_rate, gradient, gradient_rate)
    S = lambda v: np.array(ca.skew(ca.DM(v)))
    Y = {name: np.hstack([leg.points[name].translates * np.eye(3), -S(y)]) for name, y in vectors.items()}
    numbers = {name: ca.SX(y) for name, y in vectors.items()}
    sx = [ca.SX(v) for v in (axis, axis_rate)]
    sx += sx if coaxial else [ca.SX(v) for v in (gradient, gradient_rate)]
    squares = sum((weight * v @ v.T for weight, v in kane.joint_inertia_squares(leg, sx[0], sx[2])), ca.SX.zeros(3, 3))

    components = {name: ca.dot(sx[0], y) for name, y in numbers.items()}
    axial, joint = kane.inertia_forces(leg, numbers, components)
    cases = [
        (ca.SX(sx[2] * axial + joint), weighted(leg, lambda k, l: d[k].T @ vectors[l])[:, None]),
        (kane.joint_inertia(leg, sx[0], sx[2]), weighted(leg, lambda k, l: d[k].T @ d[l])),
        (squares + kane.joint_mass(leg) * ca.SX.eye(3), weighted(leg, lambda k, l: d[k].T @ d[l])),
        (kane.joint_inertia_rate(leg, *sx), weighted(leg, lambda k, l: d[k].T @ d_rate[l])),
        (kane.joint_base_inertia(leg, sx[0], sx[2], numbers), weighted(leg, lambda k, l: d[k].T @ Y[l])),
        (kane.joint_base_inertia_rate(leg, sx[0], sx[2], numbers),
         weighted(leg, lambda k, l: d[k].T @ -S(vectors[l]))),
        (kane.kinetic_energy(leg, numbers), weighted(leg, lambda k, l: vectors[k] @ vectors[l]) / 2),
    ]
    for derived, defined in cases:
        np.testing.assert_allclose(value(derived), np.atleast_2d(defined), rtol=1e-13, atol=1e-13)


def test_skew_is_the_cross_product():
    a, b = generator(4).normal(size=(2, 3))
    np.testing.assert_allclose(value(skew(ca.SX(a)) @ ca.SX(b))[:, 0], np.cross(a, b), rtol=1e-15)
