"""The systemd unit of `docs/watch.md` is one that systemd takes."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
from pathlib import Path

import pytest

PAGE = (Path(__file__).parents[1] / "docs" / "watch.md").read_text(encoding="utf-8")
(UNIT,) = re.findall(r"```ini\n(.*?)```", PAGE, re.DOTALL)
PROGRAM = "robots/.venv/bin/urdfsync"

needs_systemd = pytest.mark.skipif(not shutil.which("systemd-analyze"), reason="systemd-analyze is not installed")


def complaints(unit: str, home: Path) -> str:
    """What systemd has to say of a user unit, where the program is in this home folder; empty if nothing."""
    program = home / PROGRAM
    program.parent.mkdir(parents=True)
    program.touch(mode=0o755)
    file = home / "urdfsync.service"
    file.write_text(unit, encoding="utf-8")
    found = subprocess.run(
        ["systemd-analyze", "verify", "--user", "--man=no", str(file)],
        env={**os.environ, "HOME": str(home), "XDG_RUNTIME_DIR": str(home)},
        capture_output=True,
        text=True,
        check=False,
    )
    return found.stdout + found.stderr + (f"exit code {found.returncode}" if found.returncode else "")


@needs_systemd
def test_the_unit_is_right(tmp_path: Path) -> None:
    assert complaints(UNIT, tmp_path) == ""


def test_the_unit_starts_what_can_be_started_again() -> None:
    assert f"ExecStart=%h/{PROGRAM} watch\n" in UNIT
    assert "RestartPreventExitStatus=2 4\n" in UNIT, "an error and a lock, see `urdfsync.engine.result.Exit`"
