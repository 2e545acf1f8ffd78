"""The two JSON files: what the prototype is given, and what it gives back. Floats round-trip exactly.

Input
    version             1
    platform            resolved platform: {"version": 1, "leg_type": "uhp", "parameters": {...}}
    gravity_on          false: no gravity; true: the platform's
    step_s, steps       h [s] and N: output at t = k h, k = 0..N
    half_steps          optional; true: every series is given at t = k h/2, k = 0..2N, else at t = k h, k = 0..N
    base                series {"position": [3] m, "rotation": [9] row-major B -> O,
                        "velocity": [6] [r'; w], "acceleration": [6] [r''; w']}, O coordinates
    actuator_force      series [6] N, on the mover along +a_i
    initial             {"platform_position": [3], "platform_rotation": [9], "platform_velocity": [6]}
Output
    version, engine, integrator, step_s (of the output), integration_step_s
    closure_residual    largest constraint at the start, m (m/s for the rates), as Exudyn reports it
    time, platform_position [3], platform_rotation [9], platform_velocity [6], platform_acceleration [6]
                        of point P, O coordinates, angular parts w and w'; actuator_length [6] m
"""

import json
import os
from dataclasses import dataclass

import numpy as np

LEG = 6
PARAMETERS = {
    "base_point": (LEG, 3),
    "actuator_axis": (LEG, 3),
    "platform_point": (LEG, 3),
    "rod_length": (LEG,),
    "rod_mass": (LEG,),
    "rod_inertia": (LEG,),
    "rod_com_fraction": (LEG,),
    "mover_mass": (LEG,),
    "mover_offset": (LEG,),
    "rest_length": (LEG,),
    "axial_stiffness": (LEG,),
    "axial_damping": (LEG,),
    "payload_mass": (),
    "payload_com": (3,),
    "payload_inertia": (3, 3),
    "gravity": (3,),
}
BASE_SERIES = {"position": 3, "rotation": 9, "velocity": 6, "acceleration": 6}
ROTATION_TOLERANCE = 1e-9


class BadInput(Exception):
    """The input cannot be used; says where and why."""


@dataclass(frozen=True)
class Task:
    """A checked input; series every `spacing` seconds, of which every `stride`-th is output."""

    parameters: dict
    gravity: np.ndarray
    step: float
    spacing: float
    stride: int
    base_position: np.ndarray
    base_rotation: np.ndarray
    base_velocity: np.ndarray
    base_acceleration: np.ndarray
    actuator_force: np.ndarray
    platform_position: np.ndarray
    platform_rotation: np.ndarray
    platform_velocity: np.ndarray


def read(path):
    """Task from a JSON file."""
    try:
        with open(path, encoding="utf-8") as file:
            document = json.load(file)
    except OSError as error:
        raise BadInput(f"{path}: {error.strerror}") from error
    except ValueError as error:
        raise BadInput(f"{path}: not JSON: {error}") from error
    return task(document)


def task(document):
    """Task from the parsed input."""
    if _entry(document, "version") != 1:
        raise BadInput(f"version: {document['version']!r} is not 1, the only one known")
    parameters = _parameters(_entry(document, "platform"))
    gravity_on = _flag(_entry(document, "gravity_on"), "gravity_on")
    half_steps = _flag(document.get("half_steps", False), "half_steps")
    step, steps = _entry(document, "step_s"), _entry(document, "steps")
    if isinstance(step, bool) or not isinstance(step, (int, float)) or not 0.0 < step < float("inf"):
        raise BadInput(f"step_s: {step!r} is not a positive number of seconds")
    if isinstance(steps, bool) or not isinstance(steps, int) or steps < 1:
        raise BadInput(f"steps: {steps!r} is not a whole number of at least 1")
    stride = 2 if half_steps else 1
    samples = stride * steps + 1
    base, initial = _entry(document, "base"), _entry(document, "initial")
    series = {
        f"base_{name}": _array(_entry(base, name, "base."), (samples, size), f"base.{name}")
        for name, size in BASE_SERIES.items()
    }
    series["base_rotation"] = _rotations(series["base_rotation"], "base.rotation")
    platform_rotation = _array(_entry(initial, "platform_rotation", "initial."), (9,), "initial.platform_rotation")
    return Task(
        parameters=parameters,
        gravity=parameters["gravity"] if gravity_on else np.zeros(3),
        step=float(step),
        spacing=float(step) / stride,
        stride=stride,
        **series,
        actuator_force=_array(_entry(document, "actuator_force"), (samples, LEG), "actuator_force"),
        platform_position=_array(_entry(initial, "platform_position", "initial."), (3,), "initial.platform_position"),
        platform_rotation=_rotations(platform_rotation[None], "initial.platform_rotation")[0],
        platform_velocity=_array(_entry(initial, "platform_velocity", "initial."), (6,), "initial.platform_velocity"),
    )


def _entry(document, name, within=""):
    if not isinstance(document, dict):
        raise BadInput(f"{within.rstrip('.') or 'input'}: an object is needed here")
    if name not in document:
        raise BadInput(f"{within}{name}: missing")
    return document[name]


def _flag(value, name):
    if not isinstance(value, bool):
        raise BadInput(f"{name}: {value!r} is neither true nor false")
    return value


def _array(value, shape, name):
    wanted = "x".join(map(str, shape)) or "scalar"
    try:
        array = np.array(value, dtype=float)
    except (TypeError, ValueError) as error:
        raise BadInput(f"{name}: numbers of shape {wanted} are needed here") from error
    if array.shape != shape:
        found = "x".join(map(str, array.shape)) or "scalar"
        raise BadInput(f"{name}: shape {found} instead of {wanted}")
    if not np.isfinite(array).all():
        place = "".join(f"[{index}]" for index in np.argwhere(~np.isfinite(array))[0])
        raise BadInput(f"{name}{place}: not a finite number")
    return array


def _rotations(rows, name):
    rotations = rows.reshape(-1, 3, 3)
    errors = np.abs(rotations @ rotations.transpose(0, 2, 1) - np.eye(3)).max(axis=(1, 2))
    wrong = np.flatnonzero((errors > ROTATION_TOLERANCE) | (np.linalg.det(rotations) < 0.0))
    if wrong.size:
        raise BadInput(f"{name}[{wrong[0]}]: not a rotation matrix (R R^T differs from 1 by {errors[wrong[0]]:.2g})")
    return rotations


def _parameters(platform):
    version, leg_type = _entry(platform, "version", "platform."), _entry(platform, "leg_type", "platform.")
    if version != 1:
        raise BadInput(f"platform.version: {version!r} is not 1, the only one known")
    if leg_type != "uhp":
        raise BadInput(f"platform.leg_type: the prototype builds legs of type 'uhp', not {leg_type!r}")
    given = _entry(platform, "parameters", "platform.")
    parameters = {
        name: _array(_entry(given, name, "platform.parameters."), shape, f"platform.parameters.{name}")
        for name, shape in PARAMETERS.items()
    }
    for name in ("rod_length", "rod_mass", "rod_inertia", "mover_mass", "payload_mass"):
        if not np.all(parameters[name] > 0.0):
            raise BadInput(f"platform.parameters.{name}: must be positive")
    lengths = np.linalg.norm(parameters["actuator_axis"], axis=1)
    if np.abs(lengths - 1.0).max() > ROTATION_TOLERANCE:
        raise BadInput("platform.parameters.actuator_axis: unit vectors are needed here")
    return parameters


def write(path, document):
    """Writes the file whole or not at all."""
    partial = f"{path}.part"
    try:
        with open(partial, "w", encoding="utf-8") as file:
            json.dump(document, file, allow_nan=False)
        os.replace(partial, path)
    except OSError as error:
        if os.path.exists(partial):
            os.remove(partial)
        raise BadInput(f"{path}: cannot write: {error.strerror}") from error
