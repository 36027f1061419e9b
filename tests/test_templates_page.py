"""The page on templates of one's own: the tests follow its instructions, and builds keep its promises."""

from __future__ import annotations

import re
import shutil
import subprocess
import textwrap
from pathlib import Path

import pytest
from support.corpus import REPOSITORY
from support.modelica import Run, Task, simulate
from support.urdfs import joint, links, robot

from urdfsync.commands import cli
from urdfsync.engine.result import Exit

PAGE = REPOSITORY / "docs" / "templates.md"
TEMPLATE = "link/model.mo.jinja"
ARM = REPOSITORY / "modelica/UrdfSync/Resources/robots/six_axis_arm"
SHORT_ARM = robot(
    *links(base_link=4.0, forearm=1.0),
    joint("elbow", "revolute", "base_link", "forearm", axis="0 0 1"),
)


def block(language: str, containing: str) -> str:
    """The only code block of the page in a language that contains a text."""
    blocks = re.findall(rf"^( *)```{language}\n(.*?)^\1```$", PAGE.read_text("utf-8"), re.DOTALL | re.MULTILINE)
    (found,) = [textwrap.dedent(text) for _, text in blocks if containing in text]
    return found


def project(folder: Path, configuration: str) -> Path:
    """A project with the six-axis arm."""
    shutil.copytree(ARM, folder)
    (folder / "urdfsync.toml").write_text(configuration, encoding="utf-8")
    return folder


def marked_project(folder: Path) -> Path:
    """A project with the arm and the template of the page."""
    project(folder, block("toml", "templates"))
    copy = folder / "templates" / TEMPLATE
    copy.parent.mkdir(parents=True)
    shutil.copyfile(REPOSITORY / "templates" / "urdf" / TEMPLATE, copy)
    (folder / "marker.patch").write_text(block("diff", "marker"), encoding="utf-8")
    subprocess.run(["git", "apply", "marker.patch"], cwd=folder, check=True)
    return folder


def build(folder: Path) -> Path:
    """Build a project by the command; return its package."""
    assert cli.main(["build", "--config", str(folder / "urdfsync.toml")]) == Exit.IN_STEP
    return folder / "modelica" / "Arm"


@pytest.fixture(scope="module")
def default(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The package without templates of one's own."""
    configuration = block("toml", "templates").replace('templates = "templates"\n', "")
    return build(project(tmp_path_factory.mktemp("default") / "arm", configuration))


@pytest.fixture(scope="module")
def marked(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The package that the page builds."""
    return build(marked_project(tmp_path_factory.mktemp("marked") / "arm"))


def models(package: Path, kind: str) -> dict[str, str]:
    """The models of links or joints, without their records, by name."""
    files = (file for file in (package / kind).glob("*.mo") if not file.stem.endswith("Parameters"))
    return {file.stem: file.read_text("utf-8") for file in files if file.stem != "package"}


def test_every_link_has_the_marker(default: Path, marked: Path) -> None:
    plain, links = models(default, "Links"), models(marked, "Links")
    assert links.keys() == plain.keys()
    assert len(links) > 10
    for declared in ("Frame_b marker\n", "connect(markerPlace.frame_b, marker)\n"):
        assert [name for name, text in links.items() if text.count(declared) != 1] == []
        assert [name for name, text in plain.items() if declared in text] == []


def test_nothing_but_the_models_of_links_has_changed(default: Path, marked: Path) -> None:
    before, after = (
        {file.relative_to(package): file.read_bytes() for file in package.rglob("*") if file.is_file()}
        for package in (default, marked)
    )
    assert before.keys() == after.keys()
    changed = {path for path in before if before[path] != after[path]}
    assert changed == {Path("Links", f"{name}.mo") for name in models(default, "Links")}
    assert Path("Joints/Elbow.mo") in before


@pytest.mark.slow
def test_the_sensor_measures_the_marker_where_the_extension_puts_it(tmp_path: Path, modelica_library: Path) -> None:
    """An arm that ends with the forearm."""
    folder = marked_project(tmp_path / "arm")
    (folder / ARM.with_suffix(".urdf").name).write_text(SHORT_ARM)
    # rumoca loads no package for a text unless the text imports it
    imports = "  import Modelica;\n  import UrdfSync;\n  import Arm;\n"
    source = block("modelica", "Tracked").replace("  import Modelica;\n", imports, 1)
    places = {"seen": "robot.seen.r", "link": "robot.forearm.frame_a.r_0"}
    values = [f"{place}[{i}]" for place in places.values() for i in (1, 2, 3)]
    turned = [f"robot.forearm.frame_a.R.T[{i},{j}]" for i in (1, 2, 3) for j in (1, 2, 3)]
    (series,) = simulate(modelica_library, [build(folder)], [Task(source, "Tracked", [Run(1, 1)], [*values, *turned])])
    at = {name: series.end(*(f"{place}[{i}]" for i in (1, 2, 3))) for name, place in places.items()}
    rotation = series.end(*turned).reshape(3, 3)
    assert rotation @ (at["seen"] - at["link"]) == pytest.approx([0.1, 0.04, 0.05], abs=1e-9)
