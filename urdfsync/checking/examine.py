"""The check of one robot: syntax and layout, then compiling and balance, then the comparison with a reference."""

from __future__ import annotations

import contextlib
import functools
import os
import threading
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import msgspec

from urdfsync.checking import loading, workspace
from urdfsync.checking.cache import Cache
from urdfsync.checking.compilers import choice
from urdfsync.checking.compilers.tasks import Outcome, Task, compiling
from urdfsync.checking.diagnosis import layout, names, problems
from urdfsync.checking.diagnosis.problems import Case
from urdfsync.checking.findings import Findings
from urdfsync.checking.libraries import dependencies, library
from urdfsync.checking.libraries.library import LibraryError
from urdfsync.checking.loading import Loaded, Loader
from urdfsync.checking.process import Limits
from urdfsync.checking.subject import Subject
from urdfsync.checking.toolbox import Toolbox
from urdfsync.checking.trials import Trials
from urdfsync.checking.verdict import Compiled, Verdict
from urdfsync.checking.wishes import Wishes
from urdfsync.config import Config, RobotConfig, library_folder, shown
from urdfsync.diagnostics import Diagnostic, Severity, UrdfsyncError
from urdfsync.engine.options import BuildOptions, Progress
from urdfsync.modelica.files import StoredClasses
from urdfsync.modelica.names import LIBRARY


def examine(
    config: Config,
    robot: RobotConfig,
    wishes: Wishes,
    limits: Limits,
    tell: Progress,
    keep: Callable[[Verdict], None],
) -> Verdict:
    """Check one robot; `limits` are those of each compiler, `keep` gets the verdict as it grows."""
    findings = Findings(robot.name, robot.target.package, keep)
    with noting(findings):
        request = BuildOptions(dry=True, package_paths=wishes.package_paths, wait=wishes.wait, jobs=1)
        subject = Subject(config, robot, request)
        conflicting = bool(subject.result.conflicts)
        findings.note(built=subject.built, in_step=subject.in_step, conflicting=conflicting)
        findings.say(subject.findings)
        found = _files(subject)
        findings.say(found)
        if any(one.severity is Severity.ERROR for one in found):
            findings.miss("nothing was compiled, since the files are not in order")
            return findings.verdict
        own, others = _names(subject)
        findings.say([*own, *others])
        if any(one.severity is Severity.ERROR for one in own):
            findings.miss("nothing was compiled, since names in the package mean nothing")
        else:
            cache = Cache.of_user()
            with loading.bench(cache, config, robot) as folder:
                tools = Toolbox(Loader(subject, cache, folder), choice.compiler(wishes.tool, cache), limits)
                _Stages(subject, tools, findings, wishes, tell).run()
    return findings.verdict


def _files(subject: Subject) -> list[Diagnostic]:
    """What is wrong with the files of the package, and with those around it."""
    robot = subject.robot
    files = {robot.output / path: content for path, content in subject.around.items()}
    odd = [_odd(path) for path in workspace.oddities(robot.folder)] if subject.built else []
    return [*layout.check(subject.package), *layout.check_around(files, shown), *odd]


def _names(subject: Subject) -> tuple[list[Diagnostic], list[Diagnostic]]:
    """What is wrong with names in the package, and in the user's files outside of it."""
    robot, places = subject.robot, dependencies.search_path(subject.robot)
    around = {robot.output / path: text for path, text in subject.around.items() if path.endswith(".mo")}
    find = functools.partial(_library, subject.config, places, robot.target.package.partition(".")[0])
    others = {**around, **subject.users_files}
    sources = StoredClasses(robot.target.package, robot.folder, subject.texts, others, find)
    users = [name for name, one in sources.users.items() if Path(one.file) in subject.users_files]
    unread = [path for path in sources.unread if path in subject.users_files and path not in around]
    own = names.check(subject.package, sources.own, sources)
    return list(own), [*map(_unread, unread), *names.check(subject.package, users, sources)]


def _library(config: Config, places: Sequence[Path], top: str, name: str) -> Path | None:
    """Where a library is; `top` is the top-level package that is checked, `places` are the folders of others."""
    if name == LIBRARY != top:
        return library_folder() / LIBRARY
    if name not in library.PARTS:
        return library.find(name, places)
    try:
        found = library.standard(os.environ, library.home(), config.check.library)
    except LibraryError:
        return None
    return dict(zip(library.PARTS, (found.modelica, found.services, found.complex), strict=True))[name].path


def _unread(path: Path) -> Diagnostic:
    message, hint = "this file can't be read as Modelica, so its names were not checked", "open it in a Modelica tool"
    return Diagnostic(Severity.WARNING, "names-unread", message, shown(path), hint=hint)


def _odd(path: Path) -> Diagnostic:
    message, hint = "this is no regular file, so it was not looked at", "put the file itself here, or take it away"
    return Diagnostic(Severity.WARNING, "no-file", message, shown(path), hint=hint)


@contextlib.contextmanager
def noting(findings: Findings) -> Iterator[None]:
    """Whatever is wrong becomes a finding."""
    try:
        yield
    except UrdfsyncError as error:
        findings.say(error.diagnostics)
    except OSError as error:
        findings.say([Diagnostic(Severity.ERROR, "system", error.strerror or str(error), str(error.filename or ""))])


class _Stages:
    """What a compiler has to do for one robot."""

    def __init__(self, subject: Subject, tools: Toolbox, findings: Findings, wishes: Wishes, tell: Progress) -> None:
        self._subject, self._tools, self._findings = subject, tools, findings
        self._wishes, self._tell = wishes, tell
        self._lock = threading.Lock()

    def run(self) -> None:
        """Compile, and compare if that is wanted."""
        if self._tools.loader.missing is not None:
            self._without_library(self._tools.loader.missing)
            return
        trials = self._trials()
        models = list(self._subject.models)
        jobs = [*trials.jobs(), *self._compilations(models[1:])] if trials else self._compilations(models)
        self._all(jobs)
        if trials:
            self._all(trials.variants())
            trials.conclude()
            if not any(one.model == models[0] for one in self._findings.verdict.compiled):
                self._all(self._compilations(models[:1]))
        self._all(self._own_classes())
        compiled = self._findings.verdict.compiled
        self._findings.note(compiled=tuple(sorted(compiled, key=lambda one: models.index(one.model))))

    def _trials(self) -> Trials | None:
        """The comparisons that are wanted, if any; of these the main model is a part."""
        tool = self._wishes.tool
        if not self._wishes.physics:
            self._findings.leave_out("poses and efforts were not compared: `--physics` does that")
        elif tool != "rumoca":
            self._findings.miss(f"poses and efforts were not compared: `--tool {tool}` only compiles")
        else:
            return Trials(self._subject, self._tools, self._findings, self._loaded, self._progress)
        return None

    def _without_library(self, missing: UrdfsyncError) -> None:
        """Say why nothing is compiled: an error only if somebody asked for more."""
        found = missing.diagnostics[0]
        if self._subject.config.check.library is not None or self._wishes.physics:
            self._findings.say([found])
        self._findings.miss(f"nothing was compiled: {found.message}; {found.hint}")

    @functools.cached_property
    def _loaded(self) -> Loaded:
        return self._tools.loader.load("package", self._subject.texts)

    def _compilations(self, models: Sequence[str]) -> list[Callable[[], None]]:
        """The models by themselves, in as many processes as may work."""
        count = max(1, min(self._wishes.workers, len(models)))
        if self._wishes.physics:
            count = 1  # the comparisons have processes of their own
        return [functools.partial(self._compile, self._loaded, models[number::count]) for number in range(count)]

    def _compile(self, loaded: Loaded, models: Sequence[str]) -> None:
        def tell(number: int, outcome: Outcome) -> None:
            self._findings.used(outcome.megabytes)
            if outcome.problem:
                with self._lock:  # what was said of another model is not said again
                    self._findings.say(self._explained(outcome.problem, loaded, models[number]))
            else:
                self._findings.compiled(Compiled(models[number], outcome.unknowns, outcome.states))
            if number + 1 < len(models):
                self._progress(f"compiling {models[number + 1]}")

        if models:
            self._progress(f"compiling {models[0]}")
            self._tools.run(loaded, [self._task(model) for model in models], tell)

    def _own_classes(self) -> list[Callable[[], None]]:
        own = self._subject.package.own_models(self._subject.generated)
        return [functools.partial(self._compile_own, self._loaded, own)] if own else []

    def _compile_own(self, loaded: Loaded, models: Sequence[str]) -> None:
        """Classes of the user's that no model need contain: what does not compile by itself may be meant so."""

        def tell(number: int, outcome: Outcome) -> None:
            found = self._explained(outcome.problem, loaded, models[number]) if outcome.problem else ()
            self._findings.say(msgspec.structs.replace(one, severity=Severity.WARNING) for one in found)

        self._progress(f"compiling {models[0]}")
        self._tools.run(loaded, [self._task(model) for model in models], tell)

    def _task(self, model: str) -> Task:
        return compiling(f"{self._subject.robot.target.package}.{model}")

    def _explained(self, text: str, loaded: Loaded, model: str) -> Sequence[Diagnostic]:
        said = self._findings.verdict.diagnostics
        return problems.explain(
            text, Case(self._subject.package, self._tools.loader.folders(loaded), said, model=model)
        )

    def _progress(self, what: str) -> None:
        self._tell(f"{self._subject.robot.name}: {what}", 0, 0)

    def _all(self, jobs: Sequence[Callable[[], None]]) -> None:
        """Do jobs, some at the same time; what goes wrong with one is a finding."""

        def noted(job: Callable[[], None]) -> None:
            with noting(self._findings):
                job()

        if self._wishes.workers == 1:
            for job in jobs:
                noted(job)
            return
        with ThreadPoolExecutor(self._wishes.workers) as pool:
            for future in [pool.submit(noted, job) for job in jobs]:
                future.result()
