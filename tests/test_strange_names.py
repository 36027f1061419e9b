"""Files and folders whose names are not UTF-8: at most one error of their robot."""

from __future__ import annotations

import json
import os
import sys
from pathlib import Path

import pytest
from support.commands import Execute

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="only Linux has such names")

NAME = os.fsdecode(b"b\xffd")
URDF = '<robot name="{0}"{1}><link name="base"/></robot>'
CONFIG = "".join(f'[robots.{name}]\nsource = "{name}.urdf"\npackage = "{name.title()}"\n' for name in ("one", "other"))


@pytest.fixture
def project(folder: Path) -> Path:
    for name in ("one", "other"):
        Path(f"{name}.urdf").write_text(URDF.format(name, ""))
    Path("urdfsync.toml").write_text(CONFIG)
    return folder


@pytest.mark.parametrize("file", [f"{NAME}.mo", f"modelica/One/{NAME}.mo", f"modelica/One/{NAME}/package.mo"])
def test_sarif_has_all_results(project: Path, execute: Execute, file: str) -> None:
    execute("build", "--quiet")
    Path(file).parent.mkdir(exist_ok=True)
    Path(file).write_text("model X\n  One.Nothing nothing;\nend X;\n")
    (run,) = json.loads(execute("build", "--check", "--format", "sarif").out)["runs"]
    uris = {result["locations"][0]["physicalLocation"]["artifactLocation"]["uri"] for result in run["results"]}
    assert file.replace(NAME, "b%FFd") in uris


def test_a_model_of_the_users_may_use_a_robot_beside_others(project: Path, execute: Execute) -> None:
    execute("build", "--quiet")
    for file in (f"{NAME}.mo", "Bench.mo"):
        Path(file).write_text("model X\n  One.Nothing nothing;\nend X;\n")
    execute("build", "--quiet")
    Path("Words.mo").write_text("model Words\nend Words;\n")
    said = execute("build").errors
    assert [line.partition(":")[0] for line in said] == ["Bench.mo", "b\\udcffd.mo"]


def test_a_template_is_stray_and_nothing_else(project: Path, execute: Execute) -> None:
    Path("templates").mkdir()
    Path(f"templates/{NAME}.jinja").write_text("")
    Path("urdfsync.toml").write_text(CONFIG + 'templates = "templates"\n')
    (line,) = (line for line in execute("build").errors if "templates" in line)
    assert "[stray-template]" in line


def test_a_folder_that_xacro_can_not_name_is_an_error_of_its_robot(
    project: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch
) -> None:
    (project / NAME).mkdir()
    monkeypatch.chdir(project / NAME)
    Path("one.xacro").write_text(URDF.format("one", ' xmlns:xacro="http://www.ros.org/wiki/xacro"'))
    Path("other.urdf").write_text(URDF.format("other", ""))
    Path("urdfsync.toml").write_text(CONFIG.replace("one.urdf", "one.xacro"))
    said = execute("build", code=2)
    assert "one.xacro: error: a text or a path that it works with is not UTF-8; rename its folders" in said.err
    assert "other: 9 files written" in said.out
