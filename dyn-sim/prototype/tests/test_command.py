"""The command: exchange files, progress, messages and exit status."""

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from cases import document, platform, resting_base
from prototype.exchange import BadInput, task

DYN_SIM = Path(__file__).parents[2]


def command(*arguments):
    return subprocess.run(
        [sys.executable, "-m", "prototype", *map(str, arguments)],
        cwd=DYN_SIM,
        capture_output=True,
        text=True,
        check=False,
    )


def good():
    return document(resting_base(5), np.zeros(6), 1e-3, gravity_on=False)


def test_output_file(tmp_path):
    given, result = tmp_path / "in.json", tmp_path / "out.json"
    given.write_text(json.dumps(good()), encoding="utf-8")
    done = command(given, result)
    assert done.returncode == 0, done.stderr
    assert done.stderr.split()[-2:] == ["progress", "1.00"]
    assert set(done.stderr.split()[::2]) == {"progress"}
    written = json.loads(result.read_text(encoding="utf-8"))
    assert written["version"] == 1
    assert written["engine"].startswith("exudyn 1.13.")
    assert written["closure_residual"] < 1e-12
    assert written["time"] == [0.0, 0.001, 0.002, 0.003, 0.004]
    shapes = {"position": 3, "rotation": 9, "velocity": 6, "acceleration": 6}
    assert all(np.shape(written[f"platform_{name}"]) == (5, size) for name, size in shapes.items())
    assert np.shape(written["actuator_length"]) == (5, 6)
    assert [path.name for path in tmp_path.iterdir() if path.suffix == ".part"] == []


def change(path, value):
    def apply(given):
        *within, last = path
        for key in within:
            given = given[key]
        given[last] = value

    return apply


def remove(*path):
    def apply(given):
        *within, last = path
        for key in within:
            given = given[key]
        del given[last]

    return apply


BAD = [
    (change(["version"], 2), "version: 2 is not 1"),
    (remove("actuator_force"), "actuator_force: missing"),
    (remove("platform", "parameters", "rod_mass"), "platform.parameters.rod_mass: missing"),
    (change(["platform", "leg_type"], "stewart"), "legs of type 'uhp', not 'stewart'"),
    (change(["platform", "parameters", "rod_length"], [0.2] * 5), "rod_length: shape 5 instead of 6"),
    (change(["platform", "parameters", "rod_mass", 2], 0.0), "rod_mass: must be positive"),
    (change(["platform", "parameters", "actuator_axis", 0], [0, 0, 2]), "actuator_axis: unit vectors"),
    (change(["gravity_on"], "yes"), "gravity_on: 'yes' is neither true nor false"),
    (change(["step_s"], 0.0), "step_s: 0.0 is not a positive"),
    (change(["steps"], 4.5), "steps: 4.5 is not a whole number"),
    (change(["steps"], 7), "base.position: shape 5x3 instead of 8x3"),
    (change(["half_steps"], True), "base.position: shape 5x3 instead of 9x3"),
    (change(["base"], 1), "base: an object is needed"),
    (change(["base", "velocity", 3, 1], float("nan")), r"base.velocity\[3\]\[1\]: not a finite number"),
    (change(["base", "velocity", 3], [0.0]), "base.velocity: numbers of shape 5x6"),
    (change(["base", "rotation", 2], [1.1, 0, 0, 0, 1, 0, 0, 0, 1]), r"base.rotation\[2\]: not a rotation matrix"),
    (change(["initial", "platform_rotation"], [1, 0, 0, 0, 1, 0, 0, 0, -1]), "platform_rotation.*not a rotation"),
    (change(["initial", "platform_velocity"], [0, 0, 0]), "platform_velocity: shape 3 instead of 6"),
]


@pytest.mark.parametrize(("damage", "message"), BAD, ids=[message for _, message in BAD])
def test_bad_input_is_named(damage, message):
    given = good()
    damage(given)
    with pytest.raises(BadInput, match=message):
        task(given)


def out_of_reach():
    given = good()
    given["initial"]["platform_position"] = [0.5, 0.0, 0.4]
    return given


def torn_apart():
    given = good()
    given["actuator_force"] = [[1e5, -1e5] * 3] * 5
    given["step_s"] = 0.01
    return given


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"version": 2}, "version: 2 is not 1"),
        (out_of_reach(), "leg 1 is out of reach at the start"),
        (torn_apart(), "Exudyn stops at t = "),
    ],
    ids=["version", "out of reach", "torn apart"],
)
def test_failure_is_one_message_and_no_file(tmp_path, given, message):
    path, result = tmp_path / "in.json", tmp_path / "out.json"
    path.write_text(json.dumps(given), encoding="utf-8")
    done = command(path, result)
    assert done.returncode == 1
    messages = [line for line in done.stderr.splitlines() if not line.startswith("progress ")]
    assert len(messages) == 1 and message in messages[0], done.stderr
    assert not result.exists()


def test_unreadable_and_unwritable_files(tmp_path):
    path = tmp_path / "in.json"
    absent = command(path, tmp_path / "out.json")
    assert absent.returncode == 1 and "No such file" in absent.stderr
    path.write_text("{", encoding="utf-8")
    broken = command(path, tmp_path / "out.json")
    assert broken.returncode == 1 and "not JSON" in broken.stderr
    path.write_text(json.dumps(good()), encoding="utf-8")
    nowhere = command(path, tmp_path / "absent" / "out.json")
    assert nowhere.returncode == 1 and "cannot write" in nowhere.stderr
    assert command(path).returncode == 2


def test_shared_platform_is_the_default():
    assert platform()["name"] == "uhp_2016"
