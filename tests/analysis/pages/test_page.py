"""The page as text: one file, whose policy names its scripts, and in which no text of a source is markup."""

from __future__ import annotations

import base64
import hashlib
import math
import re
import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path
from xml.sax.saxutils import quoteattr

import pytest
from support.pages import Elements, data_of, read
from support.urdfs import link, robot

from urdfsync.analysis.checks.cache import UserCache
from urdfsync.analysis.checks.results import CheckResult, CompiledModel, EditEffect
from urdfsync.analysis.pages import page as page_module
from urdfsync.analysis.pages.content import gather
from urdfsync.analysis.pages.page import FOLLOWER, SCRIPTS
from urdfsync.analysis.pages.page import page as page_of
from urdfsync.commands import cli
from urdfsync.domain.experiment import Deviation, Quantity
from urdfsync.engine.options import BuildOptions
from urdfsync.project import config

Report = Callable[..., Path]
STILL = '<robot name="still"><link name="only"/></robot>'


@pytest.mark.slow
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


def test_no_tick_stands_above_findings(report: Report) -> None:
    """A robot of 2 t in step is in doubt; without findings it is fine."""
    heavy = robot(link("only", 2000))
    for urdf, mark in ((STILL, "fine"), (heavy, "open")):
        report(urdf)
        assert cli.main(["build"]) == 0
        page = read(report(urdf))
        assert [each["class"] for tag, each in page.tags if tag == "p" and "summary" in str(each.get("class"))] == [
            f"summary {mark}"
        ]


@pytest.mark.slow
def test_no_heading_stands_twice(arm: Path, report: Report) -> None:
    report()
    cli.main(["build", "--quiet"])
    for file in ("Links/ForearmParameters.mo", "Links/WristParameters.mo"):
        path = Path("modelica/Arm", file)
        path.write_text(path.read_text().replace("mass = ", "mass = 1 + "))
    arm.write_text(arm.read_text().replace('<mass value="15.5"/>', '<mass value="15.6"/>'))
    text = report().read_text("utf-8")
    sections = re.findall(r'<section id="([\w-]+)".*?>(.*?)</section>', text, re.DOTALL)
    headings = {name: re.findall(r"<(?:h2|caption)>(.*?)<", inner) for name, inner in sections}
    assert headings["changes"] == ["What changed", "Effects", "Files", "In numbers"]
    assert headings["edits"] == ["Your edits"]
    assert headings["findings"] == ["Findings"]
    assert [inner.count("<thead>") for name, inner in sections if name == "edits"] == [1]


def test_the_page_names_the_licence_of_three_js_and_what_wrote_it(report: Report) -> None:
    page = read(report(STILL))
    assert re.search(r"three\.js r\d+ \(Copyright .*; SPDX-License-Identifier: MIT\)", page.words)
    assert any(
        str(each.get("content")).startswith("urdfsync ") for _, each in page.tags if each.get("name") == "generator"
    )


@pytest.mark.slow
def test_the_six_axis_arm_has_less_than_3_mb(arm: Path, report: Report) -> None:
    assert report().stat().st_size < 3_000_000


@pytest.mark.slow
def test_a_check_has_its_verdict_and_a_scale_for_each_difference(arm: Path, tmp_path: Path) -> None:
    loaded = config.load(Path("urdfsync.toml"))
    content = gather(loaded, loaded.robots[0], None, BuildOptions(), tmp_path)
    right = Deviation(Quantity.EFFORT, "joint elbow", 1e-13, 20.0, 100.0, "N·m")
    wrong = Deviation(Quantity.POSITION, "link <b>hand</b>", math.nan, 1.0, 1.0, "m")
    effect = EditEffect(("Joints/Elbow.mo",), (Deviation(Quantity.EFFORT, "joint elbow", 0.67, 20.0, 100.0, "N·m"),))
    check = CheckResult("arm", "Arm", deviations=(right, wrong), effects=(effect,), reference="Pinocchio 3")
    page = Elements(page_of(content, check=check).decode())
    meters = [each for tag, each in page.tags if tag == "meter"]
    assert [each["value"] for each in meters] == ["0.0", "-15.0"]  # the worst first
    assert meters[0]["high"] == "-10.0"
    assert "link <b>hand</b>" in page.words
    assert "Joints/Elbow.mo" in page.words
    assert "0.67 N·m" in page.words


@pytest.mark.slow
def test_what_a_check_found_of_this_package_is_told(arm: Path, report: Report, monkeypatch: pytest.MonkeyPatch) -> None:
    kept = CheckResult("arm", "Arm", compiled=(CompiledModel("Arm", 7),))
    asked = list[str]()

    def load(_: UserCache, key: str, kind: type) -> CheckResult | None:
        if kind is CheckResult:  # meshes are remembered, too
            asked.append(key)
        return kept if kind is CheckResult and len(asked) == 2 else None

    monkeypatch.setattr(UserCache, "load", load)
    assert cli.main(["build", "--quiet"]) == 0
    page = read(report())
    assert len(set(asked)) == 2  # with physics, and without
    assert "Check" in page.words
    assert "1 model compiles" in page.words


@pytest.mark.slow
@pytest.mark.skipif(not shutil.which("node"), reason="no node to look at the scripts with")
def test_the_scripts_are_sound(tmp_path: Path) -> None:
    folder = Path(page_module.__file__).parent
    assert {file.name for file in folder.glob("*.js")} == {*SCRIPTS, FOLLOWER}
    for name in (*SCRIPTS, FOLLOWER):
        checked = subprocess.run(["node", "--check", folder / name], capture_output=True, text=True, check=False)
        assert checked.returncode == 0, checked.stderr
        assert (folder / name).read_text("utf-8").startswith('"use strict";\n')
