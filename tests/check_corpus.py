"""Checks a folder of URDF files as `urdfsync check --physics` does, and prints a table.

`python tests/check_corpus.py [FOLDER] [--only TEXT …] [--approach record] [--timeout S] [--jobs N]` takes all `*.urdf`
below the folder, the public corpus if none is named; `--only` those with one of the texts in their path. Stationary or
mobile is as `init` proposes. Exits with 1 if anything differs or fails that urdfsync can read.
"""

from __future__ import annotations

import argparse
import datetime
import importlib.metadata
import os
import platform
import sys
import tempfile
from collections.abc import Iterator, Sequence
from pathlib import Path

from support.corpus import FOLDER

import urdfsync
from urdfsync import config, registry
from urdfsync.check import libraries, run
from urdfsync.check.results import EFFORTS, MASSES, POSES, CheckOptions, CheckResult, largest
from urdfsync.commands import init
from urdfsync.diagnostics import SourceError
from urdfsync.domain import Deviation, Quantity

HEADER = (
    *("file", "base", "links", "axes", "models", "equations = unknowns", "pose error", "effort error", "mass error"),
    *("s", "MB", "result"),
)


def main(arguments: Sequence[str]) -> int:
    """Print one row per file, as soon as it is known."""
    options = _options(arguments)
    files = [file for file in sorted(options.folder.rglob("*.urdf")) if file.is_file()]
    files = [file for file in files if not options.only or any(text in str(file) for text in options.only)]
    print(_versions())  # noqa: T201
    _row(HEADER)
    _row(["---"] * len(HEADER))
    with tempfile.TemporaryDirectory() as folder:
        return _check(files, options, Path(folder))


def _options(arguments: Sequence[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", nargs="?", type=Path, default=FOLDER / "robots")
    parser.add_argument("--only", nargs="*", default=[], metavar="TEXT")
    parser.add_argument("--approach", choices=("package", "record"), default="package")
    parser.add_argument("--timeout", type=float, default=1800.0, metavar="S")
    parser.add_argument("--jobs", type=int, metavar="N")
    return parser.parse_args(arguments)


def _check(files: Sequence[Path], options: argparse.Namespace, folder: Path) -> int:
    """Check files in a project in `folder`."""
    readable = [file for file in files if not _refused(file, options.folder, folder)]
    if not readable:
        return 0
    domain, file = registry.domain("urdf"), folder / config.FILE_NAME
    guesses, _ = init.guess_robots(domain, folder, readable)
    text = init.configuration_text(domain, guesses)
    file.write_text(text.replace("[defaults]\n", f'[defaults]\napproach = ["{options.approach}"]\n'))
    configuration = config.load(file)
    check_options = CheckOptions(physics=True, timeout=options.timeout, jobs=options.jobs)
    bases = {guess.name: str(next((o.value for o in guess.options if o.option == "base"), "")) for guess in guesses}
    names = {robot.name: robot.source for robot in configuration.robots}
    results = []
    for result in run.check_robots(configuration, configuration.robots, check_options, lambda *_: None):
        name = names[result.robot].relative_to(options.folder.absolute()).as_posix()
        _row([name, bases[result.robot], *_cells(result)])
        results.append(result)
    return int(not all(_agrees(result) for result in results))


def _agrees(result: CheckResult) -> bool:
    """Whether the package compiles and is the robot; that it is not on disk does not matter here."""
    return not result.failed and not result.gaps and result.deviations is not None and not result.differs


def _refused(file: Path, root: Path, folder: Path) -> bool:
    """Whether a file has errors; if so its row says which."""
    try:
        init.guess_robots(registry.domain("urdf"), folder, [file])
    except SourceError as error:
        codes = ", ".join(sorted({found.code for found in error.diagnostics}))
        _row([file.relative_to(root).as_posix(), *[""] * (len(HEADER) - 2), f"refused: {codes}"])
        return True
    return False


def _cells(result: CheckResult) -> Iterator[str]:
    found = result.deviations or ()
    yield str(sum(one.quantity is Quantity.POSITION for one in found)) if found else ""
    yield (
        str(sum(one.quantity is Quantity.EFFORT and one.element.startswith("joint") for one in found)) if found else ""
    )
    yield str(len(result.compiled))
    yield f"{max((one.unknowns for one in result.compiled), default=0):,}"
    for quantities in (POSES, EFFORTS, MASSES):
        yield _error(largest(found, quantities))
    yield f"{result.seconds:.0f}"
    yield f"{result.megabytes:.0f}"
    said = [one.message for one in result.diagnostics if one.severity == "error"]
    yield "; ".join(["agrees" if _agrees(result) else "wrong", *said, *result.gaps, *result.notes])


def _error(worst: Deviation | None) -> str:
    return "" if worst is None else f"{worst.relative:.0e}"


def _row(cells: Sequence[str]) -> None:
    print(f"| {' | '.join(cells)} |", flush=True)  # noqa: T201


def _versions() -> str:
    packages = ", ".join(f"{name} {importlib.metadata.version(name)}" for name in ("rumoca", "pin"))
    standard = ".".join(map(str, libraries.find_standard_library(os.environ).version))
    today = datetime.datetime.now(tz=datetime.UTC).date()
    python = platform.python_version()
    return (
        f"{today}; urdfsync {urdfsync.__version__}, {packages}, Modelica Standard Library {standard}, Python {python}\n"
    )


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
