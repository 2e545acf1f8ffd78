"""Makes `derivation` importable from the folder above, as `python -m derivation` does."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent.parent))
