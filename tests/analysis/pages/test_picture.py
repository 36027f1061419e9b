"""The picture of a robot: which meshes are shown, how fine they are, and what the page says of the others."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any, cast

import pytest
import trimesh
from support.commands import Execute
from support.meshes import NODES, tenfold
from support.pages import data_of, faces_of, read

from urdfsync.domain.scene import PageMesh
from urdfsync.engine.result import Exit
from urdfsync.formats.urdf import scene

Report = Callable[..., Path]


@pytest.mark.slow
def test_a_mesh_that_is_missing_is_named(arm: Path, report: Report) -> None:
    Path("meshes/forearm_tube.stl").unlink()
    page = read(report())
    assert "link forearm, visual 1: mesh" in page.words
    assert "is not in the package" in page.words


@pytest.mark.slow
def test_large_meshes_share_what_small_ones_leave_and_the_page_has_one_line_about_coarse_ones(
    tmp_path: Path, report: Report, monkeypatch: pytest.MonkeyPatch
) -> None:
    texts = list[str]()
    for size, kind in ((1, "visual"), (3, "visual"), (4, "visual"), (5, "collision")):  # 80 to 20,480 triangles
        trimesh.creation.icosphere(size).export(tmp_path / f"{size}.stl")
        texts.append(f'<{kind}><geometry><mesh filename="{size}.stl"/></geometry></{kind}>')
    monkeypatch.chdir(tmp_path)
    Path("bot.urdf").write_text(f'<robot name="bot"><link name="base">{"".join(texts)}</link></robot>')
    Path("urdfsync.toml").write_text('[robots.bot]\nsource = "bot.urdf"\npackage = "Bot"\ncollisions = true\n')
    made, simplify = list[int](), scene.triangles

    def triangles(*arguments: Any) -> PageMesh | str:
        made.append(arguments[-1])
        return simplify(*arguments)

    monkeypatch.setattr(scene, "triangles", triangles)
    for most, fewest in ((10_000, (80, 1280, 5120, 500)), (3000, (80, 300, 1280, 0))):
        monkeypatch.setattr("urdfsync.analysis.pages.picture._MOST", most)
        made.clear()
        faces = [*faces_of(page := report()).values()]
        assert sum(faces) <= most + 200
        # those that are seen come first
        assert all(number >= least for number, least in zip((*sorted(faces[:3]), faces[3]), fewest, strict=True)), faces
        assert len(made) == 4, "each mesh is read once"
    before = page.read_bytes()
    made.clear()
    assert re.search(r"2 meshes are coarser here than in the file: \S+ has [\d,]+ of its 20,480 tri", read(page).words)
    assert report().read_bytes() == before
    assert made == [3000] * 2  # two meshes stayed as they are; what was simplified is remembered


def test_a_mesh_that_is_mirrored_is_stored_once(tmp_path: Path, report: Report) -> None:
    trimesh.creation.box((1, 2, 3)).export(tmp_path / "foot.stl")
    feet = (
        f'<visual><origin xyz="0 {y} 0"/><geometry><mesh filename="foot.stl" scale="2 {y} 1"/></geometry></visual>'
        for y in (1, -1)
    )
    page = report(f'<robot name="bot"><link name="base">{"".join(feet)}</link></robot>')
    (name,) = faces_of(page)
    scene_ = cast(Any, data_of(read(page))["now"])
    shapes = scene_["bodies"][0]["shapes"]
    assert [(shape["mesh"], shape["pose"][0], shape["pose"][5]) for shape in shapes] == [(name, 2, 1), (name, 2, -1)]


@pytest.mark.slow
def test_a_mesh_that_is_too_large_for_the_package_is_shown_and_one_that_is_damaged_is_not_shown(
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
    assert "triangles, more than 1,000,000; left out" in page.words
    assert re.search(r"damaged\S*\.stl can't be shown: \w+", page.words)
    (faces,) = faces_of(file).values()
    assert 200_000 < faces <= 500_000
    assert "coarser" not in page.words  # nothing visible is lost


def test_instances_in_instances_are_left_out_as_by_builds(tmp_path: Path, report: Report) -> None:
    (tmp_path / "ball.dae").write_text(tenfold(20, '<instance_geometry url="#g"/>'))
    shape = '<visual><geometry><mesh filename="ball.dae"/></geometry></visual>'
    page = read(report(f'<robot name="ball"><link name="base">{shape}</link></robot>'))
    assert page.words.count(NODES) == 2  # as a finding of the build, and of the picture
    assert "takes more than" not in page.words


def test_a_domain_without_a_picture_says_so(project: Path, execute: Execute) -> None:
    assert "have no picture" in execute("report", code=Exit.ERROR).err
