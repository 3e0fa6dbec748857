"""Makes the tools of the manual and of the notebooks importable."""

import sys
from pathlib import Path

for folder in ("docs", "notebooks"):
    sys.path.insert(0, str(Path(__file__).parents[1] / folder))
