"""One way to measure a child process: wall-clock time, processor time and peak memory."""

from __future__ import annotations

import dataclasses
import enum
import os
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path

_CHILD = Path(__file__).with_name("child.py")


class UnexpectedError(Exception):
    """What was to be measured did not happen."""


class Quantity(enum.Enum):
    """What is compared: its name, its unit, and how many of that unit a second or a byte is."""

    WALL = "wall-clock time", "ms", 1e3
    CPU = "CPU time", "ms", 1e3
    PEAK = "peak memory", "MB", 1e-6
    CREW = "peak memory of the largest worker", "MB", 1e-6

    def __init__(self, title: str, unit: str, factor: float) -> None:
        self.title, self.unit, self.factor = title, unit, factor


@dataclasses.dataclass(frozen=True)
class Cost:
    """What a process took; seconds and bytes."""

    wall: float
    cpu: float = 0.0
    """Of the process and of all that it started."""
    peak: float = 0.0
    """Of the process itself, or of the largest one that it waited for. At least that of the small process that starts
    it, about 12 MB."""
    crew: float = 0.0
    """Of the largest process that outlived it, as workers of a fork server do; 0 if there is none."""

    def of(self, quantity: Quantity) -> float:
        """One of these numbers, in the unit of the quantity."""
        value = {
            Quantity.WALL: self.wall,
            Quantity.CPU: self.cpu,
            Quantity.PEAK: self.peak,
            Quantity.CREW: self.crew,
        }[quantity]
        return value * quantity.factor


def measure(command: Sequence[str], folder: Path, said: str = "") -> Cost:
    """The cost of a process in a folder.

    Raises:
        UnexpectedError: it failed, or does not say `said`, on one of its output streams.
    """
    with tempfile.NamedTemporaryFile() as output:
        watched = [sys.executable, "-I", "-S", str(_CHILD), output.name, *command]
        told = subprocess.run(watched, cwd=folder, env=variables(), check=True, stdout=subprocess.PIPE, text=True)
        code, *costs = map(float, told.stdout.split())
        text = Path(output.name).read_text(errors="replace")
    if code:
        raise UnexpectedError(f"{' '.join(command)} in {folder}: exit code {code:g}\n{text}")
    if said not in text:
        raise UnexpectedError(f"{' '.join(command)} in {folder} does not say {said!r}, but:\n{text}")
    return Cost(*costs)


def run(command: Sequence[str], folder: Path) -> None:
    """Run a process that is not measured. Raises UnexpectedError, with what it said, if it fails."""
    done = subprocess.run(
        command, cwd=folder, check=False, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, env=variables(), text=True
    )
    if done.returncode:
        raise UnexpectedError(f"{' '.join(command)} in {folder}: exit code {done.returncode}\n{done.stdout}")


def variables() -> dict[str, str]:
    """The environment of all processes: what a hook of git or a test has set must not decide."""
    return {name: value for name, value in os.environ.items() if not name.startswith(("GIT_", "PYTHON"))}
