"""The derivation's own graph: its stages with the platform's numbers in place of parameters, before any of our passes."""

import casadi as ca

from derivation.export import export_graph, used_names
from derivation.functions import Function
from derivation.stages import Solve
from derivation.symbols import LEG_COUNT, Symbol

from .numbers import inputs, parameters


def row_major(values: list) -> ca.SX:
    return ca.vertcat(*(ca.vec(ca.densify(ca.SX(value)).T) for value in values))


def _run(stage, symbols, known):
    """Results of a stage, every array as the list of its legs' values or a list of one."""
    per_leg = {name: symbols[name].per_leg for name in stage.arguments}
    if not stage.over_legs:
        arguments = {name: known[name] if per_leg[name] else known[name][0] for name in stage.arguments}
        return {name: [value] for name, value in stage.derive(**arguments).items()}
    results = [
        stage.derive(**{name: known[name][leg if per_leg[name] else 0] for name in stage.arguments})
        for leg in range(LEG_COUNT)
    ]
    return {name: [result[name] for result in results] for name in results[0]}


def expression(function: Function, symbols: list[Symbol], platform: dict, solve) -> tuple[list[str], list, list]:
    """Names of inputs, input columns and output columns of a function with the platform's numbers.

    `solve(step, matrix, right_hand_side)` writes out a linear system.
    """
    by_name = {symbol.name: symbol for symbol in symbols}
    graphs = {
        step.name: export_graph(step, by_name) for step in function.steps if not isinstance(step, Solve)
    }
    needed = used_names(function, graphs)
    names = [symbol.name for symbol in symbols if symbol.role == "input" and symbol.name in needed]
    columns, known = inputs(symbols, names)
    known.update(parameters(symbols, platform))
    for step in function.steps:
        if isinstance(step, Solve):
            if step.solution in needed:
                solution = solve(step, known[step.matrix][0], _column(known[step.right_hand_side]))
                parts = LEG_COUNT if by_name[step.solution].per_leg else 1
                known[step.solution] = ca.vertsplit(solution) if parts > 1 else [solution]
        elif any(output["symbol"] in needed for output in graphs[step.name]["outputs"]):
            known.update(_run(step, by_name, known))
    return names, columns, [row_major(known[name]) for name in function.outputs]


def _column(parts: list) -> ca.SX:
    return ca.vertcat(*parts)
