"""A month of work: edits in every model of a package, and then the next export of the robot."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from random import Random

import pytest
from support.commands import Execute
from support.hand_edits import EDITS, MARK
from support.modelica import compile_task
from support.modelica import execute as compile_all
from support.printer import STYLES, Style, resaved
from support.urdfs import dynamics, joint, link, links, robot

from urdfsync.urdf.names import identify

PACKAGE = Path("modelica/Arm")
MODELS = ("Links/Upper_arm.mo", "Joints/Shoulder.mo", "Arm.mo", "ArmRun.mo", "ArmTest.mo")


def turn(name: str, parent: str, child: str, *inside: str) -> str:
    return joint(name, "revolute", parent, child, axis="0 1 0", inside=inside)


def export(*elements: str) -> None:
    Path("arm.urdf").write_text(robot(link("base"), *elements, name="arm"))


ARM = (
    *links(upper_arm=11.5, forearm=11.5),
    *(turn("shoulder", "base", "upper_arm"), turn("elbow", "upper_arm", "forearm")),
)
VISUAL = '<visual><geometry><box size="0.4 0.05 0.05"/></geometry></visual>'
LARGER = (
    link("upper_arm", 11.5).replace("</link>", f"{VISUAL}</link>"),
    *links(forearm=11.5, hand=11.5),
    turn("shoulder", "base", "upper_arm", dynamics(0.5, 0.1)),
    *(turn("elbow", "upper_arm", "forearm"), turn("wrist", "forearm", "hand")),
)
"""The new export adds elements to each model: a visual, friction, a link with its joint, a drive."""


@pytest.fixture
def arm(folder: Path, execute: Execute) -> Path:
    """A project with an arm of two links, which is built."""
    export(*ARM)
    execute("init", "arm.urdf", "--merge")
    execute("build")
    return folder


def edit_all(edit: Callable[[str, Random], str | None]) -> dict[str, str]:
    """Edit every model, and return the edited texts."""
    edited = {name: edit((PACKAGE / name).read_text(), Random(3)) for name in MODELS}
    texts = {name: text for name, text in edited.items() if text is not None}
    for name, text in texts.items():
        (PACKAGE / name).write_text(text)
    return texts


def assert_larger() -> None:
    """Every model has the elements that the larger arm adds."""
    new = ("visual", "friction", "Joints.Wrist wrist", "wrist_phi", "wrist")
    for name, words in zip(MODELS, new, strict=True):
        assert words in (PACKAGE / name).read_text(), name


@pytest.mark.parametrize("kind", ["add a component", "add an equation", "move a part"])
def test_what_a_hand_adds_or_moves_meets_what_cad_adds(arm: Path, execute: Execute, kind: str) -> None:
    edited = edit_all(EDITS[kind])
    assert len(edited) == len(MODELS)
    export(*LARGER)
    assert f"{len(MODELS)} merged with your edits" in execute("build").lines[0]
    assert_larger()
    for name, text in edited.items():
        now = (PACKAGE / name).read_text()
        for line in text.splitlines():
            assert MARK not in line or line in now.splitlines(), name


@pytest.mark.parametrize("style", STYLES.values(), ids=STYLES)
def test_what_an_editor_saves_again_is_no_edit_of_a_name_or_number(arm: Path, execute: Execute, style: Style) -> None:
    edit_all(lambda text, _: resaved(text, style))
    export(*LARGER)
    assert "conflict" not in execute("build").lines[0]
    assert_larger()


def test_a_mass_by_hand_meets_the_rounding_of_cad(arm: Path, execute: Execute) -> None:
    record = PACKAGE / "Links/Upper_armParameters.mo"
    record.write_text(record.read_text().replace("mass = 11.5", "mass = 99"))
    export(link("upper_arm", 11.50000001), *ARM[1:])
    execute("build")
    assert "mass = 99" in record.read_text()


@pytest.mark.parametrize("command", [["build"], ["resolve", "--all", "--merge", "--prefer", "mine"]])
def test_a_model_that_is_not_utf_8_is_one_error(arm: Path, execute: Execute, command: list[str]) -> None:
    path = PACKAGE / "Arm.mo"
    edited = path.read_bytes().replace(b'"Robot Arm"', b'"Gelenk \xe4"')
    path.write_bytes(edited)
    export(*LARGER)
    (error,) = [line for line in execute(*command, code=2).err.splitlines() if "error:" in line]
    assert error.startswith(f"{path}:3: error: the file is not UTF-8, which Modelica demands; save it as UTF-8")
    assert path.read_bytes() == edited
    assert not (PACKAGE / "Links/Hand.mo").exists()


@pytest.mark.slow
def test_what_is_kept_compiles(arm: Path, execute: Execute, modelica_library: Path) -> None:
    model = PACKAGE / "Arm.mo"
    model.write_text(model.read_text().replace('"Link \\"forearm\\""', '"The light one"'))
    assert "The light one" in model.read_text()
    export(*links(upper_arm=11.5, hand=11.5), turn("shoulder", "base", "upper_arm"), turn("wrist", "upper_arm", "hand"))
    execute("build", code=3)
    assert "which modelica/Arm/ArmTest.mo:" in execute("resolve", "--all", "--keep", code=3).err, "its bench is not"
    assert (PACKAGE / "Links/Forearm.mo").exists()
    (outcome,) = compile_all(modelica_library, [PACKAGE.absolute()], [compile_task("Arm.Arm")])
    assert not outcome.error


def test_a_connection_follows_its_part_although_another_one_takes_its_name(folder: Path, execute: Execute) -> None:
    export(link("hand", 11.5), turn("hand", "base", "hand"))
    execute("init", "arm.urdf", "--merge")
    execute("build")
    model = PACKAGE / "Arm.mo"
    twins = {
        kind: identify([("link", "hand"), ("joint", "hand")])[kind, "hand"].component for kind in ("link", "joint")
    }
    assert set(twins.values()) <= set(re.findall(r"\w+", model.read_text()))
    sensor = "Modelica.Mechanics.MultiBody.Sensors.AbsoluteSensor imu;"
    connection = f"connect(imu.frame_a, {twins['link']}.frame_a);"
    edited = model.read_text().replace("\nequation", f"\n  {sensor}\n\nequation\n  {connection}", 1)
    model.write_text(edited)
    export(link("hand_link", 11.5), turn("hand", "base", "hand_link"))
    execute("build")
    assert "connect(imu.frame_a, hand_link.frame_a);" in model.read_text()
    assert twins["joint"] not in model.read_text()


@pytest.mark.slow
def test_what_is_kept_and_lacks_what_the_others_use_is_told(arm: Path, execute: Execute) -> None:
    configuration = Path("urdfsync.toml")
    configuration.write_text(configuration.read_text().replace('on_conflict = "merge"', 'on_conflict = "keep"'))
    model = PACKAGE / "Arm.mo"
    model.write_text(model.read_text().replace('"Mass of the whole robot"', '"My mass"'))
    export(*LARGER)
    execute("build", code=3)
    for arguments, code in ((["resolve", str(model), "--keep"], 3), (["build"], 3), (["status"], 1)):
        said = "it has no `wrist`, which modelica/Arm/ArmTest.mo:"
        assert said in execute(*arguments, code=code).err
    execute("resolve", str(model), "--take")
    assert execute("build").err == ""


@pytest.mark.slow
def test_what_met_compiles(arm: Path, execute: Execute, modelica_library: Path) -> None:
    for kind in ("add a component", "add an equation", "move a part", "save again in another style"):
        edit_all(EDITS[kind])
    export(*LARGER)
    execute("build")
    assert_larger()
    tasks = [compile_task(f"Arm.{name}") for name in ("ArmRun", "ArmTest")]
    outcomes = compile_all(modelica_library, [PACKAGE.absolute()], tasks)
    assert [outcome.error for outcome in outcomes] == ["", ""]
