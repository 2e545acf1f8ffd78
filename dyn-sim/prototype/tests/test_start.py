"""The start against what Pinocchio and MuJoCo agree on (tests/vectors): positions, rates and accelerations."""

import numpy as np
import pytest
from cases import VECTORS, arrays, platform, vectors
from prototype.equations import CURRENT
from prototype.guide import guide_motion
from prototype.mechanism import Pose
from prototype.start import CannotClose, start

import exudyn as exu


def started(parameters, case):
    base, moving = ({name: np.array(value) for name, value in case[body].items()} for body in ("base", "platform"))
    _, rates, accelerations = guide_motion(*(base[name][None] for name in base))
    return start(
        parameters,
        Pose(base["position"], base["rotation"]),
        Pose(moving["position"], moving["rotation"]),
        moving["velocity"],
        parameters["gravity"],
        rates[0],
        accelerations[0],
        np.array(case["actuator_force"]),
    )


def without_wrench(case, payload_com):
    """The engines' platform acceleration for the case's actuator forces, the external wrench's share taken off."""
    wrench = np.array(case["external_wrench"])
    arm = np.array(case["platform"]["rotation"]) @ payload_com
    at_origin = np.concatenate([wrench[:3], wrench[3:] + np.cross(arm, wrench[:3])])
    outputs = case["outputs"]
    return np.array(outputs["forward_dynamics"]) - np.linalg.solve(np.array(outputs["mass_matrix_p"]), at_origin)


@pytest.mark.parametrize("path", VECTORS, ids=lambda path: path.stem)
def test_start_agrees_with_two_engines(path):
    document = vectors(path)
    parameters = arrays(document["platform"])
    for case in document["cases"][::3]:
        begin = started(parameters, case)
        assert begin.closure_residual < 1e-12
        mechanism, outputs = begin.mechanism, case["outputs"]
        system = mechanism.system
        system.systemData.SetODE2Coordinates_tt(begin.accelerations, CURRENT)
        for i, spring in enumerate(mechanism.springs):
            length = system.GetObjectOutput(spring, exu.OutputVariableType.DisplacementLocal)[2]
            speed = system.GetObjectOutput(spring, exu.OutputVariableType.VelocityLocal)[2]
            assert length == pytest.approx(outputs["actuator_length"][i], abs=1e-13)
            assert speed == pytest.approx(outputs["actuator_velocity"][i], abs=1e-11)
        acceleration = np.concatenate(
            [
                system.GetObjectOutputBody(mechanism.platform.number, quantity)
                for quantity in (exu.OutputVariableType.Acceleration, exu.OutputVariableType.AngularAcceleration)
            ]
        )
        expected = without_wrench(case, parameters["payload_com"])
        assert np.abs(acceleration - expected).max() < 1e-9 * np.abs(expected).max()


def test_leg_out_of_reach_is_named():
    parameters = arrays(platform())
    still = np.zeros(6)
    with pytest.raises(CannotClose, match="leg 1 is out of reach at the start"):
        start(
            parameters,
            Pose(np.zeros(3), np.eye(3)),
            Pose(np.array([0.5, 0.0, 0.4]), np.eye(3)),
            still,
            parameters["gravity"],
            still,
            still,
            still,
        )
