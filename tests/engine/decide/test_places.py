"""Which file on disk is that of a part: stamps say it, and a stranger may have written any stamp."""

from __future__ import annotations

from pathlib import Path

import pytest
from support.commands import Execute

from urdfsync.common.files import text_hash
from urdfsync.modelica.stamp import Stamp, split, with_stamp

ELEMENTS = Path("modelica/Ladder/Elements")


@pytest.mark.parametrize("is_gone", [False, True])
def test_a_file_whose_stamp_says_that_it_is_unedited_moves_only_if_a_build_wrote_its_text(
    execute: Execute, project: Path, is_gone: bool
) -> None:
    execute("build")
    part = project / ELEMENTS / "R1.mo"
    bare, stamp = split(part.read_text())
    assert stamp is not None
    text = bare.replace("R1", "Mine").encode()
    mine = part.with_name("Mine.mo")
    mine.write_bytes(with_stamp(text, Stamp(stamp.id, text_hash(text))))
    if is_gone:
        part.unlink()
    execute("build")
    assert split(mine.read_text())[0].encode() == text
    assert split(part.read_text())[0] == bare
