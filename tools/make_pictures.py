"""Makes the pictures of the documentation: `python tools/make_pictures.py` simulates what docs/simulate.md names.

It needs the extras `check` and `plot` and a Modelica Standard Library, and takes minutes.
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

REPOSITORY = Path(__file__).parents[1]
IMAGES = REPOSITORY / "docs/images"
EXAMPLES = "UrdfSync.Examples"
PICTURES = {
    "six_axis_arm_test": ["--stop", "5"],
    "computed_torque": ["--model", f"{EXAMPLES}.ComputedTorquePackage"],
    "tool_path": ["--model", f"{EXAMPLES}.ToolPathPackage"],
}
"""The arguments of `urdfsync simulate six_axis_arm` for each picture."""


def main() -> None:
    """Make all pictures, or those that the arguments name."""
    for name in sys.argv[1:] or PICTURES:
        command = [sys.executable, "-m", "urdfsync", "simulate", "six_axis_arm", *PICTURES[name]]
        subprocess.run([*command, "--plot", str(IMAGES / f"{name}.svg")], cwd=REPOSITORY, check=True)  # noqa: S603


if __name__ == "__main__":
    main()
