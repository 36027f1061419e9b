"""The page as text: one file, whose policy names its scripts, and in which no text of a source is markup."""

from __future__ import annotations

import base64
import hashlib
import json
import math
import re
import shutil
import subprocess
from collections.abc import Callable, Mapping
from html.parser import HTMLParser
from pathlib import Path
from typing import Any, cast
from xml.sax.saxutils import quoteattr

import pytest
import trimesh
from support.commands import Execute
from support.git import NEEDS_GIT, Repository

from urdfsync import cli, config
from urdfsync.checks.cache import UserCache
from urdfsync.checks.results import CheckResult, CompiledModel, EditEffect, ToolResult
from urdfsync.domain import Deviation, Quantity
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.result import Exit
from urdfsync.pages import page as page_module
from urdfsync.pages.content import gather
from urdfsync.pages.page import FOLLOWER, SCRIPTS
from urdfsync.pages.page import page as page_of
from urdfsync.scene import Triangles
from urdfsync.urdf.domain import UrdfDomain

Report = Callable[..., Path]
STILL = '<robot name="still"><link name="only"/></robot>'


class _Elements(HTMLParser):
    """The start tags of a page, and the texts of its scripts and styles."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.tags: list[tuple[str, dict[str, str | None]]] = []
        self.raw: list[tuple[str, dict[str, str | None], str]] = []
        self.words = ""
        self._open: tuple[str, dict[str, str | None]] | None = None
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append((tag, dict(attrs)))
        self._open = (tag, dict(attrs)) if tag in ("script", "style") else None

    def handle_data(self, data: str) -> None:
        if self._open:
            self.raw.append((*self._open, data))
        else:
            self.words += data

    def handle_endtag(self, tag: str) -> None:
        self._open = None


def read(file: Path) -> _Elements:
    return _Elements(file.read_text("utf-8"))


def data_of(page: _Elements) -> dict[str, object]:
    (text,) = (text for _, attributes, text in page.raw if attributes.get("id") == "data")
    values: dict[str, object] = json.loads(text)
    return values


def faces_of(file: Path) -> dict[str, int]:
    """Return the number of triangles of each mesh."""
    meshes = cast(Mapping[str, list[int]], data_of(read(file))["meshes"])
    return {name: faces for name, (_, faces) in meshes.items()}


def test_the_policy_has_the_hash_of_each_script_and_style(arm: Path, report: Report) -> None:
    page = read(report())
    (policy,) = (each["content"] for tag, each in page.tags if each.get("http-equiv") == "Content-Security-Policy")
    assert policy is not None
    assert policy.startswith("default-src 'none'; script-src 'sha256-")
    assert "unsafe" not in policy
    run = [text for tag, attributes, text in page.raw if tag == "style" or "type" not in attributes]
    assert len(run) == 2 + len(SCRIPTS)  # the style, three.js, and ours
    for text in run:
        assert base64.b64encode(hashlib.sha256(text.encode()).digest()).decode() in policy
    assert not [tag for tag, attributes in page.tags if {"src", "style", "onclick", "onload"} & attributes.keys()]
    assert not [each for tag, each in page.tags if tag == "a" and not str(each.get("href")).startswith("#")]


def test_names_are_no_markup_wherever_they_stand(report: Report) -> None:
    name = "</script><script>alert(1)</script><!-- \"'&"
    urdf = f"<robot name={quoteattr(name)}><link name={quoteattr(name)}/></robot>"
    plain, page = read(report(STILL)), read(report(urdf))
    assert [tag for tag, _ in page.tags] == [tag for tag, _ in plain.tags]
    now = data_of(page)["now"]
    assert isinstance(now, dict)
    assert now["bodies"][0]["element"] == f"link {name}"


def test_the_page_names_the_licence_of_three_js_and_what_wrote_it(report: Report) -> None:
    page = read(report(STILL))
    assert re.search(r"three\.js r\d+ \(Copyright .*; SPDX-License-Identifier: MIT\)", page.words)
    assert any(
        str(each.get("content")).startswith("urdfsync ") for _, each in page.tags if each.get("name") == "generator"
    )


def test_the_six_axis_arm_has_less_than_3_mb(arm: Path, report: Report) -> None:
    assert report().stat().st_size < 3_000_000


def test_changes_edits_and_conflicts_are_told(arm: Path, report: Report) -> None:
    cli.main(["build", "--quiet"])
    numbers, wrist = Path("modelica/Arm/Links/ForearmParameters.mo"), Path("modelica/Arm/Links/Wrist.mo")
    numbers.write_text(numbers.read_text().replace("4.2", "4.35"))
    wrist.write_text(wrist.read_text().replace("equation\n", "  parameter Real mine = 3;\nequation\n", 1))
    arm.write_text(arm.read_text().replace('<mass value="4.2"/>', '<mass value="5.1"/>'))
    page = read(report())
    words = " ".join(page.words.split())
    assert re.search(r"inertial / mass ?4\.2 → 5\.1 kg ?\+21\.4 %", words)
    assert "you edited it, and its generated text changed too" in words
    assert "+ parameter Real mine = 3;" in words
    assert "- mass = 4.2," in words
    values = data_of(page)
    assert values["statuses"] == {"link forearm": "changed"}
    assert values["changes"] == {"link forearm": ["inertial / mass 4.2 → 5.1 kg (+21.4 %)"]}
    assert values["before"] is not None


def test_nothing_changed_has_no_older_version(arm: Path, report: Report) -> None:
    cli.main(["build", "--quiet"])
    page = read(report())
    assert data_of(page)["before"] is None
    assert "nothing changed since the last build" in page.words


@NEEDS_GIT
def test_a_revision_is_the_older_version(arm: Path, report: Report, monkeypatch: pytest.MonkeyPatch) -> None:
    repository = Repository(arm.parent, monkeypatch)
    repository.commit("first")
    arm.write_text(
        arm.read_text()
        .replace('<link name="grasp_point"', '<link name="grip"')
        .replace('link="grasp_point"', 'link="grip"')
        .replace('reference="grasp_point"', 'reference="grip"')
    )
    values = data_of(read(report("", "--against", "HEAD")))
    assert values["renamed"] == {"link grasp_point": "link grip"}
    assert values["statuses"] == {"link grip": "renamed"}
    assert values["against"] == "HEAD"


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
    page, paths, simplify = report(), list[str](), UrdfDomain.triangles
    before, large = page.read_bytes(), re.findall(told, read(page).words)
    assert len(large) > 1

    def triangles(domain: UrdfDomain, path: str, *rest: Any) -> Triangles | str:
        paths.append(path)
        return simplify(domain, path, *rest)

    monkeypatch.setattr(UrdfDomain, "triangles", triangles)
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


def test_the_page_is_where_it_is_wanted_and_replaces_nothing_else(arm: Path, execute: Execute) -> None:
    assert "page: arm.html" in execute("report").out
    assert execute("report", "--json").json["results"][0]["bytes"] == Path("arm.html").stat().st_size
    Path("arm.html").write_text("<p>mine</p>")
    assert "urdfsync did not write it" in execute("report", code=Exit.ERROR).err
    assert Path("arm.html").read_text() == "<p>mine</p>"
    assert "a page's name ends with .html" in execute("report", "--output", "arm.urdf", code=Exit.ERROR).err
    assert "there is no such folder" in execute("report", "--output", "none/arm.html", code=Exit.ERROR).err


def test_a_source_that_can_not_be_read_writes_no_page(arm: Path, execute: Execute) -> None:
    arm.write_text("<robot>")
    assert "error" in execute("report", code=Exit.ERROR).err
    assert not Path("arm.html").exists()


def test_a_check_has_its_verdict_and_a_scale_for_each_difference(arm: Path, tmp_path: Path) -> None:
    loaded = config.load(Path("urdfsync.toml"))
    content = gather(loaded, loaded.robots[0], None, BuildOptions(), tmp_path)
    right = Deviation(Quantity.EFFORT, "joint elbow", 1e-13, 20.0, 100.0, "N·m")
    wrong = Deviation(Quantity.POSITION, "link <b>hand</b>", math.nan, 1.0, 1.0, "m")
    effect = EditEffect(("Joints/Elbow.mo",), (Deviation(Quantity.EFFORT, "joint elbow", 0.67, 20.0, 100.0, "N·m"),))
    tool = ToolResult("rumoca", deviations=(right, wrong), effects=(effect,))
    page = _Elements(page_of(content, check=CheckResult("arm", "Arm", tools=(tool,), reference="Pinocchio 3")).decode())
    meters = [each for tag, each in page.tags if tag == "meter"]
    assert [each["value"] for each in meters] == ["0.0", "-15.0"]  # the worst first
    assert meters[0]["high"] == "-10.0"
    assert "link <b>hand</b>" in page.words
    assert "Joints/Elbow.mo" in page.words
    assert "0.67 N·m" in page.words


def test_what_a_check_found_of_this_package_is_told(arm: Path, report: Report, monkeypatch: pytest.MonkeyPatch) -> None:
    kept = CheckResult("arm", "Arm", tools=(ToolResult("rumoca", (CompiledModel("Arm", 7),)),))
    asked = list[str]()

    def load(_: UserCache, key: str, kind: type) -> CheckResult | None:
        if kind is CheckResult:  # meshes are remembered, too
            asked.append(key)
        return kept if kind is CheckResult and len(asked) == 2 else None

    monkeypatch.setattr(UserCache, "load", load)
    page = read(report())
    assert len(set(asked)) == 2  # with physics, and without
    assert "Check" in page.words
    assert "1 model compiles" in page.words


def test_a_domain_without_a_picture_says_so(project: Path, execute: Execute) -> None:
    assert "have no picture" in execute("report", code=Exit.ERROR).err


@pytest.mark.skipif(not shutil.which("node"), reason="no node to look at the scripts with")
def test_the_scripts_are_sound(tmp_path: Path) -> None:
    folder = Path(page_module.__file__).parent
    assert {file.name for file in folder.glob("*.js")} == {*SCRIPTS, FOLLOWER}
    for name in (*SCRIPTS, FOLLOWER):
        checked = subprocess.run(["node", "--check", folder / name], capture_output=True, text=True, check=False)
        assert checked.returncode == 0, checked.stderr
        assert (folder / name).read_text("utf-8").startswith('"use strict";\n')
