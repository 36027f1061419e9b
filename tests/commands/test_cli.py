"""The commands as people and programs use them: output, exit codes, JSON."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from unittest import mock

import pytest
from support.commands import Execute

from urdfsync.commands import cli
from urdfsync.project import config


def test_the_configuration_is_found_or_named(
    project: Path, tmp_path: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch
) -> None:
    (project / "deep").mkdir()
    monkeypatch.chdir(project / "deep")
    assert cli.main(["build"]) == 0
    assert (project / "modelica/Ladder").is_dir()
    monkeypatch.chdir(tmp_path)
    execute("build", "--config", "project/urdfsync.toml")
    assert execute("build", code=2).err.startswith("error: no urdfsync.toml in ")
    os.mkfifo("urdfsync.toml")
    assert "the configuration can't be read: it is not a regular file" in execute("build", code=2).err
    assert execute("build", "--config", "nothing.toml", code=2).err.startswith(
        "nothing.toml: error: the configuration does not exist"
    )


def test_python_runs_it_as_a_module(project: Path) -> None:
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)}
    command = [sys.executable, "-m", "urdfsync"]
    done = subprocess.run([*command, "build", "-n"], env=environment, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (0, "ladder: 14 files to write\n", "")
    helped = subprocess.run([*command, "--help"], env=environment, capture_output=True, text=True, check=True).stdout
    assert helped.startswith("usage: urdfsync ")
    assert "resolve" in helped


def test_whatever_the_system_refuses_is_one_line(
    project: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch
) -> None:
    error = PermissionError(13, "Permission denied", "somewhere")
    monkeypatch.setattr(config, "load", mock.Mock(side_effect=error))
    assert execute("build", code=2).err == "somewhere: error: Permission denied [system]\n"
