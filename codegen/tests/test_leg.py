"""The leg's hand-simplified rates against automatic differentiation, and Kane's sums against their definition."""

import casadi as ca
import numpy as np
import pytest
from derivation import kane
from derivation.legs import uhp
from derivation.rotations import skew

from numeric import generator, rotation, value

AXIS = np.array([0.36, -0.48, 0.8])
ROD = 0.31


def closure(x, axis, s):
    return uhp.leg_closure.derive(joint_vector=x, actuator_axis=axis, rod_length=s)


@pytest.fixture
def motion():
    """x(t) = x0 + x1 t + x2 t^2/2: derivatives by t are total time derivatives."""
    t = ca.SX.sym("t")
    rng = generator(1)
    x0 = 0.2 * AXIS + 0.1 * rng.normal(size=3)
    x1, x2 = rng.normal(size=3), rng.normal(size=3)
    return t, ca.DM(x0) + t * ca.DM(x1) + t * t / 2 * ca.DM(x2), x1, x2


def test_closure_puts_the_rod_between_the_joints():
    x = 0.2 * AXIS + np.array([0.05, 0.1, -0.03])
    leg = closure(ca.SX(x), ca.SX(AXIS), ca.SX(ROD))
    length = value(leg["actuator_length"]).item()
    assert np.linalg.norm(x - length * AXIS) == pytest.approx(ROD, rel=1e-15)
    assert (x - length * AXIS) @ AXIS > 0, "the Hooke joint must be below the platform joint"
    cosine = (x - length * AXIS) @ AXIS / ROD
    assert value(leg["rod_alignment"]).item() == pytest.approx(cosine**2, rel=1e-14)


def test_gradient_is_the_derivative_of_the_length():
    x = ca.SX.sym("x", 3)
    leg = closure(x, ca.SX(AXIS), ca.SX(ROD))
    gradient = uhp.length_gradient.derive(leg["radial_offset"], leg["axial_span_reciprocal"], ca.SX(AXIS))
    by_derivative = ca.gradient(leg["actuator_length"], x)
    at = (x, 0.2 * AXIS + np.array([0.05, 0.1, -0.03]))
    np.testing.assert_allclose(value(gradient["length_gradient"], at), value(by_derivative, at), rtol=1e-14)


def test_rates_are_the_time_derivatives(motion):
    t, x, x1, x2 = motion
    axis, s = ca.SX(AXIS), ca.SX(ROD)
    velocity, acceleration = ca.jacobian(x, t), ca.SX(x2)
    leg = closure(x, axis, s)
    rates = uhp.leg_rates.derive(velocity, leg["radial_offset"], leg["axial_span_reciprocal"], axis)
    gradient = uhp.length_gradient.derive(leg["radial_offset"], leg["axial_span_reciprocal"], axis)["length_gradient"]
    gradient_rate = uhp.length_gradient_rate.derive(
        leg["radial_offset"], rates["radial_offset_rate"], rates["axial_span_rate"], leg["axial_span_reciprocal"]
    )["length_gradient_rate"]
    second = uhp.leg_accelerations.derive(
        acceleration, leg["radial_offset"], rates["radial_offset_rate"], rates["axial_span_rate"],
        leg["axial_span_reciprocal"], axis,
    )["actuator_acceleration"]
    first = ca.jacobian(leg["actuator_length"], t)
    for explicit, derived in [
        (rates["actuator_velocity"], first),
        (second, ca.jacobian(first, t)),
        (gradient_rate, ca.jacobian(gradient, t)),
    ]:
        np.testing.assert_allclose(value(explicit, (t, 0.03)), value(derived, (t, 0.03)), rtol=1e-12)


def general_leg(rng):
    """A leg that uses every term: along, across and both rates at every point, all masses."""
    points = {name: kane.Point(*map(float, rng.normal(size=4))) for name in ("one", "two", "three")}
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


def test_kane_sums_equal_their_definition():
    rng = generator(2)
    leg = general_leg(rng)
    axis = AXIS
    axis_rate = np.cross(rng.normal(size=3), axis)
    gradient, gradient_rate = rng.normal(size=3), rng.normal(size=3)
    vectors = {name: rng.normal(size=3) for name in leg.points}
    d, d_rate = partials(leg, axis, axis_rate, gradient, gradient_rate)
    S = lambda v: np.array(ca.skew(ca.DM(v)))
    Y = {name: np.hstack([np.eye(3), -S(y)]) for name, y in vectors.items()}
    numbers = {name: ca.SX(y) for name, y in vectors.items()}
    sx = [ca.SX(v) for v in (axis, axis_rate, gradient, gradient_rate)]

    axial, joint = kane.inertia_forces(leg, sx[0], numbers)
    cases = [
        (ca.SX(sx[2] * axial + joint), weighted(leg, lambda k, l: d[k].T @ vectors[l])[:, None]),
        (kane.joint_inertia(leg, sx[0], sx[2]), weighted(leg, lambda k, l: d[k].T @ d[l])),
        (kane.joint_inertia_rate(leg, *sx), weighted(leg, lambda k, l: d[k].T @ d_rate[l])),
        (kane.joint_base_inertia(leg, sx[0], sx[2], numbers), weighted(leg, lambda k, l: d[k].T @ Y[l])),
        (kane.joint_base_inertia_rate(leg, sx[0], sx[2], numbers),
         weighted(leg, lambda k, l: d[k].T @ -S(vectors[l]))),
        (kane.kinetic_energy(leg, numbers), weighted(leg, lambda k, l: vectors[k] @ vectors[l]) / 2),
    ]
    for derived, defined in cases:
        np.testing.assert_allclose(value(derived), np.atleast_2d(defined), rtol=1e-13, atol=1e-13)


def test_rod_ends_carry_the_rods_inertia():
    """End masses and coupling give the kinetic energy of a rod with transverse inertia and no spin."""
    rng = generator(3)
    mass, inertia, length, k = 1.3, 0.02, 0.4, 0.37
    ends = uhp.rod_ends.derive(ca.SX(mass), ca.SX(inertia), ca.SX(length), ca.SX(k))
    A1, A2, B = (float(ends[name]) for name in ("hooke_end_mass", "platform_end_mass", "rod_coupling"))
    u = rotation(rng)[:, 0]
    com_velocity, angular = rng.normal(size=3), rng.normal(size=3)
    angular -= u * (u @ angular)
    v1 = com_velocity + np.cross(angular, -k * length * u)
    v2 = com_velocity + np.cross(angular, (1 - k) * length * u)
    as_ends = (A1 * v1 @ v1 + A2 * v2 @ v2) / 2 + B * v1 @ v2
    assert as_ends == pytest.approx(mass * com_velocity @ com_velocity / 2 + inertia * angular @ angular / 2, rel=1e-13)


def test_skew_is_the_cross_product():
    a, b = generator(4).normal(size=(2, 3))
    np.testing.assert_allclose(value(skew(ca.SX(a)) @ ca.SX(b))[:, 0], np.cross(a, b), rtol=1e-15)


def test_squares_add_up_to_the_joint_inertia():
    rng = generator(5)
    axis, gradient = ca.SX(AXIS), ca.SX(rng.normal(size=3))
    leg = uhp._leg(ca.SX(0.9), ca.SX(0.2), ca.SX(0.6))
    squares = sum(weight * v @ v.T for weight, v in kane.joint_inertia_squares(leg, axis, gradient))
    np.testing.assert_allclose(value(squares), value(kane.joint_inertia(leg, axis, gradient)), rtol=1e-14, atol=1e-14)
