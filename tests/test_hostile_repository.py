"""A repository that attacks in all ways at once: it is cloned, and every reading command looks at it.

Nothing of it runs, and nothing outside of urdfsync's own state and cache changes: as Python's audit events tell, and as
a comparison of the home folder, of the clone and of the folder beside it tells.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

import pytest
from support import hostile
from support.git import NEEDS_GIT, Repository
from support.workplace import changes, contents

PROGRAMS = {name: Path(sys.executable).with_name(name) for name in ("urdfsync", "urdfsync-hook")}
PATIENCE = 120.0
READING = (
    *(["status"], ["status", "--verbose"], ["diff"], ["diff", "HEAD"], ["build", "--check"], ["build", "--dry-run"]),
    *(["check"], ["resolve", "--all", "--keep", "--dry-run"], ["record", "arm.urdf"], ["hook", "check"]),
)
OWN_FILES = ("/.urdfsync/stamp", "/.urdfsync/lock")
"""What a command that only reads may write in a project; the answer is unlinked and made again."""
ALONE = "alone"
"""Folder of the repository that has each attack in a project of its own."""

pytestmark = [
    NEEDS_GIT,
    pytest.mark.slow,
    pytest.mark.skipif(sys.platform == "win32", reason="the console script is another program there"),
]


_AUDIT = '''\
"""Writes down each audit event that changes a file, starts a program, opens a connection or runs code."""

import json
import os
import sys

LOG = os.open({log!r}, os.O_WRONLY | os.O_APPEND | os.O_CREAT, 0o600)
CHANGES = {{
    "os.remove": 1, "os.rename": 2, "os.mkdir": 1, "os.rmdir": 1, "os.link": 2, "os.symlink": 2, "os.truncate": 1,
    "os.chmod": 1, "os.chown": 1, "os.utime": 1, "shutil.rmtree": 1, "os.setxattr": 1,
}}
RUNS = ("subprocess.Popen", "os.system", "os.exec", "os.posix_spawn", "os.spawn", "os.startfile", "pty.spawn")
CONNECTS = ("socket.connect", "socket.bind", "socket.getaddrinfo", "urllib.Request", "ftplib.connect")


def note(kind, *values):
    os.write(LOG, (json.dumps([kind, *map(str, values)]) + "\\n").encode())


def absolute(path):
    if isinstance(path, int):
        return f"handle {{path}}"
    return os.path.abspath(os.fsdecode(path))


def audit(event, arguments):
    if event == "open":
        path, mode, flags = arguments
        if flags & (os.O_WRONLY | os.O_RDWR | os.O_CREAT | os.O_TRUNC) and not isinstance(path, int):
            note("write", absolute(path))
    elif event in CHANGES:
        for path in arguments[: CHANGES[event]]:
            note("write", absolute(path))
    elif event == "exec":
        name = getattr(arguments[0], "co_filename", "")
        if name and not name.startswith("<"):
            note("code", absolute(name))
    elif event in RUNS:
        command = arguments[1] if event == "subprocess.Popen" else arguments[0]
        note("run", *(command if isinstance(command, (list, tuple)) else [command]))
    elif event in CONNECTS:
        note("connect", event, *arguments[1:2])


sys.addaudithook(audit)
'''


def install_audit(folder: Path, log: Path) -> None:
    """Make a folder for PYTHONPATH whose processes write their events to a log."""
    folder.mkdir()
    (folder / "sitecustomize.py").write_text(_AUDIT.format(log=str(log)))


def audit_events(log: Path) -> list[Sequence[str]]:
    """The events so far: a kind (`write`, `run`, `connect`, `code`), then paths or words. Each is there once."""
    if not log.exists():
        return []
    found = dict.fromkeys(log.read_text().splitlines())
    return [json.loads(line) for line in found]


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A project that is built, and stale."""
    project = tmp_path_factory.mktemp("built") / "project"
    hostile.write_project(project)
    subprocess.run([PROGRAMS["urdfsync"], "build", "--quiet"], cwd=project, check=True)
    hostile.make_stale(project)
    return project


class Clone:
    """A clone of the repository, and the surroundings that it is after."""

    def __init__(self, folder: Path, built: Path, monkeypatch: pytest.MonkeyPatch) -> None:
        self.root, self.home, self.outside = folder / "clone", folder / "home", folder / "outside"
        self._log, self._audit = folder / "events", folder / "audit"
        (self.outside / "folder").mkdir(parents=True)
        (self.outside / "victim.mo").write_text("precious")
        (self.home / ".ssh").mkdir(parents=True)
        (self.home / ".ssh/authorized_keys").write_text("precious")
        origin = Repository(folder / "origin", monkeypatch)
        shutil.copytree(built, origin.folder, dirs_exist_ok=True, symlinks=True)
        for number, (name, attack) in enumerate(hostile.ATTACKS.items()):
            if attack.is_committed:
                alone = origin.folder / ALONE / str(number)
                shutil.copytree(built, alone, symlinks=True)
                attack.make(alone, self.outside)
                if name in hostile.TOGETHER:
                    attack.make(origin.folder, self.outside)
        origin.git("add", "-A", "--force")
        origin.git("commit", "-q", "-m", "hostile")
        subprocess.run(["git", "clone", "-q", str(origin.folder), str(self.root)], check=True, capture_output=True)
        install_audit(self._audit, self._log)

    def run(self, folder: Path, command: Sequence[str]) -> subprocess.CompletedProcess[str]:
        """Run a command as its program, under audit."""
        program, *arguments = ["urdfsync-hook", *command[1:]] if command[0] == "hook" else ["urdfsync", *command]
        return self.start(folder, [str(PROGRAMS[program]), *arguments])

    def run_all(self, folder: Path, commands: Sequence[Sequence[str]]) -> subprocess.CompletedProcess[str]:
        """Run commands one after the other in one process, under audit; its exit code is the largest."""
        code = f"import sys; from urdfsync import cli; sys.exit(max(map(cli.main, {[*map(list, commands)]!r})))"
        return self.start(folder, [sys.executable, "-P", "-c", code])

    def start(self, folder: Path, command: Sequence[str]) -> subprocess.CompletedProcess[str]:
        """Start any program, under audit."""
        self._log.unlink(missing_ok=True)
        variables = {"HOME": str(self.home), "PYTHONPATH": str(self._audit), "PYTHONDONTWRITEBYTECODE": "1"}
        environment = {name: value for name, value in os.environ.items() if not name.startswith(("XDG_", "PYTHON"))}
        return subprocess.run(
            command,
            cwd=folder,
            env=environment | variables,
            capture_output=True,
            text=True,
            errors="surrogateescape",
            timeout=PATIENCE,
            check=False,
        )

    def contents(self) -> Mapping[str, bytes | str]:
        """All that must not change, by a path that begins with its place."""
        found = {
            f"{place.name}/{name}": content
            for place in (self.root, self.home, self.outside)
            for name, content in contents(place).items()
        }
        return {name: content for name, content in found.items() if not self._is_own(name)}

    def _is_own(self, name: str) -> bool:
        if name.startswith("clone/"):
            return name.endswith(OWN_FILES)
        return name == "home/.cache" or f"{name}/".startswith("home/.cache/urdfsync/")

    def faults(self) -> list[Sequence[str]]:
        """The events that must not be."""
        temporary = Path(os.environ.get("TMPDIR") or "/tmp")  # where tracebacks and the hook's checkout go
        return [event for event in audit_events(self._log) if not self._is_allowed(event, temporary)]

    def _is_allowed(self, event: Sequence[str], temporary: Path) -> bool:
        kind, first, *_ = event
        if kind == "run":
            return Path(first).name == "git" or Path(first).resolve() == Path(sys.executable).resolve()
        path = Path(first)
        if kind == "code":  # the sandbox runs templates, whose code has the template's name
            return not path.is_relative_to(self.root) or path.suffix == ".jinja"
        if kind == "write":
            places = (self.root, self.home, self.outside)
            inside = any(path.is_relative_to(place) for place in places)
            cache = path.is_relative_to(self.home / ".cache/urdfsync") or path == self.home / ".cache"
            state = (
                path.is_relative_to(self.root)
                and path.parent.name == ".urdfsync"
                and path.name.startswith(("stamp", "lock"))
            )
            return cache or state or (not inside and (path.is_relative_to(temporary) or str(path).startswith("/dev/")))
        return False


@pytest.fixture(scope="module")
def clone(tmp_path_factory: pytest.TempPathFactory, built: Path) -> Iterator[Clone]:
    with pytest.MonkeyPatch.context() as monkeypatch:
        yield Clone(tmp_path_factory.mktemp("hostile"), built, monkeypatch)


def _assert_harmless(clone: Clone, before: Mapping[str, bytes | str], done: subprocess.CompletedProcess[str]) -> None:
    assert done.returncode in range(5), done.stderr
    assert "Traceback" not in done.stderr, done.stderr
    assert ".traceback.txt" not in done.stderr, done.stderr
    assert {char for char in done.stdout + done.stderr if not char.isprintable()} <= {"\n"}
    assert changes(before, clone.contents()) == []
    assert clone.faults() == []


@pytest.mark.parametrize("command", READING, ids=" ".join)
def test_a_command_that_reads_is_safe_in_a_repository_with_all_attacks(clone: Clone, command: Sequence[str]) -> None:
    before = clone.contents()
    _assert_harmless(clone, before, clone.run(clone.root, command))


@pytest.mark.parametrize("name", [name for name, attack in hostile.ATTACKS.items() if attack.is_committed])
def test_commands_that_read_are_safe_from_each_attack_alone(clone: Clone, name: str) -> None:
    before, number = clone.contents(), list(hostile.ATTACKS).index(name)
    _assert_harmless(clone, before, clone.run_all(clone.root / ALONE / str(number), READING))


def test_the_audit_sees_what_must_not_be(clone: Clone) -> None:
    """So that the tests above can fail."""
    code = "import os, socket; open('x', 'w').close(); os.system('true'); exec(compile('1', 'evil.py', 'exec'))"
    code += "; os.remove('x'); socket.socket().connect_ex(('127.0.0.1', 9))"
    done = clone.start(clone.root, [sys.executable, "-P", "-c", code])
    assert done.returncode == 0, done.stderr
    assert {event[0] for event in clone.faults()} == {"write", "run", "code", "connect"}
