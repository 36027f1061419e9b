"""Elements of a robot that go or are renamed, and a user's models of it: what a build says, from URDF to message."""

from __future__ import annotations

from pathlib import Path

import pytest
from support.urdfs import joint, limit, link, robot

from urdfsync import config
from urdfsync.engine.build import build
from urdfsync.engine.options import BuildOptions

BASE = (link("base", 3.0), link("upper", 2.0), joint("shoulder", "revolute", "base", "upper", inside=[limit()]))
MINE = """\
model MyArm "An arm with a payload at its hand"
  extends Plant.Arm.Arm(elbow(animation = false));
  Modelica.Mechanics.MultiBody.Parts.Body payload;
equation
  connect(hand.frame_a, payload.frame_a);
end MyArm;
"""
BENCH = """\
model MyBench
  extends Plant.Arm.ArmTest;
  parameter Plant.Arm.Joints.ElbowParameters numbers;
  Real phi = robot.elbow.revolute.phi;
end MyBench;
"""
OTHER = "model Other\n  Plant.Arm.Arm arm;\n  Real elbow = 1, x = elbow;\nend Other;\n"


@pytest.fixture
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A built robot with an elbow and a hand, and models of the user's beside its package; the output folder."""
    monkeypatch.chdir(tmp_path)
    text = '[robots.arm]\nsource = "arm.urdf"\npackage = "Plant.Arm"\ncreate_parents = true\ncross_check = false\n'
    (tmp_path / "urdfsync.toml").write_text(text)
    assert built("elbow", "hand") == []
    for name, model in (("MyArm", MINE), ("MyBench", BENCH), ("Other", OTHER)):
        (tmp_path / "modelica" / f"{name}.mo").write_text(model)
    return tmp_path / "modelica"


def built(*names: str) -> list[str]:
    """What a build says of lost names, of a robot with a third link, if its joint and it have these names."""
    more = (link(names[1], 0.7), joint(names[0], "revolute", "upper", names[1], inside=[limit()])) if names else ()
    Path("arm.urdf").write_text(robot(*BASE, *more))
    loaded = config.load(Path("urdfsync.toml").absolute())
    (result,) = build(loaded, loaded.robots, BuildOptions())
    assert not result.failed
    assert not result.conflicts
    found = (one for one in result.diagnostics if one.code == "vanished-name")
    return [f"{Path(one.file).name}:{one.line}: {one.message}; {one.hint}" for one in found]


def test_uses_of_what_goes_are_named_and_its_record_stays(project: Path) -> None:
    hint = "adapt your text to what the package is now"
    assert built() == [
        f"MyArm.mo:2: `elbow` is used here, but the package has no `elbow` any more; {hint}",
        f"MyArm.mo:5: `hand.frame_a` is used here, but the package has no `hand` any more; {hint}",
        f"MyBench.mo:4: `robot.elbow.revolute.phi` is used here, but the package has no `elbow` any more; {hint}",
    ]
    record = project / "Plant" / "Arm" / "Joints" / "ElbowParameters.mo"
    assert record.exists()
    assert not record.with_name("Elbow.mo").exists()
    assert built() == []
    assert record.exists()
    (project / "MyBench.mo").unlink()
    assert built() == []
    assert not record.exists()


def test_uses_of_what_is_renamed_get_the_new_names(project: Path) -> None:
    found = built("wrist", "tool")
    assert [line.rpartition("; ")[2] for line in found] == [
        "it is `wrist` now",
        "it is `tool` now",
        "it is `WristParameters` now",
        "it is `wrist` now",
    ]
    assert not (project / "Plant" / "Arm" / "Joints" / "ElbowParameters.mo").exists()
