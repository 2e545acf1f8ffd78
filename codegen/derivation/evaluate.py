"""Evaluates the graph file's functions with Python floats: what the sample outputs in the file come from.

It reads only the file's own rows, so it also proves that they say what CasADi derived (see the tests). Python floats
round as IEEE 754 asks, operation by operation, so the outputs are the same on every machine. Other numbers will do as well, such as
`decimal.Decimal`: `number` makes one of a constant. It needs no package.
"""

import math
import operator


def _sqrt(x):
    return x.sqrt() if hasattr(x, "sqrt") else math.sqrt(x)


_OPERATIONS = {
    "neg": operator.neg,
    "sqrt": _sqrt,
    "add": operator.add,
    "sub": operator.sub,
    "mul": operator.mul,
    "div": operator.truediv,
}


def evaluate_graph(graph: dict, arguments: list[list[float]], number=float) -> dict[str, list[float]]:
    """Outputs of one graph by name."""
    values: list[float] = []
    for operation, *operands in graph["nodes"]:
        if operation == "const":
            values.append(number(operands[0]))
        elif operation == "input":
            values.append(arguments[operands[0]][operands[1]])
        else:
            values.append(_OPERATIONS[operation](*(values[node] for node in operands)))
    return {output["symbol"]: [values[node] for node in output["nodes"]] for output in graph["outputs"]}


def dot(a, b) -> float:
    """a . b from first to last. The built-in sum rounds differently from Python 3.12 on."""
    total = 0
    for x, y in zip(a, b, strict=True):
        total += x * y
    return total


def solve(matrix: list[float], right_hand_side: list[float]) -> list[float]:
    """Gaussian elimination with partial pivoting."""
    n = len(right_hand_side)
    rows = [matrix[n * k:n * (k + 1)] + [right_hand_side[k]] for k in range(n)]
    for k in range(n):
        pivot = max(range(k, n), key=lambda row: abs(rows[row][k]))
        rows[k], rows[pivot] = rows[pivot], rows[k]
        for row in range(k + 1, n):
            factor = rows[row][k] / rows[k][k]
            for column in range(k, n + 1):
                rows[row][column] -= factor * rows[k][column]
    solution = [None] * n
    for k in reversed(range(n)):
        solution[k] = (rows[k][n] - dot(rows[k][k + 1:n], solution[k + 1:])) / rows[k][k]
    return solution


def evaluate(document: dict, function: dict, values: dict[str, list[float]], number=float) -> dict[str, list[float]]:
    """Outputs of a function by name, flat and row-major."""
    symbols = {symbol["name"]: symbol for symbol in document["symbols"]}
    graphs = {graph["name"]: graph for graph in document["graphs"]}
    legs = document["leg_count"]
    known = dict(values)
    for step in function["steps"]:
        if "solve" in step:
            known[step["solve"]] = solve(known[step["matrix"]], known[step["right_hand_side"]])
            continue
        graph = graphs[step["call"]]
        if "over" not in step:
            known.update(evaluate_graph(graph, [known[name] for name in graph["inputs"]], number))
            continue
        results = []
        for leg in range(legs):
            arguments = []
            for name in graph["inputs"]:
                size = len(known[name]) // legs if symbols[name]["per_leg"] else None
                arguments.append(known[name] if size is None else known[name][leg * size:(leg + 1) * size])
            results.append(evaluate_graph(graph, arguments, number))
        for output in graph["outputs"]:
            name = output["symbol"]
            known[name] = [value for result in results for value in result[name]]
    return {name: known[name] for name in function["outputs"]}
