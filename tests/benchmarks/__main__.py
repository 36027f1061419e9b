"""All benchmarks, by one command.

    python tests/benchmarks [--rounds N] [--published FOLDER [--python PYTHON]] [NAME …]

Each pair of measurements is taken in turn, in random order; a figure is the median over the rounds of the figures of
the single rounds. `--published` is the folder of `urdf_to_package.py`; `--python` runs it and has the package
urdf_parser_py. Without it, rows beside the published tool are left out. Needs a POSIX system.
"""

from __future__ import annotations

import argparse
import os
import platform
import signal
import statistics
import subprocess
import sys
import sysconfig
import tempfile
import venv
import zipfile
from pathlib import Path

# not this folder: its names are those of other packages, too; and what is measured is the tree that it is part of
sys.path[:1] = [str(folder) for folder in Path(__file__).resolve().parents[1:3]]

from support.corpus import REPOSITORY  # noqa: E402

from benchmarks.measuring import Result, compare  # noqa: E402
from benchmarks.published import Published  # noqa: E402
from benchmarks.rows import TABLES, Tools  # noqa: E402

_HEADINGS = ("what", "against", "at most", "measured", "spread", "cost", "cost of the other", "pairs")
_SCRIPTS = {"empty": "benchmark:main", "urdfsync": "urdfsync.__main__:main"}


def main() -> None:
    """Measure, and print one table, row by row; what does not meet its bar stands between asterisks."""
    options = _options()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit("ended"))  # so that daemons end and folders are removed
    published = None
    if options.published:
        published = Published(options.python, options.published.absolute() / "urdf_to_package.py")
    processor, version = platform.processor() or platform.machine(), platform.python_version()
    sys.stdout.write(f"{processor}, {os.cpu_count()} cores, Python {version}\n\n")
    _print([_HEADINGS, tuple("---" for _ in _HEADINGS)])
    with tempfile.TemporaryDirectory() as name:
        scripts = _install(Path(name) / "environment")
        for chosen in options.names or TABLES:
            title, pairs = TABLES[chosen]
            folder = Path(name) / chosen
            folder.mkdir()
            for pair in pairs(Tools(folder, scripts, published)):
                _print(_rows(title, compare(pair, options.slow_rounds if pair.is_slow else options.rounds)))


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="benchmarks", description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"only these of {', '.join(TABLES)}")
    parser.add_argument("--rounds", type=int, default=15, help="pairs to measure (default: 15)")
    parser.add_argument("--slow-rounds", type=int, default=3, metavar="N", help="pairs that take minutes (default: 3)")
    parser.add_argument("--published", type=Path, metavar="FOLDER", help="the folder of urdf_to_package.py")
    parser.add_argument("--python", default=sys.executable, help="the Python that runs it (default: this one)")
    options = parser.parse_args()
    if unknown := set(options.names) - set(TABLES):
        parser.error(f"no such benchmark: {', '.join(sorted(unknown))}")
    return options


def _install(folder: Path) -> Path:
    """Make an environment with the console scripts, which sees the packages of this one; return the scripts' folder.

    pip writes the scripts, so that they are those that users have.
    """
    venv.create(folder, symlinks=True)
    scripts = folder / "bin"
    python = str(scripts / "python")
    asked = [python, "-c", "import sysconfig; print(sysconfig.get_path('purelib'))"]
    libraries = Path(subprocess.run(asked, check=True, capture_output=True, text=True).stdout.strip())
    (libraries / "benchmark.pth").write_text(f"{REPOSITORY}\n{sysconfig.get_path('purelib')}\n")
    wheel = folder / "benchmark-1-py3-none-any.whl"
    _write_wheel(wheel)
    command = [sys.executable, "-m", "pip", "-q", "--python", python, "install", "--no-deps", "--no-index", str(wheel)]
    subprocess.run(command, check=True)
    return scripts


def _write_wheel(file: Path) -> None:
    """Write a wheel that has nothing but a module and the console scripts."""
    about = "benchmark-1.dist-info"
    scripts = "".join(f"{name} = {entry}\n" for name, entry in _SCRIPTS.items())
    contents = {
        "benchmark.py": "def main():\n    return 0\n",
        f"{about}/METADATA": "Metadata-Version: 2.1\nName: benchmark\nVersion: 1\n",
        f"{about}/WHEEL": "Wheel-Version: 1.0\nGenerator: by hand\nRoot-Is-Purelib: true\nTag: py3-none-any\n",
        f"{about}/entry_points.txt": f"[console_scripts]\n{scripts}",
    }
    contents[f"{about}/RECORD"] = "".join(f"{name},,\n" for name in (*contents, f"{about}/RECORD"))
    with zipfile.ZipFile(file, "w") as archive:
        for name, text in contents.items():
            archive.writestr(name, text)


def _rows(title: str, result: Result) -> list[tuple[str, ...]]:
    """The lines of the table for one pair, in the order of `_HEADINGS`."""
    pair, lines = result.pair, []
    for reading, values in zip(pair.readings, result.values, strict=True):
        median = statistics.median(values)
        bar = "" if reading.at_most is None else f"{reading.at_most:g}"
        mark = "**" if reading.at_most is not None and median > reading.at_most else ""
        what = f"{title}: {pair.what}" + (f", {reading.what}" if reading.what else "")
        spread = f"{min(values):.3g} to {max(values):.3g}"
        costs = [f"{cost.wall * 1e3:,.0f} ms" for cost in (result.mine, result.other)]
        if reading.what == "peak memory":
            costs = [f"{cost.peak / 1e6:,.0f} MB" for cost in (result.mine, result.other)]
        measured = f"{mark}{median:.3g}{mark}"
        lines.append((what, pair.against, bar, measured, spread, *costs, str(len(values))))
    return lines


def _print(rows: list[tuple[str, ...]]) -> None:
    sys.stdout.write("".join(f"| {' | '.join(row)} |\n" for row in rows))
    sys.stdout.flush()


if __name__ == "__main__":
    main()
