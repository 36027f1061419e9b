"""Fixtures for all tests, a guard against writes outside of their folders, and a count of skipped tests."""

from __future__ import annotations

import functools
import gc
import itertools
import os
import shutil
import signal
import sys
import tempfile
import zlib
from collections import Counter
from collections.abc import Callable, Collection, Generator, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from hypothesis import settings
from support import audit
from support.cases import CASES
from support.commands import Editor, Execute, Printed
from support.networks import RC_FOLDER

from urdfsync.analysis.checks.contents import content_hash
from urdfsync.analysis.checks.libraries import find_standard_library
from urdfsync.common.diagnostics import UrdfsyncError

if TYPE_CHECKING:
    from support.daemon import Start, Watch

REPOSITORY = Path(__file__).parents[1]
NO_CORPUS = "no corpus of robots: set URDFSYNC_CORPUS"
NO_LIBRARY = "no Modelica Standard Library: set MODELICAPATH"

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # as in a build: numpy's threads wait busily for each other

# a busy machine must fail no test; `URDFSYNC_CASES` gives fresh cases
settings.register_profile("urdfsync", deadline=None, derandomize=not CASES, max_examples=max(40, CASES))
settings.load_profile("urdfsync")

_HOME, _TEMPORARY = Path.home(), Path(tempfile.gettempdir())
_ALLOWED = {"__pycache__", ".hypothesis", ".pytest_cache", ".mypy_cache", ".ruff_cache", ".coverage", ".git"}
_strays: list[str] = []


def _guard(kind: str, what: str) -> None:
    """Note a write to the repository or the home folder; caches of tools may be written."""
    if kind != "write":
        return
    place = Path(what)
    if place.is_relative_to(REPOSITORY):
        is_stray = not _ALLOWED & set(place.relative_to(REPOSITORY).parts)
    else:
        is_temporary = place.is_relative_to(_TEMPORARY)  # which is in the home folder on Windows
        inside = place.is_relative_to(_HOME) and _HOME.parent != _HOME and not is_temporary
        is_stray = inside and place.relative_to(_HOME).parts[0] not in (".cache", ".matplotlib", ".config", "AppData")
    if is_stray:
        _strays.append(what)


audit.listeners.append(_guard)

if sys.platform == "win32":

    def _skip(*_: object, **__: object) -> None:
        """Skip a test that makes a link; pytest, which makes some of its own, does without."""
        if not Path(sys._getframe(1).f_code.co_filename).is_relative_to(REPOSITORY):
            raise OSError("no links")
        pytest.skip("Windows makes symbolic links for administrators alone, and no pipes in folders")

    # the texts of tests have the same bytes on each system; some tests write other line ends themselves
    Path.write_text = functools.partialmethod(Path.write_text, newline="\n")  # type: ignore[assignment,method-assign]
    Path.symlink_to = os.symlink = os.mkfifo = _skip  # type: ignore[method-assign]


@pytest.fixture(scope="session", autouse=True)
def _default_signals() -> None:
    """Signals that `nohup` or a shell's `&` lets the tests ignore are not ignored by processes that the tests start.

    A process inherits ignored signals, but no handlers.
    """
    for number in (signal.SIGINT, getattr(signal, "SIGHUP", signal.SIGINT)):
        if signal.getsignal(number) is signal.SIG_IGN:
            signal.signal(number, lambda *_: None)


@pytest.fixture(scope="session", autouse=True)
def _no_waiting_for_disks() -> Iterator[None]:
    """Builds do not wait for the disk: only a power failure would show the difference."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(os, "fsync", lambda _: None)
        patch.setattr(os, "sync", lambda: None, raising=False)
        yield


@pytest.fixture(autouse=True)
def _no_stray_writes() -> Iterator[None]:
    """A test that writes to the repository or the home folder fails."""
    _strays.clear()
    yield
    strays = list(_strays)
    _strays.clear()
    assert strays == [], "the test writes outside of its own folder"


@pytest.fixture(autouse=True)
def _plain_environment(monkeypatch: pytest.MonkeyPatch) -> None:
    """What the user's shell sets must not decide about tests."""
    for name in ("ROS_PACKAGE_PATH", "AMENT_PREFIX_PATH", "NO_COLOR", "FORCE_COLOR", "COLUMNS"):
        monkeypatch.delenv(name, raising=False)


@pytest.fixture(autouse=True)
def _no_reading_of_another_test() -> None:
    """A test that breaks a reader gets no source that an earlier test has read in the same process."""
    if source := sys.modules.get("urdfsync.engine.sources.source"):
        source._read_model.cache_clear()


@pytest.fixture(autouse=True)
def _schema_agrees() -> Iterator[None]:
    """A test fails if the schema of configurations accepts a file that the program refuses, or the other way round."""
    from support import configurations

    differing: list[str] = []
    with configurations.compared(differing):
        yield
    assert differing == []


@pytest.fixture(scope="session")
def corpus() -> Path:
    """The folder of real robots and histories."""
    folder = Path(os.environ.get("URDFSYNC_CORPUS") or REPOSITORY.parent / "shared" / "corpus")
    if not (folder / "robots").is_dir():
        pytest.skip(NO_CORPUS)
    return folder


@pytest.fixture(scope="session")
def modelica_library() -> Iterator[Path]:
    """The folder with the Modelica Standard Library, in a version that the embedded compiler takes.

    Checks in this process parse, hash and read the library only once, which saves each of them one to four
    seconds.
    """
    from urdfsync.analysis.checks import libraries
    from urdfsync.modelica.stored import parse_file

    try:
        folder = find_standard_library()["Modelica"].parent
    except UrdfsyncError:
        pytest.skip(NO_LIBRARY)
    known, read = functools.cache(content_hash), libraries.library_texts
    read_fixed = functools.cache(read)

    def hash_once(root: Path, without: Collection[str] = ()) -> str:
        is_fixed = root.is_relative_to(folder) or root.is_relative_to(sys.prefix)
        return known(root, tuple(without)) if is_fixed else content_hash(root, without)

    def read_once(path: Path) -> Mapping[str, bytes]:
        return (read_fixed if path.is_relative_to(folder) else read)(path)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(libraries, "library_texts", read_once)
        patch.setattr("urdfsync.analysis.checks.names.parse_file", functools.cache(parse_file))
        for module in ("contents", "libraries"):
            patch.setattr(f"urdfsync.analysis.checks.{module}.content_hash", hash_once)
        yield folder


@pytest.fixture
def without_library(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """No Modelica Standard Library, in this process and in those of a check: nothing is compiled."""
    monkeypatch.setattr("urdfsync.analysis.checks.libraries.library_folders", list)
    for name in ("MODELICAPATH", "OPENMODELICALIBRARY", "OPENMODELICAHOME"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("HOME", str(tmp_path / "home"))


@pytest.fixture(scope="session")
def rc_site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder that makes the RC network domain an installed distribution, once it is on Python's path."""
    site = tmp_path_factory.mktemp("site")
    info = site / "rcnetwork-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: rcnetwork\nVersion: 1.0\n")
    (info / "entry_points.txt").write_text("[urdfsync.domains]\nrcnetwork = rc_domain:DOMAIN\n")
    return site


@pytest.fixture
def rc_domain(rc_site: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The RC network domain is installed."""
    monkeypatch.syspath_prepend(rc_site)
    monkeypatch.syspath_prepend(RC_FOLDER)


@pytest.fixture
def project(rc_domain: None, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The working folder with a network, its signal and the configuration that builds `Ladder`."""
    folder = tmp_path / "project"
    shutil.copytree(RC_FOLDER / "examples", folder)
    (folder / "urdfsync.toml").write_text(
        '[robots.ladder]\nsource = "ladder.json"\npackage = "Ladder"\ndomain = "rcnetwork"\n'
    )
    monkeypatch.chdir(folder)
    return folder


@pytest.fixture
def workspace(tmp_path: Path) -> Path:
    """A folder whose configuration builds the sample arm from a ROS workspace."""
    robots = REPOSITORY / "modelica/UrdfSync/Resources/robots"
    shutil.copytree(robots / "six_axis_arm", tmp_path / "ws/src/six_axis_arm")
    source = 'source = "ws/src/six_axis_arm/six_axis_arm.urdf"\n'
    (tmp_path / "urdfsync.toml").write_text(f'[robots.arm]\n{source}package = "Arm"\nignore = ["not-modelled"]\n')
    return tmp_path


@pytest.fixture
def start(project: Path, rc_site: Path) -> Iterator[Start]:
    """A function that starts a daemon in the project, and waits until all is built; it is killed after the test."""
    from support.daemon import Watch  # watchdog takes 45 ms

    running = []

    def begin(*arguments: str, before: Sequence[str] = (), robots: int = 1) -> Watch:
        path = [rc_site, RC_FOLDER]
        quick = ("--settle", "20", "--rescan", "100000", *arguments)
        running.append(Watch(project, *quick, path=path, before=before).__enter__())
        running[-1].rest(robots=robots)
        return running[-1]

    yield begin
    for watch in running:
        watch.__exit__()


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty working folder: no configuration is in it or above."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def execute(capsys: pytest.CaptureFixture[str]) -> Execute:
    """A function that runs a command and returns the output; the exit code must be `code`, unless this is None."""
    from urdfsync.commands import cli

    def run(*arguments: object, code: int | None = 0) -> Printed:
        capsys.readouterr()
        found = cli.main(list(map(str, arguments)))
        printed = Printed(found, *capsys.readouterr())
        assert code in (None, found), printed
        return printed

    return run


@pytest.fixture
def editor(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Editor:
    """Sets the user's editor: a program in Python, which gets the names of the files as `names`."""
    program = tmp_path / "editor.py"
    monkeypatch.setenv("VISUAL", f"{sys.executable} {program}")
    monkeypatch.setenv("GIT_CONFIG_GLOBAL", os.devnull)
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    begin = "import sys\nfrom pathlib import Path\nnames = sys.argv[1:]\nfile = Path(names[0])\n"
    return lambda text: program.write_text(begin + text)


@pytest.fixture(scope="session")
def in_step(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A built project with all inputs of a decision; tests work on copies of this project."""
    from support import remembered  # needs modules that only its tests import

    return remembered.built(tmp_path_factory.mktemp("built") / "project")


@pytest.fixture
def snapshot_of() -> Callable[[Path], dict[str, tuple[int, bytes]]]:
    """A function that gives time of change and content of every file below a folder."""
    from support import files

    return files.snapshot


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add the option that runs only a part of the long tests."""
    parser.addoption("--part", metavar="N/M", default="1/1", help="run the N-th of M parts of the slow and large tests")


@pytest.hookimpl(wrapper=True, tryfirst=True)  # before `-m` reads the marks
def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> Generator[None]:
    """Mark tests whose result does not depend on the Python, and all but a test's first case; put long tests first.

    xdist gives each process a piece of this list, and later the rests of other pieces. So each piece begins with long
    tests, with those of a file in one piece, and no process ends late.
    """
    cases = Counter[str]()
    for item in items:
        test = item.nodeid.partition("[")[0]
        if cases[test] or _is_same_with_every_python(item):
            item.add_marker("once")
        cases[test] += 1
    yield
    number, parts = map(int, config.getoption("part").split("/"))
    long = [item for item in items if item.get_closest_marker("slow") or item.get_closest_marker("large")]
    part = [item for item in long if zlib.crc32(item.nodeid.encode()) % parts == number - 1]
    of_all, others = set(long), set(long) - set(part)
    quick = [item for item in items if item not in of_all]
    config.hook.pytest_deselected(items=[item for item in long if item in others])
    pieces: list[list[pytest.Item]] = [[] for _ in range(int(os.environ.get("PYTEST_XDIST_WORKER_COUNT", "1")))]
    for _, tests in itertools.groupby(part, key=lambda item: item.path):
        min(pieces, key=len).extend(tests)
    size = (len(part) + len(quick)) // len(pieces)
    for piece in pieces:
        room = max(0, size - len(piece))
        piece += quick[:room]
        del quick[:room]
    items[:] = [*itertools.chain.from_iterable(pieces), *quick]


_SAME = tuple(f"tests/{name}" for name in (
    # computed texts and numbers, and the decisions of a build
    *("engine/", "merge/", "modelica/", "output/", "formats/urdf/", "domain/test_comparison", "domain/test_matching"),
    *(f"analysis/{name}/" for name in ("pages", "patches", "simulation", "versions")),
    *("formats/table/test_catalogue", "formats/table/test_units", "test_forged_states", "test_hostile_templates"),
    *("test_ignored", "test_loops", "test_renumbered", "test_templates"),
    *(f"analysis/identification/test_{name}" for name in ("excite", "fit", "records", "run", "signals")),
    # other formats and checks, but for their processes and for rumoca
    *("formats/mjcf/", "formats/sdf/", "watch/test_checks", "watch/test_report", "watch/test_view"),
    "analysis/checks/compilers/test_omc",
    *(f"analysis/checks/test_{name}" for name in ("afterbuild", "fingerprint", "names", "report", "robot")),
    "analysis/checks/test_texts",
    # git's merges
    *("test_edits_meet_exports", "test_merge"),
    "test_unmerged",
    # texts of the project itself
    *("test_corpus_page", "test_docs", "test_domains_page", "common/test_spelling", "test_urdf_page"),
))  # fmt: skip
# beside those: processes, and libraries that load
_MAY_DIFFER = tuple(f"tests/{name}" for name in (
    *("formats/mjcf/test_worker", "formats/sdf/test_worker", "analysis/pages/test_browser"),
    *("analysis/simulation/test_fmu", "analysis/simulation/test_plot"),
))  # fmt: skip


def _is_file_of_same(path: str) -> bool:
    return path.startswith(_SAME) and not path.startswith(_MAY_DIFFER)


def pytest_ignore_collect(collection_path: Path, config: pytest.Config) -> bool | None:
    """Leave out files of which `-m "not once"` deselects all tests: a process takes 13 s to find all tests."""
    is_one_more = "not once" in config.option.markexpr and collection_path.is_relative_to(REPOSITORY)
    if not is_one_more or not collection_path.is_file():
        return None
    return _is_file_of_same(collection_path.relative_to(REPOSITORY).as_posix()) or None


def _is_same_with_every_python(item: pytest.Item) -> bool:
    """Whether a test compiles models, reads the corpus or draws random cases; rumoca has tests of its own.

    So do the files in `_SAME`. A further Python shows that all modules and libraries load and work, that processes
    start, end and exchange values, and what files, paths, threads and the command line do.
    """
    if _is_file_of_same(item.nodeid):
        return True
    needs = {"modelica_library", "corpus"} & set(getattr(item, "fixturenames", ()))
    is_random = getattr(getattr(item, "obj", None), "is_hypothesis_test", False)
    return bool(needs or is_random) and "analysis/checks/compilers" not in item.nodeid


def pytest_runtest_setup(item: pytest.Item) -> None:
    """Skip what another system is needed for; the marker `posix` says why."""
    if sys.platform == "win32" and (marker := item.get_closest_marker("posix")):
        pytest.skip(f"not on Windows: {marker.args[0]}")
    if sys.platform != "win32" and item.get_closest_marker("windows"):
        pytest.skip("only on Windows: `python -m tests --windows FOLDER` runs it")


def pytest_collection_finish() -> None:
    """The garbage collector ignores all objects that stay until the end."""
    gc.collect()
    gc.freeze()


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    """Report how many tests need a missing program or folder."""
    skipped = [str(report.longrepr) for report in terminalreporter.stats.get("skipped", [])]
    for reason in (NO_LIBRARY, NO_CORPUS):
        if count := sum(reason in text for text in skipped):
            terminalreporter.write_line(f"{count} tests skipped: {reason}", yellow=True)
