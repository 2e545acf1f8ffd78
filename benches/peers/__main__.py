"""Writes the C peers of a platform, for `cargo xtask bench` to compile, and `index.tsv`: function, implementation, way, symbol."""

import argparse
import json
import re
import sys
from pathlib import Path

import casadi as ca
import numpy as np

from derivation.functions import functions
from derivation.legs import LEG_TYPES
from derivation.symbols import symbols_of

from . import naive, same, solve

FUNCTIONS = ("inverse_dynamics", "forward_dynamics", "matrices")
# Blocks of a mass matrix that are tried: forces first, moments first.
FORCE_FIRST, MOMENT_FIRST = [0, 1, 2, 3, 4, 5], [3, 4, 5, 0, 1, 2]
# Results agree with those of dyn-gen to this part of the largest number, or nothing is written.
TOLERANCE = 1e-9


def pivot_order(explained: dict) -> tuple[list[int], list[int]]:
    """The order that dyn-gen chose for the solve of inverse dynamics, from `dyn-gen explain --json`."""
    for system in explained["eliminations"]:
        if system["function"] == "inverse_dynamics":
            return system["rows"], system["columns"]
    raise KeyError("no linear system of inverse_dynamics in what dyn-gen explained")


def evaluate(names, columns, outputs, states) -> np.ndarray:
    function = ca.Function("value", columns, [ca.vertcat(*outputs)])
    return np.array([np.array(function(*(state[name] for name in names))).ravel() for state in states])


def candidates(row, symbols, platform: dict, order, states):
    """(implementation, way, expression) of everything that is measured for a function, a row of the derivation's table."""
    name = row.name
    general = lambda matrix, right: solve.lu(matrix, right, *order)
    ways = {"elimination": (general, solve.ldl)}
    if name == "inverse_dynamics":
        halves = solve.block_order(_wrench_maps(row, symbols, platform, states))
        ways["blocks"] = (lambda matrix, right: solve.blocks(matrix, right, *halves), solve.ldl)
    elif name == "forward_dynamics":
        for way, first in (("blocks, forces first", FORCE_FIRST), ("blocks, moments first", MOMENT_FIRST)):
            ways[way] = (general, lambda matrix, right, first=first: solve.blocks(matrix, right, first, first))
    for way, (of_general, of_definite) in ways.items():
        def written_out(step, matrix, right, of_general=of_general, of_definite=of_definite):
            return (of_definite if step.symmetric_positive_definite else of_general)(matrix, right)
        yield "casadi_c_same", way, same.expression(row, symbols, platform, written_out)
    yield "casadi_c_naive", "elimination", naive.expression(name, symbols, platform, general)


def _wrench_maps(row, symbols, platform, states) -> np.ndarray:
    """The matrix of inverse dynamics' linear system at every state."""
    seen = []

    def look(step, matrix, right):
        seen.append(matrix)
        return right

    names, columns, _ = same.expression(row, symbols, platform, look)
    function = ca.Function("matrix", columns, seen)
    return np.array([np.array(function(*(state[name] for name in names))) for state in states])


def operations(function: ca.Function) -> int:
    ignored = (ca.OP_CONST, ca.OP_INPUT, ca.OP_OUTPUT, ca.OP_NEG)
    return sum(function.instruction_id(k) not in ignored for k in range(function.n_instructions()))


def main() -> int:
    parser = argparse.ArgumentParser(prog="python -m peers", description=__doc__)
    parser.add_argument("--explained", type=Path, required=True, help="from dyn-gen explain --json")
    parser.add_argument("--vectors", type=Path, required=True, help="from dyn-gen vectors: numbers, states and results")
    parser.add_argument("--folder", type=Path, required=True, help="folder to write into")
    options = parser.parse_args()
    vectors = json.loads(options.vectors.read_text(encoding="utf-8"))
    order = pivot_order(json.loads(options.explained.read_text(encoding="utf-8")))
    platform, states = vectors["platform"], [state(case) for case in vectors["cases"]]
    if platform["leg_type"] != "uhp":
        print(f"error: peers know legs of type uhp, not {platform['leg_type']}", file=sys.stderr)
        return 1
    leg = LEG_TYPES[platform["leg_type"]]
    symbols = symbols_of(leg)
    options.folder.mkdir(parents=True, exist_ok=True)
    index = []
    for name in FUNCTIONS:
        row = next(function for function in functions(leg) if function.name == name)
        expected = np.array([np.concatenate([np.ravel(case["outputs"][o]) for o in row.outputs]) for case in vectors["cases"]])
        for number, (implementation, way, (names, columns, outputs)) in enumerate(
            candidates(row, symbols, platform, order, states)
        ):
            values = evaluate(names, columns, outputs, states)
            error = (np.abs(values - expected).max(axis=1) / np.abs(expected).max(axis=1)).max()
            if not error <= TOLERANCE:
                print(f"error: {name} by {implementation} ({way}) differs from dyn-gen by {error:.1e}", file=sys.stderr)
                return 1
            symbol = f"{implementation}_{name}_{number}"
            function = ca.Function(symbol, columns, ca.cse([ca.vertcat(*outputs)]))
            write(function, options.folder)
            count = operations(function)
            print(f"{name:<17} {implementation:<15} {way:<22} {count:>6} operations, differs from dyn-gen by {error:.0e}")
            index.append((name, implementation, way, symbol))
    text = "".join("\t".join(row) + "\n" for row in index)
    (options.folder / "index.tsv").write_text(text, encoding="utf-8")
    return 0


def state(case: dict) -> dict[str, list[float]]:
    """A case of dyn-gen's vectors as inputs by name."""
    moving = [(body, key) for body in ("base", "platform") for key in ("position", "rotation", "velocity", "acceleration")]
    named = {f"{body}_{key}": np.ravel(case[body][key]) for body, key in moving}
    return named | {key: np.ravel(case[key]) for key in ("actuator_force", "external_wrench")}


def write(function: ca.Function, folder: Path) -> None:
    """C with one entry, named by the macro PEER, that everything else may be inlined into.

    CasADi's own functions become static, its entries by the macro CASADI_SYMBOL_EXPORT: compiled twice, they would collide. A
    function of scalars needs no work arrays. What stands there already is not touched, so that it need not be compiled again.
    """
    generator = ca.CodeGenerator(f"{function.name()}.c")
    generator.add(function)
    text = re.sub(r"^casadi_real (?=casadi_\w+\()", "static casadi_real ", generator.dump(), flags=re.MULTILINE)
    entry = "void PEER(const casadi_real** arg, casadi_real** res) { casadi_f0(arg, res, 0, 0, 0); }"
    text, path = f"{text}\n{entry}\n", folder / f"{function.name()}.c"
    if not path.is_file() or path.read_text(encoding="utf-8") != text:
        path.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    sys.exit(main())
