"""What the compiler is given for a robot's package, and what happens if somebody deletes that meanwhile."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Iterable
from pathlib import Path

import pytest

from urdfsync import config
from urdfsync.checking import loading
from urdfsync.checking.cache import Cache, CacheError
from urdfsync.checking.compilers import choice
from urdfsync.checking.compilers.compiler import CompilerError, ignore
from urdfsync.checking.compilers.tasks import Job, Outcome, Task
from urdfsync.checking.libraries.library import LibraryError
from urdfsync.checking.loading import Loader
from urdfsync.checking.process import Limits
from urdfsync.checking.subject import Subject
from urdfsync.checking.toolbox import Toolbox
from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.engine.build import build
from urdfsync.engine.options import BuildOptions

PARTS = """
    package Blocks/package Constants Electrical/package Electrical/Analog Icons Math Mechanics/package
    Mechanics/MultiBody/package Mechanics/Rotational Mechanics/Translational Units Utilities
""".split()
TASKS = [Task(name, f"model {name}\nend {name};") for name in ("One", "Two", "Three")]
RIGHT, WRONG = Outcome(unknowns=3), Outcome("there is no class `Foo`")
CRASH = CompilerError(Diagnostic(Severity.ERROR, "compiler-crashed", "the compiler broke down"))


class Compiler:
    """Finds everything right but models that `faults` name, as long as all files are there that were at first.

    Before each model it does what `meanwhile` says.
    """

    def __init__(self, meanwhile: Callable[[str], None] = lambda _: None, *faults: str) -> None:
        self.jobs: list[Job] = []
        self.crashes = False
        self._meanwhile, self._faults = meanwhile, faults
        self._files: dict[tuple[str, ...], set[Path]] = {}

    def compile(self, job: Job, limits: Limits, tell: Callable[[int, Outcome], None] = ignore) -> list[Outcome]:
        self.jobs.append(job)
        whole = self._files.setdefault(job.roots, files(job.roots))
        for number, task in enumerate(job.tasks):
            self._meanwhile(task.model)
            there = files(job.roots) == whole
            if not there and self.crashes:
                raise CRASH
            tell(number, RIGHT if there and task.model not in self._faults else WRONG)
        return []


def files(roots: Iterable[str]) -> set[Path]:
    return {path for root in roots for path in Path(root).rglob("*.mo")}


@pytest.fixture
def bench(project: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The project, built, with a made-up standard library, and a library on MODELICAPATH; the cache's folder."""
    for name in PARTS:
        put(f"libraries/Modelica 4.1.0/{name}.mo", "package Modelica end Modelica;")
    put("libraries/ModelicaServices 4.1.0/package.mo", "package ModelicaServices end ModelicaServices;")
    put("libraries/Complex 4.1.0.mo", "operator record Complex end Complex;")
    put("path/Pumps/package.mo", "package Pumps import Modelica.Electrical.Analog; end Pumps;")
    monkeypatch.setenv("MODELICAPATH", str(project / "path"))
    with Path("urdfsync.toml").open("a") as file:
        file.write('[check]\nlibrary = "libraries"\n')
    loaded = config.load(Path("urdfsync.toml").absolute())
    list(build(loaded, loaded.robots, BuildOptions()))
    return project / "cache"


@pytest.fixture(autouse=True)
def without_pauses(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(loading, "_PAUSE", 0.0)


def put(name: str, text: str) -> None:
    Path(name).parent.mkdir(parents=True, exist_ok=True)
    Path(name).write_text(text)


def tools(cache: Path, compiler: Compiler | None = None) -> Toolbox:
    loaded = config.load(Path("urdfsync.toml").absolute())
    subject = Subject(loaded, loaded.robots[0], BuildOptions(dry=True))
    loader = Loader(subject, Cache(cache), Cache(cache).workspace("ladder"))
    return Toolbox(loader, compiler or choice.compiler("rumoca", Cache(cache)), Limits())


def test_a_library_of_the_users_is_there_with_what_it_needs_of_the_standard_library(bench: Path) -> None:
    made = tools(bench)
    plain = made.loader.load("plain", {"package.mo": b"package Ladder end Ladder;"})
    pumps = made.loader.load("pumps", {"package.mo": b"package Ladder Pumps.Small p; end Ladder;"})
    assert "Pumps" not in plain.libraries
    assert not Path(plain.standard[0], "Modelica/Electrical").exists()
    assert pumps.libraries["Pumps"] == Path("path/Pumps").absolute()
    assert Path(pumps.standard[0], "Modelica/Electrical/Analog.mo").exists()


def test_a_broken_standard_library_is_a_clear_error(bench: Path) -> None:
    shutil.rmtree("libraries/Modelica 4.1.0/Mechanics/MultiBody")
    with pytest.raises(LibraryError, match=r"Modelica 4\.1\.0 is broken: there is no `Modelica\.Mechanics\.MultiBody`"):
        tools(bench)


def test_tasks_import_the_libraries(bench: Path) -> None:
    compiler = Compiler()
    made = tools(bench, compiler)
    loaded = made.loader.load("pumps", {"package.mo": b"package Ladder Pumps.Small p; end Ladder;"})
    assert made.run(loaded, TASKS[:1]) == [RIGHT]
    assert "  import Pumps;\n" in compiler.jobs[0].tasks[0].source


@pytest.mark.parametrize("crashes", [False, True])
@pytest.mark.parametrize("what", ["", "work", "libraries", "work/ladder/disk/Ladder/Elements"])
def test_a_cache_that_is_emptied_meanwhile_is_no_fault_of_the_package(what: str, crashes: bool, bench: Path) -> None:
    """What is told already is not told again."""
    emptied: list[str] = []

    def empty_once(model: str) -> None:
        if model == "Two" and not emptied:
            emptied.append(model)
            shutil.rmtree(bench / what)

    compiler = Compiler(empty_once)
    compiler.crashes = crashes
    made = tools(bench, compiler)
    told: list[tuple[int, Outcome]] = []
    loaded = made.loader.load("disk", made.loader.subject.texts)
    assert made.run(loaded, TASKS, lambda *news: told.append(news)) == [RIGHT] * 3
    assert told == list(enumerate([RIGHT] * 3))
    assert [len(job.tasks) for job in compiler.jobs] == [3, 2]


def test_one_that_is_emptied_all_the_time_is_a_clear_error(bench: Path) -> None:
    made = tools(bench, Compiler(lambda _: shutil.rmtree(bench / "work")))
    with pytest.raises(CacheError) as caught:
        made.run(made.loader.load("disk", made.loader.subject.texts), TASKS)
    (found,) = caught.value.diagnostics
    assert (found.code, found.file) == ("cache-emptied", str(bench))
    assert found.hint


def test_a_problem_with_everything_in_place_is_one_of_the_package(bench: Path) -> None:
    compiler = Compiler(lambda _: None, "Two")
    made = tools(bench, compiler)
    assert made.run(made.loader.load("disk", made.loader.subject.texts), TASKS) == [RIGHT, WRONG, RIGHT]
    assert len(compiler.jobs) == 1


def test_a_library_that_the_user_takes_away_meanwhile_is_missed(bench: Path) -> None:
    def take_away(model: str) -> None:
        if model == "Two":
            shutil.rmtree("path/Pumps", ignore_errors=True)

    compiler = Compiler(take_away, "Two")
    made = tools(bench, compiler)
    loaded = made.loader.load("pumps", {"package.mo": b"package Ladder Pumps.Small p; end Ladder;"})
    assert made.run(loaded, TASKS) == [RIGHT, WRONG, RIGHT]
    assert not any("Pumps" in root for root in compiler.jobs[1].roots)


def test_two_checks_of_a_robot_have_a_folder_each_which_clearing_spares(bench: Path) -> None:
    loaded, cache = config.load(Path("urdfsync.toml").absolute()), Cache(bench)
    robot = loaded.robots[0]
    with loading.bench(cache, loaded, robot) as first, loading.bench(cache, loaded, robot) as second:
        assert first != second
        (first / "file").touch()
        (second / "file").touch()
        cache.clear()
        assert (first / "file").exists()
        assert (second / "file").exists()
    assert not second.exists()
    with loading.bench(cache, loaded, robot) as again:
        assert again == first
