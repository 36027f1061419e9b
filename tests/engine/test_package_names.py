"""What names of a package are called now, since this build or an earlier one."""

from __future__ import annotations

from pathlib import Path

import pytest
from support.commands import Execute
from support.files import unchanged
from support.old_names import CELL, COMMAND, CONFIG, NAMES, NO_OLD_NAMES, RENAMED, make_user, texts, write_source


@pytest.fixture
def user(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, execute: Execute) -> Path:
    return make_user(tmp_path, monkeypatch, execute)


def test_what_an_earlier_build_renamed_is_renamed_by_its_names(user: Path, execute: Execute) -> None:
    hint = "`urdfsync resolve --rename-uses elbow=wrist` shows the lines, and writes them if you agree [rename-uses]"
    assert f"note: your files can get the new names; {hint}" in execute("build").words
    assert "Write 7 lines" not in execute(*COMMAND, code=2).out, "they are known until the next build that writes"
    assert "Arm has no `elbowAxis`; use `wristAxis` instead" in execute("status").err
    write_source("wrist", "push")
    execute("build")
    Path("modelica/Arm/Arm.mo").touch()
    note = f"{NO_OLD_NAMES}; give names that an earlier build renamed: --rename-uses OLD=NEW"
    assert f"note: {note} [no-old-names]" in execute(*COMMAND).errors
    with unchanged(user / "modelica/Arm/Joints"):
        assert execute(*NAMES, "--yes").lines[-1] == "7 lines in 3 files written"
    assert texts() == RENAMED


def test_a_name_that_may_mean_either_of_two_is_left_to_the_user(user: Path, execute: Execute) -> None:
    """What was `elbow` is `swing`, and what was `swing` is `wrist`."""
    write_source("swing", "wrist")
    with unchanged(user.parent):
        assert NO_OLD_NAMES in execute(*COMMAND, "--yes").err


def test_another_name_of_the_package_is_followed(user: Path, execute: Execute) -> None:
    write_source("elbow")
    Path("modelica/Arm/Links/Mine.mo").unlink()
    Path("../plant/Bench.mo").unlink()
    Path("urdfsync.toml").write_text(CONFIG.replace('"Arm"', '"Robot"'))
    execute("build")
    execute(*COMMAND, "Arm=Robot", "--yes")
    assert Path("Cell.mo").read_bytes().decode() == CELL.replace("Arm.Arm robot", "Robot.Robot robot")
