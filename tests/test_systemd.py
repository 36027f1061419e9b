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


@pytest.mark.skipif(not shutil.which("systemd-analyze"), reason="systemd-analyze is not installed")
def test_the_unit_is_right(tmp_path: Path) -> None:
    program, file = tmp_path / PROGRAM, tmp_path / "urdfsync.service"
    program.parent.mkdir(parents=True)
    program.touch(mode=0o755)
    file.write_text(UNIT, encoding="utf-8")
    found = subprocess.run(
        ["systemd-analyze", "verify", "--user", "--man=no", str(file)],
        env={**os.environ, "HOME": str(tmp_path), "XDG_RUNTIME_DIR": str(tmp_path)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert (found.returncode, found.stdout + found.stderr) == (0, "")


def test_the_unit_starts_what_can_be_started_again() -> None:
    assert f"ExecStart=%h/{PROGRAM} watch\n" in UNIT
    assert "RestartPreventExitStatus=2 4\n" in UNIT, "an error and a lock, see `urdfsync.engine.result.Exit`"
