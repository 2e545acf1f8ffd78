"""The UPS leg's hand-simplified rates against automatic differentiation, its vectors against its rigid bodies."""

import casadi as ca
import numpy as np
import pytest
from derivation import kane
from derivation.legs import ups

from numeric import generator, rotation, value

MASSES = {
    "lower_mass": 1.3, "lower_com_distance": 0.12, "lower_inertia": 0.007,
    "upper_mass": 0.7, "upper_com_distance": 0.16, "upper_inertia": 0.003,
}


@pytest.fixture
def motion():
    """Base and platform joint in O, polynomials of t, and a base that turns about a fixed axis: derivatives by t are
    total time derivatives."""
    t = ca.SX.sym("t")
    rng = generator(11)
    polynomial = lambda x: ca.DM(x[0]) + t * ca.DM(x[1]) + t * t / 2 * ca.DM(x[2])
    base = polynomial(rng.normal(size=(3, 3)))
    joint = polynomial(rng.normal(size=(3, 3)))
    turn = rotation(rng)
    angle = 0.3 + 1.7 * t
    spin = ca.blockcat([[ca.cos(angle), -ca.sin(angle), 0], [ca.sin(angle), ca.cos(angle), 0], [0, 0, 1]])
    base_rotation = ca.DM(turn) @ spin
    base_rate = ca.DM([0, 0, 1.7])
    return t, base_rotation, base_rate, base, joint


def test_rates_are_the_time_derivatives(motion):
    t, base_rotation, base_rate, base, joint = motion
    d_dt = lambda x: ca.jacobian(x, t)
    # Only the frame turns with the base; its joint moves on its own, so that no formula can lean on a rigid base.
    x = base_rotation.T @ (joint - base)
    leg = ups.leg_closure.derive(x)
    u = ups.length_gradient.derive(x, leg["length_reciprocal"])["length_gradient"]
    rate = ups.leg_rates.derive(d_dt(x), u)["actuator_velocity"]
    u_rate = ups.length_gradient_rate.derive(
        ca.SX(base_rate), x, d_dt(x), rate, u, leg["length_reciprocal"]
    )["length_gradient_rate"]
    zero, none = ca.SX.zeros(3), ca.SX.zeros(3, 3)
    accelerations = [base_rotation.T @ d_dt(d_dt(point)) for point in (base, joint)]
    second = ups.leg_accelerations.derive(
        zero, zero, accelerations[0], none, accelerations[1], none, leg["actuator_length"], u, u_rate
    )["actuator_acceleration"]
    in_o = (joint - base) / ca.norm_2(joint - base)
    for explicit, derived in [
        (leg["actuator_length"], ca.norm_2(joint - base)),
        (u, base_rotation.T @ in_o),
        (rate, d_dt(leg["actuator_length"])),
        (u_rate, base_rotation.T @ d_dt(in_o)),
        (second, d_dt(d_dt(leg["actuator_length"]))),
    ]:
        np.testing.assert_allclose(value(explicit, (t, 0.03)), value(derived, (t, 0.03)), rtol=1e-12)


def test_gradient_is_the_derivative_of_the_length():
    x = ca.SX.sym("x", 3)
    leg = ups.leg_closure.derive(x)
    gradient = ups.length_gradient.derive(x, leg["length_reciprocal"])["length_gradient"]
    at = (x, np.array([0.2, -0.1, 0.4]))
    np.testing.assert_allclose(value(gradient, at), value(ca.gradient(leg["actuator_length"], x), at), rtol=1e-14)


def test_alignment_is_one_until_the_leg_has_no_length():
    x = ca.SX.sym("x", 3)
    alignment = ups.leg_closure.derive(x)["rod_alignment"]
    assert value(alignment, (x, np.array([0.2, -0.1, 0.4]))).item() == pytest.approx(1, rel=1e-15)
    assert np.isnan(value(alignment, (x, np.zeros(3))).item())


def leg_with_all_masses(length, rate):
    masses = ups.leg_masses.derive(**{name: ca.SX(number) for name, number in MASSES.items()})
    end_mass = masses.pop("platform_end_mass")
    leg = ups._leg(ca.SX(1 / length), ca.SX(rate), **masses)
    leg.masses["base", "base"] = ca.SX(MASSES["lower_mass"])
    leg.masses["joint", "joint"] = end_mass
    return leg


def test_vectors_carry_the_inertia_of_both_parts():
    """Masses between joints and direction give the kinetic energy of two rigid bodies without spin."""
    rng = generator(12)
    u = rotation(rng)[:, 0]
    length = 0.45
    base, joint = rng.normal(size=(2, 3))
    u_rate = (joint - base - u * (u @ (joint - base))) / length
    w = np.cross(u, u_rate)
    m = MASSES
    lower = base + np.cross(w, m["lower_com_distance"] * u)
    upper = joint + np.cross(w, -m["upper_com_distance"] * u)
    defined = (
        m["lower_mass"] * lower @ lower + m["upper_mass"] * upper @ upper
        + (m["lower_inertia"] + m["upper_inertia"]) * w @ w
    ) / 2
    vectors = {"base": ca.SX(base), "joint": ca.SX(joint), "direction": ca.SX(u_rate)}
    assert float(kane.kinetic_energy(leg_with_all_masses(length, 0), vectors)) == pytest.approx(defined, rel=1e-14)


def test_rates_of_partial_velocities_are_the_time_derivatives():
    """D' of the direction, from its factors' rates, against (1 - u u^T)/d differentiated."""
    t = ca.SX.sym("t")
    rng = generator(13)
    x = ca.DM(rng.normal(size=3)) + t * ca.DM(rng.normal(size=3))
    length = ca.norm_2(x)
    u = x / length
    rate = ca.jacobian(length, t)
    point = ups._leg(1 / length, rate, 0, 0, 0).points["direction"]
    u_rate = ca.jacobian(u, t)
    derived = ca.jacobian(ca.vec((ca.SX.eye(3) - u @ u.T) / length), t)
    factors = (
        point.along_rate * u @ u.T + point.along * (u_rate @ u.T + u @ u_rate.T) + point.across_rate * ca.SX.eye(3)
    )
    np.testing.assert_allclose(value(ca.vec(factors), (t, 0.2)), value(derived, (t, 0.2)), rtol=1e-12, atol=1e-13)
