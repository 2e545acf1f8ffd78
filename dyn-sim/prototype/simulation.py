"""Time integration by Exudyn.

Method: the trapezoidal rule on velocity-level constraints (Newmark, beta 1/4, gamma 1/2, index 2), from consistent
initial accelerations. It evaluates forces and prescribed motion at the ends of steps only, so the step is the spacing
of the given series: with series at half steps it is half the output's step, and no value is interpolated.

Chosen by measurement: worst error in the published experiment (0.1 s, step 1e-4 s, complex amplitudes at 40, 100 and
200 Hz) and in a large one (0.5 s, 2e-4 s; base turning by 0.35 rad in decimetre motion, gravity on; linear and angular
acceleration relative to the largest value, and position):

    method                                     published   linear    angular   position
    trapezoidal, consistent start              4.2e-3 %    1.7e-6    3.0e-6    8.9e-8 m
    the same, series at half steps             1.1e-3 %    4.3e-7    7.3e-7    2.2e-8 m
    trapezoidal, Exudyn's own start            4.2e-3 %    6.9e-2    2.1e-1    8.9e-8 m
    trapezoidal, zero accelerations at start   4.2e-3 %    7.9e-1    7.3e-1    4.0e-5 m
    generalised-alpha, index 3, rho = 0.9      8.9e-3 %    1.2e-3    2.2e-3    4.8e-8 m (*)
    generalised-alpha, index 3, rho = 0.6      1.1e-2 %    --        --        --       (*)
    (*) Newton's tolerance 1e-8; the large experiment with the tree below, rigid bodies do not converge

The rule has no numerical damping: what a wrong start excites alternates from step to step for ever. A consistent start
(start.py) excites nothing. It is of second order (tests/test_accuracy.py).

The base is constrained in its rates, since the rule satisfies velocity constraints; its position is the rule's
integral of them, 7e-10 off after the large experiment.

The same mechanism in minimal coordinates (an ObjectKinematicTree of base, movers and rods) gave the same errors but
took two to four times as long: every marker on a tree computes the whole tree.
"""

import sys
from dataclasses import dataclass

import exudyn as exu
import numpy as np

INITIAL, CURRENT = exu.ConfigurationType.Initial, exu.ConfigurationType.Current
METHOD = "trapezoidal rule, index 2 (Newmark, beta = 1/4, gamma = 1/2), consistent initial accelerations"


class StepFailed(Exception):
    """Exudyn cannot go on at some time."""


@dataclass(frozen=True)
class Motion:
    """The platform's motion as Exudyn's sensors report it, O coordinates, and the actuator lengths."""

    time: np.ndarray
    position: np.ndarray
    rotation: np.ndarray
    velocity: np.ndarray
    acceleration: np.ndarray
    actuator_length: np.ndarray


def simulate(start, guide_rates, forces, step, report):
    """Integrates from `start` through the series.

    `guide_rates`: [n+1][6] rates of the base's coordinates; `forces`: [n+1][6] N; both every `step` seconds.
    `report`: called with the fraction done.
    """
    mechanism, steps = start.mechanism, len(forces) - 1
    system = mechanism.system
    data = system.systemData
    for configuration in (INITIAL, CURRENT):
        data.SetODE2Coordinates(start.coordinates, configuration)
        data.SetODE2Coordinates_t(start.rates, configuration)
        data.SetODE2Coordinates_tt(start.accelerations, configuration)
    reached = 0

    def before_step(_, time):
        nonlocal reached
        reached = round(time / step)
        mechanism.set_base_rates(guide_rates[reached])
        mechanism.set_actuator_forces(forces[reached])
        if reached * 100 // steps > (reached - 1) * 100 // steps:
            report(reached / steps)
        return True

    system.SetPreStepUserFunction(before_step)
    try:
        system.SolveDynamic(_settings(step, steps))
    except Exception as error:  # Exudyn raises several of its own types, and ValueError, for a failed step
        lines = [line for line in str(error).splitlines() if line.strip()]
        raise StepFailed(
            f"Exudyn stops at t = {reached * step:.6g} s (step {reached} of {steps}): "
            f"{lines[0] if lines else type(error).__name__}. A leg near its reach or a rod nearly square to its "
            "actuator does this; so do forces that do not belong to the motion"
        ) from error
    return _motion(mechanism, steps, step)


def _settings(step, steps):
    settings = exu.SimulationSettings()
    settings.solution.file.write = False
    settings.solution.sensors.writePeriod = step
    settings.linearSolver.solverType = exu.LinearSolverType.EigenSparse
    integration = settings.timeIntegration
    integration.numberOfSteps, integration.endTime = steps, steps * step
    integration.verboseMode = 0
    integration.adaptiveStep = False  # another step would need values between the given ones
    rule = integration.generalizedAlpha
    rule.useNewmark, rule.useIndex2Constraints = True, True
    rule.computeInitialAccelerations, rule.resetAccelerations = False, False
    # A new Jacobian as soon as convergence slows: halves the time of large motions, changes no result.
    integration.newton.modifiedNewtonContractivity = 0.02
    # The default, 1e-8, shows in accelerations as 2e-6 of their largest value.
    integration.newton.relativeTolerance = 1e-10
    return settings


def _motion(mechanism, steps, step):
    def series(sensor):
        return np.array(mechanism.system.GetSensorStoredData(sensor))[:, 1:]

    read = {name: series(sensor) for name, sensor in mechanism.platform_sensors.items()}
    if len(read["position"]) != steps + 1:
        raise StepFailed(f"Exudyn stored {len(read['position'])} samples instead of {steps + 1}")
    turned = read["rotation"].reshape(-1, 3, 3) @ mechanism.platform.pose.rotation
    motion = Motion(
        time=step * np.arange(steps + 1),
        position=read["position"],
        rotation=turned.reshape(-1, 9),
        velocity=np.hstack([read["velocity"], read["angular_velocity"]]),
        acceleration=np.hstack([read["acceleration"], read["angular_acceleration"]]),
        actuator_length=np.column_stack([series(sensor)[:, 2] for sensor in mechanism.length_sensors]),
    )
    if not all(np.isfinite(values).all() for values in vars(motion).values()):
        raise StepFailed("Exudyn's result contains values that are not finite")
    return motion


def progress_on_stderr(fraction):
    print(f"progress {fraction:.2f}", file=sys.stderr, flush=True)
