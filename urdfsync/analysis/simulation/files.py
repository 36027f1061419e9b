"""Files that the user asks for: series as CSV, plots. Each file is written as a whole or not at all."""

from __future__ import annotations

import importlib.util
import itertools
import os
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path

from urdfsync.analysis.simulation.outcomes import Study, table
from urdfsync.analysis.simulation.results import SimulateResult
from urdfsync.common import system
from urdfsync.common.diagnostics import ConfigError, OutputError
from urdfsync.common.extras import install_command
from urdfsync.common.files import kind_of, put, shown
from urdfsync.project.config import Config, RobotConfig

PLOTS = (".png", ".svg")


def check_outputs(files: Mapping[str, Path], inputs: Mapping[str, Path]) -> None:
    """Raise an error for a file that can't be written, before the simulation. `inputs` must not be replaced.

    The kinds of `files` are `csv` and `plot`.
    """
    for kind, file in files.items():
        if kind == "plot" and importlib.util.find_spec("matplotlib") is None:
            message = "`--plot` needs matplotlib, which is not installed"
            raise ConfigError.of("no-plot", message, hint=install_command("plot"))
        if kind == "plot" and file.suffix.lower() not in PLOTS:
            raise not_writable(file, f"a plot is one of {', '.join(PLOTS)}", "name a file that ends so")
        check_file(file, inputs)
        if file.exists() and (file.suffix == ".mo" or file.name == "package.order"):
            raise not_writable(file, "a file of a Modelica package has this name", "name another file")
    check_distinct(files)


def check_distinct(files: Mapping[str, Path]) -> None:
    """Raise OutputError if two outputs have the same name."""
    if len({Path(os.path.realpath(file)) for file in files.values()}) < len(files):
        raise not_writable(next(iter(files.values())), "two outputs have this name", "name two files")


def input_files(config: Config, robot: RobotConfig, motion: Path | None) -> dict[str, Path]:
    """Return the files that no output may replace, by their kinds."""
    files = {
        f"the source of robot `{other.name}`": other.source for other in config.robots if other.source != robot.source
    }
    files |= {"the source of the robot": robot.source, "the configuration": config.file}
    return files | ({"the file with the inputs": motion} if motion else {})


def check_file(file: Path, inputs: Mapping[str, Path]) -> None:
    """Raise OutputError for a file that can't be written, or is one of `inputs`."""
    if file.exists() and not file.is_file():
        raise not_writable(file, f"{kind_of(file.stat().st_mode)} is in its place", "name a file")
    if not Path(os.path.realpath(file)).parent.is_dir():
        raise not_writable(file, "there is no such folder", "make it first")
    target = file if file.exists() else Path(os.path.realpath(file)).parent
    if not os.access(target, os.W_OK) or not os.access(Path(os.path.realpath(file)).parent, os.W_OK):
        raise not_writable(file, "the file can't be written: no permission", "name a file elsewhere")
    for what, other in inputs.items():
        if file.exists() and other.exists() and file.samefile(other):
            raise not_writable(file, f"{what} has this name", "name another file")


def default_file(name: str, is_ours: Callable[[Path], bool]) -> Path:
    """Return the file with this name in the working folder. Raises OutputError for a file that is not `is_ours`."""
    file = Path(name)
    if file.is_symlink() or (file.exists() and not is_ours(file)):
        hint = "name a file with `--output`; name this one to replace it"
        raise not_writable(file, "the file exists, and urdfsync did not write it", hint)
    return file


def write_file(file: Path, content: bytes) -> None:
    """Write a file. Raises OutputError."""
    try:
        put(Path(os.path.realpath(file)), content)
    except OSError as error:
        usual = "check that its folder may be written to, and that there is space on the disk"
        hint = system.held_hint(error) or usual
        raise not_writable(file, f"the file can't be written: {error.strerror}", hint) from None


def write_outputs(files: Mapping[str, Path], result: SimulateResult | Study) -> None:
    """Write the files: none, if one of them can't be made. Raises OutputError."""
    contents = {file: _content(kind, file, result) for kind, file in files.items()}
    for file, content in contents.items():
        write_file(file, content)


def _content(kind: str, file: Path, result: SimulateResult | Study) -> bytes:
    if kind == "csv":
        return "".join(table(result) if isinstance(result, Study) else _csv_lines(result)).encode()
    from urdfsync.analysis.simulation.plot import draw, draw_study  # their import takes 0.5 s; matplotlib is an extra

    form = file.suffix.lower().removeprefix(".")
    return draw_study(result, form) if isinstance(result, Study) else draw(result, form)


def _csv_lines(result: SimulateResult) -> Iterator[str]:
    """Yield the lines of a CSV file, with all digits of each number; names with commas are quoted.

    The series of an older version have names such as `robot.elbow.phi@HEAD~1`, and blanks after its end.
    """
    columns = dict(result.series)
    revision = result.against.revision if result.against else ""
    columns |= {f"{name}@{revision}": values for name, values in result.former.items() if name != "time"}
    names = (f'"{name}"' if "," in name else name for name in columns)
    yield ",".join(names) + "\n"
    for row in itertools.islice(itertools.zip_longest(*columns.values()), result.points):
        yield ",".join("" if value is None else repr(value) for value in row) + "\n"


def not_writable(file: Path, message: str, hint: str) -> OutputError:
    """Return the error for a file that can't be written."""
    return OutputError.of("output-not-writable", message, shown(file), hint=hint)
