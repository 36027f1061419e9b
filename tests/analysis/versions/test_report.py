"""The section of a comparison."""

from __future__ import annotations

from pathlib import Path

import pytest
from support.commands import Execute

from urdfsync.analysis.versions.comparison import Comparison


def test_the_package_is_judged_as_often_for_many_files(
    folder: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A judgement reads all actions: with one for each file, `diff` took minutes for 10,000 rows."""
    asked, judge = list[Comparison](), vars(Comparison)["in_step"].fget

    def count(compared: Comparison) -> bool:
        asked.append(compared)
        return bool(judge(compared))

    monkeypatch.setattr(Comparison, "in_step", property(count))
    source, counts = Path("p.csv"), list[int]()
    source.write_text("name,m [kg]\nA,1\n")
    execute("init", "--domain", "table", "p.csv")
    execute("build")
    for rows in ("A,2", "A,2\nB,3\nC,4\nD,5"):
        source.write_text(f"name,m [kg]\n{rows}\n")
        asked.clear()
        execute("diff", code=None)
        counts.append(len(asked))
    assert counts[0] == counts[1] > 0
