"""The three runs of `vectors.py`: write, check, dry run."""

import sys
import time

import numpy as np

from agreement import (
    CHECK_LIMIT,
    CLOSURE_LIMIT,
    ENGINES_LIMIT,
    LONG_RUN_LIMIT,
    Disagreement,
    cancelling_scales,
    compare,
    require,
    self_checks,
    worst,
)
from leg_types import leg_type_and_parameters
from mujoco_mechanism import MujocoMechanism
from outputs import Solution
from pinocchio_mechanism import PinocchioMechanism
from reduction import ClosureError
from states import DRAWS, Sampler, SamplingError, well_conditioned
from vector_file import FileError, read_platform, read_vectors, state_arrays, write_vectors

InputError = (FileError, SamplingError)

# Partial velocities and per-body forces are half of a case's numbers: only every third case keeps them.
BULKY_EVERY = 3
BULKY = ("partial_velocity", "partial_angular_velocity", "active_force", "inertia_force")
# First Hooke axis turned about the mount, per engine [rad]: the legs' spin changes, not the results.
PINOCCHIO_TURN, MUJOCO_TURN = 0.0, 0.4


def run(options):
    """Does what the command line asks for; returns the exit status."""
    platforms = [read_platform(path) for path in options.platforms]
    names = [platform["name"] for platform in platforms]
    if len(set(names)) < len(names):
        raise FileError(f"two platforms of one name: {', '.join(names)}")
    if options.check:
        return _check(platforms, options)
    # Everything is computed before anything is written.
    limit = LONG_RUN_LIMIT if options.dry_run else ENGINES_LIMIT
    computed = [_compute(platform, options.states, options.seed, limit) for platform in platforms]
    if not options.dry_run:
        for platform, cases in zip(platforms, computed):
            path = options.out_dir / f"{platform['name']}.json"
            write_vectors(
                path, platform, [(state, _kept(outputs, i)) for i, (state, outputs) in enumerate(cases)]
            )
            _say(f"wrote {path} ({path.stat().st_size / 1e6:.2f} MB)")
    return 0


def _check(platforms, options):
    found = []
    for platform in platforms:
        path = options.out_dir / f"{platform['name']}.json"
        committed_platform, committed = read_vectors(path)
        if committed_platform != platform:
            raise Disagreement(
                f"{path}: made for other numbers of platform {platform['name']}: write it again"
            )
        sampled = _compute(platform, len(committed), options.seed, ENGINES_LIMIT)
        figures = []
        for index, ((state, outputs), (fresh_state, _)) in enumerate(zip(committed, sampled)):
            where = f"{platform['name']}, case {index}"
            figures.append(compare(state_arrays(fresh_state), state_arrays(state), CHECK_LIMIT, where))
            # At the committed state itself: its last digits are an input, not a result.
            fresh, _ = solve(platform, state, where, ENGINES_LIMIT)
            scales = cancelling_scales(*leg_type_and_parameters(platform), fresh)
            figures.append(compare(_kept(fresh, index), outputs, CHECK_LIMIT, where, scales))
        found.append(worst(figures))
        _say(f"{path}: worst difference {found[-1]}")
    _say(f"committed vectors confirmed, worst difference {worst(found)}, limit {CHECK_LIMIT:g}")
    return 0


def _compute(platform, count, seed, limit):
    """[(state, outputs)] in order; raises on the first disagreement."""
    sampler, cases, figures, began = Sampler(platform, seed), [], [], time.monotonic()
    for index, (family, draw) in enumerate(sampler.candidates(count)):
        where = f"{platform['name']}, case {index} ({family})"
        state, outputs, figure = _acceptable(platform, sampler, draw, where, limit)
        cases.append((state, outputs))
        figures.append(figure)
        if sys.stderr.isatty() or (index + 1) % 500 == 0:
            _say(f"{platform['name']}: {index + 1}/{count}", end="\r" if sys.stderr.isatty() else "\n")
    took = time.monotonic() - began
    _say(f"{platform['name']}: {count} states, engines agree, worst {worst(figures)}, {took:.1f} s")
    return cases


def _acceptable(platform, sampler, draw, where, limit):
    for _ in range(DRAWS):
        state = draw()
        outputs, figure = solve(
            platform, state, where, limit, lambda found: well_conditioned(found, sampler.radius)
        )
        if outputs is not None:
            return state, outputs, figure
    raise SamplingError(f"{where}: no state with a well-conditioned Jacobian in {DRAWS} draws")


def solve(platform, state, where, limit, acceptable=lambda outputs: True):
    """Both engines at one state: (Pinocchio's outputs, worst figure), or (None, None) if not acceptable."""
    leg_type, parameters = leg_type_and_parameters(platform)
    try:
        solution = Solution(PinocchioMechanism, leg_type, parameters, state, PINOCCHIO_TURN)
        outputs = solution.outputs()
        if not acceptable(outputs):
            return None, None
        other = Solution(MujocoMechanism, leg_type, parameters, state, MUJOCO_TURN)
    except (ClosureError, np.linalg.LinAlgError) as error:
        raise Disagreement(f"{where}: {error}") from error
    for side in (solution, other):
        require(f"closure residual of {side.mechanism.name}", side.residual, CLOSURE_LIMIT, where)
    scales = cancelling_scales(leg_type, parameters, outputs)
    figure = compare(outputs, other.outputs(), limit, where, scales)
    return outputs, worst([figure, self_checks(solution, outputs, where)])


def _kept(outputs, index):
    """The outputs that case number `index` stores."""
    if index % BULKY_EVERY == 0:
        return outputs
    return {name: value for name, value in outputs.items() if not name.endswith(BULKY)}


def _say(text, end="\n"):
    print(text, end=end, file=sys.stderr, flush=True)
