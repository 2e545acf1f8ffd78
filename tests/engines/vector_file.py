"""Reading resolved platforms, reading and writing vector files. Floats keep every digit (`repr`)."""

import json
import os
import tempfile

import numpy as np

from description import Pose
from leg_types import LEG_TYPES
from outputs import Motion, State

VERSION = 1
PLATFORM_PARAMETERS = {"payload_mass": (), "payload_com": (3,), "payload_inertia": (3, 3), "gravity": (3,)}


class FileError(Exception):
    """A file is missing, or not what its place asks for; the message names the file and the remedy."""


def read_platform(path):
    """A resolved platform file, as the object it holds, shapes checked."""
    platform = _read_json(path, "a resolved platform; make one with the example `resolve` of dyn-platform")
    try:
        if platform["version"] != VERSION or platform["leg_type"] not in LEG_TYPES:
            raise FileError(f"{path}: needs version {VERSION} and a leg_type out of {', '.join(LEG_TYPES)}")
        expected = {**LEG_TYPES[platform["leg_type"]].PARAMETERS, **PLATFORM_PARAMETERS}
        shapes = {name: np.shape(platform["parameters"][name]) for name in expected}
        home = (np.shape(platform["home"]["position"]), np.shape(platform["home"]["rotation"]))
        platform["name"]
    except (KeyError, TypeError) as error:
        raise FileError(f"{path}: not a resolved platform: no {error}") from error
    for name, shape in expected.items():
        if shapes[name] != shape:
            raise FileError(f"{path}: {name} has shape {shapes[name]}, not {shape}")
    if home != ((3,), (3, 3)):
        raise FileError(f"{path}: home needs position[3] and rotation[3][3]")
    return platform


def read_vectors(path):
    """A vector file: (platform, [(State, outputs by name)])."""
    content = _read_json(path, "committed vectors; without --check this command writes them")
    try:
        cases = [_state_and_outputs(case) for case in content["cases"]]
        if not cases:
            raise ValueError("no cases")
        return content["platform"], cases
    except (KeyError, TypeError, ValueError) as error:
        raise FileError(f"{path}: not a vector file ({error}): write it again") from error


def write_vectors(path, platform, cases):
    """Replaces the file in one step. One case per line, so that a change shows which cases it touches."""
    lines = ",\n".join(_line(_case(state, outputs)) for state, outputs in cases)
    text = f'{{"version":{VERSION},"platform":{_line(platform)},"cases":[\n{lines}\n]}}\n'
    os.makedirs(os.path.dirname(path) or ".", exist_ok=True)
    handle, partial = tempfile.mkstemp(dir=os.path.dirname(path) or ".", prefix=".vectors-", suffix=".json")
    try:
        with os.fdopen(handle, "w", encoding="utf-8") as file:
            file.write(text)
        # mkstemp makes a private file; a committed one is readable.
        os.chmod(partial, 0o644)
        os.replace(partial, path)
    except BaseException:
        os.unlink(partial)
        raise


def state_arrays(state):
    """The state's numbers by name, to compare two states."""
    result = {"actuator_force": state.actuator_force, "external_wrench": state.external_wrench}
    for side in ("base", "platform"):
        motion = getattr(state, side)
        result[f"{side}_position"], result[f"{side}_rotation"] = motion.pose.position, motion.pose.rotation
        result[f"{side}_velocity"], result[f"{side}_acceleration"] = motion.velocity, motion.acceleration
    return result


def _case(state, outputs):
    return {
        "base": _motion_object(state.base),
        "platform": _motion_object(state.platform),
        "actuator_force": state.actuator_force.tolist(),
        "external_wrench": state.external_wrench.tolist(),
        "outputs": {name: value.tolist() for name, value in outputs.items()},
    }


def _motion_object(motion):
    return {
        "position": motion.pose.position.tolist(),
        "rotation": motion.pose.rotation.tolist(),
        "velocity": motion.velocity.tolist(),
        "acceleration": motion.acceleration.tolist(),
    }


def _state_and_outputs(case):
    motions = [_motion(case[side]) for side in ("base", "platform")]
    state = State(*motions, np.array(case["actuator_force"]), np.array(case["external_wrench"]))
    return state, {name: np.array(value) for name, value in case["outputs"].items()}


def _motion(content):
    position, rotation, velocity, acceleration = (
        np.array(content[key]) for key in ("position", "rotation", "velocity", "acceleration")
    )
    return Motion(Pose(position, rotation), velocity, acceleration)


def _line(content):
    return json.dumps(content, separators=(",", ":"), allow_nan=False)


def _read_json(path, expected):
    try:
        with open(path, encoding="utf-8") as file:
            return json.load(file)
    except OSError as error:
        raise FileError(f"{path}: {error.strerror}; expected {expected}") from error
    except ValueError as error:
        raise FileError(f"{path}: not JSON ({error}); expected {expected}") from error
