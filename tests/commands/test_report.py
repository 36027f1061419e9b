"""`urdfsync report`: where the page goes, and when there is none."""

from __future__ import annotations

from pathlib import Path

import pytest
from support.commands import Execute

from urdfsync.engine.result import Exit


@pytest.fixture
def arm(folder: Path, execute: Execute) -> Path:
    """The source of a project with one robot."""
    Path("arm.urdf").write_text('<robot name="arm"><link name="base"/></robot>')
    execute("init", "arm.urdf", "-q")
    return folder / "arm.urdf"


def test_the_page_is_where_it_is_wanted_and_replaces_nothing_else(arm: Path, execute: Execute) -> None:
    assert "page: arm.html" in execute("report").out
    assert execute("report", "--format=json").json["results"][0]["bytes"] == Path("arm.html").stat().st_size
    Path("arm.html").write_text("<p>mine</p>")
    assert "urdfsync did not write it" in execute("report", code=Exit.ERROR).err
    assert Path("arm.html").read_text() == "<p>mine</p>"
    assert "a page's name ends with .html" in execute("report", "-o", "arm.urdf", code=Exit.ERROR).err
    assert "there is no such folder" in execute("report", "--output", "none/arm.html", code=Exit.ERROR).err


def test_a_source_that_can_not_be_read_writes_no_page(arm: Path, execute: Execute) -> None:
    arm.write_text("<robot>")
    assert "error" in execute("report", code=Exit.ERROR).err
    assert not Path("arm.html").exists()
    assert "old-page" not in execute("report", code=Exit.ERROR).err


def test_a_page_that_a_refused_export_leaves_in_place_is_told(arm: Path, execute: Execute) -> None:
    execute("report")
    page = Path("arm.html").read_bytes()
    arm.write_text("<robot>")
    assert "arm.html: warning: this page was not written: it shows an older version" in execute("report", code=2).err
    assert Path("arm.html").read_bytes() == page
