"""Motions whose result is known without any model of the mechanism."""

import numpy as np
from cases import HOME_HEIGHT, arrays, document, platform, resting_base
from prototype.exchange import task
from prototype.run import run

# Home of platforms/uhp_2016.toml, by hand. Horizontal offset of each rod, squared:
# 0.18^2 + 0.12^2 - 2 0.18 0.12 cos(28 deg) = 0.0086567 m^2, so the actuator is
# 0.382 - sqrt(0.206^2 - 0.0086567) = 0.1982084 m long.
HOME_LENGTH = 0.19820844412349722
# By symmetry a leg carries a sixth of the payload, its rod and its mover, and holds its stretched spring:
# 21555.9 N/m (0.1982084 - 0.198) m + (6.092/6 + 1.024 + 0.611) kg 9.81 m/s^2.
HOLDING_FORCE = 30.49297068169361


def simulate(given):
    return {name: np.array(value) for name, value in run(task(given), lambda _: None).items()}


def test_holding_forces_keep_the_platform_at_home_under_gravity():
    result = simulate(document(resting_base(201), np.full(6, HOLDING_FORCE), 1e-3, gravity_on=True))
    assert np.abs(result["platform_acceleration"]).max() < 1e-9
    assert np.abs(result["platform_position"] - [0.0, 0.0, HOME_HEIGHT]).max() < 1e-12
    assert np.abs(result["actuator_length"] - HOME_LENGTH).max() < 1e-12


def test_a_force_too_small_lets_the_platform_sink():
    result = simulate(document(resting_base(3), np.full(6, HOLDING_FORCE - 1.0), 1e-3, gravity_on=True))
    assert result["platform_acceleration"][0, 2] < -0.1


def test_mechanism_falls_freely_with_its_base():
    resolved = platform()
    resolved["parameters"]["rest_length"] = [HOME_LENGTH] * 6
    gravity = arrays(resolved)["gravity"]
    time = 1e-3 * np.arange(301)
    base = resting_base(time.size)
    base["position"] = np.outer(time**2 / 2.0, gravity)
    base["velocity"][:, :3] = np.outer(time, gravity)
    base["acceleration"][:, :3] = gravity
    result = simulate(document(base, np.zeros(6), 1e-3, gravity_on=True, resolved=resolved))
    assert np.abs(result["platform_acceleration"] - [*gravity, 0.0, 0.0, 0.0]).max() < 1e-8
    assert np.abs(result["platform_position"] - base["position"] - [0.0, 0.0, HOME_HEIGHT]).max() < 1e-10
    assert np.abs(result["actuator_length"] - HOME_LENGTH).max() < 1e-10


def test_damping_takes_the_stroke_speed():
    """Without springs, gravity and forces only the dampers brake: c_e a quarter up, deceleration a quarter up."""
    decelerations = []
    for damping in (40.0, 50.0):
        resolved = platform()
        resolved["parameters"]["axial_stiffness"] = [0.0] * 6
        resolved["parameters"]["axial_damping"] = [damping] * 6
        upwards = [0.0, 0.0, 1e-4, 0.0, 0.0, 0.0]
        still = resting_base(3)
        given = document(still, np.zeros(6), 1e-5, gravity_on=False, resolved=resolved, platform_velocity=upwards)
        decelerations.append(simulate(given)["platform_acceleration"][0, 2])
    # Upright motion: every mover, rod and the payload move together, 6 c_e v over the whole mass, 15.902 kg.
    assert np.allclose(decelerations, [-6 * 40.0 * 1e-4 / 15.902, -6 * 50.0 * 1e-4 / 15.902], rtol=1e-4)


def test_rotated_start_is_the_same_motion_rotated():
    """Base, platform, velocity and gravity turned together turn the result, but for the integration error, which
    depends on the angles that Exudyn integrates."""
    turn = np.array([[0.36, 0.48, -0.8], [-0.8, 0.6, 0.0], [0.48, 0.64, 0.6]])
    velocity = np.array([0.05, -0.02, 0.04, 0.3, -0.2, 0.4])
    forces = HOLDING_FORCE + np.array([3.0, -2.0, 1.0, 4.0, -5.0, 2.0])
    upright = simulate(document(resting_base(51), forces, 5e-4, gravity_on=True, platform_velocity=velocity))
    resolved = platform()
    resolved["parameters"]["gravity"] = (turn @ resolved["parameters"]["gravity"]).tolist()
    base = resting_base(51)
    base["rotation"] = np.tile(turn, (51, 1, 1))
    turned_velocity = np.concatenate([turn @ velocity[:3], turn @ velocity[3:]])
    turned = simulate(
        document(base, forces, 5e-4, gravity_on=True, resolved=resolved, platform_velocity=turned_velocity)
    )
    assert np.abs(turned["platform_position"] - upright["platform_position"] @ turn.T).max() < 1e-8
    rotations = turn @ upright["platform_rotation"].reshape(-1, 3, 3)
    assert np.abs(turned["platform_rotation"].reshape(-1, 3, 3) - rotations).max() < 1e-7
    difference = turned["platform_acceleration"][:, :3] - upright["platform_acceleration"][:, :3] @ turn.T
    assert np.abs(difference).max() < 1e-5 * np.abs(upright["platform_acceleration"]).max()
