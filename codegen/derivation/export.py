"""Turns stages into single-assignment graphs and the table of functions into the graph file."""

import hashlib
import json
from pathlib import Path

import casadi as ca

from .functions import Function
from .stages import Solve, Stage
from .symbols import LEG_COUNT, Symbol

FORMAT_VERSION = 1

_UNARY = {ca.OP_NEG: "neg", ca.OP_SQRT: "sqrt"}
_BINARY = {ca.OP_ADD: "add", ca.OP_SUB: "sub", ca.OP_MUL: "mul", ca.OP_DIV: "div"}


class DerivationError(Exception):
    """A mistake in the derivation, with the stage it is in."""


def matrix_shape(shape: tuple[int, ...]) -> tuple[int, int]:
    """Shape of the CasADi matrix that stands for an array: scalars 1 x 1, vectors as columns."""
    return (*shape, 1, 1)[:2]


def _argument(symbol: Symbol, label: str) -> tuple[ca.SX, list[ca.SX]]:
    """The array as an SX matrix, and its elements in row-major order."""
    rows, columns = matrix_shape(symbol.shape)
    elements = [ca.SX.sym(f"{label}_{k}") for k in range(rows * columns)]
    return ca.reshape(ca.vertcat(*elements), columns, rows).T, elements


def _row_major(value: ca.SX) -> ca.SX:
    return ca.vec(ca.densify(ca.SX(value)).T)


class _Nodes:
    """Single-assignment list in which equal nodes are shared."""

    def __init__(self):
        self.rows: list[list] = []
        self._index: dict[tuple, int] = {}

    def add(self, *row) -> int:
        if row not in self._index:
            self._index[row] = len(self.rows)
            self.rows.append(list(row))
        return self._index[row]


def _expand(nodes: _Nodes, operation: int, operands: list[int], stage: Stage) -> int:
    """One CasADi operation in the file's six operations."""
    if operation in _BINARY:
        return nodes.add(_BINARY[operation], *operands)
    if operation in _UNARY:
        return nodes.add(_UNARY[operation], operands[0])
    if operation == ca.OP_SQ:
        return nodes.add("mul", operands[0], operands[0])
    if operation == ca.OP_TWICE:
        return nodes.add("mul", nodes.add("const", 2.0), operands[0])
    if operation == ca.OP_INV:
        return nodes.add("div", nodes.add("const", 1.0), operands[0])
    raise DerivationError(f"stage {stage.name}: CasADi operation number {operation} has no name in the graph format")


def export_graph(stage: Stage, symbols: dict[str, Symbol]) -> dict:
    """Derives a stage and writes it as nodes."""
    values, inputs = {}, []
    for name in stage.arguments:
        if name not in symbols:
            raise DerivationError(f"stage {stage.name}: argument {name} is not in the symbol table")
        symbol = symbols[name]
        if symbol.per_leg and not stage.over_legs:
            legs = [_argument(symbol, f"{name}_{leg}") for leg in range(LEG_COUNT)]
            values[name] = [matrix for matrix, _ in legs]
            inputs.append(ca.vertcat(*(element for _, elements in legs for element in elements)))
        else:
            values[name], elements = _argument(symbol, name)
            inputs.append(ca.vertcat(*elements))

    derived = stage.derive(**values)
    for name, value in derived.items():
        if name not in symbols:
            raise DerivationError(f"stage {stage.name}: result {name} is not in the symbol table")
        symbol = symbols[name]
        whole = symbol.per_leg and not stage.over_legs
        if whole or ca.SX(value).shape != matrix_shape(symbol.shape):
            raise DerivationError(f"stage {stage.name}: result {name} has shape {ca.SX(value).shape}, not {symbol.shape}")

    results = ca.cse([_row_major(value) for value in derived.values()])
    function = ca.Function(stage.name, inputs, results)
    nodes, work = _Nodes(), {}
    outputs = [[0] * result.shape[0] for result in results]
    for k in range(function.n_instructions()):
        operation = function.instruction_id(k)
        source, target = function.instruction_input(k), function.instruction_output(k)
        if operation == ca.OP_CONST:
            work[target[0]] = nodes.add("const", function.instruction_constant(k))
        elif operation == ca.OP_INPUT:
            work[target[0]] = nodes.add("input", source[0], source[1])
        elif operation == ca.OP_OUTPUT:
            outputs[target[0]][target[1]] = work[source[0]]
        else:
            work[target[0]] = _expand(nodes, operation, [work[slot] for slot in source], stage)
    return {
        "name": stage.name,
        "meaning": stage.meaning,
        "inputs": list(stage.arguments),
        "outputs": [{"symbol": name, "nodes": outputs[k]} for k, name in enumerate(derived)],
        "nodes": nodes.rows,
    }


def used_names(function: Function, graphs: dict[str, dict]) -> set[str]:
    """Names that the outputs of a function depend on, by its steps in reverse."""
    needed = set(function.outputs)
    for step in reversed(function.steps):
        if isinstance(step, Solve):
            if step.solution in needed:
                needed |= {step.matrix, step.right_hand_side}
        else:
            graph = graphs[step.name]
            if any(output["symbol"] in needed for output in graph["outputs"]):
                needed |= set(graph["inputs"])
    return needed


def _steps(function: Function, graphs: dict[str, dict]) -> list[dict]:
    """The steps that the outputs need, each once."""
    needed = used_names(function, graphs)
    steps, seen = [], set()
    for step in function.steps:
        if isinstance(step, Solve):
            steps.append({
                "solve": step.solution,
                "matrix": step.matrix,
                "right_hand_side": step.right_hand_side,
                "symmetric_positive_definite": step.symmetric_positive_definite,
            })
        elif step.name not in seen and any(output["symbol"] in needed for output in graphs[step.name]["outputs"]):
            seen.add(step.name)
            steps.append({"call": step.name, "over": "legs"} if step.over_legs else {"call": step.name})
    return steps


def source_digest() -> str:
    """SHA-256 of the derivation's sources: provenance of the graph."""
    digest = hashlib.sha256()
    root = Path(__file__).parent
    for path in sorted(root.rglob("*.py"), key=lambda path: path.relative_to(root).as_posix()):
        digest.update(path.relative_to(root).as_posix().encode())
        digest.update(path.read_bytes().replace(b"\r\n", b"\n"))
    return digest.hexdigest()


def build(name: str, symbols: list[Symbol], functions: list[Function]) -> dict:
    """The graph file as plain data, sample left out."""
    by_name = {symbol.name: symbol for symbol in symbols}
    if len(by_name) != len(symbols):
        raise DerivationError("the symbol table has a name twice")
    stages = {step.name: step for function in functions for step in function.steps if isinstance(step, Stage)}
    graphs = {stage.name: export_graph(stage, by_name) for stage in stages.values()}
    rows, used, called = [], set(), set()
    for function in functions:
        needed = used_names(function, graphs)
        used |= needed
        steps = _steps(function, graphs)
        called |= {step["call"] for step in steps if "call" in step}
        rows.append({
            "name": function.name,
            "meaning": function.meaning,
            "equation": function.equation,
            "inputs": [symbol.name for symbol in symbols if symbol.role == "input" and symbol.name in needed],
            "outputs": list(function.outputs),
            "leg_specific": function.leg_specific,
            "steps": steps,
        })
    # A leg type need not use every stage that the table of functions offers: its file then lacks what they derive.
    given = {name: {output["symbol"] for output in graph["outputs"]} for name, graph in graphs.items()}
    used |= {symbol for name in called for symbol in given[name]}
    spared = {symbol for name in given.keys() - called for symbol in given[name]} - used
    unused = [symbol.name for symbol in symbols if symbol.name not in used | spared]
    if unused:
        raise DerivationError(f"symbols that nothing uses: {', '.join(unused)}")
    return {
        "format": "dyn-gen graph",
        "version": FORMAT_VERSION,
        "name": name,
        "leg_count": LEG_COUNT,
        "provenance": {"casadi": ca.__version__, "derivation_sha256": source_digest()},
        "symbols": [
            {
                "name": symbol.name, "role": symbol.role, "per_leg": symbol.per_leg, "shape": list(symbol.shape),
                "unit": symbol.unit, "frame": symbol.frame, "meaning": symbol.meaning, "equation": symbol.equation,
            }
            for symbol in symbols if symbol.name in used
        ],
        "graphs": [graph for name, graph in graphs.items() if name in called],
        "functions": rows,
    }


def _row(value) -> str:
    return json.dumps(value, separators=(",", ":"), allow_nan=False)


def to_text(document: dict) -> str:
    """JSON with one symbol, step list or output per line, so that differences can be read."""
    lines = ["{"]
    for key, value in document.items():
        if key == "graphs":
            graphs = []
            for graph in value:
                head = ",\n".join(f'    "{k}": {_row(graph[k])}' for k in ("name", "meaning", "inputs"))
                outputs = ",\n".join(f"      {_row(output)}" for output in graph["outputs"])
                nodes = _wrapped([_row(node) for node in graph["nodes"]], "      ")
                graphs.append(f'  {{\n{head},\n    "outputs": [\n{outputs}\n    ],\n    "nodes": [\n{nodes}\n    ]\n  }}')
            lines.append(f'"{key}": [\n' + ",\n".join(graphs) + "\n],")
        elif isinstance(value, list):
            lines.append(f'"{key}": [\n' + ",\n".join(f"  {_row(row)}" for row in value) + "\n],")
        elif isinstance(value, dict):
            lines.append(f'"{key}": {{\n' + ",\n".join(f"  {_row(k)}: {_row(v)}" for k, v in value.items()) + "\n},")
        else:
            lines.append(f'"{key}": {_row(value)},')
    lines[-1] = lines[-1].rstrip(",")
    return "\n".join([*lines, "}"]) + "\n"


def _wrapped(items: list[str], indent: str, width: int = 118) -> str:
    """Items joined by commas, broken into lines."""
    lines, line = [], indent
    for k, item in enumerate(items):
        piece = item + ("," if k + 1 < len(items) else "")
        if len(line) + len(piece) > width and line.strip():
            lines.append(line)
            line = indent
        line += piece
    return "\n".join([*lines, line])
