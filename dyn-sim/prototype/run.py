"""From input to output: guide, start, simulation."""

from importlib.metadata import version

from . import simulation
from .exchange import BadInput
from .guide import TurnedTooFar, guide_motion
from .mechanism import Pose
from .start import start


def run(task, report=simulation.progress_on_stderr):
    """The output document of a checked input."""
    try:
        _, rates, accelerations = guide_motion(
            task.base_position, task.base_rotation, task.base_velocity, task.base_acceleration
        )
    except TurnedTooFar as error:
        raise BadInput(
            f"base.rotation[{error.sample}]: at t = {error.sample * task.spacing:.6g} s the base has turned by more "
            "than the prototype's angles can follow (80 degrees in the second of three)"
        ) from error
    begin = start(
        task.parameters,
        Pose(task.base_position[0], task.base_rotation[0]),
        Pose(task.platform_position, task.platform_rotation),
        task.platform_velocity,
        task.gravity,
        rates[0],
        accelerations[0],
        task.actuator_force[0],
    )
    motion = simulation.simulate(begin, rates, task.actuator_force, task.spacing, report)
    every = slice(None, None, task.stride)
    return {
        "version": 1,
        "engine": f"exudyn {version('exudyn')}",
        "integrator": simulation.METHOD,
        "step_s": task.step,
        "integration_step_s": task.spacing,
        "closure_residual": begin.closure_residual,
        "time": [task.step * k for k in range(len(motion.time[every]))],
        "platform_position": motion.position[every].tolist(),
        "platform_rotation": motion.rotation[every].tolist(),
        "platform_velocity": motion.velocity[every].tolist(),
        "platform_acceleration": motion.acceleration[every].tolist(),
        "actuator_length": motion.actuator_length[every].tolist(),
    }
