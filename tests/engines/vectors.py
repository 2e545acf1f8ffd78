"""Writes or checks the test vectors: the same states in Pinocchio and in MuJoCo (see README.md)."""

import argparse
import os
import sys
from pathlib import Path

# One thread, set before numpy loads its BLAS: the matrices are small, and sums keep their order.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

DEFAULT_SEED = 2016
DEFAULT_STATES = 20
EPILOG = """\
`cargo xtask vectors` runs this script for all platforms of the workspace, in an environment of its own.

examples:
  cargo run -q -p dyn-platform --example resolve -- platforms/uhp_2016.toml > /tmp/uhp_2016.json
  python tests/engines/vectors.py /tmp/uhp_2016.json --out-dir tests/vectors           write
  python tests/engines/vectors.py /tmp/uhp_2016.json --out-dir tests/vectors --check   compare, write nothing
  python tests/engines/vectors.py /tmp/uhp_2016.json --dry-run --states 2000 --seed 7  long run, write nothing

Needs the packages of tests/engines/requirements.lock:
  python3 -m venv target/venv-engines
  target/venv-engines/bin/pip install --require-hashes -r tests/engines/requirements.lock

Exit status: 0 all agree, 1 a disagreement (platform, case, array and figure are named), 2 unusable input.
"""


def parse(arguments):
    parser = argparse.ArgumentParser(
        description=__doc__, epilog=EPILOG, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument(
        "platforms", nargs="+", type=Path, metavar="PLATFORM.json", help="resolved platform file"
    )
    parser.add_argument(
        "--out-dir", type=Path, metavar="DIR", help="folder of the vector files, NAME.json for each platform"
    )
    parser.add_argument(
        "--states",
        type=int,
        metavar="N",
        help=f"states per platform (default {DEFAULT_STATES}; with --check: as committed)",
    )
    parser.add_argument(
        "--seed",
        type=int,
        default=DEFAULT_SEED,
        help="seed of the states, not negative (default %(default)s)",
    )
    mode = parser.add_mutually_exclusive_group()
    mode.add_argument(
        "--check", action="store_true", help="compute again and compare with the files in DIR, write nothing"
    )
    mode.add_argument(
        "--dry-run",
        action="store_true",
        help="compare the engines only, to 1e-11; needs no DIR, writes nothing",
    )
    options = parser.parse_args(arguments)
    if options.out_dir is None and not options.dry_run:
        parser.error("--out-dir is needed (or --dry-run)")
    if options.seed < 0 or (options.states is not None and options.states < 1):
        parser.error("--seed must not be negative, --states must be at least 1")
    if options.check and options.states is not None:
        parser.error("--check takes the number of states from the committed files: leave out --states")
    if options.states is None:
        options.states = DEFAULT_STATES
    return options


def main(arguments=None):
    options = parse(arguments)
    try:
        import runs
    except ImportError as error:
        say(f"error: {error}\n\n{EPILOG[EPILOG.index('Needs') :]}")
        return 2
    try:
        return runs.run(options)
    except runs.InputError as error:
        say(f"error: {error}")
        return 2
    except runs.Disagreement as error:
        say(f"disagreement: {error}")
        return 1


def say(text):
    print(text, file=sys.stderr, flush=True)


if __name__ == "__main__":
    sys.exit(main())
