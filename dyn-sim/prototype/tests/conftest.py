"""Makes `prototype` importable from the folder above, as `python -m prototype` does."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2]))
