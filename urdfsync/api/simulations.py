"""Simulations, and models as FMU."""

from __future__ import annotations

import importlib.util
import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any, Literal

import msgspec

from urdfsync import config as configuration
from urdfsync.api import Place, load, select_one
from urdfsync.checks.compilers.compiler import Export
from urdfsync.checks.tools import chosen_tools
from urdfsync.config import Config, RobotConfig
from urdfsync.diagnostics import ConfigError
from urdfsync.engine.options import Progress, no_progress
from urdfsync.extras import install_command
from urdfsync.output.console import findings, html
from urdfsync.simulation import run
from urdfsync.simulation.export import Exported, export, is_exported
from urdfsync.simulation.files import check_file, check_outputs, not_writable, write_file, write_outputs
from urdfsync.simulation.fmu import KINDS, WrittenFmu, find_faults, try_out
from urdfsync.simulation.report import fmu_lines, result_lines
from urdfsync.simulation.results import SimulateOptions, SimulateResult

VERSIONS = {"2": "2.0", "3": "3.0"}
EXPORTED = {"me": "me", "cs": "cs", "both": "me_cs"}
"""The kinds of FMUs as users choose them, and as OpenModelica does."""


class Simulation(SimulateResult, frozen=True):
    """A simulation, to look at as well."""

    def _repr_html_(self) -> str:
        return html([*result_lines(self, {}), *findings(self.diagnostics, quiet=False, verbose=False)])


class Fmu(WrittenFmu, frozen=True):
    """An FMU in a file, to look at as well."""

    def _repr_html_(self) -> str:
        return html([*fmu_lines(self), *findings(self.diagnostics, quiet=False, verbose=False)])


def simulate(
    *robots: str,
    config: Place = None,
    model: str = "",
    stop: float | None = None,
    step: float | None = None,
    tolerance: float | None = None,
    method: str = "",
    values: Sequence[str] = (),
    motion: Path | None = None,
    variables: Sequence[str] = (),
    csv: Path | None = None,
    parquet: Path | None = None,
    plot: Path | None = None,
    tool: str | None = None,
    trust: bool = False,
    timeout: float = 600,
    memory: float | None = None,
    wait: float = 60,
    progress: Progress = no_progress,
) -> Simulation:
    """Simulate a robot, as `urdfsync simulate` does, whose options these are; `robots` is one, or none if there is one.

    `values` are `NAME=VALUE`, `motion` is a table of inputs. The result has `series`, times (s) and the values of each
    variable, and `joints`, whose range is held against their limits. Raises UrdfsyncError for whatever is wrong with
    the model, its inputs, the compiler or the files to write.
    """
    loaded = load(config)
    robot = select_one(loaded, robots, "simulate")
    files = {kind: file for kind, file in (("csv", csv), ("parquet", parquet), ("plot", plot)) if file is not None}
    check_outputs(files, _inputs(loaded, robot, motion))
    given = {"model": model, "stop": stop, "step": step, "tolerance": tolerance, "method": method, "motion": motion}
    limits = {"timeout": timeout, "memory": memory, "wait": wait}
    options = _options(loaded, tool, values, trust=trust, variables=tuple(variables), **given, **limits)
    result = run.simulate(loaded, robot, options, progress)
    write_outputs(files, result)
    return Simulation(**msgspec.structs.asdict(result))


def export_fmu(
    *robots: str,
    config: Place = None,
    model: str = "",
    output: Path | None = None,
    fmi: Literal["2", "3"] = "2",
    kind: Literal["me", "cs", "both"] = "both",
    tolerance: float | None = None,
    stop: float | None = None,
    step: float | None = None,
    values: Sequence[str] = (),
    check: bool = False,
    motion: Path | None = None,
    trust: bool = False,
    timeout: float = 600,
    memory: float | None = None,
    wait: float = 60,
    progress: Progress = no_progress,
) -> Fmu:
    """Export a model as FMU, by OpenModelica, as `urdfsync fmu` does, whose options these are.

    The result has the `file`, and with `check` the `trial` in which FMPy ran it. Raises UrdfsyncError for whatever is
    wrong with the model, the compiler or the file.
    """
    loaded = load(config)
    robot = select_one(loaded, robots, "fmu")
    if check and importlib.util.find_spec("fmpy") is None:
        raise ConfigError.of("no-fmpy", "`--check` needs FMPy, which is not installed", hint=install_command("fmu"))
    if output and output.suffix.lower() != ".fmu":
        raise not_writable(output, "an FMU's name ends with .fmu", "name such a file")
    if output:
        check_file(output, _inputs(loaded, robot, motion))
    given = {"model": model, "stop": stop, "step": step, "tolerance": tolerance, "motion": motion}
    options = _options(loaded, "omc", values, trust=trust, timeout=timeout, memory=memory, wait=wait, **given)
    form = Export(VERSIONS[fmi], EXPORTED[kind])
    exported = export(loaded, robot, options, form, progress, for_trial=check)
    file = output or _default_file(exported)
    kinds = [name for name in KINDS if name in form.kind]
    trial = try_out(loaded, robot, options, exported, kinds, progress) if check else None
    write_file(file, exported.content)
    warnings = robot.without_ignored(find_faults(trial, file)) if trial else ()
    return Fmu(robot.name, exported, form, file, trial, warnings)


def _options(config: Config, tool: str | None, values: Sequence[str], *, trust: bool, **given: Any) -> SimulateOptions:
    chosen, *_ = chosen_tools(config, tool, trusted=trust)
    paths = configuration.ros_package_path(os.environ)
    return SimulateOptions(tool=chosen, values=tuple(values), package_paths=paths, **given)


def _inputs(config: Config, robot: RobotConfig, motion: Path | None) -> dict[str, Path]:
    """Return the files that no output may replace, by what they are."""
    files = {"the source of the robot": robot.source, "the configuration": config.file}
    return files | ({"the file with the inputs": motion} if motion else {})


def _default_file(exported: Exported) -> Path:
    """Return the file that has the model's name. Raises OutputError for one that is not an FMU of urdfsync's."""
    file = Path(f"{exported.model.rpartition('.')[2]}.fmu")
    if file.is_symlink() or (file.exists() and not is_exported(file)):
        hint = "name a file with `--output`, this one to replace it"
        raise not_writable(file, "it is there, and urdfsync did not write it", hint)
    return file
