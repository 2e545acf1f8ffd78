"""Functions that reach the same physics by different stages agree: on the sample of the graph file.

Forces without matrices (base coordinates), matrices (O coordinates) and forces body by body (Kane's definition with
partial velocities by automatic differentiation) are three derivations.
"""

import numpy as np
import pytest
from derivation.__main__ import document
from derivation.evaluate import evaluate
from derivation.legs import LEG_TYPES


@pytest.fixture(scope="module", params=LEG_TYPES)
def model(request):
    data = document(request.param)
    rows = {row["name"]: row for row in data["functions"]}

    def call(name, **changes):
        outputs = evaluate(data, rows[name], {**data["sample"], **changes})
        return {key: np.array(numbers) for key, numbers in outputs.items()}

    call.sample = {name: np.array(numbers) for name, numbers in data["sample"].items()}
    return call


def matrices(model):
    return {name: numbers.reshape(6, 6) for name, numbers in model("matrices").items()}


def applied_wrench(sample):
    force, moment = sample["external_wrench"][:3], sample["external_wrench"][3:]
    arm = sample["platform_rotation"].reshape(3, 3) @ sample["payload_com"]
    return np.concatenate([force, moment + np.cross(arm, force)])


def close(actual, expected):
    np.testing.assert_allclose(actual, expected, rtol=0, atol=1e-13 * np.abs(expected).max())


def test_bias(model):
    close(model("bias")["bias"], model("equation_of_motion")["bias"])


def test_inverse_and_forward_dynamics_solve_the_equation_of_motion(model):
    m, bias, s = matrices(model), model("bias")["bias"], model.sample
    base = m["mass_matrix_b"] @ s["base_acceleration"]
    left = m["mass_matrix_p"] @ s["platform_acceleration"] + bias - applied_wrench(s) - base
    close(model("inverse_dynamics")["inverse_dynamics"], np.linalg.solve(m["jacobian_dp"].T, left))
    right = m["jacobian_dp"].T @ s["actuator_force"] + applied_wrench(s) + base - bias
    close(model("forward_dynamics")["forward_dynamics"], np.linalg.solve(m["mass_matrix_p"], right))


def test_forces_of_all_bodies_vanish_along_the_motion(model):
    forces = model("generalised_forces", actuator_force=list(model("inverse_dynamics")["inverse_dynamics"]))
    total = sum(numbers.reshape(-1, 6).sum(axis=0) for numbers in forces.values())
    largest = max(np.abs(numbers).max() for numbers in forces.values())
    assert np.abs(total).max() < 1e-11 * largest


def test_jacobians_give_the_actuator_velocity(model):
    m, s = matrices(model), model.sample
    rate = m["jacobian_dp"] @ s["platform_velocity"] - m["jacobian_db"] @ s["base_velocity"]
    close(model("leg_kinematics")["actuator_velocity"], rate)


def test_mass_matrix_is_the_curvature_of_the_kinetic_energy(model):
    m, s = matrices(model), model.sample
    energy = lambda v: model("energy", platform_velocity=list(v))["kinetic_energy"][0]
    v, e = s["platform_velocity"], np.eye(6)
    gradient = np.array([(energy(v + e[k]) - energy(v - e[k])) / 2 for k in range(6)])
    close(gradient, m["mass_matrix_p"] @ v - m["mass_matrix_b"] @ s["base_velocity"])
