"""A file of the user's that no build can read; `tests/scenarios/edits.txt` has what becomes of hand edits."""

from __future__ import annotations

import builtins
import errno
import os
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest
from support.networks import C1, LADDER, drop, run


@pytest.mark.parametrize(
    ("module", "name"), [(None, ""), (builtins, "open"), (os, "lstat")], ids=["link", "file", "folder"]
)
def test_an_own_class_that_cant_be_read_stops_no_build(
    project: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, module: ModuleType | None, name: str
) -> None:
    """Neither where it is behind a link, nor where the file is refused, nor where its folder lets nobody look at it."""
    run()
    mine, refused = Path(f"{LADDER}/Elements/Mine.mo").absolute(), [""]
    mine.write_text("within Ladder.Elements;\nmodel Mine\n  extends C1;\nend Mine;\n")
    drop("C1")
    if module is None:
        mine.symlink_to(mine.rename(tmp_path / "Mine.mo"))
    else:
        real = getattr(module, name)
        refused.clear()

        def refusing(path: Any, *arguments: Any, **keywords: Any) -> Any:
            if str(path) == str(mine):
                refused.append(path)
                raise PermissionError(errno.EACCES, "Permission denied", str(path))
            return real(path, *arguments, **keywords)

        monkeypatch.setattr(module, name, refusing)
    result = run()
    assert refused
    assert {finding.code for finding in result.diagnostics} <= {"order-lacks"}
    assert not Path(C1).exists()
