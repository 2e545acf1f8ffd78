"""Numbers for symbolic expressions, and seeded samples."""

import casadi as ca
import numpy as np


def value(expression, *at: tuple[ca.SX, object]) -> np.ndarray:
    """Value of an SX expression where each named symbol has the given number or array."""
    if not at:
        return np.array(ca.evalf(ca.SX(expression)))
    function = ca.Function("value", [symbol for symbol, _ in at], [ca.SX(expression)])
    return np.array(function(*(number for _, number in at)))


def generator(seed: int) -> np.random.Generator:
    return np.random.default_rng(seed)


def rotation(rng) -> np.ndarray:
    q = rng.normal(size=4)
    w, x, y, z = q / np.linalg.norm(q)
    return np.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ])
