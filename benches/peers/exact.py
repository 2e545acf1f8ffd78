"""Results of the committed graph in decimal arithmetic of fifty digits, to judge rounding errors by.

It reads the graph file and dyn-gen's vectors, of which it takes numbers and states; needs no package. Every other state is
rounded to single precision before, so that f32 code gets exact inputs too (`single`); a rounded rotation is a rotation to
eight digits only, so such a state is fit for code of the same graph alone.
"""

import argparse
import json
import struct
from decimal import Decimal, getcontext
from pathlib import Path

FUNCTIONS = ("inverse_dynamics", "forward_dynamics", "matrices")
DIGITS = 50


def flat(value) -> list:
    return [element for part in value for element in flat(part)] if isinstance(value, list) else [value]


def single(number: float) -> float:
    return struct.unpack("f", struct.pack("f", number))[0]


def graph_outputs(graph: dict, arguments: list[list[Decimal]]) -> dict[str, list[Decimal]]:
    values: list[Decimal] = []
    for operation, *operands in graph["nodes"]:
        if operation == "const":
            values.append(Decimal(operands[0]))
        elif operation == "input":
            values.append(arguments[operands[0]][operands[1]])
        elif operation == "neg":
            values.append(-values[operands[0]])
        elif operation == "sqrt":
            values.append(values[operands[0]].sqrt())
        else:
            x, y = (values[node] for node in operands)
            values.append({"add": x.__add__, "sub": x.__sub__, "mul": x.__mul__, "div": x.__truediv__}[operation](y))
    return {output["symbol"]: [values[node] for node in output["nodes"]] for output in graph["outputs"]}


def solve(matrix: list[Decimal], right: list[Decimal]) -> list[Decimal]:
    """Gauss-Jordan elimination with partial pivoting."""
    n = len(right)
    rows = [matrix[n * k:n * (k + 1)] + [right[k]] for k in range(n)]
    for k in range(n):
        pivot = max(range(k, n), key=lambda row: abs(rows[row][k]))
        rows[k], rows[pivot] = rows[pivot], rows[k]
        rows[k] = [value / rows[k][k] for value in rows[k]]
        for row in range(n):
            if row != k:
                factor = rows[row][k]
                rows[row] = [value - factor * other for value, other in zip(rows[row], rows[k])]
    return [row[n] for row in rows]


def evaluate(document: dict, name: str, known: dict[str, list[Decimal]]) -> list[Decimal]:
    """All outputs of a function, one after the other."""
    function = next(row for row in document["functions"] if row["name"] == name)
    per_leg = {symbol["name"]: symbol["per_leg"] for symbol in document["symbols"]}
    graphs = {graph["name"]: graph for graph in document["graphs"]}
    legs, known = document["leg_count"], dict(known)
    for step in function["steps"]:
        if "solve" in step:
            known[step["solve"]] = solve(known[step["matrix"]], known[step["right_hand_side"]])
            continue
        graph = graphs[step["call"]]
        if "over" not in step:
            known.update(graph_outputs(graph, [known[name] for name in graph["inputs"]]))
            continue
        results = []
        for leg in range(legs):
            sizes = [len(known[name]) // legs for name in graph["inputs"]]
            results.append(graph_outputs(graph, [
                known[name][leg * size:(leg + 1) * size] if per_leg[name] else known[name]
                for name, size in zip(graph["inputs"], sizes)
            ]))
        known.update({key: [value for result in results for value in result[key]] for key in results[0]})
    return [value for output in function["outputs"] for value in known[output]]


def main() -> None:
    parser = argparse.ArgumentParser(prog="python -m peers.exact", description=__doc__)
    parser.add_argument("--graph", type=Path, required=True, help="codegen/graphs/*.json")
    parser.add_argument("--vectors", type=Path, required=True, help="from dyn-gen vectors")
    parser.add_argument("--output", type=Path, required=True, help="file to write")
    options = parser.parse_args()
    getcontext().prec = DIGITS
    document = json.loads(options.graph.read_text(encoding="utf-8"))
    vectors = json.loads(options.vectors.read_text(encoding="utf-8"))
    parameters = {name: flat(value) for name, value in vectors["platform"]["parameters"].items()}
    cases = []
    for number, case in enumerate(vectors["cases"]):
        state = {f"{body}_{key}": flat(value) for body in ("base", "platform") for key, value in case[body].items()}
        state |= {key: flat(case[key]) for key in ("actuator_force", "external_wrench", "reference_velocity")}
        if number % 2:
            state = {key: [single(value) for value in values] for key, values in state.items()}
        known = {key: [Decimal(value) for value in values] for key, values in (parameters | state).items()}
        results = {name: [float(value) for value in evaluate(document, name, known)] for name in FUNCTIONS}
        cases.append({"single": bool(number % 2), "state": state, "results": results})
    text = ",\n".join(json.dumps(case, separators=(",", ":")) for case in cases)
    head = f'{{"platform":{json.dumps(vectors["platform"]["name"])},"digits":{DIGITS},"cases":[\n'
    options.output.write_text(f"{head}{text}\n]}}\n", encoding="utf-8")


if __name__ == "__main__":
    main()
