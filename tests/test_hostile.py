"""A repository of a stranger's: no command runs code of it, writes outside of it, hangs, or ends in a traceback.

Each attack of `support.hostile` meets every command in this process. In CI, all attacks meet a build, and a third of
them the other commands. Modules of the working folder meet the programs, as does a clone with all attacks at once.
Audit events of Python and a comparison of all folders show violations.
"""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Mapping, Sequence
from pathlib import Path

import pytest
from support import hostile
from support.cases import sampled
from support.git import NEEDS_GIT, Repository
from support.workplace import WATCH, Workplace, changes, check_output, contents

from urdfsync.formats.urdf.meshes import process

BIN = Path(sys.executable).parent
TESTS = Path(__file__).parent
ROBOTS = 6
"""A number of stale robots that a build plans in several processes."""
PATIENCE = 120.0
READING = (
    *(["build", "--check"], ["build", "--dry-run"], ["status", "--verbose"], ["diff"], ["hook", "check"]),
    ["report", "arm", "--output", "page.html"],
)
WRITING = (["build"], ["resolve", "--all", "--take"], ["hook", "build"])
OF_SOURCES = (["record", "arm.urdf"], ["init", "--config", "new.toml"])
"""Commands that read no configuration and no state."""
SOURCES = ("source", "chain", "entities", "numbers", "terminal", "meshes")
"""Words of the attacks that concern these commands."""
LARGE = ("a long chain", "200 MB", "meshes")
READ = (".urdfsync/deps/", ".urdfsync/notes/", ".urdfsync/lock", ".git/index", ".git/urdfsync", "page.html")
"""Files of the project that reading commands may change."""
WRITTEN = (*READ, "modelica/Arm", ".urdfsync", "new.toml", "modelica/package.order")

pytestmark = [
    NEEDS_GIT,
    pytest.mark.skipif(sys.platform == "win32", reason="the console script is another program there"),
]


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


@pytest.fixture(autouse=True)
def _little_time(monkeypatch: pytest.MonkeyPatch) -> None:
    """Give up endless meshes sooner in this process."""
    monkeypatch.setattr(process, "CPU_SECONDS", 1.0)


def _attack(
    work: Workplace, stale: Path, name: str, commands: Sequence[Sequence[str]], allowed: tuple[str, ...], afresh: bool
) -> None:
    """Run commands in a project under attack; with `afresh`, each command gets its own project."""
    for number, command in enumerate(commands):
        if number == 0 or afresh:
            work.fill(stale)
            hostile.attack(name, work.project, work.outside)
            if name in hostile.COMMITTED:
                subprocess.run(["git", "add", "-A"], cwd=work.project, check=True, capture_output=True)
            before = contents(work.project)
        work.run(command)
        changed = changes(before, contents(work.project))
        assert [path for path in changed if not path.startswith(allowed)] == [], command


ATTACKS = [name for name in hostile.ATTACKS if name not in ("modules", "a domain of the repository")]
"""Attacks for commands in this process; only programs can import modules of the working folder."""
BIG = [name for name in ATTACKS if any(word in name for word in LARGE)]
OTHERS = [name for name in ATTACKS if name not in BIG]


@pytest.mark.parametrize("name", [*OTHERS, *(pytest.param(name, marks=pytest.mark.slow) for name in BIG)])
def test_an_attack_meets_a_build(tmp_path: Path, stale: Path, name: str) -> None:
    work = Workplace(tmp_path)
    _attack(work, stale, name, READING[:1], READ, afresh=False)
    _attack(work, stale, name, WRITING[:1], WRITTEN, afresh=True)


@pytest.mark.slow
@pytest.mark.parametrize("name", [*sampled(OTHERS, 6), *(pytest.param(name, marks=pytest.mark.large) for name in BIG)])
def test_an_attack_meets_every_other_command(tmp_path: Path, stale: Path, name: str) -> None:
    work = Workplace(tmp_path)
    _attack(work, stale, name, READING[1:], READ, afresh=False)
    _attack(work, stale, name, [*WRITING[1:], ["check"], WATCH], WRITTEN, afresh=True)
    if any(word in name for word in SOURCES):
        _attack(work, stale, name, OF_SOURCES, WRITTEN, afresh=False)


# Programs


def _started(
    work: Workplace, command: Sequence[str], program: Sequence[str] = (), **variables: str
) -> subprocess.Popen[str]:
    """Run a console script in the project as a user does, without options for Python; or another program."""
    own = {key: value for key, value in os.environ.items() if not key.startswith(("XDG_", "PYTHON"))}
    return subprocess.Popen(
        [*(program or [str(BIN / "urdfsync")]), *command],
        cwd=work.project,
        env={**own, "HOME": str(work.home), "TMPDIR": str(work.folder / "temporary"), **variables},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        errors="surrogateescape",
    )


@pytest.mark.parametrize(
    ("attack", "command"),
    [
        ("modules", ["build"]),
        *(
            pytest.param("modules", command, marks=pytest.mark.slow)
            for command in (
                *(["status"], ["diff"], *WRITING[1:], ["record", "r0.urdf"], ["check", "r0"]),
                ["watch", "--settle", "10"],
            )
        ),
        ("a domain of the repository", ["build"]),
    ],
    ids=str,
)
def test_no_module_of_the_working_folder_runs(
    tmp_path: Path,
    tmp_path_factory: pytest.TempPathFactory,
    monkeypatch: pytest.MonkeyPatch,
    attack: str,
    command: Sequence[str],
) -> None:
    work = Workplace(tmp_path_factory.mktemp("w"))  # not `tmp_path`: the path of a socket has 107 bytes at most
    for number in range(ROBOTS):
        (tmp_path / "new").mkdir(exist_ok=True)
        (tmp_path / f"new/r{number}.urdf").write_text(hostile.urdf())
    tables = [f'[robots.r{n}]\nsource = "r{n}.urdf"\npackage = "R{n}"\n' for n in range(ROBOTS)]
    (tmp_path / "new/urdfsync.toml").write_text("".join(tables))
    work.fill(tmp_path / "new")
    hostile.attack(attack, work.project, work.outside)
    Repository(work.project, monkeypatch).git("add", "-A")
    with _started(work, [*command, *(["--jobs", "2"] if command == ["build"] else [])]) as process:
        if command[0] == "watch":
            end = time.monotonic() + PATIENCE
            while not (work.project / f"modelica/R{ROBOTS - 1}/package.mo").exists() and time.monotonic() < end:
                time.sleep(0.05)
            process.send_signal(signal.SIGTERM)
        said, _ = process.communicate(timeout=PATIENCE)
    check_output(command, process.returncode, said)
    assert "evil" in said or process.returncode in ({0, 1} if command[0] != "check" else range(5)), said
    assert not (work.outside / "module").exists()
    assert not (work.outside / "pth").exists()


class Clone(Workplace):
    """A clone of a repository with all attacks at once; programs in the clone log their events."""

    def __init__(self, folder: Path, stale: Path, monkeypatch: pytest.MonkeyPatch) -> None:
        super().__init__(folder)
        self.fill(stale)
        for name in hostile.TOGETHER:
            hostile.attack(name, self.project, self.outside)
        Repository(self.project, monkeypatch).git("add", "-A", "--force")
        Repository(self.project, monkeypatch).git("commit", "-q", "-m", "hostile")
        self.project.rename(folder / "origin")
        subprocess.run(["git", "clone", "-q", "origin", "project"], cwd=folder, check=True, capture_output=True)
        (folder / "site").mkdir()
        text = f"import sys; sys.path.insert(0, {str(TESTS)!r})\nfrom support import audit\nsys.path.pop(0)\n"
        (folder / "site/sitecustomize.py").write_text(f"{text}audit.log_to({str(folder / 'events')!r})\n")

    def start(self, command: Sequence[str], program: Sequence[str] = ()) -> tuple[int, str]:
        """Run a program; return exit code and output."""
        (self.folder / "events").unlink(missing_ok=True)
        variables = {"PYTHONPATH": str(self.folder / "site"), "PYTHONDONTWRITEBYTECODE": "1"}
        with _started(self, command, program, **variables) as process:
            said, _ = process.communicate(timeout=PATIENCE)
        return process.returncode, said

    def faults(self) -> list[tuple[str, str]]:
        """The forbidden events."""
        events = dict.fromkeys((self.folder / "events").read_text().splitlines())
        found = [json.loads(event) for event in events]
        return [(kind, what) for kind, what in found if not self.is_allowed(kind, what)]


@pytest.fixture(scope="module")
def clone(tmp_path_factory: pytest.TempPathFactory, stale: Path) -> Clone:
    with pytest.MonkeyPatch.context() as monkeypatch:
        return Clone(tmp_path_factory.mktemp("hostile"), stale, monkeypatch)


@pytest.mark.slow
@pytest.mark.parametrize(
    "command",
    [
        *READING,
        ["diff", "HEAD"],
        ["diff", "--against", "HEAD"],
        ["check"],
        ["resolve", "--all", "--keep", "--dry-run"],
        ["record", "arm.urdf"],
    ],
    ids=" ".join,
)
def test_a_program_that_reads_is_safe_in_a_clone_with_all_attacks(clone: Clone, command: Sequence[str]) -> None:
    def everything() -> Mapping[str, bytes | str]:
        inside = {name: text for name, text in contents(clone.project).items() if not name.startswith(READ)}
        return inside | {f"../{name}": text for name, text in clone.others().items()}

    before = everything()
    check_output(command, *clone.start(command))
    assert clone.faults() == []
    assert changes(before, everything()) == []


@pytest.mark.slow
def test_the_audit_sees_what_must_not_be(clone: Clone) -> None:
    """The tests above can fail."""
    code = "import os, socket; open('../x', 'w').close(); os.system('true'); exec(compile('1', 'evil.py', 'exec'))"
    code += "; os.remove('../x'); socket.socket().connect_ex(('127.0.0.1', 9))"
    assert clone.start(["-P", "-c", code], [sys.executable]) == (0, "")
    assert {event[0] for event in clone.faults()} == {"write", "start", "code", "connect"}
