"""Order of convergence, and accelerations that do not alternate, on a strongly moving base."""

import numpy as np
import pytest
from cases import document, moving_base
from prototype.exchange import task
from prototype.guide import TurnedTooFar, guide_motion
from prototype.run import run

DURATION = 0.064
FORCES = 30.0 + np.array([8.0, -5.0, 3.0, 6.0, -7.0, 2.0])


def motion(step, half_steps=False):
    spacing = step / 2.0 if half_steps else step
    base = moving_base(spacing * np.arange(round(DURATION / spacing) + 1))
    velocity = base["velocity"][0].copy()
    arm = base["rotation"][0] @ [0.0, 0.0, 0.382]
    velocity[:3] += np.cross(velocity[3:], arm) + [0.02, 0.01, -0.02]
    changing = 1.0 + 0.3 * np.sin(40.0 * spacing * np.arange(len(base["position"])))
    given = document(
        base, np.outer(changing, FORCES), step, gravity_on=True, platform_velocity=velocity, half_steps=half_steps
    )
    return {name: np.array(value) for name, value in run(task(given), lambda _: None).items()}


@pytest.fixture(scope="module")
def motions():
    return {step: motion(step) for step in (8e-4, 4e-4, 2e-4)}


@pytest.mark.parametrize("quantity", ["platform_position", "platform_rotation", "platform_acceleration"])
def test_second_order(motions, quantity):
    coarse, middle, fine = (motions[step][quantity][:: round(8e-4 / step)] for step in (8e-4, 4e-4, 2e-4))
    ratio = np.abs(coarse - middle).max() / np.abs(middle - fine).max()
    assert 3.5 < ratio < 4.5


def test_accelerations_do_not_alternate(motions):
    """What a start without the base's own acceleration would excite, and the rule would keep."""
    acceleration = motions[2e-4]["platform_acceleration"]
    alternating = acceleration[:-3] - 3.0 * acceleration[1:-2] + 3.0 * acceleration[2:-1] - acceleration[3:]
    assert np.abs(alternating).max() < 1e-5 * np.abs(acceleration).max()


def test_velocity_and_acceleration_are_the_derivatives(motions):
    """Central differences of Exudyn's positions and velocities, to the differences' own error."""
    result, h = motions[2e-4], 2e-4
    speed = (result["platform_position"][2:] - result["platform_position"][:-2]) / (2.0 * h)
    assert np.abs(speed - result["platform_velocity"][1:-1, :3]).max() < 1e-4
    change = (result["platform_velocity"][2:] - result["platform_velocity"][:-2]) / (2.0 * h)
    assert np.abs(change - result["platform_acceleration"][1:-1]).max() < 1e-3 * np.abs(change).max()
    matrices = result["platform_rotation"].reshape(-1, 3, 3)
    turning = (matrices[2:] - matrices[:-2]) @ matrices[1:-1].transpose(0, 2, 1) / (2.0 * h)
    rates = np.column_stack([turning[:, 2, 1], turning[:, 0, 2], turning[:, 1, 0]])
    assert np.abs(rates - result["platform_velocity"][1:-1, 3:]).max() < 1e-3


def test_series_at_half_steps_are_integrated_at_half_steps(motions):
    halves = motion(4e-4, half_steps=True)
    whole = motions[2e-4]
    assert len(halves["time"]) == round(DURATION / 4e-4) + 1
    assert np.array_equal(halves["platform_acceleration"], whole["platform_acceleration"][::2])


def test_guide_is_the_derivative_of_itself():
    time = 1e-4 * np.arange(2001)
    values, rates, second = guide_motion(**moving_base(time))
    assert np.abs(values[0]).max() < 1e-15
    assert np.abs((values[2:] - values[:-2]) / 2e-4 - rates[1:-1]).max() < 1e-6 * np.abs(rates).max()
    assert np.abs((rates[2:] - rates[:-2]) / 2e-4 - second[1:-1]).max() < 1e-6 * np.abs(second).max()


def test_guide_refuses_a_right_angle():
    time = np.linspace(0.0, 1.0, 11)
    base = moving_base(time)
    angle = 1.6 * time
    zero, one = np.zeros_like(angle), np.ones_like(angle)
    rows = [np.cos(angle), zero, np.sin(angle), zero, one, zero, -np.sin(angle), zero, np.cos(angle)]
    base["rotation"] = np.column_stack(rows).reshape(-1, 3, 3)
    with pytest.raises(TurnedTooFar) as caught:
        guide_motion(**base)
    assert caught.value.sample == 9  # 1.44 rad, the first beyond 80 degrees
