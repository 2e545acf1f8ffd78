"""Platforms, states and inputs that the tests share."""

import copy
import json
from pathlib import Path

import numpy as np
from prototype.exchange import PARAMETERS

REPOSITORY = Path(__file__).parents[3]
# The prototype builds legs of the paper's type only; other types have vectors of their own, named after them.
VECTORS = sorted(path for path in (REPOSITORY / "tests" / "vectors").glob("*.json") if not path.stem.startswith("ups_"))
HOME_HEIGHT = 0.382  # m, platforms/uhp_2016.toml


def vectors(path):
    return json.loads(path.read_text(encoding="utf-8"))


def platform():
    """The resolved default platform."""
    return copy.deepcopy(vectors(REPOSITORY / "tests" / "vectors" / "uhp_2016.json")["platform"])


def arrays(resolved):
    return {name: np.array(resolved["parameters"][name], dtype=float) for name in PARAMETERS}


def resting_base(count):
    return {
        "position": np.zeros((count, 3)),
        "rotation": np.tile(np.eye(3), (count, 1, 1)),
        "velocity": np.zeros((count, 6)),
        "acceleration": np.zeros((count, 6)),
    }


def moving_base(time):
    """Swings about one axis by 0.35 rad while it moves by 5 cm, accelerated from the first instant."""
    axis, speed = np.array([2.0, -1.0, 2.0]) / 3.0, 2.0 * np.pi * 1.5
    angle, shift = 0.35 * np.cos(speed * time), np.array([0.05, 0.03, -0.04])
    x, y, z = axis
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    sine, cosine = np.sin(angle)[:, None, None], np.cos(angle)[:, None, None]
    rate, second = -0.35 * speed * np.sin(speed * time), -(speed**2) * angle
    phase = speed * time + 0.5
    return {
        "position": np.outer(np.sin(phase), shift),
        "rotation": np.eye(3) + sine * cross + (1.0 - cosine) * (cross @ cross),
        "velocity": np.hstack([np.outer(speed * np.cos(phase), shift), np.outer(rate, axis)]),
        "acceleration": np.hstack([np.outer(-(speed**2) * np.sin(phase), shift), np.outer(second, axis)]),
    }


def document(base, forces, step, *, gravity_on, resolved=None, platform_velocity=None, half_steps=False):
    """Input with the platform at home relative to the base. `forces`: [6], constant, or a series."""
    count = len(base["position"])
    start = base["rotation"][0]
    result = {
        "version": 1,
        "platform": resolved or platform(),
        "gravity_on": gravity_on,
        "step_s": step,
        "steps": (count - 1) // (2 if half_steps else 1),
        "base": {name: values.reshape(count, -1).tolist() for name, values in base.items()},
        "actuator_force": np.broadcast_to(forces, (count, 6)).tolist(),
        "initial": {
            "platform_position": (base["position"][0] + start @ [0.0, 0.0, HOME_HEIGHT]).tolist(),
            "platform_rotation": start.ravel().tolist(),
            "platform_velocity": np.zeros(6).tolist() if platform_velocity is None else list(platform_velocity),
        },
    }
    if half_steps:
        result["half_steps"] = True
    return result
