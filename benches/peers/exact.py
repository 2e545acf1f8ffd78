"""Results of the committed graph in decimal arithmetic of fifty digits, to judge rounding errors by.

It reads the graph file and dyn-gen's vectors, of which it takes numbers and states, and evaluates the file's own rows. Every other state is
rounded to single precision before, so that f32 code gets exact inputs too (`single`); a rounded rotation is a rotation to
eight digits only, so such a state is fit for code of the same graph alone.
"""

import argparse
import json
import struct
from decimal import Decimal, getcontext
from pathlib import Path

from derivation.evaluate import evaluate

FUNCTIONS = ("inverse_dynamics", "forward_dynamics", "matrices")
DIGITS = 50


def flat(value) -> list:
    return [element for part in value for element in flat(part)] if isinstance(value, list) else [value]


def single(number: float) -> float:
    return struct.unpack("f", struct.pack("f", number))[0]


def main() -> None:
    parser = argparse.ArgumentParser(prog="python -m peers.exact", description=__doc__)
    parser.add_argument("--graph", type=Path, required=True, help="codegen/graphs/*.json")
    parser.add_argument("--vectors", type=Path, required=True, help="from dyn-gen vectors")
    parser.add_argument("--output", type=Path, required=True, help="file to write")
    options = parser.parse_args()
    getcontext().prec = DIGITS
    document = json.loads(options.graph.read_text(encoding="utf-8"))
    functions = {function["name"]: function for function in document["functions"]}
    vectors = json.loads(options.vectors.read_text(encoding="utf-8"))
    parameters = {name: flat(value) for name, value in vectors["platform"]["parameters"].items()}
    cases = []
    for number, case in enumerate(vectors["cases"]):
        state = {f"{body}_{key}": flat(value) for body in ("base", "platform") for key, value in case[body].items()}
        state |= {key: flat(case[key]) for key in ("actuator_force", "external_wrench", "reference_velocity")}
        if number % 2:
            state = {key: [single(value) for value in values] for key, values in state.items()}
        known = {key: [Decimal(value) for value in values] for key, values in (parameters | state).items()}
        results = {}
        for name in FUNCTIONS:
            outputs = evaluate(document, functions[name], known, Decimal)
            results[name] = [float(value) for output in functions[name]["outputs"] for value in outputs[output]]
        cases.append({"single": bool(number % 2), "state": state, "results": results})
    text = ",\n".join(json.dumps(case, separators=(",", ":")) for case in cases)
    head = f'{{"platform":{json.dumps(vectors["platform"]["name"])},"digits":{DIGITS},"cases":[\n'
    options.output.write_text(f"{head}{text}\n]}}\n", encoding="utf-8")


if __name__ == "__main__":
    main()
