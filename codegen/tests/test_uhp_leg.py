"""The UHP leg's hand-simplified rates against automatic differentiation."""

import casadi as ca
import numpy as np
import pytest
from derivation import kane
from derivation.legs import uhp

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
    gradient = uhp.length_gradient.derive(leg["radial_offset"], leg["axial_span_reciprocal"], axis)["length_gradient"]
    rates = uhp.leg_rates.derive(velocity, gradient, axis)
    gradient_rate = uhp.length_gradient_rate.derive(
        ca.SX.zeros(3), gradient, leg["radial_offset"], rates["radial_offset_rate"], rates["axial_span_rate"],
        leg["axial_span_reciprocal"],
    )["length_gradient_rate"]
    second = uhp.leg_accelerations.derive(
        acceleration, gradient, rates["radial_offset_rate"], rates["axial_span_rate"], leg["axial_span_reciprocal"],
    )["actuator_acceleration"]
    first = ca.jacobian(leg["actuator_length"], t)
    for explicit, derived in [
        (rates["actuator_velocity"], first),
        (second, ca.jacobian(first, t)),
        (gradient_rate, ca.jacobian(gradient, t)),
    ]:
        np.testing.assert_allclose(value(explicit, (t, 0.03)), value(derived, (t, 0.03)), rtol=1e-12)


def test_rod_ends_carry_the_rods_inertia():
    """End masses and coupling give the kinetic energy of a rod with transverse inertia and no spin."""
    rng = generator(3)
    mass, inertia, length, k = 1.3, 0.02, 0.4, 0.37
    ends = uhp.rod_ends.derive(ca.SX(mass), ca.SX(inertia), ca.SX(length), ca.SX(k), ca.SX(0.7))
    A1, A2, B = (float(ends[name]) for name in ("hooke_end_mass", "platform_end_mass", "rod_coupling"))
    assert float(ends["axial_mass"]) == pytest.approx(A1 + 0.7, rel=1e-15)
    u = rotation(rng)[:, 0]
    com_velocity, angular = rng.normal(size=3), rng.normal(size=3)
    angular -= u * (u @ angular)
    v1 = com_velocity + np.cross(angular, -k * length * u)
    v2 = com_velocity + np.cross(angular, (1 - k) * length * u)
    as_ends = (A1 * v1 @ v1 + A2 * v2 @ v2) / 2 + B * v1 @ v2
    assert as_ends == pytest.approx(mass * com_velocity @ com_velocity / 2 + inertia * angular @ angular / 2, rel=1e-13)


def test_squares_add_up_to_the_joint_inertia():
    rng = generator(5)
    axis, gradient = ca.SX(AXIS), ca.SX(rng.normal(size=3))
    leg = uhp._leg(ca.SX(0.9), ca.SX(0.2), ca.SX(0.6))
    squares = sum(weight * v @ v.T for weight, v in kane.joint_inertia_squares(leg, axis, gradient))
    np.testing.assert_allclose(value(squares), value(kane.joint_inertia(leg, axis, gradient)), rtol=1e-14, atol=1e-14)
