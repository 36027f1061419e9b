"""Generated packages compile and are balanced: robot, Run and Test of every robot of the corpus, and odd names."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import pytest
from support import corpus, nasty
from support.modelica import Task, compile_task, execute
from support.packages import Package, generate, proposed_base

from urdfsync.domain import Target
from urdfsync.modelica.names import class_name

MANY_JOINTS = 3
"""Larger ones take long, and their robots are compiled for the comparison with Pinocchio anyway."""
FAULTY = {"robots/random/spot_ros/spot_description/urdf/spot_arm.urdf"}
"""Without a package: see the tests of the reader."""


def _cases() -> list[object]:
    return [
        pytest.param(file, id=corpus.label(file), marks=pytest.mark.large if joints > MANY_JOINTS else pytest.mark.slow)
        for file, joints in corpus.moving_joints().items()
        if file not in FAULTY
    ]


def tasks(package: Package) -> Sequence[Task]:
    """One task for the robot and for each of its benches."""
    name = f"{package.target.package}.{package.target.name}"
    return [compile_task(name + suffix) for suffix in ("", "Run", "Test")]


@pytest.mark.parametrize("file", _cases())
def test_robot_and_benches_compile(file: str, corpus: Path, modelica_library: Path, tmp_path: Path) -> None:
    """Stationary or mobile, as `init` proposes; a model that is not balanced does not compile."""
    name = class_name(Path(file).stem)
    package = generate(corpus / file, Target(name, name), base=proposed_base((corpus / file).read_bytes()))
    outcomes = execute(modelica_library, [package.write(tmp_path)], tasks(package))
    assert [outcome.error for outcome in outcomes] == ["", "", ""]


@pytest.mark.slow
def test_nasty_names_compile(modelica_library: Path, tmp_path: Path) -> None:
    package = generate(nasty.write(tmp_path / "source"), nasty.TARGET)
    (tmp_path / "Plant").mkdir()
    (tmp_path / "Plant" / "package.mo").write_text("within;\npackage Plant\nend Plant;\n")
    package.write(tmp_path)
    (outcome,) = execute(modelica_library, [tmp_path / "Plant"], [compile_task("Plant.Nasty.NastyTest")])
    assert outcome.error == ""
