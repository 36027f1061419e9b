"""Whatever is wrong with the standard streams, the work is done, and nothing crashes."""

from __future__ import annotations

import json
import os
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

import urdfsync

MESH = '<visual><geometry><mesh filename="gone.stl"/></geometry></visual>'
URDF = f'<robot name="arm"><link name="base">{MESH}</link></robot>'

posix = pytest.mark.skipif(sys.platform == "win32", reason="needs a POSIX shell")
full = pytest.mark.skipif(not Path("/dev/full").exists(), reason="there is no /dev/full")


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "arm.urdf").write_text(URDF)
    robots = "".join(f'[robots.r{n}]\nsource = "arm.urdf"\npackage = "R{n}"\n' for n in range(3))
    (tmp_path / "urdfsync.toml").write_text(robots)
    return tmp_path


def shell(folder: Path, line: str, **environment: str) -> subprocess.CompletedProcess[str]:
    """Run a line of shell in which `urdfsync` is this program, and `$?` of a pipe is that of its first part."""
    program = f'urdfsync() {{ {shlex.quote(sys.executable)} -m urdfsync "$@"; }}; '
    path = os.pathsep.join(filter(None, [str(Path(urdfsync.__file__).parents[1]), os.environ.get("PYTHONPATH", "")]))
    variables = {key: value for key, value in os.environ.items() if key != "PYTHONUTF8"}
    return subprocess.run(
        ["bash", "-c", program + line],
        cwd=folder,
        env=variables | {"PYTHONPATH": path} | environment,
        capture_output=True,
        encoding="utf-8",
        errors="replace",
        check=False,
    )


def built(folder: Path) -> list[str]:
    return sorted(path.name for path in (folder / "modelica").iterdir())


@posix
@pytest.mark.parametrize("closed", [">&-", "<&- >&- 2>&-", pytest.param("2> /dev/full", marks=full)])
def test_streams_that_are_closed_or_full_stop_nothing(folder: Path, closed: str) -> None:
    done = shell(folder, f"urdfsync build {closed}")
    assert done.returncode == 0
    assert "Traceback" not in done.stderr
    assert built(folder) == ["R0", "R1", "R2"]


@posix
@pytest.mark.parametrize("options", ["--format=json", "--verbose --svg"])
def test_a_reader_that_goes_away_stops_no_work(folder: Path, options: str) -> None:
    done = shell(folder, f"urdfsync build {options} 2>errors | head -n 1; exit ${{PIPESTATUS[0]}}")
    assert done.returncode == 0
    assert len(done.stdout.splitlines()) == 1
    assert "Traceback" not in (folder / "errors").read_text()
    assert "Exception ignored" not in (folder / "errors").read_text()
    assert built(folder) == ["R0", "R1", "R2"]


@posix
@full
@pytest.mark.parametrize("command", ["build", "--help", "library --format=json"])
def test_a_full_disk_is_told_on_the_error_stream(folder: Path, command: str) -> None:
    done = shell(folder, f"urdfsync {command} > /dev/full")
    assert done.returncode == 2
    assert done.stderr.splitlines()[-1] == "error: the output can't be written: No space left on device [output]"
    assert "Traceback" not in done.stderr


@posix
@pytest.mark.parametrize("encoding", ["ascii", "cp1252"])
def test_characters_that_an_encoding_lacks_are_escaped(folder: Path, encoding: str) -> None:
    (folder / "urdfsync.toml").write_text('[robots.arm]\nsource = "Größe – 腕.urdf"\npackage = "Arm"\n')
    done = shell(folder, "urdfsync build 2>&1", PYTHONIOENCODING=encoding, PYTHONUTF8="0")
    assert done.returncode == 2
    assert "\\u8155.urdf does not exist" in done.stdout
    done = shell(folder, "urdfsync build --format=json", PYTHONIOENCODING=encoding)
    assert "腕.urdf does not exist" in json.loads(done.stdout)["results"][0]["diagnostics"][0]["message"]
