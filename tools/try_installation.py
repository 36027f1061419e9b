"""Installs the wheel in empty environments, without extras and with each, and does the README's main job there.

`python tools/try_installation.py PYTHON…` names the interpreters to try, such as the oldest and the newest. It needs
the package index, the packages `build` and `twine`, and takes minutes.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
import tomllib
from collections.abc import Sequence
from pathlib import Path

REPOSITORY = Path(__file__).parents[1]
ARM = REPOSITORY / "modelica/UrdfSync/Resources/robots/six_axis_arm/six_axis_arm.urdf"
OWN = ("test", "dev", "docs")
"""Extras of those who work on urdfsync."""


def run(*command: str | Path, folder: Path = REPOSITORY) -> str:
    """Run a program; returns its output. Raises CalledProcessError."""
    return subprocess.run(command, cwd=folder, check=True, stdout=subprocess.PIPE, text=True).stdout  # noqa: S603


def main(pythons: Sequence[str]) -> None:
    """Try each interpreter with each extra, and print what the environment takes on disk."""
    project = tomllib.loads((REPOSITORY / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    extras = [extra for extra in project["optional-dependencies"] if extra not in OWN]
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        run(sys.executable, "-m", "build", "--outdir", folder)
        run(sys.executable, "-m", "twine", "check", "--strict", *folder.iterdir())
        (wheel,) = folder.glob("*.whl")
        for python in pythons:
            for extra in ("", *extras):
                environment = folder / f"{Path(python).parts[-3]}-{extra}"
                size = try_wheel(python, f"{wheel}[{extra}]" if extra else str(wheel), environment)
                sys.stdout.write(f"{run(python, '--version').strip()}  {extra or 'no extra':<9}  {size:4.0f} MB\n")
                sys.stdout.flush()


def try_wheel(python: str, wheel: str, environment: Path) -> float:
    """Install a wheel in an empty environment, and build a robot with it; returns the size of its packages in MB."""
    run(python, "-m", "venv", "--without-pip", environment)
    interpreter = environment / "bin/python"
    pip = ("-m", "pip", "--python", interpreter, "install", "--quiet", "--no-compile", "--disable-pip-version-check")
    run(python, *pip, wheel)
    run(python, "-m", "pip", "--python", interpreter, "check")
    project = environment / "project"
    project.mkdir()
    for arguments in (["init", ARM], ["build", "--svg"], ["build", "--check"]):
        run(environment / "bin/urdfsync", *arguments, folder=project)
    return sum(file.stat().st_size for file in (environment / "lib").rglob("*") if file.is_file()) / 1e6


if __name__ == "__main__":
    main(sys.argv[1:] or [sys.executable])
