"""Meshes of a stranger's: each ends in one finding within its limits. `test_hostile` brings some before commands."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import psutil
import pytest
from support.meshes import HOSTILE, LIMITS, dae, gltf, write_hostile
from support.urdfs import link, robot

from urdfsync.commands import cli
from urdfsync.formats.urdf.meshes import process
from urdfsync.formats.urdf.meshes.process import MeshError, MeshProcess, MeshRequest

Capture = pytest.CaptureFixture[str]

pytestmark = [pytest.mark.slow, pytest.mark.skipif(sys.platform != "linux", reason="elsewhere not all limits hold")]
REQUEST = MeshRequest(".dae")
SOUND = dae().encode()
ENDLESS = gltf([{"mesh": 0}] * 200_000, [*range(200_000)]).encode()


@pytest.fixture
def reader() -> Iterator[MeshProcess]:
    found = MeshProcess()
    yield found
    found.end()


def _configure(*meshes: str) -> None:
    """A robot whose base shows these meshes, and one that shows none."""
    shapes = "".join(f'<visual><geometry><mesh filename="{mesh}"/></geometry></visual>' for mesh in meshes)
    Path("arm.urdf").write_text(robot(f'<link name="base">{shapes}</link>'))
    Path("other.urdf").write_text(robot(link("base", 1.0)))
    tables = [f'[robots.{name}]\nsource = "{name}.urdf"\npackage = "{name.title()}"\n' for name in ("arm", "other")]
    Path("urdfsync.toml").write_text("".join(tables))


@pytest.mark.parametrize("name", HOSTILE)
def test_each_ends_in_one_finding_within_its_limits(
    folder: Path, capsys: Capture, monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    if HOSTILE[name][1] == LIMITS:
        monkeypatch.setattr(process, "CPU_SECONDS", 1.0)
    write_hostile(folder, name)
    _configure(name)
    assert cli.main(["build", "arm", "--dry-run", "--verbose"]) == 0
    (finding,) = [line for line in "".join(capsys.readouterr()).splitlines() if "warning:" in line]
    assert finding.startswith("arm.urdf:3: warning:")
    assert name in finding
    assert finding.endswith("[mesh-unreadable]")
    assert re.search(HOSTILE[name][1], finding), finding


# --- the process ------------------------------------------------------------------------------------------------------


def _pid() -> int:
    """The process that was started last."""
    return max(psutil.Process().children(), key=psutil.Process.create_time).pid


def test_the_process_is_kept_until_a_mesh_breaks_a_limit(reader: MeshProcess, monkeypatch: pytest.MonkeyPatch) -> None:
    ((stl, facts),) = reader.read(REQUEST, SOUND)
    assert (len(stl), facts["bounds"]) == (134, [[0, 0, 0], [1, 1, 0]])
    first = _pid()
    with pytest.raises(MeshError, match="well-formed"):
        reader.read(REQUEST, b"<a")
    assert (reader.read(REQUEST, SOUND), _pid()) == ([(stl, facts)], first)
    monkeypatch.setattr(process, "CPU_SECONDS", 0.3)
    with pytest.raises(MeshError, match=LIMITS):
        reader.read(MeshRequest(".gltf"), ENDLESS)
    assert not psutil.pid_exists(first)
    monkeypatch.undo()
    assert reader.read(REQUEST, SOUND) == [(stl, facts)]
    assert _pid() != first


def test_time_by_the_clock_is_limited_too(reader: MeshProcess, monkeypatch: pytest.MonkeyPatch) -> None:
    reader.read(REQUEST, SOUND)
    os.kill(_pid(), signal.SIGSTOP)
    monkeypatch.setattr(process, "WALL_SECONDS", 0.2)
    with pytest.raises(MeshError, match=LIMITS):
        reader.read(REQUEST, SOUND)


@pytest.mark.parametrize(("program", "words"), [
    ("import os; os.abort()", "the process that reads the file fails"),
    ("print('{\"sizes\": [1000000000]}', flush=True); input()", "the process that reads the file fails"),
    ("print('no answer', flush=True); input()", "the process that reads the file fails"),
    ('print(\'{"problem": "it \\\\u001b[2J\\\\n is wrong"}\', flush=True); input()', r"it  \[2J  is wrong"),
])  # fmt: skip
def test_a_crash_and_a_wrong_answer_are_told(
    reader: MeshProcess, monkeypatch: pytest.MonkeyPatch, program: str, words: str
) -> None:
    monkeypatch.setattr(process, "python_module", lambda _module: [sys.executable, "-c", program])
    with pytest.raises(MeshError, match=words):
        reader.read(REQUEST, SOUND)


def test_an_interruption_is_heard_while_a_mesh_is_read(reader: MeshProcess) -> None:
    reader.read(REQUEST, SOUND)
    first = _pid()
    signal.setitimer(signal.ITIMER_REAL, 0.5)
    before = signal.signal(signal.SIGALRM, signal.default_int_handler)
    try:
        with pytest.raises(KeyboardInterrupt):
            reader.read(MeshRequest(".gltf"), ENDLESS)
    finally:
        signal.signal(signal.SIGALRM, before)
    assert not psutil.pid_exists(first)
    assert reader.read(REQUEST, SOUND)


def test_the_process_ends_with_whoever_started_it(tmp_path: Path) -> None:
    program = (
        "import os, psutil; from urdfsync.formats.urdf.meshes.process import MeshProcess, MeshRequest;"
        "reader = MeshProcess();"
        f"reader.read(MeshRequest('.dae'), {SOUND!r}); print(psutil.Process().children()[0].pid, flush=True);"
        "os.kill(os.getpid(), 9)"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False)
    end = time.monotonic() + 30
    while psutil.pid_exists(int(done.stdout)) and psutil.Process(int(done.stdout)).status() != psutil.STATUS_ZOMBIE:
        assert time.monotonic() < end
        time.sleep(0.05)


def test_it_imports_nothing_from_the_working_folder_and_writes_nothing(folder: Path, reader: MeshProcess) -> None:
    for name in ("collada", "numpy", "msgspec", "urdfsync", "signal", "resource", "sitecustomize"):
        (folder / f"{name}.py").write_text(f"open({str(folder / 'mark')!r}, 'w').close()\n")
    assert reader.read(REQUEST, SOUND)
    assert not (folder / "mark").exists()
