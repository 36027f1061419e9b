"""The functions behind the commands, for scripts and notebooks: `urdfsync.build` and further functions (docs/api.md).

They print nothing, and raise the errors of the commands. Each function imports its own modules, so that builds are
quick: loading the checks takes 100 ms, the merge 20 ms.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias, TypeVar

import msgspec

from urdfsync.common.diagnostics import ConfigError, Diagnostic, Severity
from urdfsync.common.diagnostics import UrdfsyncError as UrdfsyncError
from urdfsync.common.files import shown
from urdfsync.domain import Target, Version
from urdfsync.engine.build import build as build_robots
from urdfsync.engine.options import BuildOptions, Progress, no_progress
from urdfsync.engine.result import Result
from urdfsync.modelica.names import class_name, is_class_name
from urdfsync.output.build_section import build_lines
from urdfsync.output.console import StyledLine, findings, html, line
from urdfsync.output.terminal import text
from urdfsync.project import config as configuration
from urdfsync.project.config import Config, RobotConfig
from urdfsync.project.config import library_folder as library_folder

if TYPE_CHECKING:
    from urdfsync.analysis.checks.results import CheckResult
    from urdfsync.analysis.identification.report import IdentificationDisplay
    from urdfsync.analysis.identification.results import Excitation
    from urdfsync.analysis.simulation.report import SimulationDisplay, StudyDisplay
    from urdfsync.analysis.versions.comparison import Comparison
    from urdfsync.engine.edits import RobotEdits

R = TypeVar("R", bound="Result | Comparison | RobotEdits | CheckResult")
Place: TypeAlias = Config | Path | str | None
"""A configuration, or its file; None for the nearest `urdfsync.toml` in the working folder or above."""


class Results(list[R]):
    """The results of a call, one for each robot, in the order of the configuration.

    `str` and notebooks show the results as the command does.
    """

    def __init__(self, results: Iterable[R], lines: Callable[[R], Iterable[StyledLine]]) -> None:
        """`lines` returns the text of a result."""
        super().__init__(results)
        self._lines = lines

    def __str__(self) -> str:
        return "\n".join(map(str, self._shown()))

    def _repr_html_(self) -> str:
        return html(self._shown())

    def _shown(self) -> Iterator[StyledLine]:
        for result in self:
            yield from (*findings(result.diagnostics), *self._lines(result))


class WholeRecord(msgspec.Struct, frozen=True):
    """A whole robot as one record of Modelica, in the package `within`; empty for no package."""

    KEYS = ("name", "within", "text", "file", "is_written")

    text: str
    name: str
    within: str
    diagnostics: tuple[Diagnostic, ...]
    file: Path | None = None
    """The file of `urdfsync record --output`."""
    is_written: bool = False
    """Whether the file was written; False if the file already had this text."""

    def _repr_html_(self) -> str:
        return html([*findings(self.diagnostics), *(line((text, "")) for text in self.text.splitlines())])


def load(config: Place = None) -> Config:
    """Return the configuration in a file; return a loaded configuration as it is.

    Its field `robots` has the robots with names, sources and packages. Raises ConfigError with all faults of the file.
    """
    if isinstance(config, Config):
        return config
    return configuration.load(Path(config) if config else configuration.find(configuration.working_folder()))


def build(*robots: str, config: Place = None, merge: bool = False, **given: Any) -> Results[Result]:
    """Bring packages in step with their sources, as `urdfsync build` does.

    `robots` are names, sources or outputs; without any, all robots are built. With `merge`, changes are merged into
    edited files. `given` are fields of `BuildOptions`, such as `dry` for a dry run. A robot that can't be built has
    `failed` and `diagnostics`; the others are built. Raises UrdfsyncError for a bad configuration, and for an unknown
    robot.
    """
    loaded = load(config)
    built = build_and_check(loaded, loaded.select(robots), BuildOptions(merges=merge, **given))
    return Results(built, build_lines)


def build_and_check(config: Config, robots: Sequence[RobotConfig], options: BuildOptions) -> Iterator[Result]:
    """Build robots, and check the packages of those with `on_build = "check"`; a dry run checks nothing."""
    results = build_robots(config, robots, options)
    if options.dry or not any(robot.on_build == "check" for robot in robots):
        return results
    from urdfsync.analysis.checks import run

    return run.check_builds(config, options, results)


def status(*robots: str, **given: Any) -> Results[Result]:
    """Return the results of a `build` that writes nothing; `action.status` tells the state of each file.

    No `command` runs; `stale` names its changed inputs.
    """
    from urdfsync.output.status import status_section

    return Results(build(*robots, dry=True, **given), lambda result: text(status_section(result)))


def diff(*sources: str, against: str | None = None, config: Place = None, **given: Any) -> Results[Comparison]:
    """Return the changes of sources since the last build, or since the version `against`: a git revision, else a file.

    `sources` are files or robots; without any, all sources are compared. Of two files that are not both sources of
    robots, the motion is compared, the first as the older version. Comparing a file with `against` needs no
    configuration. Raises UrdfsyncError if there is nothing to compare. If a version can't be read, the `result` of its
    comparison has `failed`.
    """
    from urdfsync.analysis.versions.report import to_section

    compared = compare(sources, against, config, BuildOptions(**given))
    return Results(compared, lambda each: text(to_section(each, verbose=False)))


def compare(sources: Sequence[str], against: str | None, config: Place, options: BuildOptions) -> Iterator[Comparison]:
    """Yield what `diff` returns, each comparison as soon as it is known."""
    from urdfsync.analysis.versions import comparison

    folder = configuration.working_folder()
    is_near = any((place / configuration.FILE_NAME).is_file() for place in (folder, *folder.parents))
    loaded = load(config) if is_near or config or not sources else None
    older = comparison.older_of_pair(sources, loaded, folder) if against is None else None
    chosen_sources, other = (sources[1:], older) if older else (sources, against)
    for known, chosen in list(comparison.select_sources(chosen_sources, other, loaded, folder)):
        yield from comparison.compare_sources(chosen, other, known, options, folder, is_pair=older is not None)


def edits(*paths: str, config: Place = None, **given: Any) -> Results[RobotEdits]:
    """Return the user's edits in packages: all edits, or those in `paths`, which are robots, files or folders.

    Raises ConfigError for a path that belongs to no robot.
    """
    from urdfsync.engine.edits import find_edits
    from urdfsync.output.edits import to_section

    loaded, options = load(config), BuildOptions(dry=True, **given)
    return Results(find_edits(paths, loaded, options), lambda each: text(to_section(each, verbose=False)))


def check(
    *robots: str,
    config: Place = None,
    tool: str | None = None,
    trusted: bool = False,
    progress: Progress = no_progress,
    **given: Any,
) -> Results[CheckResult]:
    """Check the packages on disk, as `urdfsync check` does; `result.status` is the verdict.

    `given` are fields of `CheckOptions`, such as `physics`. Raises UrdfsyncError for a bad configuration, an unknown
    robot, an untrusted compiler, and a cache that can't be written.
    """
    from urdfsync.analysis.checks import compilers, run
    from urdfsync.analysis.checks.report import to_section
    from urdfsync.analysis.checks.results import CheckOptions

    loaded = load(config)
    options = CheckOptions(tools=compilers.choose(loaded, tool, trusted=trusted), **given)
    checked = run.check_robots(loaded, loaded.select(robots), options, progress)
    return Results(checked, lambda result: text(to_section(result, verbose=False)))


def simulate(
    *robots: str,
    config: Place = None,
    files: Mapping[str, Path] | None = None,
    tool: str | None = None,
    trusted: bool = False,
    progress: Progress = no_progress,
    **given: Any,
) -> SimulationDisplay:
    """Simulate a robot, as `urdfsync simulate` does. Without `robots`, the configuration must have only one robot.

    `given` are fields of `SimulateOptions`, such as `model` and `stop` (s). The result has `series` (times in s, and
    the values of each variable) and `joints` (with ranges and limits), and the differences from a revision `against`.
    It writes `files`: `csv` or `plot`. Raises UrdfsyncError for faults of the model, its inputs, the compiler or files.
    """
    from urdfsync.analysis.checks import compilers
    from urdfsync.analysis.simulation import run
    from urdfsync.analysis.simulation.files import check_outputs, input_files, write_outputs
    from urdfsync.analysis.simulation.report import SimulationDisplay
    from urdfsync.analysis.simulation.results import SimulateOptions

    loaded, files = load(config), files or {}
    robot = loaded.select_one(robots, "simulate", given.get("model", ""))
    check_outputs(files, input_files(loaded, robot, given.get("motion")))
    chosen, *_ = compilers.choose(loaded, tool, trusted=trusted)
    options = SimulateOptions(tool=chosen, **given)
    if options.against is not None:
        from urdfsync.analysis.simulation.against import simulate_against  # takes 60 ms with libgit2

        result = simulate_against(loaded, robot, options, progress)
    else:
        result = run.simulate(loaded, robot, options, progress)
    write_outputs(files, result)
    return SimulationDisplay(**msgspec.structs.asdict(result) | {"files": files})


def vary(
    *robots: str,
    config: Place = None,
    files: Mapping[str, Path] | None = None,
    tool: str | None = None,
    trusted: bool = False,
    progress: Progress = no_progress,
    **given: Any,
) -> StudyDisplay:
    """Simulate many cases of a robot, as `urdfsync simulate --vary` does.

    `given` are fields of `VaryOptions`: `vary` has the varied parameters, `NAME=SPEC`. The result has `cases`,
    `summaries` and `worst`. It writes `files`: `csv` (a row for each case) or `plot`. Raises UrdfsyncError as
    `simulate` does; a case that fails raises nothing.
    """
    from urdfsync.analysis.checks import compilers
    from urdfsync.analysis.simulation import vary as cases
    from urdfsync.analysis.simulation.files import check_outputs, input_files, write_outputs
    from urdfsync.analysis.simulation.report import StudyDisplay
    from urdfsync.analysis.simulation.results import VaryOptions

    loaded, files = load(config), files or {}
    robot = loaded.select_one(robots, "simulate", given.get("model", ""))
    inputs = input_files(loaded, robot, given.get("motion"))
    if tables := [Path(name) for name in given.get("vary", ()) if "=" not in name]:
        inputs["the file with the cases"] = tables[0]
    check_outputs(files, inputs)
    chosen, *_ = compilers.choose(loaded, tool, trusted=trusted)
    study = cases.vary(loaded, robot, VaryOptions(tool=chosen, **given), progress)
    if "plot" in files and study.worst is None:
        message = "all cases failed, so there is nothing to draw"
        undrawn = Diagnostic(Severity.WARNING, "no-plot", message, shown(files["plot"]))
        study = msgspec.structs.replace(study, diagnostics=robot.without_ignored([*study.diagnostics, undrawn]))
        files = {kind: file for kind, file in files.items() if kind != "plot"}
    write_outputs(files, study)
    return StudyDisplay(**msgspec.structs.asdict(study) | {"files": files})


def identify(
    *robots: str,
    log: Path | str,
    config: Place = None,
    write: bool = False,
    files: Mapping[str, Path] | None = None,
    progress: Progress = no_progress,
    **given: Any,
) -> IdentificationDisplay:
    """Fit the records of a robot to a log, as `urdfsync identify` does; with `write`, write them.

    `given` are fields of `IdentifyOptions`, such as `joints`. The result has `joints` (how much of each effort is
    explained), `numbers` (before, after, standard error) and `unexcited`. It writes `files`: `plot`. Raises
    UrdfsyncError for faults of the log, and for a robot that is out of step.
    """
    from urdfsync.analysis.identification import run
    from urdfsync.analysis.identification.report import IdentificationDisplay
    from urdfsync.analysis.identification.results import IdentifyOptions
    from urdfsync.analysis.simulation.files import check_outputs, input_files, write_file

    loaded, files, log = load(config), files or {}, Path(log)
    robot = loaded.select_one(robots, "identify")
    check_outputs(files, input_files(loaded, robot, None) | ({"the log": log} if log.exists() else {}))
    result = run.identify(loaded, robot, log, IdentifyOptions(**given), progress, write=write)
    for file in files.values():
        from urdfsync.analysis.identification.plot import draw  # matplotlib takes 0.5 s, and is an extra

        write_file(file, draw(result, file.suffix.lower().removeprefix(".")))
    return IdentificationDisplay(**msgspec.structs.asdict(result) | {"files": files})


def excite(
    *robots: str,
    file: Path | str,
    config: Place = None,
    seconds: float = 20.0,
    seed: int = 0,
    progress: Progress = no_progress,
    **given: Any,
) -> Excitation:
    """Write a motion that excites the numbers of a robot, as `urdfsync identify --excite` does."""
    from urdfsync.analysis.identification import run
    from urdfsync.analysis.identification.results import IdentifyOptions
    from urdfsync.analysis.simulation.files import check_outputs, input_files, write_file

    loaded, file = load(config), Path(file)
    robot = loaded.select_one(robots, "identify")
    check_outputs({"csv": file}, input_files(loaded, robot, None))
    text, result = run.find_motion(loaded, robot, seconds, seed, IdentifyOptions(**given), progress)
    write_file(file, text.encode())
    return msgspec.structs.replace(result, files={"csv": file})


def record(
    source: Path | str,
    *,
    class_: str = "",
    within: str = "",
    domain: str = "urdf",
    arguments: Mapping[str, str] | None = None,
) -> WholeRecord:
    """Return the record of a source, as `urdfsync record` writes it; for xacro, with its `arguments`.

    The record's name is `class_`; without it, the name follows from the source. Raises SourceError for a source that
    can't be read, and ConfigError for a name that can't be used.
    """
    from urdfsync.domain import registry
    from urdfsync.engine.judgements import judge
    from urdfsync.engine.package.generate import Package
    from urdfsync.engine.sources import source as sources

    source, target, form = Path(source), _target(class_, within, Path(source)), registry.domain(domain)
    text = sources.read_file_source(form, source, arguments or {}, configuration.ros_package_path())
    snapshot, reading = sources.read_permissively(form, text)
    recorder = form.record
    if recorder is None:
        message = f"the domain `{form.name}` has no record approach"
        raise ConfigError.of("no-record", message, hint="use `urdfsync build`")
    judged = judge(form, Version(snapshot), reading, text.name)
    artifact, told = recorder(reading, shown(source), target, form.options())
    generated = Package([artifact], sources.domain_templates(form), target.package)
    all_findings = [*text.diagnostics, *map(text.locate, (*reading.diagnostics, *judged, *told))]
    diagnostics = tuple(sorted(all_findings, key=lambda finding: finding.line))
    return WholeRecord(generated.content(artifact.path).decode(), target.name, within, diagnostics)


def _target(name: str, within: str, source: Path) -> Target:
    """Return the record's class: the chosen name, else a name from the source. Raises ConfigError."""
    if name and not is_class_name(name):
        hint = "choose a name that begins with a capital and is not reserved by Modelica or urdfsync"
        raise ConfigError.of("modelica-name", f"{name!r} can't be a class", hint=hint)
    if within and not configuration.is_package(within):
        raise ConfigError.of("modelica-name", f"{within!r} can't be a package", hint="name a package like Plant.Robots")
    return Target(within, name or class_name(source.name.partition(".")[0]) + "Parameters")
