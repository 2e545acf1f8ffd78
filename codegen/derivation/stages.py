"""Stages: the pieces of a derivation that become graphs.

A stage is a Python function whose parameters are names from the symbol table and whose result is a dictionary of
further such names. A leg stage is derived for one leg and mapped over all of them; its per-leg arguments are one leg's
slices. In a platform stage a per-leg array arrives as the list of its legs' values.
"""

import inspect
from dataclasses import dataclass
from typing import Callable

import casadi as ca


@dataclass(frozen=True)
class Stage:
    """A graph in the making."""

    name: str
    meaning: str
    over_legs: bool
    arguments: tuple[str, ...]
    derive: Callable[..., dict[str, ca.SX]]


@dataclass(frozen=True)
class Solve:
    """A linear system between stages: `matrix` times `solution` is `right_hand_side`."""

    solution: str
    matrix: str
    right_hand_side: str
    symmetric_positive_definite: bool


def _stage(function: Callable, over_legs: bool) -> Stage:
    meaning = (inspect.getdoc(function) or "").splitlines()
    assert meaning, f"stage {function.__name__} has no docstring"
    arguments = tuple(inspect.signature(function).parameters)
    return Stage(function.__name__, meaning[0].rstrip("."), over_legs, arguments, function)


def platform_stage(function: Callable) -> Stage:
    """Declares a stage that is evaluated once."""
    return _stage(function, over_legs=False)


def leg_stage(function: Callable) -> Stage:
    """Declares a stage that is evaluated for every leg."""
    return _stage(function, over_legs=True)
