"""The picture of a robot: which meshes are shown, which are simplified, and what is said of the others."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
import trimesh
from support.commands import Execute
from support.pages import faces_of, read

from urdfsync.engine.result import Exit
from urdfsync.pages.scene import Triangles
from urdfsync.urdf import scene

Report = Callable[..., Path]


def test_a_mesh_that_is_missing_is_named(arm: Path, report: Report) -> None:
    Path("meshes/forearm_tube.stl").unlink()
    page = read(report())
    assert "link forearm, visual 1: mesh" in page.words
    assert "is not in the package" in page.words


def test_a_large_mesh_is_simplified_once_and_the_page_says_so(
    arm: Path, report: Report, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("urdfsync.pages.picture._MOST", 200)
    told = r"Resources/(\S*)\.(?:stl|obj) is simplified for this page: \d+ of its [\d,]+ triangles are left"
    page, paths, simplify = report(), list[str](), scene.triangles
    before, large = page.read_bytes(), re.findall(told, read(page).words)
    assert len(large) > 1

    def triangles(path: str, *rest: Any) -> Triangles | str:
        paths.append(path)
        return simplify(path, *rest)

    monkeypatch.setattr(scene, "triangles", triangles)
    assert report().read_bytes() == before
    assert paths
    assert not any(name in path for path in paths for name in large)


def test_meshes_have_equal_shares_of_what_the_page_may_have(
    arm: Path, report: Report, monkeypatch: pytest.MonkeyPatch
) -> None:
    whole = faces_of(report())
    monkeypatch.setattr("urdfsync.pages.picture._MOST_IN_ALL", 700 * len(whole))
    shared = faces_of(report())
    for name, faces in whole.items():
        assert shared[name] == faces if faces <= 700 else 200 < shared[name] <= 700
    assert max(whole.values()) > 700


@pytest.mark.slow
def test_a_mesh_that_is_too_large_for_the_package_is_simplified_and_one_that_is_damaged_is_not_shown(
    tmp_path: Path, report: Report
) -> None:
    ball = trimesh.creation.icosphere(8)  # 1.3 million triangles
    ball.export(tmp_path / "ball.ply")
    (tmp_path / "damaged.stl").write_bytes(b"solid\n")
    shapes = (
        f'<visual><geometry><mesh filename="{name}" scale="2 2 2"/></geometry></visual>'
        for name in ("ball.ply", "damaged.stl")
    )
    file = report(f'<robot name="ball"><link name="base">{"".join(shapes)}</link></robot>')
    page = read(file)
    assert "it has more than 1,000,000 triangles; left out" in page.words
    assert re.search(
        r"ball\S*\.stl is simplified for this page: [\d,]+ of its 1,310,720 triangles are left", page.words
    )
    assert re.search(r"damaged\S*\.stl can't be shown: it", page.words)
    (faces,) = faces_of(file).values()
    assert 10_000 < faces <= 60_000


def test_a_domain_without_a_picture_says_so(project: Path, execute: Execute) -> None:
    assert "have no picture" in execute("report", code=Exit.ERROR).err
