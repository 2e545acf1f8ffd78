"""One sample of every input and parameter, so that each later stage can check itself without Python.

The numbers only have to be generic: no zero, no symmetry, every leg within reach. They come from a fixed sequence and
from + - * / and square roots of Python floats alone, so they are the same on every machine.
"""

from math import sqrt

from .evaluate import dot
from .symbols import LEG_COUNT


def _spread(count: int, start: int, scale: float = 1.0) -> list[float]:
    """Numbers in (-scale, scale) without pattern."""
    return [scale * ((k * 0.6180339887498949) % 1 * 2 - 1) for k in range(start, start + count)]


def _vary(value: float, start: int) -> list[float]:
    return [value * (1 + deviation) for deviation in _spread(LEG_COUNT, start, 0.2)]


def _multiply(a, b):
    return [[dot(a[i], [row[j] for row in b]) for j in range(len(b[0]))] for i in range(3)]


def _rotation(x: float, y: float, z: float):
    """Rotation matrix of the quaternion (1, x, y, z)/|.|."""
    s = 2 / (1 + x * x + y * y + z * z)
    return [
        [1 - s * (y * y + z * z), s * (x * y - z), s * (x * z + y)],
        [s * (x * y + z), 1 - s * (x * x + z * z), s * (y * z - x)],
        [s * (x * z - y), s * (y * z + x), 1 - s * (x * x + y * y)],
    ]


def _unit(vector):
    norm = sqrt(dot(vector, vector))
    return [component / norm for component in vector]


def _flat(rows) -> list[float]:
    return [value for row in rows for value in row]


def _uhp_legs() -> dict[str, list[float]]:
    tilt = zip(_spread(LEG_COUNT, 51, 0.1), _spread(LEG_COUNT, 61, 0.1))
    return {
        "actuator_axis": _flat(_unit((x, y, 1.0)) for x, y in tilt),
        "rod_length": _vary(0.24, 131),
        "rod_mass": _vary(1.0, 141),
        "rod_inertia": _vary(0.004, 151),
        "rod_com_fraction": _vary(0.5, 161),
        "mover_mass": _vary(0.6, 171),
        "mover_offset": _vary(0.05, 181),
        "rest_length": _vary(0.2, 191),
    }


def _ups_legs() -> dict[str, list[float]]:
    return {
        "lower_mass": _vary(1.3, 131),
        "lower_com_distance": _vary(0.12, 141),
        "lower_inertia": _vary(0.006, 151),
        "upper_mass": _vary(0.8, 161),
        "upper_com_distance": _vary(0.14, 171),
        "upper_inertia": _vary(0.004, 181),
        "rest_length": _vary(0.4, 191),
    }


_LEGS = {"uhp": _uhp_legs, "ups": _ups_legs}


def sample(leg_type: str) -> dict[str, list[float]]:
    """Values for a leg type, flat and row-major."""
    base_rotation = _rotation(*_spread(3, 11, 0.4))
    base_position = _spread(3, 23)
    offset = _multiply(base_rotation, [[0.011], [-0.007], [0.385]])
    # Neighbouring joints approach each other above and part below, as on every Gough-like platform.
    upper = [(0.116, 0.031), (0.116, -0.031), (-0.031, -0.116), (-0.085, -0.085), (-0.085, 0.085), (-0.031, 0.116)]
    lower = [(0.132, 0.123), (0.132, -0.123), (0.040, -0.176), (-0.172, -0.052), (-0.172, 0.052), (0.040, 0.176)]
    height = _spread(LEG_COUNT, 41, 0.01)
    return {
        "base_position": base_position,
        "base_rotation": _flat(base_rotation),
        "base_velocity": _spread(6, 71, 1.3),
        "base_acceleration": _spread(6, 81, 3.1),
        "platform_position": [base_position[k] + offset[k][0] for k in range(3)],
        "platform_rotation": _flat(_multiply(base_rotation, _rotation(*_spread(3, 17, 0.1)))),
        "platform_velocity": _spread(6, 91, 1.7),
        "platform_acceleration": _spread(6, 101, 2.9),
        "reference_velocity": _spread(6, 221, 1.5),
        "actuator_force": _spread(LEG_COUNT, 111, 23.0),
        "external_wrench": _spread(6, 121, 5.3),
        "base_point": _flat((x, y, z) for (x, y), z in zip(lower, height)),
        "platform_point": _flat((x, y, -z) for (x, y), z in zip(upper, height)),
        **_LEGS[leg_type](),
        "axial_stiffness": _vary(2.1e4, 201),
        "axial_damping": _vary(7.0, 211),
        "payload_mass": [6.1],
        "payload_com": [0.004, -0.006, 0.031],
        "payload_inertia": [0.025, 0.003, -0.002, 0.003, 0.03, 0.004, -0.002, 0.004, 0.035],
        "gravity": [0.3, -0.4, -9.7],
    }
