"""All benchmarks, by one command.

    python tests/benchmarks [--rounds N] [--peers FOLDER] [--published FOLDER] [NAME …]

Every round takes each measurement once, each round in another order, so that other load on the machine meets all of
them alike; a ratio is the median of those of the single rounds. `--peers` is a folder with the programs of other tools
(ninja, doit, dvc), for example the `bin` of an environment of their own; without it, those on PATH are taken along.
`--published` is the folder of `urdf_to_package.py`; it is run by the `python` among the peers, if there is one, which
has to have the package urdf_parser_py. What is not there is left out, and that is said. Needs a POSIX system.
"""

from __future__ import annotations

import argparse
import dataclasses
import shutil
import signal
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import TextIO

# not this folder: its names are those of other packages, too; and what is measured is the tree that it is part of
sys.path[:1] = [str(folder) for folder in Path(__file__).resolve().parents[1:3]]

from rich.console import Console  # noqa: E402

from benchmarks import build, check, hook, machine, noop, published, scale, tables, watch  # noqa: E402
from benchmarks.study import Figures, Finding, Study, find, measured  # noqa: E402
from benchmarks.tools import Tools, install, search_path  # noqa: E402

BENCHMARKS = {module.__name__.rpartition(".")[2]: module for module in (noop, build, scale, watch, hook, check)}
_WIDTH = 200
"""Characters of a line where there is no terminal."""


def main() -> None:
    """Measure, print a table of each study, and at last one of all bars."""
    options = _options()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit("ended"))  # so that daemons end and folders are removed
    out, aside, left_out = _console(sys.stdout), _console(sys.stderr), dict[str, None]()
    found: list[tuple[str, Finding]] = []
    with tempfile.TemporaryDirectory() as name, aside.status("preparing") as status:
        tools = _tools(Path(name), options, left_out)
        out.out("".join(f"- {line}\n" for line in machine.described(tools)), highlight=False)
        for chosen in dict.fromkeys(options.names or BENCHMARKS):
            status.update(f"preparing {chosen}")
            folder = tools.folder / chosen
            folder.mkdir()
            for study in BENCHMARKS[chosen].studies(dataclasses.replace(tools, folder=folder)):
                findings = _findings(study, options, status.update)
                found += [(study.title, finding) for finding in findings]
                grid = tables.figures(study) if isinstance(study, Figures) else tables.pairs(study.title, findings)
                _print(out, grid, options)
                status.update(f"preparing more of {chosen}")
    _print(out, tables.bars(found), options)
    for line in left_out:
        aside.print(line, markup=False)


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="benchmarks", description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"only these of {', '.join(BENCHMARKS)}")
    parser.add_argument("--rounds", type=int, default=15, help="how often to measure everything (default: 15)")
    slow = "and so often what takes minutes (default: 3)"
    parser.add_argument("--slow-rounds", type=int, default=3, metavar="ROUNDS", help=slow)
    parser.add_argument("--peers", type=Path, metavar="FOLDER", help="the folder of the other tools' programs")
    parser.add_argument("--published", type=Path, metavar="FOLDER", help="the folder of urdf_to_package.py")
    parser.add_argument("--markdown", action="store_true", help="print tables to paste into a page")
    parser.add_argument("--idle", type=float, default=60, metavar="S", help="watch: seconds to idle (default: 60)")
    rebuilds = "watch: so many, to see how memory grows (default: 500)"
    parser.add_argument("--rebuilds", type=int, default=500, metavar="N", help=rebuilds)
    options = parser.parse_args()
    if unknown := set(options.names) - set(BENCHMARKS):
        parser.error(f"no such benchmark: {', '.join(sorted(unknown))}")
    if min(options.rounds, options.slow_rounds) < 1:
        parser.error("at least one round is needed")
    return options


def _tools(folder: Path, options: argparse.Namespace, left_out: dict[str, None]) -> Tools:
    peers = options.peers.absolute() if options.peers else None
    python = peers and shutil.which("python", path=str(peers))
    other = published.find(options.published, python or sys.executable, left_out.setdefault)
    scripts = install(folder / "environment")
    return Tools(folder, scripts, search_path(peers), other, left_out.setdefault, options.idle, options.rebuilds)


def _findings(study: Study | Figures, options: argparse.Namespace, tell: Callable[[str], None]) -> list[Finding]:
    """Measure what has to be measured."""
    if isinstance(study, Figures):
        return []
    rounds = measured(study, options.rounds, options.slow_rounds, tell)
    return [found for row in study.rows if (found := find(row, rounds)) is not None]


def _print(out: Console, grid: tables.Grid, options: argparse.Namespace) -> None:
    if options.markdown:
        out.out(tables.markdown(grid), highlight=False)
    elif grid.rows:
        out.print(tables.table(grid))


def _console(stream: TextIO) -> Console:
    return Console(file=stream, width=None if stream.isatty() else _WIDTH)


if __name__ == "__main__":
    main()
