"""A project in a folder whose name is not UTF-8: every command works there, and its JSON can be read."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
from support.git import NEEDS_GIT, Repository
from support.urdfs import joint, limit, link, robot

pytestmark = [
    NEEDS_GIT,
    pytest.mark.slow,
    pytest.mark.skipif(sys.platform != "linux", reason="file systems elsewhere refuse such names"),
]
PROGRAM = Path(sys.executable).with_name("urdfsync")


def urdf(mass: float) -> str:
    return robot(
        link("base"), link("arm", mass), joint("elbow", "revolute", "base", "arm", axis="0 0 1", inside=[limit()])
    )


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    folder = tmp_path / os.fsdecode(b"caf\xe9")
    Repository(folder, monkeypatch)
    monkeypatch.chdir(folder)
    Path("arm.urdf").write_text(urdf(1.0))
    return folder


def run(*arguments: str, code: int = 0) -> str:
    """Run a command; returns its output."""
    environment = {**os.environ, "LC_ALL": "C.UTF-8"}
    done = subprocess.run([PROGRAM, *arguments], capture_output=True, env=environment, check=False)
    assert (done.returncode, b"Traceback" in done.stderr) == (code, False), done.stderr
    return done.stdout.decode()


def test_every_command_works(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    run("init")
    assert json.loads(run("build", "--format=json"))["exit"] == 0
    subprocess.run(["git", "add", "-A"], check=True)
    for _ in range(2):  # the second answer is a saved one
        assert run("build").startswith("arm: in step")
    (record,) = Path("modelica/Arm/Links").glob("Arm_link_*Parameters.mo")
    record.write_text(record.read_text().replace("mass = 1,", "mass = 2,"))
    Path("arm.urdf").write_text(urdf(1.5))
    assert "1.5" in run("diff", code=1)
    assert json.loads(run("build", "--format=json", code=3))["exit"] == 3
    assert "conflict" in run("status", code=3)
    subprocess.run(["git", "add", "-A"], check=True)
    assert json.loads(run("hook", "check", "--format=json", code=3))["exit"] == 3
    assert json.loads(run("resolve", str(folder / record), "--take", "--format=json"))["exit"] == 0
    assert json.loads(run("diff", "--against", "HEAD", "--format=json", code=2))["exit"] == 2  # nothing is committed
    run("hook", "build", code=1)
    run("record", str(folder / "arm.urdf"), "-o", str(folder / "Arm.mo"))
    monkeypatch.chdir("/")
    config = str(folder / "urdfsync.toml")
    assert json.loads(run("status", "--config", config, "--format=json"))["exit"] == 0
    assert "caf" in run("init", str(folder / "arm.urdf"), "--config", str(folder / "other.toml"))
