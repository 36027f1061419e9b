"""Files: how they are shown and hashed, which are read, and that none is left half written."""

from __future__ import annotations

from pathlib import Path

import pytest

from urdfsync.files import shown


def test_paths_are_shown_as_they_are_seen_from_the_working_folder(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    inside, beside = tmp_path / "cad" / "arm.urdf", tmp_path.with_name(f"{tmp_path.name}-2") / "arm.urdf"
    assert [shown(path) for path in (tmp_path, inside, beside)] == [".", str(Path("cad/arm.urdf")), str(beside)]
