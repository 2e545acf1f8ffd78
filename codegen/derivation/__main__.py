"""Derives the equations and writes the graph file, or compares it with the one that is there."""

import argparse
import os
import sys
import tempfile
from pathlib import Path

from .evaluate import evaluate
from .export import DerivationError, build, to_text
from .functions import functions
from .legs import LEG_TYPES
from .sample import uhp_sample
from .symbols import DYNAMICS, INPUTS, LEG_INTERFACE, MOTION, OUTPUTS, PLATFORM_PARAMETERS, UHP_INTERMEDIATES


def document(leg_type: str) -> dict:
    """The whole graph file of a leg type as plain data."""
    leg = LEG_TYPES[leg_type]
    symbols = [
        *INPUTS, *leg.PARAMETERS, *PLATFORM_PARAMETERS, *MOTION, *LEG_INTERFACE, *UHP_INTERMEDIATES, *DYNAMICS, *OUTPUTS,
    ]
    result = build(leg_type, symbols, functions(leg))
    sample = uhp_sample()
    for function in result["functions"]:
        function["sample_outputs"] = evaluate(result, function, sample)
    result["sample"] = sample
    return result


def write_atomically(path: Path, text: str) -> None:
    """Writes beside the target and renames, so that the target is whole at every moment."""
    handle, temporary = tempfile.mkstemp(dir=path.parent, prefix=path.name, suffix=".tmp")
    try:
        with os.fdopen(handle, "w", encoding="utf-8", newline="\n") as file:
            file.write(text)
        os.chmod(temporary, 0o644)
        os.replace(temporary, path)
    except BaseException:
        os.unlink(temporary)
        raise


def main() -> int:
    parser = argparse.ArgumentParser(prog="python -m derivation", description=__doc__)
    parser.add_argument("--leg-type", choices=sorted(LEG_TYPES), default="uhp")
    parser.add_argument("--output", type=Path, required=True, help="graph file")
    parser.add_argument("--check", action="store_true", help="compare only; exit code 1 where the file differs")
    options = parser.parse_args()
    try:
        text = to_text(document(options.leg_type))
    except DerivationError as error:
        print(f"derivation failed: {error}", file=sys.stderr)
        return 2
    if options.check:
        same = options.output.exists() and options.output.read_text(encoding="utf-8") == text
        if not same:
            print(f"{options.output} is not what the derivation gives", file=sys.stderr)
        return 0 if same else 1
    write_atomically(options.output, text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
