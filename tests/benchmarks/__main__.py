"""All benchmarks, by one command.

    python tests/benchmarks [--rounds N] [--peers FOLDER] [noop | build | hook | watch | check …]

Every round takes each measurement once, in turn, so that other load on the machine meets all of them alike; a ratio
is the median of those of the single rounds. `--peers` is a folder with the programs of other tools (ninja, doit, dvc),
for example the `bin` of an environment of their own; without it, those on PATH are taken along.
"""

from __future__ import annotations

import argparse
import os
import platform
import subprocess
import sys
import tempfile
from pathlib import Path

FOLDER = Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent))

from rich.console import Console  # noqa: E402
from rich.progress import track  # noqa: E402
from support.timing import comparison  # noqa: E402

from benchmarks import noop  # noqa: E402

SCRIPTS = {name: f"bench_{name}.py" for name in ("build", "hook", "watch", "check")}
"""Benchmarks that print tables of their own."""


def main() -> None:
    """Measure and print tables."""
    parser = argparse.ArgumentParser(prog="benchmarks", description=__doc__.partition("\n")[0])
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"only these of noop, {', '.join(SCRIPTS)}")
    parser.add_argument("--rounds", type=int, default=15, help="how often to measure everything (default: 15)")
    parser.add_argument("--peers", type=Path, help="the folder of the other tools' programs")
    options = parser.parse_args()
    names = options.names or ["noop", *SCRIPTS]
    if unknown := set(names) - {"noop", *SCRIPTS}:
        parser.error(f"no such benchmark: {', '.join(sorted(unknown))}")
    console = Console(width=None if sys.stdout.isatty() else 120)
    console.print(f"Python {platform.python_version()}, {platform.platform()}, {os.cpu_count()} cores")
    if "noop" in names:
        _measure(console, options.rounds, options.peers)
    for name in names:
        if name in SCRIPTS:
            subprocess.run([sys.executable, FOLDER / SCRIPTS[name]], check=True)


def _measure(console: Console, count: int, peers: Path | None) -> None:
    with tempfile.TemporaryDirectory() as folder:
        with console.status("preparing"):
            measurements = noop.prepare(Path(folder), peers.absolute() if peers else None)
        rounds = [
            {label: measure() for label, measure in measurements.items()}
            for _ in track(range(count + 1), "measuring", console=console, transient=True)
        ]
    console.print(comparison("nothing to do", rounds[1:], noop.rows(list(measurements))))  # the first fills caches


if __name__ == "__main__":
    main()
