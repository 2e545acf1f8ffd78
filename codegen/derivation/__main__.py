"""Derives the equations of every leg type and writes the graph files, or compares them with those that are there."""

import argparse
import os
import sys
import tempfile
from pathlib import Path

from .evaluate import evaluate
from .export import DerivationError, build, to_text
from .functions import functions
from .legs import LEG_TYPES
from .sample import sample
from .symbols import symbols_of


def document(leg_type: str) -> dict:
    """The whole graph file of a leg type as plain data."""
    leg = LEG_TYPES[leg_type]
    result = build(leg_type, symbols_of(leg), functions(leg))
    numbers = sample(leg_type)
    for function in result["functions"]:
        function["sample_outputs"] = evaluate(result, function, numbers)
    result["sample"] = numbers
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
    parser.add_argument("--folder", type=Path, required=True, help="folder of the graph files, LEG_TYPE.json each")
    parser.add_argument("--check", action="store_true", help="compare only; exit code 1 where a file differs")
    options = parser.parse_args()
    try:
        # Everything is derived before anything is written.
        texts = {options.folder / f"{leg_type}.json": to_text(document(leg_type)) for leg_type in LEG_TYPES}
    except DerivationError as error:
        print(f"derivation failed: {error}", file=sys.stderr)
        return 2
    if options.check:
        changed = [path for path, text in texts.items() if not _holds(path, text)]
        for path in changed:
            print(f"{path} is not what the derivation gives", file=sys.stderr)
        return 1 if changed else 0
    for path, text in texts.items():
        write_atomically(path, text)
    return 0


def _holds(path: Path, text: str) -> bool:
    return path.exists() and path.read_text(encoding="utf-8") == text


if __name__ == "__main__":
    sys.exit(main())
