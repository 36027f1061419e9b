"""All checks of the project, as CI runs them: `python -m tests [pytest arguments]`."""

import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]

CHECKS = {
    "lint": ["ruff", "check", "."],
    "format": ["ruff", "format", "--check", "."],
    "types": ["mypy"],
    "examples in step": ["urdfsync", "build", "--check"],
    # one more process than cores, since those that watch folders mostly wait
    "tests": ["pytest", "-n", str((os.cpu_count() or 1) + 1), "-m", "not large"],
}


def main() -> int:
    """Run every check, even after one has failed; the exit code is 1 if any did."""
    failed = []
    for name, (module, *arguments) in CHECKS.items():
        print(f"== {name}", flush=True)  # noqa: T201
        extra = sys.argv[1:] if module == "pytest" else []
        if subprocess.run([sys.executable, "-m", module, *arguments, *extra], cwd=ROOT, check=False).returncode:
            failed.append(name)
    print(f"failed: {', '.join(failed)}" if failed else "all checks passed", flush=True)  # noqa: T201
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
