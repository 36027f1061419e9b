"""A repository of a stranger's: no command runs code of it, writes outside of it, hangs, or ends in a traceback.

The attacks of `support.hostile` meet every command in this process; modules of the working folder meet the programs.
"""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Sequence
from pathlib import Path

import pytest
from support import hostile
from support.git import NEEDS_GIT, Repository
from support.urdfs import joint, limit, link, robot
from support.workplace import WATCH, Workplace, changes, contents

from urdfsync import cli, render
from urdfsync.engine import source

Capture = pytest.CaptureFixture[str]

PROGRAM = Path(sys.executable).with_name("urdfsync")
HOOK = Path(sys.executable).with_name("urdfsync-hook")
COUNT = 6
"""So many stale robots are planned in several processes."""
TEMPLATE = "joint/revolute.mo.jinja"
PATIENCE = 60.0

pytestmark = [
    NEEDS_GIT,
    pytest.mark.skipif(sys.platform == "win32", reason="the console script is another program there"),
]


def _urdf(offset: float) -> str:
    return robot(
        link("base"),
        link("arm", 1.0 + offset),
        joint("shoulder", "revolute", "base", "arm", axis="0 0 1", inside=[limit()]),
    )


def _configure(folder: Path, count: int, templates: bool) -> None:
    own = 'templates = "templates"\n' if templates else ""
    robots = [f'[robots.r{n}]\nsource = "r{n}.urdf"\npackage = "Robot{n}"\n{own}' for n in range(count)]
    (folder / "urdfsync.toml").write_text("\n".join(["[defaults]\ncross_check = false\n", *robots]))


def _project(folder: Path, count: int, monkeypatch: pytest.MonkeyPatch) -> Repository:
    """A repository with robots that are built and committed; it is the working folder."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(folder.parent / "cache"))
    (folder.parent / "cache").mkdir(mode=0o700)
    repository = Repository(folder, monkeypatch)
    for number in range(count):
        (folder / f"r{number}.urdf").write_text(_urdf(0))
    _configure(folder, count, templates=False)
    monkeypatch.chdir(folder)
    assert cli.main(["build", "--quiet"]) == 0
    repository.commit()
    return repository


def _watch(folder: Path, word: str) -> str:
    """What the daemon says until a word comes, or an end of its own."""
    output = folder.parent / "said"
    with output.open("w") as file:
        daemon = subprocess.Popen([PROGRAM, "watch", "--settle", "10", "--sample", "10"], stdout=file, stderr=file)
        try:
            end = time.monotonic() + PATIENCE
            while word not in output.read_text() and daemon.poll() is None and time.monotonic() < end:
                time.sleep(0.05)
        finally:
            daemon.send_signal(signal.SIGTERM)
            daemon.wait(PATIENCE)
    return output.read_text()


# --- every attack meets every command ---------------------------------------------------------------------------------

READING = (["build", "--check"], ["build", "--dry-run"], ["status"], ["diff"], ["hook", "check"])
WRITING = (["build"], ["build", "--repair"], ["resolve", "--all", "--take"], ["hook", "build"])
OF_SOURCES = (["record", "arm.urdf"], ["init", "--config", "new.toml"])
"""Commands that read no configuration and no state."""
SOURCES = ("source", "chain", "entities", "numbers", "terminal")
"""Words of the attacks that those commands can meet."""
LONGER = (["check"], WATCH)
ALLOWED = ("modelica/Arm", ".urdfsync", "new.toml", ".git/index", "modelica/package.order")
"""What commands may change in the project; a link is changed only where it leads, which is outside."""


@pytest.fixture(scope="module")
def stale(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A project that is built and committed, with a source that has changed since."""
    work = Workplace(tmp_path_factory.mktemp("built"))
    hostile.write_project(work.folder / "new")
    work.fill(work.folder / "new")
    with pytest.MonkeyPatch.context() as monkeypatch:
        repository = Repository(work.project, monkeypatch)
        assert work.run(["build"])[0] == 0
        repository.commit()
    hostile.make_stale(work.project)
    return work.project


def _attack(work: Workplace, stale: Path, name: str, commands: Sequence[Sequence[str]], afresh: bool) -> None:
    """Run commands in a project under attack; with `afresh` each in one of its own."""
    for number, command in enumerate(commands):
        if number == 0 or afresh:
            work.fill(stale)
            hostile.ATTACKS[name].make(work.project, work.outside)
            if hostile.ATTACKS[name].is_committed:
                subprocess.run(["git", "add", "-A"], cwd=work.project, check=True, capture_output=True)
            before = contents(work.project)
        work.run(command)  # which looks for changes outside, for tracebacks and for what a terminal obeys
        changed = changes(before, contents(work.project))
        assert [path for path in changed if not path.startswith(ALLOWED)] == [], command


IN_PROCESS = [
    pytest.param(name, marks=pytest.mark.slow if name == "a long chain" else ())
    for name in hostile.ATTACKS
    if name not in ("modules", "a domain of the repository")
]
"""Modules of the working folder can only meet programs; thousands of files take seconds a command."""


@pytest.mark.parametrize("name", IN_PROCESS)
def test_an_attack_meets_every_command(tmp_path: Path, stale: Path, name: str) -> None:
    work = Workplace(tmp_path)
    _attack(work, stale, name, READING, afresh=False)
    _attack(work, stale, name, WRITING, afresh=True)
    if any(word in name for word in SOURCES):
        _attack(work, stale, name, OF_SOURCES, afresh=False)


@pytest.mark.parametrize("name", IN_PROCESS)
@pytest.mark.parametrize("command", LONGER, ids=lambda command: str(command[0]))
@pytest.mark.slow
def test_an_attack_meets_the_commands_that_take_longer(
    tmp_path: Path, stale: Path, name: str, command: Sequence[str]
) -> None:
    _attack(Workplace(tmp_path), stale, name, [command], afresh=True)


# --- modules in the working folder ------------------------------------------------------------------------------------


@pytest.fixture
def modules(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Many robots to build, beside a module of the name of each that Python and urdfsync import. The folder of marks.

    A module leaves a mark, and is otherwise empty: so whoever imports it also breaks.
    """
    folder, marks = tmp_path / "project", tmp_path / "marks"
    marks.mkdir()
    repository = _project(folder, COUNT, monkeypatch)
    for number in range(COUNT):
        (folder / f"r{number}.urdf").write_text(_urdf(0.5))
    others = ("urdfsync", "jinja2", "msgspec", "lxml", "numpy", "psutil", "rumoca", "deepdiff", "rich", "sitecustomize")
    for name in (*sys.stdlib_module_names, *others):
        text = f"open({str(marks / name)!r}, 'w').close()\n"
        (folder / f"{name}.py").write_text(text)
    repository.git("add", "-A")
    return marks


@pytest.mark.parametrize(
    ("program", "arguments", "code"),
    [
        *((PROGRAM, command, 0) for command in ("build", "build --dry-run", "status", "resolve --all --take")),
        *((PROGRAM, command, 1) for command in ("build --check", "diff")),
        *((HOOK, mode, 1) for mode in ("build", "check")),
        (PROGRAM, "record r0.urdf", 0),
        pytest.param(PROGRAM, "check r0", None, marks=pytest.mark.slow),
        (PROGRAM, "watch", None),
    ],
)
def test_no_module_of_the_working_folder_runs(modules: Path, program: Path, arguments: str, code: int | None) -> None:
    """Run a console script as a user would, with nothing said to Python."""
    assert program.is_file(), "urdfsync is not installed"
    if arguments == "watch":
        said = _watch(Path.cwd(), f"r{COUNT - 1}")
    else:
        jobs = ["--jobs", "2"] if arguments.startswith("build") and program is PROGRAM else []
        environment = {
            name: value for name, value in os.environ.items() if name not in ("PYTHONSAFEPATH", "PYTHONPATH")
        }
        command = [str(program), *arguments.split(), *jobs]
        done = subprocess.run(command, capture_output=True, text=True, env=environment, timeout=PATIENCE, check=False)
        assert code in (None, done.returncode), done.stderr
        said = done.stderr
    assert sorted(mark.name for mark in modules.iterdir()) == [], "modules of the working folder ran"
    assert "Traceback" not in said


# --- templates --------------------------------------------------------------------------------------------------------

SHELL = "cycler.__init__.__globals__.os.popen({command!r}).read()"


@pytest.fixture
def marker(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A repository with one robot whose template runs a command; the file that the command makes."""
    found = tmp_path / "marker"
    _project(tmp_path / "project", 1, monkeypatch)
    _template(f"\n\n<< {SHELL.format(command=f'touch {found}')} >>\n")
    return found


def _template(text: str, name: str = TEMPLATE) -> None:
    file = Path("templates", name)
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(text)
    _configure(Path.cwd(), 1, templates=True)


def _errors(text: str) -> list[str]:
    return [line for line in text.splitlines() if ": error:" in line]


def _status(capsys: Capture) -> str:
    """The error of `urdfsync status`, which is the only one, and is no traceback."""
    capsys.readouterr()
    assert cli.main(["status"]) == 2
    said = "".join(capsys.readouterr())
    assert "Traceback" not in said
    (error,) = _errors(said)
    assert "[template]" in error
    return error


@pytest.mark.parametrize(
    "attack",
    [
        "<< {shell} >>",
        "<% set x = {shell} %>",
        "<% macro m() %><< {shell} >><% endmacro %><< m() >>",
        "<% import 'part.jinja' as part %><< part.m(1) >>",
        "<% import 'part.jinja' as part %><< [1] | once(part.m) >>",
        "<% include 'part2.jinja' %>",
        "<< [''] | map(attribute='__class__') | first >>",
        "<< ('' | attr('__class__')).mro() >>",
        "<< ''['__class__'].mro() >>",
        "<< '{{0.__class__.__mro__}}'.format('') >>",
        "<< ['x'] | once('{{0.__class__}}'.format) >>",
        "<< ['x'] | once(cycler) >>",
        "<% set parts = [] %><< parts.append(1) >>",
        "<< self.__init__ >>",
        "<< once.__globals__ >>",
    ],
)
def test_the_sandbox_holds_in_all_parts_of_a_template(marker: Path, capsys: Capture, attack: str) -> None:
    shell = SHELL.format(command=f"touch {marker}")
    _template(attack.format(shell=shell))
    _template(f"<% macro m(x) %><< {shell} >><% endmacro %>", "part.jinja")
    _template(f"<< {shell} >>", "part2.jinja")
    assert "templates/" in _status(capsys)
    assert not marker.exists()


@pytest.mark.parametrize(
    ("attack", "words"),
    [
        ("<< range(1000000) >>", "Range too big"),
        ("<% for n in range(1000) %><< 'a' * 1000000 >><% endfor %>", "characters"),
        ("<< 10 ** (10 ** 10) >>", "too large"),
        ("<% set n = namespace(x=3) %><% for i in range(60) %><% set n.x = n.x * n.x %><% endfor %>", "too large"),
        ("<< ('f' * 4000000) | int(0, 16) // ('f' * 2000000) | int(0, 16) >>", "too large"),
        ("<< (1).from_bytes(('f' * 4000000).encode()) % 7 >>", "too large"),
        ("<< 1 | round(10000000000, 'ceil') >>", "larger than"),
        ("<< [1] | slice(1000000000000) | max >>", "larger than"),
        ("<< lipsum(1000000000) >>", "lipsum"),
        ("<% macro m() %><< m() >><% endmacro %><< m() >>", "without end"),
        ("<% include 'joint/revolute.mo.jinja' %>", "without end"),
        ("<# " + "x" * source.MAX_TEMPLATE + " #>", "too large for a template"),
    ],
)
def test_a_template_has_limits(marker: Path, capsys: Capture, attack: str, words: str) -> None:
    _template(attack)
    assert words in _status(capsys)


@pytest.mark.skipif(sys.platform != "linux", reason="elsewhere memory has no limit")
@pytest.mark.parametrize(
    "attack",
    [
        "<< ('a' * 10000000000) | length >>",
        "<< '%10000000000d' | format(1) | length >>",
        "<< '{:10000000000}'.format(1) | length >>",
        "<% set n = namespace(x='aa') %><% for i in range(60) %><% set n.x = n.x ~ n.x %><% endfor %>",
    ],
)
def test_a_template_takes_no_more_memory_than_it_may(marker: Path, capsys: Capture, attack: str) -> None:
    import resource

    before = resource.getrlimit(resource.RLIMIT_AS)
    _template(attack)
    assert "more memory than it may take" in _status(capsys)
    assert resource.getrlimit(resource.RLIMIT_AS) == before


@pytest.mark.parametrize(
    "attack",
    [
        "<% for a in range(99999) %><% for b in range(99999) %><% endfor %><% endfor %>",
        "<% macro m(n) %><< m(n - 1) ~ m(n - 1) if n else '' >><% endmacro %><< m(60) >>",
    ],
)
def test_a_template_takes_no_more_time_than_it_may(
    marker: Path, capsys: Capture, monkeypatch: pytest.MonkeyPatch, attack: str
) -> None:
    monkeypatch.setattr(render, "MAX_SECONDS", 0.5)
    _template(attack)
    started = time.monotonic()
    error = _status(capsys)
    assert "it takes more than 0.5 s" in error
    assert f"templates/{TEMPLATE}:1" in error
    assert time.monotonic() - started < 20


def test_a_link_out_of_the_template_folder_is_refused(marker: Path, tmp_path: Path, capsys: Capture) -> None:
    secret = tmp_path / "secret" / "revolute.mo.jinja"
    secret.parent.mkdir()
    secret.write_text("secret")
    file = Path("templates", TEMPLATE)
    file.unlink()
    file.symlink_to(secret)
    assert "link leads out of the template folder" in _status(capsys)
    shutil.rmtree("templates/joint")
    Path("templates/joint").symlink_to(secret.parent)
    assert "link leads out of the template folder" in _status(capsys)
    Path("templates/joint").unlink()
    for path in ("../../secret/revolute.mo.jinja", str(secret)):
        _template(f"<% include {path!r} %>")
        assert "there is no template" in _status(capsys)


def test_a_link_inside_of_the_template_folder_is_followed(marker: Path, capsys: Capture) -> None:
    _template("<< 1 >", "other.jinja")
    Path("templates", TEMPLATE).unlink()
    Path("templates", TEMPLATE).symlink_to("../other.jinja")
    assert "link" not in _status(capsys)
