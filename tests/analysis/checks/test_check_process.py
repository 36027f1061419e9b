"""`urdfsync check` in real processes: what it prints, its memory, and what is left when it is interrupted."""

from __future__ import annotations

import json
import signal
import subprocess
import sys
import time
from pathlib import Path

import psutil
import pytest
from support.urdfs import dynamics, joint, links, robot

COMMAND = [sys.executable, "-m", "urdfsync", "check", "--format=json"]
MEGABYTE = 1e6

ARM = robot(
    *links(base=3.0, arm=2.0), joint("shoulder", "continuous", "base", "arm", axis="0 1 0", inside=[dynamics(0.5, 0.2)])
)

pytestmark = pytest.mark.slow


@pytest.fixture
def arm(tmp_path: Path, modelica_library: Path) -> Path:
    """A project with a robot that nobody built or checked before: what was found right is not compiled again."""
    damping = f"0.5{time.time_ns() % 1_000_000:06}"
    (tmp_path / "arm.urdf").write_text(ARM.replace('damping="0.5"', f'damping="{damping}"'))
    assert damping in (tmp_path / "arm.urdf").read_text()
    (tmp_path / "urdfsync.toml").write_text('[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\n')
    return tmp_path


def test_a_check_takes_little_memory_itself(arm: Path) -> None:
    """Whatever is large is in processes of its own."""
    highest = 0
    with psutil.Popen(COMMAND, cwd=arm, stdout=subprocess.PIPE, text=True) as process:
        while process.poll() is None:
            try:
                highest = max(highest, process.memory_info().rss)
            except psutil.NoSuchProcess:
                break
            time.sleep(0.05)
        document = json.loads(process.stdout.read())
    assert process.returncode == 1
    (found,) = document["results"]
    assert (found["status"], found["built"], found["diagnostics"]) == ("not built", False, [])
    assert len(found["compiled"]) == 3
    assert 0 < highest < 200 * MEGABYTE


def _is_compiler(process: psutil.Process) -> bool:
    try:
        return any("urdfsync.analysis.checks.process" in word for word in process.cmdline())
    except psutil.NoSuchProcess:  # a zombie among them
        return False


@pytest.mark.skipif(sys.platform == "win32", reason="no such signals")
@pytest.mark.parametrize("number", [pytest.param(signal.SIGINT, marks=pytest.mark.large), signal.SIGKILL])
def test_no_process_is_left_by_an_end_in_the_midst(arm: Path, number: signal.Signals) -> None:
    with psutil.Popen(COMMAND, cwd=arm, stdout=subprocess.PIPE) as process:
        compilers: list[psutil.Process] = []
        deadline = time.monotonic() + 60
        while not compilers and time.monotonic() < deadline:
            children = process.children(recursive=True)
            compilers = [child for child in children if _is_compiler(child)]
            time.sleep(0.02)
        assert compilers
        time.sleep(0.5)  # until it is at work
        process.send_signal(number)
        _, alive = psutil.wait_procs(children, timeout=60)
        assert alive == []
    assert process.returncode == (-number if number is signal.SIGKILL else 130)
