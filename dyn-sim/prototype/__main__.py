"""python -m prototype INPUT.json OUTPUT.json

Progress on stderr ("progress 0.25"). Exit status: 0, or 1 with one message on stderr, or 2 for wrong arguments.
"""

import sys

from .exchange import BadInput, read, write
from .run import run
from .simulation import StepFailed
from .start import CannotClose


def main(arguments):
    if len(arguments) != 2:
        print("usage: python -m prototype INPUT.json OUTPUT.json", file=sys.stderr)
        return 2
    try:
        write(arguments[1], run(read(arguments[0])))
    except (BadInput, CannotClose, StepFailed) as error:
        print(f"prototype: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
